# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.sticking_block import PRESSURE
from tactile_push.control import PushLaw
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed, Situation, follow
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT

BELT_SPEED, PERIOD, PIECE = 0.005, 0.1, 5e-4
AHEAD = math.pi / 2.0
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(*friction_cone(math.inf), STRAIGHT, 0.0),
)
START = Situation(0.0, math.radians(20.0), -0.006, 0.0, 0.0)


def law():
    return SettleLaw(math.radians(-10.0), BELT_SPEED, PERIOD)


def belief(now, d_error=0.0):
    spread = Spread(1e-3, 1e-3, 0.1, 0.005, PIECE)
    ends, friction = (-0.025, 0.025), (0.0, math.inf)
    return Belief(now.x, now.theta, now.d + d_error, PUSHED, friction, ends, spread)


def driven(one, d_error=0.0, periods=100):
    """Let a law push an object, and return theta in each period."""
    now, before, thetas = START, None, []
    for _ in range(periods):
        if before is not None:
            one.believe(belief(before, d_error))
            one.pass_time(PERIOD)
        phi = one.update(now.theta)
        assert one.phi_min <= phi <= one.phi_max
        thetas.append(now.theta)
        before = now
        now = follow(now, 1.0 / math.tan(phi), PIECE, PUSHED)
    return np.array(thetas)


def test_it_is_law_18_until_something_is_believed_and_again_after_that():
    one, other = law(), PushLaw(0.05, 5.0, math.radians(-10.0))
    one.tune(0.05, 5.0, math.radians(-10.0))
    for theta in (0.2, 0.21, 0.2):
        assert one.update(theta) == other.update(theta)
    one.believe(belief(START))
    one.pass_time(PERIOD)
    assert one.update(0.19) != other.update(0.19)
    one.believe(None)
    other.phi = one.phi
    assert one.update(0.18) == other.update(0.18)


def test_the_angle_of_a_goal_takes_the_place_of_theta_desired():
    one = law()
    one.goal = math.radians(20.0)
    assert one.aim == math.radians(20.0)
    thetas = driven(one)
    assert np.abs(thetas[10:] - math.radians(20.0)).max() < math.radians(0.5)
    one.goal = math.nan
    assert one.aim == math.radians(-10.0)


def test_it_turns_the_edge_as_fast_as_phi_allows_and_then_holds_it():
    thetas = driven(law())
    # 30 degrees at most at about 1.54 / 38.5 mm are 26 periods of half a millimetre.
    assert np.abs(thetas[36:] - math.radians(-10.0)).max() < math.radians(0.1)
    assert thetas[20] > math.radians(-5.0)


@pytest.mark.parametrize('d_error', [-0.003, 0.003])
def test_a_wrong_belief_of_d_leaves_theta_near_its_angle(d_error):
    # The turn of a period is wrong by PIECE d_error / (c^2 + d^2 + l^2), 0.09 degrees, and three
    # periods bring theta back.
    thetas = driven(law(), d_error)
    assert np.abs(thetas[40:] - math.radians(-10.0)).max() < math.radians(0.5)


def test_after_a_stop_it_believes_nothing():
    one = law()
    driven(one, periods=10)
    one.reset()
    assert one.present() is None
    assert [one.update(0.1), one.update(0.1)] == [AHEAD] * 2


def test_it_goes_on_from_what_the_finger_was_told_where_that_was_less():
    one, now = law(), START
    for _ in range(3):
        one.update(now.theta)
        one.believe(belief(now))
    one.phi = AHEAD  # as where the finger may not go farther
    one.pass_time(PERIOD)
    assert one.update(now.theta) == one.phi_max
