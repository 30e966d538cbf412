# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.rim import SECTORS, UNSEEN, Rim, RimProfile

UPRIGHT, LENS, MIDDLE = (math.pi, 0.0, 0.0), (60.0, 0.0, 0.0), (0.0, 0.0, 0.0)
CAMERA = DomeCamera(200, 200, (100.0, 100.0), UPRIGHT, LENS, MIDDLE)
AZIMUTHS = -math.pi + (np.arange(SECTORS) + 0.5) * 2.0 * math.pi / SECTORS


def pattern(azimuth):
    return 100.0 + 20.0 * np.cos(azimuth - 0.7) + 10.0 * np.cos(3.0 * azimuth)


def image(turned=0.0):
    """Return an image whose brightness depends on the azimuth alone."""
    rows, columns = np.mgrid[:200, :200] - 100.0
    azimuth = math.pi + np.arctan2(rows, columns)
    return pattern(azimuth - turned).astype(np.float32)


def profile(levels):
    return RimProfile(tuple(levels))


def test_profile_has_the_levels_around_the_rim():
    found = Rim(CAMERA).profile(image())
    assert found.levels == pytest.approx(pattern(AZIMUTHS), abs=1.0)


def test_part_of_the_rim_that_the_image_does_not_show_is_0():
    cut = DomeCamera(200, 140, (100.0, 100.0), UPRIGHT, LENS, MIDDLE)
    found = Rim(cut).profile(image()[:140])
    down = int(np.argmin(abs(AZIMUTHS + math.pi / 2.0)))
    assert found.levels[down] == 0.0
    assert found.levels[SECTORS - 1 - down] > 80.0  # up


def test_dead_pixels_do_not_change_it():
    spoiled = image()
    dead = np.random.default_rng(1).random(spoiled.shape) < 0.05
    spoiled[dead] = 255.0
    assert Rim(CAMERA).profile(spoiled).levels == pytest.approx(pattern(AZIMUTHS), abs=2.0)


def test_the_same_rim_is_no_difference_however_bright():
    before = profile(pattern(AZIMUTHS))
    assert before.difference(profile(0.5 * pattern(AZIMUTHS))) == ''


@pytest.mark.parametrize('degrees', [40, 90, -90, 180])
def test_image_that_was_turned_is_recognised(degrees):
    before = Rim(CAMERA).profile(image())
    after = Rim(CAMERA).profile(image(math.radians(degrees)))
    said = before.difference(after)
    assert said == f'the image is turned by {degrees}° against the calibration'


def test_another_rim_is_not_the_same():
    other = profile(100.0 + 20.0 * np.cos(5.0 * AZIMUTHS))
    said = profile(pattern(AZIMUTHS)).difference(other)
    assert said.startswith('the rim does not look as calibrated: correlation')


def test_dark_rim_is_not_the_same():
    said = profile(pattern(AZIMUTHS)).difference(profile(np.zeros(SECTORS)))
    assert said == 'the rim does not look as calibrated: all alike around'


def test_rim_that_was_alike_all_around_tells_nothing():
    alike = profile(np.full(SECTORS, 100.0))
    assert alike.difference(profile(pattern(AZIMUTHS))) == ''


def placed(elevation, unseen=0, levels=None):
    """Return a rim that is seen at an elevation, but for some sectors."""
    elevations = [UNSEEN] * unseen + [elevation] * (SECTORS - unseen)
    return RimProfile(tuple(levels or [100.0] * SECTORS), tuple(elevations))


@pytest.mark.parametrize(
    ('before', 'now', 'words'),
    [
        (placed(0.01), placed(0.02), ''),
        (placed(0.01), placed(-0.03), 'the rim is 2.3° off its place in the calibration'),
        (placed(0.01, unseen=30), placed(0.05, unseen=10), 'the rim is 2.3° off'),
        (placed(0.01), placed(0.01, unseen=50), 'the rim is not seen where it was calibrated'),
        (placed(0.01, unseen=50), placed(0.05), ''),  # it was hardly seen
        (RimProfile((100.0,) * SECTORS), placed(0.05), ''),  # nobody looked
    ],
)
def test_rim_in_another_place_is_noticed_without_a_pattern(before, now, words):
    assert before.difference(now).startswith(words)
    assert bool(before.difference(now)) == bool(words)


def test_dirt_on_some_sectors_is_no_other_place():
    elevations = [0.15] * 20 + [0.0] * (SECTORS - 20)
    assert placed(0.0).difference(RimProfile((100.0,) * SECTORS, tuple(elevations))) == ''
