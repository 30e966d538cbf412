# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of goals for an object that is steered."""

import math

import pytest

from tactile_push.control import CONTACT_SILENT, PUSHING, STOPPED
from tactile_push.control.placing.stages import (
    HELD_STILL,
    NO_GOAL,
    NOT_FINITE,
    OTHER_FRAME,
    OUTSIDE_WORKSPACE,
)
from tactile_push.interface import STEER
from tactile_push.parameters.push_controller import PushControllerParameters, make_control
from tactile_push.pipeline.steering import STEERING, SteerGoals

PERIOD, AHEAD = 0.1, math.pi / 2.0
ANY = (0.0, 0.0, 0.0, 1.0)


@pytest.fixture
def push():
    control = make_control(PushControllerParameters(law=STEER, theta_desired=-0.2))
    control.activate(0.0)
    return control


def ticks(push, first, count, x=0.0, theta=0.0):
    """Feel an edge in each period and return the ticks."""
    found = []
    for k in range(first, first + count):
        push.locate_finger(x, k * PERIOD, AHEAD)
        push.feel(theta, k * PERIOD)
        found.append(push.tick(k * PERIOD))
    return found


def test_without_a_goal_law_18_acts_as_it_is(push):
    goals = SteerGoals(push)
    assert goals.stage == NO_GOAL
    assert {tick.trim for tick in ticks(push, 0, 20)} == {0.0}
    assert push.law.aim == -0.2


def test_a_goal_is_steered_to_whatever_the_yaw_is(push):
    goals = SteerGoals(push)
    ticks(push, 0, 3)
    assert goals.goal('left/finger_base', 0.01, (math.nan,) * 4) == ''
    assert (goals.stage, push.steadying.goal) == (STEERING, 0.01)
    # It begins where theta is: the trim makes up for the angle that law (18) was told.
    assert ticks(push, 3, 1)[0].trim == pytest.approx(0.2, abs=0.02)
    assert goals.goal('', -0.02, ANY) == ''
    assert push.steadying.goal == -0.02


@pytest.mark.parametrize(
    ('frame', 'x', 'refusal'),
    [
        ('finger_disk', 0.0, OTHER_FRAME),
        ('finger_base', math.nan, NOT_FINITE),
        ('finger_base', math.inf, NOT_FINITE),
        ('finger_base', 0.106, OUTSIDE_WORKSPACE),
        ('finger_base', -0.106, OUTSIDE_WORKSPACE),
    ],
)
def test_a_goal_that_makes_no_sense_is_refused_and_the_last_one_stays(push, frame, x, refusal):
    goals = SteerGoals(push)
    goals.goal('', 0.03, ANY)
    assert goals.goal(frame, x, ANY) == refusal
    assert push.steadying.goal == 0.03


def test_while_the_finger_is_held_still_goals_are_refused(push):
    ticks(push, 0, 3)
    push.notice_another_command()
    assert SteerGoals(push).goal('', 0.0, ANY) == HELD_STILL


def test_a_cancelled_goal_leaves_law_18_as_it_is(push):
    goals = SteerGoals(push)
    assert not goals.cancel()
    goals.goal('', 0.02, ANY)
    ticks(push, 0, 10)
    assert goals.cancel()
    assert goals.stage == NO_GOAL
    assert ticks(push, 10, 1)[0].trim == 0.0


def test_what_stops_the_finger_keeps_the_goal(push):
    goals = SteerGoals(push)
    goals.goal('', 0.02, ANY)
    ticks(push, 0, 10)
    stopped = [push.tick(k * PERIOD) for k in range(10, 15)][-1]
    assert (stopped.state, stopped.stop_reason, stopped.v_x) == (STOPPED, CONTACT_SILENT, 0.0)
    again = ticks(push, 15, 2)
    assert again[-1].state == PUSHING
    assert again[-1].trim != 0.0
    assert goals.stage == STEERING
