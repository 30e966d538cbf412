# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where rendered tips end, whose camera is known exactly."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.rim import SECTORS, UNSEEN, Rim
from tactile_push.tactile.rim_step import RimStep
from tactile_push.tactile.touched_region import mean_image

F = 110.0  # focal length [px]
VIEW = DomeView(width=320, height=240, focal_length=F, defocus=2.0, dead=0.05)
CAMERA = DomeCamera(
    *(320, 240, (159.5, 119.5), (math.pi, 0.0, 0.0)),
    *((F, -F / 24.0, F / 1920.0), (0.0, 0.0, -1.0)),  # of 2 f sin(alpha/2)
)


def reference(view, seed=0):
    dome = DomeImages(view, seed)
    return mean_image(dome.image(NO_CONTACT) for _ in range(10))


@pytest.fixture(scope='module')
def calibrated():
    return Rim(CAMERA).profile(reference(VIEW))


def test_tip_ends_at_its_rim_all_around():
    found = np.degrees(RimStep(CAMERA).elevations(reference(VIEW)))
    assert len(found) == SECTORS
    assert abs(found).max() < 1.0


def test_dark_waveguide_has_no_step():
    assert set(RimStep(CAMERA).elevations(reference(replace(VIEW, skin=0.0)))) == {UNSEEN}


def differs(calibrated, **changes):
    return calibrated.difference(Rim(CAMERA).profile(reference(replace(VIEW, **changes), seed=1)))


@pytest.mark.parametrize('changes', [{}, {'skin': 60.0}, {'defocus': 5.0}, {'vignetting': 0.6}])
def test_lamps_that_age_and_a_lens_out_of_focus_are_no_other_tip(calibrated, changes):
    assert differs(calibrated, **changes) == ''


@pytest.mark.parametrize(
    'changes',
    [
        {'principal_point': (4.0, 0.0)},  # the camera was shifted
        {'turned': (0.0, 0.04, 0.0)},  # and tilted
        {'eye': (0.0, 0.0, -1.1)},  # and sank; or the tip is smaller
        {'focal_length': 1.05 * F},  # another lens
    ],
)
def test_camera_that_moved_or_a_tip_of_another_size_is_noticed(calibrated, changes):
    assert 'off its place in the calibration' in differs(calibrated, **changes)


def test_much_larger_tip_is_noticed(calibrated):
    assert differs(calibrated, focal_length=1.3 * F).startswith('the rim is ')
