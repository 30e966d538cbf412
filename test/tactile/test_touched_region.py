# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.tactile.touched_region import NOTHING, mean_image, touched_region

SHAPE = (120, 160)
ROWS, COLUMNS = np.mgrid[: SHAPE[0], : SHAPE[1]].astype(float)
GREY = np.full(SHAPE, 80.0)
THRESHOLD = 12.0


def spot(x, y, radius, height):
    """Return a dome of brightness over a disk."""
    square = 1.0 - ((COLUMNS - x) ** 2 + (ROWS - y) ** 2) / radius**2
    return height * np.sqrt(np.maximum(square, 0.0))


def picture(levels, noise=0.0, dead=None, seed=0):
    noisy = levels + noise * np.random.default_rng(seed).standard_normal(SHAPE)
    image = np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
    if dead is not None:
        image[dead[0]], image[dead[1]] = 0, 255
    return image


def find(levels, where=None, threshold=THRESHOLD, **spoiled):
    reference = mean_image(picture(GREY, seed=seed, **spoiled) for seed in range(1, 11))
    return touched_region(picture(levels, **spoiled), reference, threshold, where)


@pytest.mark.parametrize('height', [80.0, -60.0])
def test_spot_is_found_where_it_is_whether_it_is_brighter_or_darker(height):
    found = find(GREY + spot(71.3, 52.6, 12.0, height))
    assert (found.x, found.y) == pytest.approx((71.3, 52.6), abs=0.1)
    assert found.area == pytest.approx(np.pi * 12.0**2, rel=0.15)
    assert found.changed == found.area


def test_noise_and_dead_pixels_hardly_move_it():
    random = np.random.default_rng(7).random(SHAPE)
    dead = random < 0.025, (random >= 0.025) & (random < 0.05)
    errors = []
    for number in range(20):
        x, y = 60.0 + 2.17 * number, 40.0 + 1.31 * number
        found = find(GREY + spot(x, y, 12.0, 80.0), noise=5.1, dead=dead)
        errors.append(np.hypot(found.x - x, found.y - y))
    # A pixel's noise of 5 levels on a mean change of 50 moves the mean of 450 pixels, which lie up
    # to 12 away, by 0.03 a direction; a twentieth of the pixels missing does by 0.06.
    assert np.sqrt(np.mean(np.square(errors))) < 0.2


def test_noise_alone_is_nothing():
    assert find(GREY, noise=5.1) == NOTHING


def test_the_largest_of_several_is_taken_and_all_are_counted():
    found = find(GREY + spot(40.0, 60.0, 8.0, 120.0) + spot(110.0, 60.0, 14.0, 60.0))
    assert (found.x, found.y) == pytest.approx((110.0, 60.0), abs=0.1)
    assert found.changed > found.area


def test_brighter_side_weighs_more():
    inside = (abs(COLUMNS - 80.0) <= 20.0) & (abs(ROWS - 60.0) <= 20.0)
    ramp = np.where(inside, 60.0 + 2.0 * (COLUMNS - 80.0), 0.0)
    # Over -20..20 the mean of x (60 + 2 x) over that of 60 + 2 x is 2 * 140 / 60.
    assert find(GREY + ramp).x == pytest.approx(80.0 + 2.0 * 140.0 / 60.0, abs=0.4)


def test_outside_of_where_to_look_there_is_nothing():
    where = COLUMNS < 80.0
    both = GREY + spot(40.0, 60.0, 8.0, 80.0) + spot(110.0, 60.0, 14.0, 80.0)
    assert find(both, where).x == pytest.approx(40.0, abs=0.1)
    assert find(GREY + spot(110.0, 60.0, 14.0, 80.0), where) == NOTHING


def test_change_below_the_threshold_is_nothing():
    assert find(GREY + spot(80.0, 60.0, 12.0, 10.0)) == NOTHING
    assert find(GREY + spot(80.0, 60.0, 12.0, 10.0), threshold=5.0).area > 0
