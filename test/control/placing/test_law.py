# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from support.sticking_block import PRESSURE
from tactile_push.control import NO_REASON, NOTHING_TO_DO
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.law import NOWHERE, PlaceLaw
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Goal, Pushed, Situation, centre_of_mass, follow
from tactile_push.control.placing.regrasp import Moves
from tactile_push.control.placing.stages import (
    CANCELLED,
    LEARNING,
    LETTING_GO,
    MISSED,
    NO_GOAL,
    OBJECT_LOST,
    PLACING,
    REGRASPING,
    RELEASED,
)
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT

BELT_SPEED, PERIOD, PIECE = 0.005, 0.1, 5e-4
AHEAD = math.pi / 2.0
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(*friction_cone(math.inf), STRAIGHT, 0.0),
)
ENDS = (-0.025, 0.025)
GOAL, START = Goal(-0.02, 0.0), Situation(0.0, 0.2, 0.003, 0.0, 0.0)


def law(goal=GOAL, belt=0.3, **how):
    return PlaceLaw(goal, belt, BELT_SPEED, PERIOD, **how)


def belief(now, d_spread=1e-4):
    spread = Spread(1e-3, d_spread, 0.1, 0.005, PIECE)
    return Belief(now.x, now.theta, now.d, PUSHED, (math.inf, math.inf), ENDS, spread)


def driven(one, d_spread=1e-4, now=START, periods=600, known_every=1, felt_every=1, truth=PUSHED):
    """Let a law push an object; return where it ends.

    What is believed may be known, and the object felt, in some periods only.
    """
    before, known_at = None, 0
    for k in range(periods):
        if before is not None:
            if (k - 1) % known_every == 0:
                known, known_at = before, k - 1
            one.believe(belief(known, d_spread), (k - 1 - known_at) * PERIOD)
            one.pass_time(PERIOD)
        if k % felt_every:
            one.go_on()
        else:
            one.update(now.theta)
        phi = one.phi
        assert one.phi_min <= phi <= one.phi_max
        before, way = now, PIECE
        if one.stage == RELEASED:
            way = one.let_go_in * BELT_SPEED
        now = follow(now, 1.0 / math.tan(phi), way, truth)
        if one.stage in (RELEASED, MISSED):
            break
    return now


def test_it_pushes_straight_ahead_until_something_is_believed():
    one = law()
    assert [one.update(0.2), one.update(0.21)] == [AHEAD, AHEAD]
    assert one.stage == LEARNING
    assert one.used == 0.0


def test_it_lets_go_within_the_period_in_which_the_object_is_there():
    one = law()
    end = driven(one)
    assert one.stage == RELEASED
    assert 0.0 <= one.let_go_in < PERIOD
    assert centre_of_mass(end, PUSHED) == pytest.approx(-0.02, abs=5e-5)
    assert end.theta == pytest.approx(0.0, abs=math.radians(0.1))


@pytest.mark.parametrize('share', [0.94, 1.06])
def test_an_object_that_turns_otherwise_than_believed_need_not_go_around_once_more(share):
    goal = Goal(-0.03, 0.3)
    as_believed, otherwise = law(goal, lag=PERIOD), law(goal, lag=PERIOD)
    pressure = PUSHED.pressure._replace(c_squared=share * PUSHED.pressure.c_squared)
    driven(as_believed, truth=PUSHED._replace(lag=PIECE))
    end = driven(otherwise, truth=PUSHED._replace(pressure=pressure, lag=PIECE))
    assert otherwise.stage == RELEASED
    assert centre_of_mass(end, PUSHED) == pytest.approx(goal.x, abs=1e-4)
    assert end.theta == pytest.approx(goal.theta, abs=math.radians(0.1))
    assert otherwise.used < as_believed.used + 0.01


def test_it_commits_itself_when_d_is_known():
    one = law()
    driven(one, d_spread=3e-3, periods=20)
    assert one.stage == LEARNING
    driven(one, d_spread=0.9e-3, periods=3)
    assert one.stage == PLACING


def test_it_does_not_learn_for_ever():
    one = law(belt=0.05)
    driven(one, d_spread=3e-3, periods=50)
    assert one.stage != LEARNING


def test_nothing_is_let_go_while_d_is_not_known_well():
    # An object that can be held at its goal: d + l tan theta = 0 on its leaf (docs/placing.md).
    goal, leaf = Goal(-0.02, -0.469), START.d + PUSHED.r * START.theta
    assert leaf - PUSHED.r * goal.theta + PUSHED.l * math.tan(goal.theta) == pytest.approx(
        0, abs=1e-4
    )
    sure, unsure = law(goal), law(goal)
    driven(sure)
    driven(unsure, d_spread=4e-4, periods=round(sure.used / PIECE) + 10)
    assert sure.stage == RELEASED
    assert unsure.stage == PLACING


def test_it_does_not_wait_for_ever():
    one = law()
    end = driven(one, d_spread=4e-4)
    assert one.stage == RELEASED
    assert centre_of_mass(end, PUSHED) == pytest.approx(-0.02, abs=1e-4)


