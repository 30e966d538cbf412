# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The push that tells most, against the bound of Cramer and Rao by differences of whole pushes."""

import math

import numpy as np
import pytest

from tactile_push.control.placing.learning import Spread, telling_command
from tactile_push.control.placing.model import Bounds, Pushed, Situation, follow
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT

PIECE, NOISE, SLIPPERY = 5e-4, 0.005, 0.1
SPREAD = Spread(NOISE, 4e-3, 0.3, NOISE, PIECE)
BOUNDS = Bounds(1.5, 2000.0, -0.1, 0.1, -0.022, 0.022, 0.8)


def pushed(c=0.0187, mu_c=math.inf):
    pressure = Pressure(c * c, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
    return Pushed(0.02375, 0.0135, pressure, *friction_cone(mu_c), STRAIGHT, 0.0)


def readings(commands, theta, d, log_c, mu_c=math.inf):
    now, found = Situation(0.0, theta, d, 0.0, 0.0), []
    for command in commands:
        now = follow(now, command, PIECE, pushed(0.0187 * math.exp(log_c), mu_c))
        found.append(now.theta)
    return np.array(found)


def deviation(commands, theta, d):
    """Return the least standard deviation of d after a push, with the spreads known before.

    The fourth unknown is friction: two deviations lie between what sticks and what slips.
    """
    at, step = np.array((theta, d, 0.0)), np.array((1e-5, 1e-6, 1e-4))
    slopes = [
        (readings(commands, *(at + e)) - readings(commands, *(at - e))) / (2.0 * e.sum())
        for e in np.diag(step)
    ]
    slips = (readings(commands, *at, SLIPPERY) - readings(commands, *at)) / 2.0
    slopes = np.array([*slopes, slips])
    before = np.diag(1.0 / np.square((SPREAD.theta, SPREAD.d, SPREAD.log_c, 1.0)))
    return math.sqrt(np.linalg.inv(before + slopes @ slopes.T / NOISE**2)[1, 1])


def told(now, theta, bounds=BOUNDS, spread=SPREAD, slippery=SLIPPERY):
    return telling_command(now, pushed(), pushed(mu_c=slippery), bounds, spread, theta)


@pytest.mark.parametrize(
    ('theta', 'd', 'share'), [(0.3, 0.004, 0.8), (0.0, -0.01, 0.8), (-0.2, 0.0, 1.01)]
)
def test_it_tells_of_d_what_a_push_straight_ahead_tells_and_mostly_more(theta, d, share):
    now, commands = Situation(0.0, theta, d, 0.0, 0.0), []
    for _ in range(24):
        commands.append(told(now, theta))
        now = follow(now, commands[-1], PIECE, pushed())
    known, ahead = (deviation(one, theta, d) for one in (commands, [0.0] * 24))
    assert known < share * ahead
    assert abs(now.theta - theta) < math.radians(20.0)


@pytest.mark.parametrize(('theta', 'd'), [(0.31, 0.0041), (0.05, -0.011)])
def test_it_is_alike_on_both_sides(theta, d):
    one = told(Situation(0.01, theta, d, 0.2, 0.2), theta)
    other = told(Situation(-0.01, -theta, -d, -0.2, -0.2), -theta)
    assert one == -other != 0.0


def test_it_stays_away_from_an_end_of_the_edge():
    # Turning clockwise rolls the finger to larger d.
    narrow = SPREAD._replace(d=1e-3)
    now = Situation(0.0, 0.0, 0.0205, 0.0, 0.0)
    for _ in range(20):
        command = told(now, 0.0, spread=narrow)
        now = follow(now, command, PIECE, pushed())
    assert now.d < 0.0215


def test_it_stays_on_the_edge_also_if_the_contact_slips():
    narrow = SPREAD._replace(d=1e-3)
    now = Situation(0.0, 0.3, 0.018, 0.0, 0.0)
    for _ in range(30):
        command = told(now, 0.3, spread=narrow, slippery=0.0)
        now = follow(now, command, PIECE, pushed(mu_c=0.0))
    assert now.d < 0.022


def test_it_stays_near_its_angle():
    now, commands, thetas = Situation(0.0, 0.0, 0.01, 0.0, 0.0), [], []
    for _ in range(48):
        commands.append(told(now, 0.0))
        now = follow(now, commands[-1], PIECE, pushed())
        thetas.append(now.theta)
    assert np.abs(thetas).max() < math.radians(6.0)
    # What holds theta points the ray at the finger's motion, whatever c and friction are.
    assert deviation(commands, 0.0, 0.01) < 0.5 * deviation([0.0] * 48, 0.0, 0.01)
