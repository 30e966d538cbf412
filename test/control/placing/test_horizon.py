# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The planner's search and least squares against scipy, the shortest belt and what pushes reach."""

import math

import numpy as np
import pytest
from scipy.optimize import least_squares

from tactile_push.control.placing import horizon
from tactile_push.control.placing.car import shortest_belt
from tactile_push.control.placing.horizon import ARCS, LENGTH, RESIDUALS, UNKNOWNS
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    follow,
)
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure

L, R, C = 0.02375, 0.0135, 0.0187
STEEPEST = 1.5
FREE = Bounds(STEEPEST, 1e9, -1.0, 1.0, -1.0, 1.0, 1.4)
BOUNDS = Bounds(STEEPEST, 1e9, -0.1, 0.1, -0.022, 0.022, 0.8)


def pushed(mu_c=math.inf, r=R):
    pressure = Pressure(C * C, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
    return Pushed(L, r, pressure, *friction_cone(mu_c), 0.0, 0.0)


def planned(start, goal, numbers, bounds, most=0.3):
    push = np.empty(UNKNOWNS)
    told = horizon.plan(start, goal, numbers, bounds, 0.0, most, 3, 8, 15, push)
    return push, told


def end(start, push, numbers):
    """Return where a push leads, arc by arc in short steps."""
    for u, belt in zip(push[:ARCS], push[ARCS:], strict=True):
        start = follow(start, u, belt * LENGTH, numbers)
    return centre_of_mass(start, numbers), start.theta


def test_the_least_squares_agree_with_scipy():
    start, goal, numbers = Situation(0.0, 0.2, 0.003, 0.0, 0.0), Goal(-0.03, -0.1), pushed()
    first = np.array((0.5, -0.4, -0.6, -1.2, 0.08, 0.08, 0.08, 0.18))
    counts = np.array((9, 9, 9, 16))

    def missed(push):
        out = np.empty(RESIDUALS)
        horizon.residuals(push, counts, start, goal, numbers, BOUNDS, 0.0, 0.3, out)
        return out

    high = np.array((STEEPEST,) * ARCS + (3.0,) * ARCS)
    low = np.array((-STEEPEST,) * ARCS + (0.0,) * ARCS)
    oracle = least_squares(missed, first, bounds=(low, high), x_scale='jac', xtol=1e-10, ftol=1e-10)
    push = first.copy()
    cost, x, theta, beyond = horizon.refine(push, start, goal, numbers, BOUNDS, 0.0, 0.3, 60)
    assert 0.999 * oracle.cost <= cost <= 1.03 * oracle.cost
    assert abs(x) < 2e-6
    assert abs(theta) < 1e-4
    assert beyond < 1.0


@pytest.mark.parametrize('shift', [-0.03, 0.01, 0.04])
def test_a_shift_takes_no_less_than_the_shortest_belt_and_no_more_than_with_the_cheapest_arcs(
    shift,
):
    # Without rolling; an object that goes straight ahead before and afterwards.
    numbers = pushed(r=1e-9)
    start = Situation(0.0, 0.0, 0.0, 0.0, 0.0)
    push, told = planned(start, Goal(shift, 0.0), numbers, FREE)
    wheelbase = (C * C + L * L) / L
    belt = push[ARCS:].sum() * LENGTH
    assert abs(told[1]) < 1e-5
    assert abs(told[2]) < 1e-4
    assert belt >= (1.0 - 2e-3) * shortest_belt(shift, wheelbase, STEEPEST)
    # A short shift takes 2 sqrt(L X/u) of belt s; s (BRIEF + EFFORT u^2/U^2) is least at this u.
    cheapest = STEEPEST * math.sqrt(horizon.BRIEF / (3.0 * horizon.EFFORT))
    assert belt <= shortest_belt(shift, wheelbase, cheapest)


@pytest.mark.parametrize('mu_c', [0.1, 0.3, 1.0, math.inf])
def test_what_a_push_reaches_is_found_again_on_no_longer_belt(mu_c):
    rng = np.random.default_rng(4)
    numbers, tried = pushed(mu_c), 0
    while tried < 6:
        start = Situation(0.0, rng.uniform(-0.4, 0.4), rng.uniform(-0.01, 0.01), 0.0, 0.0)
        now, belt = start, 0.0
        for _ in range(2):
            way = rng.uniform(0.01, 0.04)
            now, belt = follow(now, rng.uniform(-1.0, 1.0), way, numbers), belt + way
        if max(abs(now.theta), 50.0 * abs(now.d), 10.0 * abs(now.x)) > 0.7:
            continue
        tried += 1
        goal = Goal(centre_of_mass(now, numbers), now.theta)
        push, told = planned(start, goal, numbers, BOUNDS)
        assert abs(told[1]) < 1e-4
        assert abs(told[2]) < math.radians(0.1)
        assert told[3] < 1.0
        assert push[ARCS:].sum() * LENGTH <= 1.3 * belt
        x, theta = end(start, push, numbers)
        assert x == pytest.approx(goal.x, abs=3e-4)
        assert theta == pytest.approx(goal.theta, abs=math.radians(0.3))


def test_the_rest_of_a_push_leads_where_the_whole_does():
    numbers = pushed()
    start, goal = Situation(0.0, 0.2, 0.003, 0.0, 0.0), Goal(-0.03, -0.1)
    push, _ = planned(start, goal, numbers, FREE)
    whole = end(start, push, numbers)
    rest, now = push.copy(), start
    piece = 2.5e-3
    for _ in range(10):
        command = rest[0]
        left = rest[ARCS] * LENGTH
        piece_now = min(left, piece)
        now = follow(now, command, piece_now, numbers)
        after = np.empty(UNKNOWNS)
        horizon.rest_of(rest, piece_now, after)
        rest = after
        assert rest[ARCS] > 0.0
    assert end(now, rest, numbers) == pytest.approx(whole, abs=2e-5)


def test_a_push_that_is_over_has_no_rest():
    push = np.array((1.0, 0.5, -0.5, -1.0, 0.1, 0.1, 0.1, 0.1))
    rest = np.empty(UNKNOWNS)
    horizon.rest_of(push, 0.05, rest)
    assert rest[ARCS:].sum() == pytest.approx(0.0, abs=1e-12)
