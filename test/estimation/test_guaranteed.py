# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.estimation import GuaranteedSet, ModelBounds, Prior
from tactile_push.estimation.cells import FACES, Bounds, Interval, push_cells, split_cells
from tactile_push.estimation.resistance import Push
from tactile_push.mechanics import Outline, Slider, Support, friction_cone, push, tangent_angle

RADIUS = 0.0135
BLOCK = Outline.rectangle(0.05, 0.0475)
PATH = BLOCK.path(RADIUS)
HALF = 0.02375


def pushed(slider, theta, d, mu_c, v_x, duration=0.1):
    sigma = BLOCK.sigma(RADIUS, d=d)
    turn = tangent_angle(sigma, PATH)
    angle, after, _, _ = push(
        *(theta - turn, sigma, v_x, 0.005, duration, PATH, slider.c, slider.points),
        *(*friction_cone(mu_c), RADIUS),
    )
    return angle + turn, d + after - sigma


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
@pytest.mark.parametrize('support', [None, 'corners', 'rim', 'uniform'])
def test_the_truth_stays_in_its_cell(mu_c, support):
    rng = np.random.default_rng(3)
    for _ in range(60):
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.02, 0.02)
        v_x, share, angle = rng.uniform(-0.004, 0.004), 0.0, 0.0
        if support is None:
            slider = Slider(BLOCK, rng.uniform(0.005, 0.036))
        else:
            count = () if support == 'corners' else (60,)
            slider = Slider.on(BLOCK, getattr(Support, support)(BLOCK, *count), exact=True)
            share, angle = 0.6, math.radians(15.0)  # of this c, not of the best one
        cell = box_around(rng, theta, d, slider.c, mu_c)

        bounds = Bounds(
            Interval(-0.025, 0.025),
            Interval(HALF, HALF),
            Interval(RADIUS, RADIUS),
            0.0,
            share,
            angle,
        )
        left = push_cells(cell, Push(v_x, 0.005, 0.1), bounds)

        theta, d = pushed(slider, theta, d, mu_c, v_x)
        assert left == 1
        assert cell[0, 0] <= theta <= cell[0, 1]
        assert cell[0, 2] <= d + RADIUS * theta <= cell[0, 3]


def test_a_sticking_contact_stays_in_its_cell_where_the_finger_moves_along_the_edge():
    rng = np.random.default_rng(4)
    slider = Slider(BLOCK, 0.0187)
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


@pytest.mark.parametrize('error', [-0.15, 0.15])
def test_the_truth_is_never_outside_while_l_and_r_are_within_their_bounds(error):
    prior = Prior((-0.025, 0.025), HALF / (1.0 + error), 0.075 * HALF, mu_c=(math.inf, math.inf))
    bounds = ModelBounds(math.radians(0.5), 0.0, 0.0)
    told = RADIUS / (1.0 - error)
    for seed in range(6):
        slider = Slider(BLOCK, 0.006 + 0.005 * seed)
        found, d = follow(slider, math.inf, prior, bounds, seed, radii=(0.775 * told, 1.225 * told))

        (least, most), (least_c, most_c), _ = found.ranges()
        assert least <= d <= most
        assert least_c <= slider.c <= most_c
        assert most - least < 0.04


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


def follow(slider, mu_c, prior, bounds, seed, steps=120, radii=(RADIUS, RADIUS)):
    """Steer a block with noisy readings: give the set and the true d at the end."""
    rng = np.random.default_rng(seed)
    theta, d, v_x = rng.uniform(-0.3, 0.3), rng.uniform(-0.015, 0.015), 0.0
    noise = rng.uniform(-bounds.noise, bounds.noise, steps + 1)
    found = GuaranteedSet(prior, bounds, radii, theta + noise[0])
    for k in range(steps):
        v_x = float(np.clip(-0.01 * (theta + noise[k]), -0.004, 0.004))
        theta, d = pushed(slider, theta, d, mu_c, v_x)
        found.push(v_x, 0.005, 0.1)
        found.read(theta + noise[k + 1])
    return found, d


@pytest.mark.parametrize('support', [None, 'corners', 'uniform'])
def test_the_truth_is_never_outside_and_a_sticking_contact_is_found(support):
    prior = Prior((-0.025, 0.025), HALF, mu_c=(math.inf, math.inf))
    bounds = ModelBounds(math.radians(0.5))
    for seed in range(6):
        if support is None:
            slider = Slider(BLOCK, 0.006 + 0.005 * seed)
        else:
            count = () if support == 'corners' else (60,)
            slider = Slider.on(BLOCK, getattr(Support, support)(BLOCK, *count), exact=True)
        found, d = follow(slider, math.inf, prior, bounds, seed)

        (least, most), _, _ = found.ranges()
        assert least <= d <= most
        assert most - least < 0.02


@pytest.mark.parametrize('mu_c', [0.0, 0.2, 0.6])
def test_the_truth_is_never_outside_when_it_may_slip(mu_c):
    prior = Prior((-0.025, 0.025), HALF)
    bounds = ModelBounds(math.radians(0.5), 0.0, 0.0)
    for seed in range(6):
        c = 0.006 + 0.005 * seed
        found, d = follow(Slider(BLOCK, c), mu_c, prior, bounds, seed, 40)

        truths = (d, c, mu_c)
        for (least, most), truth in zip(found.ranges(), truths, strict=True):
            assert least <= truth <= most


def test_readings_that_no_object_gives_leave_nothing_and_then_the_prior():
    prior = Prior((-0.025, 0.025), HALF, mu_c=(math.inf, math.inf))
    found = GuaranteedSet(prior, ModelBounds(0.01), (RADIUS, RADIUS), 0.0)
    assert not found.empty

    found.push(0.0, 0.005, 0.1)
    found.read(0.5)

    assert found.empty
    assert found.ranges() == pytest.approx(np.array([prior.d, prior.c, prior.mu_c]))


@pytest.mark.parametrize(
    ('name', 'value'), [('noise', -0.1), ('turn', 1.0), ('cone', math.inf), ('noise', math.nan)]
)
def test_bounds_that_are_none_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        ModelBounds(**{'noise': 0.01, name: value})
