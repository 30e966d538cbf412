# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The planner's best push against the shortest belt and against what pushes reach."""

import math

import numpy as np
import pytest

from tactile_push.control.placing import horizon, refinement
from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS
from tactile_push.control.placing.car import shortest_belt
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


def planned(start, goal, numbers, bounds, most=0.3, roundabout=False):
    push = np.empty(UNKNOWNS)
    task = start, goal, numbers, bounds, 0.0, most
    told = horizon.plan(*task, 3, 8, 15, roundabout, push)
    return push, told


def end(start, push, numbers):
    """Return where a push leads, arc by arc in short steps."""
    for u, belt in zip(push[:ARCS], push[ARCS:], strict=True):
        start = follow(start, u, belt * LENGTH, numbers)
    return centre_of_mass(start, numbers), start.theta


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
    cheapest = STEEPEST * math.sqrt(refinement.BRIEF / (3.0 * refinement.EFFORT))
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
