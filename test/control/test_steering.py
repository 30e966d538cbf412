# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Steering against the mechanics of a tip that turns, and what it asks of law (18)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import PushControl, PushLaw
from tactile_push.control.limits import Limits
from tactile_push.control.steering import STEEPEST, Steering
from tactile_push.mechanics import friction_cone, push
from tactile_push.mechanics.contact import contact, piece_at
from tactile_push.simulation import paper_block

PERIOD, BELT_SPEED, AHEAD = 0.1, 0.005, math.pi / 2.0
KP, KD = 0.05, 5.0
TURNING = -12.5  # of the usual finger at home [rad/m]
START = 0.007  # about where the centre of mass of fig. 8's block starts, from the finger [m]
checked = settings(derandomize=True, deadline=None, max_examples=40)


def pushed(goal, turning, steps=900, theta_desired=0.0, noise=0.0, gains=(KP, KD), c=0.0187):
    """Return theta [rad], x of the centre of mass and of the finger [m], and the steering.

    Fig. 8's block under the control, with no bound on x. The tip turns at a constant rate.
    """
    config = paper_block(c=c)
    law = PushLaw(*gains, theta_desired)
    steering = Steering(law, BELT_SPEED, goal)
    limits = Limits(workspace_min=-9.0, workspace_max=9.0)
    control = PushControl(law, BELT_SPEED, PERIOD, limits, steering)
    control.activate(0.0)
    random = np.random.default_rng(0)
    theta, sigma, x, found = config.theta, config.sigma, 0.0, []
    cone, path, r = friction_cone(config.mu_c), config.body.path, config.radius
    for k in range(steps):
        _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
        found.append((theta, x - d * math.cos(theta) - (l + r) * math.sin(theta), x))
        control.locate_finger(x, k * PERIOD, AHEAD + turning * x)
        control.feel(theta + random.normal(0.0, noise), k * PERIOD)
        v_x = control.tick(k * PERIOD).v_x
        theta, sigma, _, _ = push(
            *(theta, sigma, v_x, BELT_SPEED, PERIOD, path, config.body.c, None),
            *(*cone, r, turning * v_x),
        )
        x += v_x * PERIOD
    return *np.array(found).T, steering


@pytest.mark.parametrize('turning', [TURNING, -5.0, 0.0, 12.5])
@pytest.mark.parametrize('aside', [-0.015, 0.01])
def test_the_block_is_carried_straight_ahead_at_the_goal_however_the_tip_turns(turning, aside):
    goal = aside - START
    theta, x, finger, steering = pushed(goal, turning, steps=1200)
    late = slice(-200, None)
    assert np.abs(x[late] - goal).max() < 5e-4
    assert np.ptp(finger[late]) < 1e-3
    # Straight ahead: the contact is right behind the centre of mass, docs/placing.md.
    assert finger[-1] - 0.0135 * math.sin(theta[-1]) == pytest.approx(x[-1], abs=2e-4)
    assert steering.x == pytest.approx(x[-2], abs=2e-4)
    assert steering.target == goal


@pytest.mark.parametrize('c', [0.0067, 0.024])
def test_it_does_not_have_to_know_c_nor_readings_without_noise(c):
    _, x, _, _ = pushed(-START, TURNING, steps=1300, noise=math.radians(0.3), c=c)
    assert np.abs(x[-300:] + START).max() < 2e-3


def test_it_does_not_matter_which_angle_law_18_is_told():
    ways = [pushed(0.0, TURNING, 60, theta_desired)[2] for theta_desired in (0.0, -0.3)]
    assert ways[0] == pytest.approx(ways[1], abs=1e-12)


