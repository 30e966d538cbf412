# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the finger leaves the object, and that it knows its way back."""

import math

import pytest

from support.sticking_block import BOUNDS, STICKING
from tactile_push.control.placing.elsewhere import IN_VAIN, Elsewhere
from tactile_push.control.placing.model import Goal, Situation, centre_of_mass
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import Moves

START = Situation(0.0, 0.35, 0.012, 0.0, 0.0)
TASK = Task(START, STICKING, BOUNDS, 0.2)
# Pushed left of the centre of mass at this angle, it moves to the left all the way.
EXCLUDED = Goal(centre_of_mass(START, STICKING) + 0.015, 0.35)
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


def looked(one, goal=EXCLUDED, task=TASK):
    """Look until the finger leaves or all is tried; return whether it leaves."""
    while one.is_due:
        if one.look(task, goal):
            return True
    return False


def test_it_leaves_for_the_contact_with_the_least_belt():
    one = elsewhere()
    assert looked(one)
    assert (one.regrasps, one.is_clear, one.is_late) == (1, False, False)
    assert one.velocity()[1] < 0.0


def test_where_no_contact_leads_to_the_goal_it_stays_and_looks_again_later():
    one = elsewhere()
    assert not looked(one, NOWHERE_NEAR)
    assert one.regrasps == 0
    for _ in range(IN_VAIN):
        assert not one.is_due
        one.count(arrives=False)
    assert one.is_due


def test_what_has_led_too_far_aside_meanwhile_is_not_gone_for():
    one, aside = elsewhere(), START._replace(x=-0.099)
    one.look(TASK, EXCLUDED)
    # All contacts that lead there are to the left, where the workspace now ends.
    assert not looked(one, task=Task(aside, STICKING, BOUNDS, 0.2))


def test_it_goes_back_no_farther_than_there_is_room_for_all_times():
    one = elsewhere(room=0.03)
    assert looked(one)
    while not one.is_clear:
        one.pass_time(PERIOD, one.velocity())
        one.velocity()
    for _ in range(2 * IN_VAIN):
        assert not one.is_due
        one.count(arrives=False)
    assert one.is_due
    assert not looked(one)


def test_it_goes_home_as_far_as_it_has_gone_back():
    one = elsewhere()
    assert looked(one)
    assert one.is_home
    y = 0.0
    while not one.is_clear:
        v_x, v_y = one.velocity()
        one.pass_time(PERIOD, (v_x, v_y))
        y += v_y * PERIOD
        one.velocity()
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
    assert looked(one)
    one.begin()
    assert (one.regrasps, one.is_due) == (0, False)
    assert not math.isnan(one.velocity()[0])  # on its way it goes on
