# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the finger leaves the object, and that it knows its way back."""

import math
from dataclasses import replace

import pytest

from support.sticking_block import BOUNDS, STICKING
from tactile_push.control.placing.elsewhere import AFTER_TOUCH, IN_VAIN, Elsewhere
from tactile_push.control.placing.model import Goal, Situation, centre_of_mass
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import Moves

START = Situation(0.0, 0.35, 0.012, 0.0, 0.0)
TASK = Task(START, STICKING, BOUNDS, 0.2)
# Pushed left of the centre of mass at this angle, it moves to the left all the way.
EXCLUDED = Goal(centre_of_mass(START, STICKING) + 0.015, 0.35)
TOO_FAR = EXCLUDED._replace(x=EXCLUDED.x + 0.05)  # for the belt, but in the same direction
NOWHERE_NEAR = Goal(0.5, 0.0)
MOVES, PERIOD = Moves(0.02, 0.05, 0.005), 0.1


def elsewhere(moves=MOVES, room=0.04):
    one = Elsewhere(moves, room, PERIOD)
    for _ in range(IN_VAIN):
        assert not one.is_due
        one.count(arrives=False)
    return one


def test_a_plan_that_arrives_keeps_the_finger_where_it_is():
    one = elsewhere()
    assert one.is_due
    one.count(arrives=True)
    assert not one.is_due


def test_a_finger_of_one_axis_never_leaves():
    assert not elsewhere(None).is_due


def left(goal=EXCLUDED, task=TASK, nearest=math.inf, room=0.04):
    """Return one that has left the object and gone back, and the velocities of the way."""
    one, way = elsewhere(room=room), []
    assert one.leave(task, nearest)
    while not one.is_clear:
        one.look(goal)
        way.append(one.velocity())
        one.pass_time(PERIOD, way[-1])
        assert len(way) < 100
    return one, way


def test_it_goes_back_for_a_contact_that_leads_to_the_goal():
    one, way = left()
    assert (one.regrasps, one.is_late) == (1, False)
    assert {v_x for v_x, _ in way[:-1]} == {0.0}
    # It goes back without a pause, and then to the left.
    assert max(v_y for _, v_y in way[:-1]) < 0.0 > one.velocity()[0]


def test_it_leaves_once_while_no_plan_arrives_and_for_a_while_not_again():
    one, _ = left()
    for _ in range(AFTER_TOUCH):
        assert not one.is_due
        one.count(arrives=False)
    assert one.is_due


def test_where_no_contact_leads_to_the_goal_it_keeps_away_until_all_are_tried_and_stays():
    # No plan from elsewhere comes as near as the one from here is said to.
    one, way = left(NOWHERE_NEAR, nearest=0.0)
    assert one.velocity()[0] == 0.0
    assert [v_y for _, v_y in way[-4:-1]] == pytest.approx([-MOVES.belt_speed] * 3)


def test_where_no_contact_leads_to_the_goal_it_goes_for_the_one_that_comes_nearest():
    one, _ = left(TOO_FAR, replace(TASK, belt=0.08), room=0.06)
    assert one.velocity()[0] < 0.0


def test_it_does_not_leave_without_the_room_to_go_back():
    one = elsewhere(room=0.004)
    assert not one.leave(TASK, math.inf)
    assert (one.is_due, one.regrasps) == (False, 0)


def test_it_goes_back_no_farther_than_there_is_room():
    _, way = left(NOWHERE_NEAR, room=0.006)
    assert -sum(v_y for _, v_y in way) * PERIOD <= 0.006 + 1e-9


def test_it_goes_home_as_far_as_it_has_gone_back():
    assert elsewhere().is_home
    one, way = left()
    y = sum(v_y for _, v_y in way) * PERIOD
    assert y < -0.002
    assert not one.is_home
    periods = 0
    while not one.is_home:
        v_x, v_y = one.velocity_home()
        assert v_x == 0.0 < v_y <= MOVES.speed
        one.pass_time(PERIOD, (v_x, v_y))
        y += v_y * PERIOD
        periods += 1
    assert y == pytest.approx(0.0, abs=2e-4)
    assert periods * PERIOD < 2.0


def test_a_new_goal_begins_anew():
    one = elsewhere()
    assert one.leave(TASK, math.inf)
    one.look(NOWHERE_NEAR)
    one.begin()
    assert (one.regrasps, one.is_due) == (0, False)
    while not one.is_clear:  # on its way it goes on, for the new goal
        one.look(EXCLUDED)
        one.pass_time(PERIOD, one.velocity())
    assert one.velocity()[0] < 0.0