def test_an_object_that_cannot_wait_at_its_goal_does_not_go_around_for_being_surer():
    # At this angle it drifts past the goal. To be surer may take a share of 5 % of the belt.
    goal = Goal(centre_of_mass(START, PUSHED) - 0.02, 0.43)
    sure, unsure = law(goal), law(goal)
    driven(sure)
    end = driven(unsure, d_spread=4e-4)
    assert (sure.stage, unsure.stage) == (RELEASED, RELEASED)
    assert unsure.used <= sure.used + 0.05 * 0.3
    assert centre_of_mass(end, PUSHED) == pytest.approx(goal.x, abs=2e-4)
    assert end.theta == pytest.approx(goal.theta, abs=math.radians(0.2))


def test_at_the_end_of_the_belt_it_says_that_it_has_missed_and_does_not_let_go():
    one = law(Goal(0.08, 0.0), belt=0.02)
    driven(one)
    assert one.stage == MISSED
    assert math.isnan(one.let_go_in)
    assert one.used == pytest.approx(0.02, abs=PIECE)


def test_after_a_stop_it_believes_nothing_and_remembers_the_belt():
    one = law()
    driven(one, periods=10)
    used = one.used
    one.reset()
    assert one.present() is None
    assert one.update(0.1) == AHEAD
    assert one.update(0.1) == AHEAD
    assert one.used == used > 0.0


@pytest.mark.parametrize('rare', [{'known_every': 3}, {'felt_every': 3}])
def test_it_plans_from_what_was_known_some_periods_ago(rare):
    one = law()
    end = driven(one, **rare)
    assert one.stage == RELEASED
    assert centre_of_mass(end, PUSHED) == pytest.approx(-0.02, abs=2e-4)
    assert end.theta == pytest.approx(0.0, abs=math.radians(0.2))


def test_the_belt_runs_out_while_the_finger_rests_too():
    one = law(belt=0.05)
    driven(one, periods=10)
    for _ in range(100):
        one.reset()
        one.pass_time(PERIOD)
    assert one.stage == MISSED
    assert one.rests == NOTHING_TO_DO


def test_without_a_goal_it_has_nothing_to_do_until_it_gets_one():
    one = law(NOWHERE)
    assert (one.stage, one.rests) == (NO_GOAL, NOTHING_TO_DO)
    one.aim_at(GOAL)
    assert (one.stage, one.rests, one.theta_desired) == (LEARNING, NO_REASON, 0.0)


def test_a_new_goal_has_all_the_belt_and_what_is_believed():
    one = law()
    driven(one, periods=30)
    assert one.used > 0.01
    one.aim_at(Goal(-0.01, 0.1))
    assert (one.used, one.stage, one.began) == (0.0, LEARNING, False)
    one.update(0.1)
    one.pass_time(PERIOD)
    one.update(0.1)
    assert one.stage == PLACING
    assert one.used == pytest.approx(PIECE)


def test_a_goal_that_has_ended_is_not_pushed_for():
    one = law()
    driven(one, periods=30)
    one.end(CANCELLED)
    one.pass_time(PERIOD)
    assert one.update(0.1) == AHEAD
    assert one.rests == NOTHING_TO_DO


def test_what_was_not_let_go_is_placed_again():
    one = law()
    driven(one)
    assert one.stage == RELEASED
    one.take_back()
    assert (one.stage, one.rests) == (PLACING, NO_REASON)
    assert math.isnan(one.let_go_in)


def test_the_gains_of_the_other_law_are_not_its_own():
    one = law()
    one.tune(1.0, 2.0, 0.3)
    assert (one.kp, one.kd, one.theta_desired) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize('delay', [0.05, 0.24])
def test_a_slow_lift_is_told_earlier_and_the_object_is_there_when_it_is_free(delay):
    one, now, before, told, t = law(delay=delay), START, None, math.nan, 0.0
    while one.stage != RELEASED:
        if before is not None:
            one.believe(belief(before))
            one.pass_time(PERIOD)
        one.update(now.theta)
        if math.isfinite(one.tell_in):
            assert math.isnan(told)
            told = t + one.tell_in
        way = PIECE
        if one.stage == RELEASED:
            way = one.let_go_in * BELT_SPEED
        before, now = now, follow(now, 1.0 / math.tan(one.phi), way, PUSHED)
        t += way / BELT_SPEED
        assert one.stage != LETTING_GO or not one.rests
    assert t - told == pytest.approx(delay, abs=1e-9)
    assert centre_of_mass(now, PUSHED) == pytest.approx(-0.02, abs=2e-4)
    assert now.theta == pytest.approx(0.0, abs=math.radians(0.2))


def test_an_object_whose_lift_has_begun_is_let_go_whatever_is_felt():
    one, now, before = law(delay=0.5), START, None
    while one.stage != LETTING_GO:
        if before is not None:
            one.believe(belief(before))
            one.pass_time(PERIOD)
        one.update(now.theta)
        before, now = now, follow(now, 1.0 / math.tan(one.phi), PIECE, PUSHED)
    for _ in range(8):
        one.reset()
        one.pass_time(PERIOD)
    assert one.stage == RELEASED


