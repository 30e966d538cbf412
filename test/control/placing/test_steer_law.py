# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the law that steers does with what it is told and without it."""

import math

import pytest

from support.sticking_block import PRESSURE
from tactile_push.control import PushLaw
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed, Situation, centre_of_mass, follow
from tactile_push.control.placing.steer_law import SteerLaw
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import TurningTip

BELT_SPEED, PERIOD, PIECE = 0.005, 0.1, 5e-4
KP, KD, THETA_D = 0.05, 5.0, -0.2
USUAL = TurningTip(0.06, 0.08, 0.08, -1.0)  # -12.5 rad/m at x = 0
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(*friction_cone(0.3), USUAL, 0.0),
)
START = Situation(0.0, 0.05, -0.003, 0.0, 0.0)


def law(goal=math.nan):
    one = SteerLaw(THETA_D, BELT_SPEED, PERIOD)
    one.tune(KP, KD, THETA_D)
    one.goal = goal
    return one


def belief(now):
    spread = Spread(1e-3, 1e-3, 0.1, 0.005, PIECE)
    ends, friction = (-0.025, 0.025), (0.3, 0.3)
    return Belief(now.x, now.theta, now.d, PUSHED, friction, ends, spread)


@pytest.mark.parametrize(('goal', 'known'), [(math.nan, True), (0.0, False)])
def test_without_a_goal_or_an_estimate_it_is_law_18(goal, known):
    one, other = law(goal), PushLaw(KP, KD, THETA_D)
    one.trim = other.trim = 0.1
    for theta in (0.2, 0.21, 0.2):
        one.believe(belief(START) if known else None)
        assert one.update(theta) == other.update(theta)
        one.pass_time(PERIOD)


def test_it_brings_the_object_nearer_and_stays_within_its_bounds():
    one, now, before = law(0.004), START, None
    first = abs(centre_of_mass(now, PUSHED) - one.goal)
    for _ in range(60):
        if before is not None:
            one.believe(belief(before))
            one.pass_time(PERIOD)
        phi = one.update(now.theta)
        assert one.phi_min <= phi <= one.phi_max
        before = now
        now = follow(now, 1.0 / math.tan(phi), PIECE, PUSHED)
    assert abs(centre_of_mass(now, PUSHED) - one.goal) < first


def test_after_a_stop_it_believes_nothing_and_plans_anew():
    one = law(0.02)
    one.believe(belief(START))
    first = one.update(0.05)
    one.reset()
    assert one.present() is None
    one.believe(belief(START))
    one._looks = 0
    assert one.update(0.05) == first
