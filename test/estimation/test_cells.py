# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from itertools import product

import numpy as np
import pytest

from support.pushed_block import HALF, OUTLINE, RADIUS, pushed, pushed_above
from tactile_push.estimation.cells import (
    FACES,
    Bounds,
    Interval,
    cut_cells,
    hull,
    push_cells,
    split_cells,
    squared,
    times,
)
from tactile_push.mechanics import Slider, Support
from tactile_push.mechanics.resistance import Push


def box_around(rng, theta, d, c, mu_c):
    """Give a cell with the truth somewhere inside."""
    values = (theta, d + RADIUS * theta, c * c, math.atan(mu_c))
    widths = (0.02, 0.002, 1e-4, 0.3)
    cell = np.empty((1, FACES))
    for i, (value, width) in enumerate(zip(values, widths, strict=True)):
        below, above = rng.uniform(0.0, width, 2)
        cell[0, 2 * i], cell[0, 2 * i + 1] = value - below, value + above
    cell[0, 4] = max(cell[0, 4], 1e-6)
    cell[0, 6], cell[0, 7] = max(cell[0, 6], 0.0), min(cell[0, 7], math.pi / 2.0)
    return cell


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.5, math.inf])
@pytest.mark.parametrize(
    ('support', 'tilt'),
    [
        *((None, 0.0), ('corners', 0.0), ('rim', 0.0), ('uniform', 0.0)),
        *(('corners', 0.005), ('uniform', 0.005)),
    ],
)
@pytest.mark.parametrize('turning', [0.0, 0.1])  # of the finger's disk, at the most [rad/s]
def test_the_truth_stays_in_its_cell(mu_c, support, turning, tilt):
    rng = np.random.default_rng(3)
    for i in range(60):
        spin = turning * math.cos(i)
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.02, 0.02)
        v_x, share, angle = rng.uniform(-0.004, 0.004), 0.0, 0.0
        if support is None:
            slider = Slider(OUTLINE, rng.uniform(0.005, 0.036))
        else:
            count = () if support == 'corners' else (60,)
            made = getattr(Support, support)(OUTLINE, *count)
            slider = Slider.on(OUTLINE, made, exact=True, tilt=rng.uniform(0.0, tilt))
            share, angle = 0.6, math.radians(15.0)  # of this c, not of the best one
        cell = box_around(rng, theta, d, slider.c, mu_c)

        bounds = Bounds(
            Interval(-0.025, 0.025),
            Interval(HALF, HALF),
            Interval(RADIUS, RADIUS),
            0.0,
            share,
            angle,
            tilt,
        )
        left = push_cells(cell, Push(v_x, 0.005, 0.1, spin), bounds)

        theta, d = pushed(slider, theta, d, mu_c, v_x, spin=spin)
        assert left == 1
        assert cell[0, 0] <= theta <= cell[0, 1]
        assert cell[0, 2] <= d + RADIUS * (theta - 0.1 * spin) <= cell[0, 3]


@pytest.mark.parametrize('mu_c', [0.0, 0.2, 1.0, math.inf])
def test_an_object_that_turns_about_a_shifted_centre_stays_in_its_cell(mu_c):
    # An ellipsoid needs no liberties but the shift. Without this one it leaves the narrow cells.
    rng = np.random.default_rng(5)
    told, untold = 0, 0
    for _ in range(40):
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.015, 0.015)
        c, v_x = rng.uniform(0.01, 0.036), rng.uniform(-0.004, 0.004)
        shift = 0.008 * rng.uniform(0.0, 1.0)
        after, d_after = pushed_above(shift, theta, d, c, mu_c, v_x, duration=0.05)
        for tilt in (0.008, 0.0):
            values = theta, d + RADIUS * theta, c * c, math.atan(mu_c)
            cell = np.repeat(np.array([values]), 2, axis=1)
            bounds = Bounds(
                *(Interval(-0.025, 0.025), Interval(HALF, HALF), Interval(RADIUS, RADIUS)),
                *(0.0, 0.0, 0.0, tilt),
            )
            left = push_cells(cell, Push(v_x, 0.005, 0.05), bounds)
            inside = left == 1 and cell[0, 0] <= after <= cell[0, 1]
            inside = inside and cell[0, 2] <= d_after + RADIUS * after <= cell[0, 3]
            if tilt > 0.0:
                told += inside
            else:
                untold += inside
    assert told == 40
    assert untold < 10


@pytest.mark.parametrize('mu_c', [0.2, math.inf])
def test_a_wide_cell_holds_what_turns_about_a_shifted_centre(mu_c):
    # d is anywhere on a long edge near the centre of mass, where the shift counts most.
    rng = np.random.default_rng(6)
    long, l = Interval(-0.04, 0.04), 0.006
    for _ in range(40):
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.02, 0.02)
        c, v_x = rng.uniform(0.005, 0.01), rng.uniform(-0.004, 0.004)
        cell = np.array(
            [[theta, theta, -0.04 + RADIUS * theta, 0.04 + RADIUS * theta, c * c, c * c]]
        )
        cell = np.hstack([cell, [[0.0, math.atan(mu_c)]]])
        bounds = Bounds(*(long, Interval(l, l), Interval(RADIUS, RADIUS), 0.0, 0.0, 0.0, 0.004))

        left = push_cells(cell, Push(v_x, 0.005, 0.05), bounds)

        after, d_after = pushed_above(0.004, theta, d, c, mu_c, v_x, l, 0.05)
        assert left == 1
        assert cell[0, 0] <= after <= cell[0, 1]
        assert cell[0, 2] <= d_after + RADIUS * after <= cell[0, 3]