@pytest.mark.parametrize('felt', [math.pi / 2.0, 1.2])
def test_plans_stay_some_way_inside_of_where_the_sensor_feels(felt):
    one = law(felt=felt)
    driven(one, periods=2)
    assert felt - 0.1 < one.task().bounds.felt < felt


def test_the_task_is_what_is_left_of_it():
    one = law()
    assert one.task() is None
    driven(one, periods=40)
    task = one.task()
    assert task.belt == pytest.approx(0.3 - one.used)
    assert (task.bounds.d_min, task.bounds.d_max) == ENDS


MOVES = Moves(0.02, 0.05, BELT_SPEED)
# Pushed left of the centre of mass at this angle, it moves to the left all the way.
ASIDE = Situation(0.0, 0.35, 0.012, 0.0, 0.0)
EXCLUDED = Goal(centre_of_mass(ASIDE, PUSHED) + 0.015, 0.35)


def regrasping(**how):
    """Return a law that has just left the object for another contact."""
    one = law(EXCLUDED, moves=MOVES, room=0.05, **how)
    now = ASIDE
    for _ in range(120):
        one.believe(belief(now))
        one.update(now.theta)
        if one.away is not None:
            return one
        one.pass_time(PERIOD)
        now = follow(now, 1.0 / math.tan(one.phi), PIECE, PUSHED)
    raise AssertionError(one.stage)


def test_a_finger_of_one_axis_stays_on_the_object():
    one = law(EXCLUDED)
    driven(one, now=ASIDE, periods=80)
    assert one.away is None
    assert one.regrasps == 0


def test_a_goal_that_no_push_reaches_is_gone_for_from_another_contact():
    one = regrasping()
    assert (one.stage, one.regrasps, one.plan) == (REGRASPING, 1, None)
    assert one.away == (0.0, pytest.approx(-0.02))
    assert one.rests == NO_REASON
    # What is felt before it has gone back is still the contact that it leaves.
    one.pass_time(PERIOD)
    one.update(0.35)
    assert one.stage == REGRASPING
    used = one.used
    aside = 0.0
    while one.away != (0.0, 0.0):
        aside += one.away[0] * PERIOD
        one.pass_time(PERIOD)
        one.go_on()
    assert one.used > used + 0.005
    assert aside < -0.002  # to where it pushes the object to the right
    # What it feels then is another one, of which nothing is believed yet.
    one.pass_time(PERIOD)
    one.update(0.35)
    assert (one.stage, one.away, one.phi) == (PLACING, None, AHEAD)
    assert one.present() is None


def test_an_object_that_does_not_come_again_is_lost():
    one = regrasping()
    for _ in range(100):
        one.pass_time(PERIOD)
        one.go_on()
        if one.stage != REGRASPING:
            break
    assert (one.stage, one.away, one.rests) == (OBJECT_LOST, None, NOTHING_TO_DO)


def test_a_finger_that_was_stopped_off_the_object_goes_nowhere_by_itself():
    one = regrasping()
    one.reset()
    assert (one.stage, one.away) == (LEARNING, None)


def test_the_belt_runs_out_while_the_finger_is_off_the_object_too():
    one = regrasping(belt=0.2)
    used = one.used
    one.pass_time((0.2 - used) / BELT_SPEED + 1e-6)
    assert one.stage in (MISSED, OBJECT_LOST)
    assert one.away is None


def returning():
    """Return a law that has let go behind its line."""
    one = regrasping()
    for _ in range(5):
        one.pass_time(PERIOD)
        one.go_on()
    one.end(RELEASED)
    one.go_on()
    return one


def test_once_it_has_let_go_the_finger_goes_back_to_its_line_and_rests_there():
    one, gone = returning(), 0.0
    assert one.rests == NO_REASON
    assert not one.apart
    while one.returns:
        v_x, v_y = one.away
        assert v_x == 0.0 < v_y
        one.pass_time(PERIOD)
        one.go_on()
        gone += v_y * PERIOD
    assert gone > 0.002
    assert one.rests == NOTHING_TO_DO


def test_a_finger_that_feels_something_on_its_way_back_stands():
    one = returning()
    one.pass_time(PERIOD)
    one.update(0.1)
    assert (one.away, one.rests) == ((0.0, 0.0), NO_REASON)
    one.pass_time(PERIOD)
    one.go_on()
    assert one.away[1] > 0.0


def test_a_finger_that_was_stopped_on_its_way_back_stays_and_takes_the_next_goal():
    one = returning()
    for _ in range(2):  # in each period in which it rests
        one.reset()
        assert (one.away, one.returns, one.rests) == (None, False, NOTHING_TO_DO)
    one.aim_at(GOAL)
    assert (one.stage, one.away) == (LEARNING, None)


def test_a_new_goal_off_the_object_leaves_the_finger_on_its_way():
    one = regrasping()
    away = one.away
    one.aim_at(GOAL)
    assert (one.stage, one.away, one.goal) == (REGRASPING, away, GOAL)
