# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where plans aim and how much belt they keep, by what is known and how the last ones ended."""

import math

import numpy as np
import pytest

from support.sticking_block import PRESSURE
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.ending import Ending
from tactile_push.control.placing.horizon import Plan
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Goal, Pushed, Situation
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT

PIECE, DELAY, BELT = 5e-4, 2e-4, 0.3
GOAL, NOW = Goal(-0.02, 0.0), Situation(0.0, 0.0, 0.003, 0.0, 0.0)
PUSHED = Pushed(0.02375, 0.0135, PRESSURE, *friction_cone(math.inf), STRAIGHT, 0.0)


def plan(length, miss=0.0):
    """Return a plan of so much belt, which misses the goal across the belt [m]."""
    return Plan(np.array([0.0, 0.0, 0.0, 0.0, length / 0.1, 0.0, 0.0, 0.0]), 0.0, miss, 0.0, 0.0)


def spread(d=1e-4, theta=1e-3, log_c=0.1):
    return Spread(theta, d, log_c, 0.005, PIECE)


def belief(log_c=0.1):
    known = math.inf, math.inf
    return Belief(0.0, 0.0, NOW.d, PUSHED, known, (-0.025, 0.025), spread(log_c=log_c))


@pytest.fixture
def ending():
    return Ending(BELT, PIECE, DELAY)


def test_who_knows_enough_keeps_no_belt(ending):
    assert ending.least(None, spread(), 0.0) == 0.0
    for vague in (spread(d=1e-3), spread(theta=0.01)):
        assert ending.least(None, vague, 0.0) == ending.least(plan(0.1), vague, 0.0) > DELAY


def test_a_plan_that_does_not_arrive_keeps_no_belt(ending):
    assert ending.least(plan(0.1, miss=0.01), spread(d=1e-3), 0.0) == 0.0


def test_belt_is_kept_for_a_while_only(ending):
    vague = spread(d=1e-3)
    kept = ending.least(None, vague, 0.1)
    ending.take(plan(kept), None, 0.1)
    assert ending.least(plan(kept), vague, 0.11) == kept
    assert ending.least(plan(kept), vague, 0.1 + BELT) == 0.0
    ending.begin()
    assert ending.least(plan(kept), vague, 0.1 + BELT) == kept


def test_a_missed_end_takes_another_loop_until_a_plan_arrives(ending):
    missed = plan(PIECE / 2.0, miss=0.002)
    assert ending.take(missed, None, 0.1)
    loop = ending.least(missed, spread(), 0.1)
    assert loop > 10.0 * PIECE
    assert not ending.take(plan(0.05, miss=0.002), missed, 0.1)
    assert ending.least(missed, spread(), 0.1) == loop
    ending.take(plan(0.05), missed, 0.1)
    assert ending.least(plan(0.05), spread(), 0.1) == 0.0


def test_belt_is_not_kept_where_plans_that_keep_it_have_ceased_to_arrive(ending):
    vague = spread(d=1e-3)
    kept = ending.least(None, vague, 0.1)
    ending.take(plan(0.1, miss=0.01), plan(0.1), 0.1)
    assert ending.least(plan(0.002), vague, 0.1) == 0.0
    ending.take(plan(0.002), plan(0.002), 0.1)  # which keeps none
    assert ending.least(plan(0.002), vague, 0.1) == 0.0
    ending.take(plan(2.0 * kept), plan(0.002), 0.1)
    assert ending.least(plan(2.0 * kept), vague, 0.1) == kept


@pytest.mark.parametrize(('length', 'is_last'), [(PIECE, True), (2.0 * PIECE, False)])
def test_the_lift_takes_its_part_of_the_last_period(ending, length, is_last):
    assert ending.take(plan(length), None, 0.1) == is_last
    assert ending.take(None, None, 0.1) is False


def test_a_plan_aims_up_the_drift_the_more_the_less_the_turn_is_known(ending):
    assert ending.aim(GOAL, None, NOW, belief()) == GOAL
    # At theta 0 the ray from the contact leads to smaller x where d is positive.
    aims = [ending.aim(GOAL, plan(0.05), NOW, belief(log_c)).x for log_c in (0.0, 0.1, 0.2)]
    assert GOAL.x < aims[0] < aims[1] < aims[2] < GOAL.x + 0.005
    right = ending.aim(GOAL, plan(0.05), NOW._replace(d=-0.003), belief())
    assert right.x - GOAL.x == pytest.approx(GOAL.x - aims[1])


def test_at_its_end_a_plan_aims_at_the_goal(ending):
    assert ending.aim(GOAL, plan(PIECE), NOW, belief()) == GOAL
