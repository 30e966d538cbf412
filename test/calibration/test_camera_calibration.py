# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.dome import CENTRE, SLOPE, place
from support.dome_touches import SIZE, write_folder
from tactile_push.calibration.camera_calibration import calibrate_camera
from tactile_push.calibration.camera_images import TouchImages, images_in_folder
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, Reading
from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.sphere import angles_between, directions_of
from tactile_push.tactile.touched_region import mean_image, touched_region

THRESHOLD = 12.0


@pytest.fixture(scope='module')
def images(tmp_path_factory):
    """Return images of touches on the small tip."""
    return images_in_folder(write_folder(tmp_path_factory.mktemp('dome') / 'images'))


@pytest.fixture(scope='module')
def calibration(images):
    """Return what they calibrate."""
    return calibrate_camera(images, THRESHOLD)


def test_touches_are_found_and_explained(calibration):
    for pixel, (azimuth, elevation) in zip(calibration.pixels, suggested_touches(), strict=True):
        assert pixel == pytest.approx(place(azimuth, elevation), abs=0.25)
    assert math.degrees(calibration.fit.rms) < 0.3


def test_camera_sees_the_pole_where_it_is_and_the_rim_as_far_away(calibration):
    camera = calibration.fit.camera
    assert camera.pixels([0.0, 0.0, 1.0]) == pytest.approx(CENTRE, abs=0.3)
    rim = camera.pixels(directions_of(np.linspace(-3.0, 3.0, 20), np.zeros(20)))
    away = np.hypot(*(rim - CENTRE).T)
    assert away == pytest.approx(SLOPE * math.pi / 2.0, abs=1.0)


def test_reach_is_that_of_the_outermost_touch(calibration):
    assert math.degrees(calibration.reach) == pytest.approx(78.0, abs=0.01)


def test_force_scale_explains_the_forces(calibration):
    # All touches are 5/36 rad wide, of which the threshold leaves the most part, at 1.5 N.
    area = math.pi * (SIZE / SLOPE) ** 2
    assert calibration.force_scale == pytest.approx(1.5 / area**1.5, rel=0.35)


def test_without_forces_there_is_no_scale(images):
    unknown = [touch._replace(normal_force=math.nan) for touch in images.touches]
    assert calibrate_camera(replace(images, touches=unknown), THRESHOLD).force_scale == 0.0


def test_rim_is_that_of_the_untouched_tip(calibration):
    # Levels of 90 (1 + 0.2 cos a + 0.1 cos 3 a), from azimuth -pi on.
    levels = calibration.rim.levels
    assert levels[0] == pytest.approx(90.0 * 0.7, abs=3.0)
    assert levels[len(levels) // 2] == pytest.approx(90.0 * 1.3, abs=3.0)


def test_image_without_a_touch_is_named(images):
    blank = replace(images, images=[*images.images[:-1], images.reference.astype(np.uint8)])
    with pytest.raises(ValueError, match=r'^touch_20.png: expected a touch, got an image like'):
        calibrate_camera(blank, THRESHOLD)


SPOILED = DomeView(
    width=320,
    height=240,
    focal_length=130.0,
    principal_point=(9.0, -6.0),
    eye=(0.1, 0.0, -1.0),
    turned=(0.3, 0.05, -0.03),
    defocus=3.0,
    vignetting=0.5,
    noise=0.02,
    dead=0.05,
)


@pytest.mark.slow
def test_spoiled_images_of_a_camera_beside_the_axis_give_directions_to_half_a_degree():
    dome = DomeImages(SPOILED, seed=3)
    reference = mean_image(dome.image(NO_CONTACT) for _ in range(10))
    known = [KnownTouch(*at, 1.0, '') for at in suggested_touches()]
    pictures = [dome.image(Reading(*touch[:3])) for touch in known]
    names = [str(number) for number in range(len(known))]
    camera = calibrate_camera(TouchImages(reference, pictures, known, names), THRESHOLD).fit.camera
    cut = CutRegions(camera)
    errors = []
    for number in range(30):
        azimuth, elevation = 2.4 * number % 6.2 - 3.1, math.asin(0.09 + 0.9 * number / 29.0)
        image = dome.image(Reading(azimuth, elevation, 0.5 + 0.05 * number))
        region = cut.completed(touched_region(image, reference, THRESHOLD, cut.dome))
        found = camera.directions((region.x, region.y))
        errors.append(angles_between(found, directions_of(azimuth, elevation)))
    assert math.degrees(np.sqrt(np.mean(np.square(errors)))) <= 0.5