@checked
@given(st.lists(st.floats(-1.4, 1.4), min_size=2, max_size=40), st.floats(-0.1, 0.1))
def test_with_its_lead_the_law_follows_the_angle_as_it_follows_theta(thetas, goal):
    # phi(k) - phi(k-1) = kp (theta - aim) + kd (change of theta - change of aim)
    law = PushLaw(KP, KD, 0.0, -1e9, 1e9)
    steering = Steering(law, BELT_SPEED, goal)
    aims, phis = [], []
    for theta in thetas:
        law.trim = steering.follow(theta, 0.0, 0.0, AHEAD, PERIOD)
        phis.append(law.update(theta))
        aims.append(law.aim)
    # The law aims at a + kd/kp (a - a before); a is theta before there is a reason to turn.
    aim = (KP * aims[0] + KD * thetas[0]) / (KP + KD)
    for k in range(1, len(thetas)):
        now = (KP * aims[k] + KD * aim) / (KP + KD)
        changed = KP * (thetas[k] - now) + KD * (thetas[k] - thetas[k - 1] - (now - aim))
        assert phis[k] - phis[k - 1] == pytest.approx(changed, abs=1e-9)
        assert abs(now) <= max(STEEPEST, abs(thetas[0])) + 1e-9
        assert abs(now - aim) <= math.radians(0.4) + 1e-9 or abs(aim) > STEEPEST
        aim = now


def test_where_the_object_cannot_be_held_at_the_goal_it_goes_to_the_nearest_place():
    # The tip rolls the contact by r 12.5 rad/m 0.1 m = 17 mm on the way there; no angle up to
    # 40 degrees makes up for that: 10 mm are (l - r + l q) theta with q = -0.144.
    theta, x, _, steering = pushed(0.1, TURNING, steps=3000)
    assert START < steering.target < 0.06
    assert np.abs(theta[-300:]).max() < STEEPEST + math.radians(2.0)
    assert abs(x[-1] - steering.target) < 4e-3
    assert np.ptp(x[-300:]) < 2e-3


def test_without_a_goal_law_18_is_left_alone():
    theta, _, _, steering = pushed(math.nan, 0.0, 300, math.radians(-10.0))
    assert steering.trim == 0.0
    assert math.isnan(steering.x)
    assert math.isnan(steering.target)
    assert math.degrees(theta[250]) == pytest.approx(-10.0, abs=1.5)  # as in fig. 8


@pytest.mark.parametrize(('x', 'psi'), [(math.nan, AHEAD), (0.0, math.nan)])
def test_a_finger_that_is_not_known_is_not_steered(x, psi):
    steering = Steering(PushLaw(KP, KD, 0.0), BELT_SPEED, 0.02)
    for _ in range(50):
        steering.follow(0.1, 0.0, 0.0, AHEAD, PERIOD)
    assert steering.trim != 0.0
    assert steering.follow(0.1, 0.0, x, psi, PERIOD) == 0.0
    assert math.isnan(steering.x)


def test_after_a_reset_it_begins_where_theta_is():
    steering = Steering(PushLaw(KP, KD, 0.0), BELT_SPEED, 0.02)
    for _ in range(100):
        steering.follow(0.1, 0.0, 0.0, AHEAD, PERIOD)
    steering.reset()
    assert steering.trim == 0.0
    # d is hardly known yet, so the edge is hardly turned: by less than 0.05 degrees.
    lead = 1.0 + KD / KP
    trim = steering.follow(-0.2, 0.0, 0.05, AHEAD, PERIOD)
    assert abs(trim + 0.2) < lead * math.radians(0.05)


def test_without_kp_it_leads_by_nothing():
    steering = Steering(PushLaw(0.0, KD, 0.0), BELT_SPEED, 0.02)
    for _ in range(100):
        assert abs(steering.follow(0.1, 0.0, 0.0, AHEAD, PERIOD)) <= STEEPEST


@pytest.mark.parametrize(
    ('l', 'turning', 'holds'),
    [
        # l - r + 2 l r psi_x / (1 - r psi_x) for r = 13.5 mm
        (0.02375, -12.5, True),  # 10.25 - 6.86
        (0.0175, -12.5, False),  # 4.0 - 5.05
        (0.012, 0.0, False),  # -1.5
        (0.02375, math.nan, False),
    ],
)
def test_it_tells_where_turning_the_edge_moves_the_contact_enough(l, turning, holds):
    assert Steering(PushLaw(KP, KD, 0.0), BELT_SPEED, 0.0, l).holds(turning) is holds
