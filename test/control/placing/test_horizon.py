# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The planner's best push against the shortest belt and against what pushes reach."""

import math

import numpy as np
import pytest

from support.turning_tip import A, B, X, Y, psi
from tactile_push.control.placing import horizon, refinement
from tactile_push.control.placing.arcs import ARCS, LENGTH
from tactile_push.control.placing.car import shortest_belt
from tactile_push.control.placing.horizon import Plan, at_once, planning
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
from tactile_push.mechanics.turning_tip import STRAIGHT, TurningTip

L, R, C = 0.02375, 0.0135, 0.0187
STEEPEST = 1.5
FREE = Bounds(STEEPEST, 1e9, -1.0, 1.0, -1.0, 1.0, 1.4)
BOUNDS = Bounds(STEEPEST, 1e9, -0.1, 0.1, -0.022, 0.022, 0.8)


def pushed(mu_c=math.inf, r=R):
    pressure = Pressure(C * C, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
    return Pushed(L, r, pressure, *friction_cone(mu_c), STRAIGHT, 0.0)


def planned(start, goal, numbers, bounds, most=0.3, roundabout=False):
    return at_once(planning((start, goal, numbers), bounds, 0.0, most, roundabout=roundabout))


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
    plan = planned(start, Goal(shift, 0.0), numbers, FREE)
    wheelbase = (C * C + L * L) / L
    belt = plan.length
    assert abs(plan.x_error) < 1e-5
    assert abs(plan.theta_error) < 1e-4
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
        plan = planned(start, goal, numbers, BOUNDS)
        assert abs(plan.x_error) < 1e-4
        assert abs(plan.theta_error) < math.radians(0.1)
        assert plan.beyond < 1.0
        assert plan.length <= 1.3 * belt
        x, theta = end(start, plan.push, numbers)
        assert x == pytest.approx(goal.x, abs=3e-4)
        assert theta == pytest.approx(goal.theta, abs=math.radians(0.3))


def test_the_first_command_is_the_mean_over_the_period():
    plan = Plan(np.array((1.0, -1.0, 0.0, 0.0, 0.001, 0.1, 0.0, 0.0)), 0.0, 0.0, 0.0, 0.0)
    assert plan.length == pytest.approx(0.101 * LENGTH)
    assert plan.command(0.0005) == pytest.approx(0.2 * 1.0 - 0.8 * 1.0)
    assert plan.command(0.00005) == pytest.approx(1.0)


def test_of_two_plans_one_that_misses_less_is_better_unless_it_takes_much_more_belt():
    push = np.array((0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0))
    longer = np.array((0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0))
    near, exact = Plan(push, 0.0, 1e-4, 0.0, 0.0), Plan(push, 0.0, 0.0, 0.0, 0.0)
    assert exact.merit < near.merit < Plan(longer, 0.0, 0.0, 0.0, 0.0).merit


def farthest_from_the_pole(start, push, numbers):
    """Return the largest angle between the edge's normal and the usual finger's pole on a push."""
    most = 0.0
    for u, belt in zip(push[:ARCS], push[ARCS:], strict=True):
        for _ in range(50):
            start = follow(start, u, belt * LENGTH / 50, numbers)
            most = max(most, abs(start.theta + math.pi / 2.0 - psi(start.x)))
    return most


def test_a_plan_keeps_the_contact_where_the_sensor_feels_it():
    numbers = pushed(1.0)._replace(tip=TurningTip(A, B, Y, -1.0))
    start = Situation(X, -0.147, -0.0118, 0.0, 0.0)
    goal = Goal(centre_of_mass(start, numbers) + 0.03, 0.5)
    felt = math.radians(65.0)
    free = planned(start, goal, numbers, BOUNDS)
    bound = planned(start, goal, numbers, BOUNDS._replace(felt=felt))
    assert free.arrives
    assert bound.arrives
    slack = math.radians(0.5)
    assert farthest_from_the_pole(start, bound.push, numbers) < felt + slack
    assert felt + slack < farthest_from_the_pole(start, free.push, numbers)


def test_no_piece_of_a_plan_is_more_than_one_refinement(monkeypatch):
    rounds = []
    refine = horizon.refine

    def counted(*numbers):
        rounds.append(numbers[-1])
        return refine(*numbers)

    monkeypatch.setattr(horizon, 'refine', counted)
    start, goal = Situation(0.0, 0.2, 0.003, 0.0, 0.0), Goal(-0.03, -0.1)
    problem = (start, goal, pushed()), BOUNDS, 0.0, 0.3
    pieces = planning(*problem)
    for made, _ in enumerate(pieces, 1):
        assert rounds == [horizon.ROUNDS] * made
    assert 1 < len(rounds) <= horizon.MORE_TRIES