def test_a_sticking_contact_stays_in_its_cell_where_the_finger_moves_along_the_edge():
    rng = np.random.default_rng(4)
    slider = Slider(OUTLINE, 0.0187)
    for _ in range(60):
        theta, d = rng.uniform(1.5, 1.62), rng.uniform(-0.02, 0.02)
        cell = np.empty((1, FACES))
        values = (theta, d + RADIUS * theta, slider.c**2, math.pi / 2.0)
        for i, (value, width) in enumerate(zip(values, (1e-4, 1e-5, 1e-7, 0.0), strict=True)):
            cell[0, 2 * i], cell[0, 2 * i + 1] = value - width, value + width

        bounds = Bounds(
            *(Interval(-0.03, 0.03), Interval(HALF, HALF), Interval(RADIUS, RADIUS)),
            *(0.0, 0.3, math.radians(15.0)),
        )
        left = push_cells(cell, Push(0.0, 0.005, 0.1), bounds)

        theta, d = pushed(slider, theta, d, math.inf, 0.0)
        assert left == 1
        assert cell[0, 0] <= theta <= cell[0, 1]
        assert cell[0, 2] <= d + RADIUS * theta <= cell[0, 3]


def test_splitting_keeps_the_whole():
    cells = np.zeros((64, FACES))
    cells[0] = (0.1, 0.2, -0.03, 0.02, 2.5e-5, 1.3e-3, 0.0, math.pi / 2.0)
    whole = cells[0].copy()
    count = 1
    while count < 64:
        count = split_cells(cells, count, HALF, RADIUS, 0.0)

    sides = cells[:, 1::2] - cells[:, ::2]
    assert (sides > 0.0).all()
    assert sides.prod(axis=1).sum() == pytest.approx((whole[1::2] - whole[::2]).prod())
    assert cells[:, ::2].min(axis=0) == pytest.approx(whole[::2])
    assert cells[:, 1::2].max(axis=0) == pytest.approx(whole[1::2])


def test_a_reading_cuts_cells_and_removes_those_it_excludes():
    cells = np.zeros((3, FACES))
    cells[:, :2] = (-0.3, -0.1), (-0.05, 0.02), (0.01, 0.4)
    cells[:, 4] = 1.0, 2.0, 3.0  # tells them apart

    left = cut_cells(cells, -0.02, 0.03)

    assert left == 2
    assert cells[:2, :2].tolist() == [[-0.02, 0.02], [0.01, 0.03]]
    assert cells[:2, 4].tolist() == [2.0, 3.0]


@pytest.mark.parametrize(
    ('a', 'b', 'product'),
    [
        ((1.0, 2.0), (3.0, 5.0), (3.0, 10.0)),
        ((-2.0, 3.0), (-5.0, 4.0), (-15.0, 12.0)),
        ((-2.0, -1.0), (-4.0, -3.0), (3.0, 8.0)),
        ((-2.0, 3.0), (0.0, 0.0), (0.0, 0.0)),
    ],
)
def test_a_product_of_intervals_has_the_products_of_their_ends(a, b, product):
    assert times(Interval(*a), Interval(*b)) == product


@pytest.mark.parametrize(
    ('interval', 'square'),
    [((1.0, 2.0), (1.0, 4.0)), ((-3.0, -2.0), (4.0, 9.0)), ((-3.0, 2.0), (0.0, 9.0))],
)
def test_a_square_is_never_negative(interval, square):
    assert squared(Interval(*interval)) == square


def test_the_hull_reaches_as_far_as_the_corners_of_the_cells():
    rng = np.random.default_rng(7)
    cells = np.sort(rng.uniform(0.0, 0.02, (5, FACES // 2, 2))).reshape(5, FACES)
    radii, theta_0 = Interval(0.012, 0.015), 0.01  # the edge turns either way
    bounds = Bounds(Interval(-1.0, 0.018), Interval(HALF, HALF), radii, theta_0, 0.3, 0.2)

    d, c_squared, alpha = hull(cells, bounds)

    corners = [
        rolled - r * (theta - theta_0)
        for cell in cells
        for theta, rolled, r in product(cell[0:2], cell[2:4], radii)
    ]
    assert max(corners) > 0.018  # beyond the end of the edge
    assert d == pytest.approx((min(corners), 0.018))
    assert c_squared == (cells[:, 4].min(), cells[:, 5].max())
    assert alpha == (cells[:, 6].min(), cells[:, 7].max())
