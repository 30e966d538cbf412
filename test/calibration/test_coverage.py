# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.calibration.coverage import (
    check_coverage,
    in_words,
    missing_regions,
    suggested_touches,
)
from tactile_push.tactile.sphere import directions_of


def at(*degrees):
    """Return directions of azimuths and elevations in degrees."""
    azimuth, elevation = np.radians(np.reshape(degrees, (-1, 2))).T
    return directions_of(azimuth, elevation)


EACH = [
    *((0.0, 85.0), (10.0, 60.0), (80.0, 60.0), (-170.0, 60.0), (-80.0, 60.0)),
    *((10.0, 40.0), (80.0, 40.0), (-170.0, 40.0), (-80.0, 40.0)),
    *((10.0, 20.0), (100.0, 20.0), (170.0, 20.0), (-100.0, 20.0)),
]


def test_one_touch_in_each_region_covers_the_tip():
    assert missing_regions(at(*EACH)) == []
    check_coverage(at(*EACH))


@pytest.mark.parametrize(
    ('left_out', 'region'),
    [
        (0, 'pole, elevation 75° to 90°'),
        (1, 'left, elevation 50° to 75°'),
        (7, 'right, elevation 25° to 50°'),
        (10, 'up, elevation 0° to 25°'),
        (12, 'down, elevation 0° to 25°'),
    ],
)
def test_region_without_a_touch_is_named(left_out, region):
    assert missing_regions(at(*np.delete(EACH, left_out, 0))) == [region]


def test_without_touches_all_regions_are_missing():
    assert len(missing_regions(np.empty((0, 3)))) == len(EACH)


@pytest.mark.parametrize('touches', [[], at(*(EACH[:5] * 3))])
def test_touches_that_are_badly_spread_are_refused(touches):
    with pytest.raises(ValueError, match='none at .*left, elevation 0° to 25°; up, elevation 0°'):
        check_coverage(touches)


def test_suggested_touches_cover_the_tip():
    azimuth, elevation = np.array(suggested_touches()).T
    check_coverage(directions_of(azimuth, elevation))
    assert (abs(azimuth) <= math.pi).all()


@pytest.mark.parametrize(
    ('degrees', 'words'),
    [
        ((0.0, 90.0), 'pole, azimuth 0°, elevation 90°'),
        ((0.0, 38.0), 'left, azimuth 0°, elevation 38°'),
        ((180.0, 12.0), 'right, azimuth 180°, elevation 12°'),
        ((-180.0, 12.0), 'right, azimuth -180°, elevation 12°'),
        ((45.0, 62.0), 'left and up, azimuth 45°, elevation 62°'),
        ((-135.0, 62.0), 'right and down, azimuth -135°, elevation 62°'),
    ],
)
def test_places_have_words_as_seen_along_the_pole(degrees, words):
    assert in_words(*map(math.radians, degrees)) == words
