# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    follow,
)
from tactile_push.control.placing.planner import Planner
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT

BOUNDS = Bounds(1.54, 2000.0, -0.1, 0.1, -0.022, 0.022, 0.8)
PIECE = 5e-4


def pushed(c=0.0187, mu_c=math.inf):
    pressure = Pressure(c * c, 1.5, 0.0, np.array((1.0, 0.0, 1.0)))
    return Pushed(0.02375, 0.0135, pressure, *friction_cone(mu_c), STRAIGHT, PIECE)


def closed_loop(truth, believed, goal, now):
    """Follow a plan that is made anew in every period; return the errors and the belt."""
    planner, used = Planner(BOUNDS), 0.0
    while used < 0.3:
        plan = planner.plan(now, believed, goal, 0.3 - used, way=PIECE if used else 0.0)
        way = min(PIECE, plan.length)
        now = follow(now, plan.command(PIECE), way, truth)
        used += way
        if way < PIECE:
            break
    return centre_of_mass(now, truth) - goal.x, now.theta - goal.theta, used


@pytest.mark.parametrize('goal', [Goal(-0.03, -0.1), Goal(-0.025, 0.1)])
def test_it_gets_there_although_the_object_turns_less_than_it_is_believed_to(goal):
    start = Situation(0.0, 0.2, 0.003, 0.0, 0.0)
    x, theta, used = closed_loop(pushed(0.0196), pushed(), goal, start)
    assert abs(x) < 3e-4
    assert abs(theta) < math.radians(0.3)
    assert used < 0.15  # it may have to go around once more


def test_it_spares_some_of_its_bounds_if_it_can():
    planner = Planner(BOUNDS)
    plan = planner.plan(Situation(0.0, 0.2, 0.003, 0.0, 0.0), pushed(), Goal(-0.03, -0.1), 0.3)
    assert plan.arrives
    assert np.abs(plan.push[:4]).max() <= 0.8 * BOUNDS.steepest + 1e-12


def test_a_goal_that_cannot_be_reached_has_no_plan_that_arrives():
    plan = Planner(BOUNDS).plan(
        Situation(0.0, 0.2, 0.003, 0.0, 0.0), pushed(), Goal(0.2, -0.1), 0.3
    )
    assert plan is None or not plan.arrives


# The contact is far aside, and only one that slips gets back to the middle.
ASIDE, BACK = Situation(0.0, 0.1, 0.012, 0.0, 0.0), Goal(0.01, 0.05)


def planned(planner, numbers, others=(), times=10):
    """Plan again and again from the same place."""
    return [planner.plan(ASIDE, numbers, BACK, 0.3, others=others) for _ in range(times)][-1]


def test_where_no_plan_arrives_it_follows_one_for_less_friction():
    others = pushed(mu_c=0.3), pushed(mu_c=1.0)
    assert not planned(Planner(BOUNDS), pushed()).arrives
    assert planned(Planner(BOUNDS), pushed(), others).arrives


def test_once_a_plan_arrives_with_what_is_likely_it_takes_nothing_for_granted():
    planner, others = Planner(BOUNDS), (pushed(mu_c=0.2), pushed(mu_c=0.3))
    planned(planner, pushed(), others)
    likely = planned(planner, pushed(mu_c=0.5), others, times=20)
    expected = planned(Planner(BOUNDS), pushed(mu_c=0.5), times=20)
    assert likely.arrives
    assert likely.length == pytest.approx(expected.length, rel=0.2)


def test_what_was_looked_at_is_remembered_while_plans_are_dropped():
    planner = Planner(BOUNDS)
    others = pushed(mu_c=0.3), pushed(mu_c=1.0)
    found = []
    for _ in range(8):
        found.append(planner.plan(ASIDE, pushed(), BACK, 0.3, others=others).arrives)
        planner.drop()
    assert any(found)
