# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.parameters import CameraSensorParameters
from tactile_push.parameters.camera_sensor import make_image_finder
from tactile_push.parameters.simulated_camera import CALIBRATION, dome_view
from tactile_push.simulation.dome_image import DomeImages
from tactile_push.tactile import NO_CONTACT, Reading


@pytest.mark.parametrize(('azimuth', 'elevation'), [(0.0, 1.2), (2.0, 0.6), (-2.8, 0.35)])
def test_contacts_of_the_simulated_camera_are_found_where_they_are(azimuth, elevation):
    finder = make_image_finder(CameraSensorParameters(**CALIBRATION, reference_at_start=True))
    dome = DomeImages(dome_view(noise=0.02))
    for number in range(12):
        image = dome.image(NO_CONTACT)
        if number > 9:
            assert not finder.contact(image, 0.02 * number).reading.in_contact
            continue
        try:
            finder.contact(image, 0.02 * number)
        except ValueError as refused:
            assert str(refused) == 'no reference'
    found = finder.contact(dome.image(Reading(azimuth, elevation, 2.7)), 1.0).reading
    assert math.degrees(found.elevation - elevation) == pytest.approx(0.0, abs=0.5)
    apart = np.angle(np.exp(1j * (found.azimuth - azimuth))) * math.cos(elevation)
    assert math.degrees(apart) == pytest.approx(0.0, abs=0.5)
