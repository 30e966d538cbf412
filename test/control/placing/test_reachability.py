# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import pytest

from support.sticking_block import PRESSURE
from support.turning_tip import A, B, Y, psi
from tactile_push.control.placing import horizon
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation, centre_of_mass
from tactile_push.control.placing.reachability import (
    Task,
    judging,
    nearest_goal,
    nearing,
    on_the_way,
    reach,
)
from tactile_push.control.placing.stages import (
    AT_THE_LIMITS,
    BELT,
    FRICTION,
    OUT_OF_REACH,
    SENSOR,
    WITH_RESERVE,
    WORKSPACE,
)
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT, TurningTip

BOUNDS = Bounds(1.54, 2000.0, -0.1, 0.1, -0.024, 0.024, 0.85)
NOW = Situation(0.0, 0.1, -0.002, 0.0, 0.0)


def task(mu_c=math.inf, belt=0.3, now=NOW, bounds=BOUNDS):
    pushed = Pushed(0.02375, 0.0135, PRESSURE, *friction_cone(mu_c), STRAIGHT, 0.0)
    return Task(now, pushed, bounds, belt)


def test_a_goal_ahead_is_reached_with_reserve():
    told = reach(task(), Goal(-0.01, 0.0))
    assert (told.verdict, told.reason) == (WITH_RESERVE, '')
    assert told.plan.arrives


def test_a_goal_that_takes_nearly_all_the_belt_is_at_the_limits():
    goal = Goal(-0.03, 0.0)
    belt = reach(task(), goal).plan.length
    assert reach(task(belt=1.02 * belt), goal).verdict == AT_THE_LIMITS


def test_a_goal_farther_aside_than_the_finger_gets_on_the_belt_is_out_of_reach_for_the_belt():
    # The finger cannot go farther than 1.54 times the belt, and theta and d end as they began.
    start = centre_of_mass(NOW, task().pushed)
    told = reach(task(belt=0.02), Goal(start + 0.04, 0.1))
    assert (told.verdict, told.reason) == (OUT_OF_REACH, BELT)


def test_a_goal_beyond_the_workspace_is_out_of_reach_for_it():
    told = reach(task(belt=0.4), Goal(-0.14, 0.0))
    assert (told.verdict, told.reason) == (OUT_OF_REACH, WORKSPACE)


def test_a_goal_where_the_tip_points_away_from_the_contact_is_out_of_reach_for_the_sensor():
    # With its centre of mass there the edge is touched at x = 45 to 88 mm, where the pole of the
    # usual finger is within 21 degrees of the way across: theta has to be smaller.
    goal, numbers = Goal(0.05, 0.45), task().pushed
    across = goal.x + (numbers.l + numbers.r) * math.sin(goal.theta)
    ends = [across + d * math.cos(goal.theta) for d in (BOUNDS.d_min, BOUNDS.d_max)]
    assert max(psi(ends[0]), psi(ends[1])) < goal.theta - 0.03
    turns = replace(task(), pushed=numbers._replace(tip=TurningTip(A, B, Y, -1.0)))
    bounds = BOUNDS._replace(felt=math.pi / 2.0)
    assert reach(turns, goal).verdict == reach(replace(task(), bounds=bounds), goal).verdict
    told = reach(replace(turns, bounds=bounds), goal)
    assert (told.verdict, told.reason) == (OUT_OF_REACH, SENSOR)


def test_without_friction_a_contact_beside_the_middle_cannot_turn_back_on_a_short_belt():
    # d > l mu_c turns the object counterclockwise only, and slipping across takes belt.
    now, goal = Situation(0.0, 0.0, 0.015, 0.0, 0.0), Goal(-0.03, -0.3)
    told = reach(task(mu_c=0.0, belt=0.04, now=now), goal)
    assert (told.verdict, told.reason) == (OUT_OF_REACH, FRICTION)


@pytest.mark.parametrize('goal', [Goal(-0.12, 0.0), Goal(0.0, 1.0)])
def test_the_nearest_goal_can_be_reached(goal):
    nearest = nearest_goal(task(), goal)
    assert not task().arrives(goal)
    assert task().arrives(nearest)
    away = math.hypot(1e3 * (nearest.x - goal.x), math.degrees(nearest.theta - goal.theta))
    assert 0.1 < away < 33.0


def test_the_nearest_goal_to_one_in_reach_is_itself():
    assert nearest_goal(task(), Goal(-0.01, 0.0)) == Goal(-0.01, 0.0)


@pytest.mark.parametrize('looking', [judging, nearing])
def test_a_look_pauses_before_it_refines_another_push(looking, monkeypatch):
    pieces = [0]

    def nothing(*numbers):
        pieces[0] += 1
        return math.inf, 0.0, 0.0, 0.0

    monkeypatch.setattr(horizon, 'refine', nothing)  # contact is lost whatever is done
    before = pauses = 0
    for _ in looking(task(), Goal(0.0, 0.0)):
        assert pieces[0] <= before + 1
        before = pieces[0]
        pauses += 1
    assert pauses >= pieces[0] > 4


# The contact is far aside. It gets to the goal if it slips, and does not if it sticks.
ASIDE, BACK = Situation(0.0, 0.1, 0.012, 0.0, 0.0), Goal(0.01, 0.05)


def test_a_goal_that_takes_a_friction_which_may_be_is_at_the_limits():
    sticks, slips = task(now=ASIDE), task(mu_c=0.3, now=ASIDE)
    assert reach(sticks, BACK).verdict == OUT_OF_REACH
    assert reach(slips, BACK).verdict == WITH_RESERVE
    told = reach(replace(sticks, others=(slips.pushed,)), BACK)
    assert (told.verdict, told.reason) == (AT_THE_LIMITS, '')
    assert told.plan.arrives


def test_between_the_start_and_a_goal_there_is_one_that_can_be_reached():
    x, goal = centre_of_mass(NOW, task().pushed), Goal(0.3, 0.5)
    found = on_the_way(task(belt=0.05), goal)
    share = (found.x - x) / (goal.x - x)
    assert 0.0 <= share < 1.0
    assert found.theta == pytest.approx(NOW.theta + share * (goal.theta - NOW.theta))
    assert task(belt=0.05).arrives(found)
    # No farther than the finger gets on the belt, and what the edge's turn moves the centre aside.
    assert found.x - x < 1.54 * 0.05 + 0.005
