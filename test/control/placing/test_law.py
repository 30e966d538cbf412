# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.control.placing.law import (
    LEARNING,
    MISSED,
    PLACING,
    RELEASED,
    Belief,
    PlaceLaw,
)
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Goal, Pushed, Situation, centre_of_mass, follow
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure

BELT_SPEED, PERIOD, PIECE = 0.005, 0.1, 5e-4
AHEAD = math.pi / 2.0
PUSHED = Pushed(
    *(0.02375, 0.0135, Pressure(0.0187**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))),
    *(*friction_cone(math.inf), 0.0, 0.0),
)
ENDS = (-0.025, 0.025)
GOAL, START = Goal(-0.02, 0.0), Situation(0.0, 0.2, 0.003, 0.0, 0.0)


def law(goal=GOAL, belt=0.3):
    return PlaceLaw(goal, belt, BELT_SPEED, PERIOD)


def belief(now, d_spread=1e-4):
    spread = Spread(1e-3, d_spread, 0.1, 0.005, PIECE)
    return Belief(now.x, now.theta, now.d, PUSHED, ENDS, spread)


def driven(one, d_spread=1e-4, now=START, periods=600):
    """Let a law push an object that is what it believes it to be; return where it ends."""
    before = None
    for _ in range(periods):
        if before is not None:
            one.believe(belief(before, d_spread))
        phi = one.update(now.theta)
        assert one.phi_min <= phi <= one.phi_max
        before, way = now, PIECE
        if one.stage == RELEASED:
            way = one.let_go_in * BELT_SPEED
        now = follow(now, 1.0 / math.tan(phi), way, PUSHED)
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
    assert one.update(0.1) == AHEAD
    assert one.update(0.1) == AHEAD
    assert one.used == used > 0.0
