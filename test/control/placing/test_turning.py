# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The command that turns the edge, against the least belt that a turn can take."""

import math

import numpy as np
import pytest

from tactile_push.control.placing.model import Bounds, Pushed, Situation, follow
from tactile_push.control.placing.turning import turning_command
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT

L, R, C = 0.02375, 0.0135, 0.0187
PIECE, STEEPEST = 5e-4, 1.54
BOUNDS = Bounds(STEEPEST, 2000.0, -0.1, 0.1, -0.023, 0.023, math.inf)


def pushed(mu_c=math.inf, lag=0.0):
    round_ = np.array((1.0, 0.0, 1.0))
    return Pushed(L, R, Pressure(C * C, 0.0, 0.0, round_), *friction_cone(mu_c), STRAIGHT, lag)


START = Situation(0.0, 0.35, -0.006, 0.0, 0.0)


def turned(theta, mu_c=math.inf, lag=5e-4, now=START, pieces=120):
    """Return theta and d at the start of every piece of belt, and the commands."""
    thing, rows = pushed(mu_c, lag), []
    for _ in range(pieces):
        command = turning_command(now, theta, PIECE, thing, BOUNDS)
        assert abs(command) <= STEEPEST
        rows.append((now.theta, now.d, command))
        now = follow(now, command, PIECE, thing)
    return np.array(rows).T


def least_belt(start, end, d):
    """Return the belt of a turn at the steepest command, a contact that sticks, by Euler."""
    theta, belt, step = start, 0.0, 1e-5
    u = math.copysign(STEEPEST, end - start)
    while (theta - end) * (start - end) > 0.0:
        delta = math.atan2(d, L)
        rate = (math.sin(theta + delta) + u * math.cos(theta + delta)) * math.hypot(d, L)
        rate /= C * C + d * d + L * L  # (P2)
        theta, d, belt = theta + rate * step, d - R * rate * step, belt + step
    return belt


@pytest.mark.parametrize('theta', [-0.17, 0.0, 0.6])
def test_the_edge_is_there_as_soon_as_a_turn_can_bring_it_and_stays(theta):
    thetas, _, commands = turned(theta)
    near = np.abs(thetas - theta) < math.radians(1.0)
    first = int(np.argmax(near))
    least = least_belt(0.35, theta, -0.006)
    assert least <= (first + 1) * PIECE <= least + 5.0 * PIECE  # the finger lags by one
    assert near[first:].all()
    assert np.abs(thetas[-50:] - theta).max() < math.radians(0.05)
    # Carried on without turning: u = -tan chi.
    chi = thetas[-1] + math.atan2(turned(theta)[1][-1], L)
    assert commands[-1] == pytest.approx(-math.tan(chi), abs=0.01)


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.3])
def test_a_contact_that_slips_is_brought_to_where_it_can_stay(mu_c):
    thetas, d, _ = turned(-0.17, mu_c, pieces=300)
    assert np.abs(thetas[-100:] + 0.17).max() < math.radians(1.0)
    # An object that does not turn is pushed by a force through its centre of mass.
    assert abs(d[-1]) <= L * mu_c + 2e-4


def test_an_edge_that_is_there_and_translates_is_left_alone():
    now = Situation(0.0, 0.1, -L * math.tan(0.1), 0.0, 0.0)  # carried straight ahead
    assert turning_command(now, 0.1, PIECE, pushed(), BOUNDS) == pytest.approx(0.0, abs=1e-3)


def test_without_friction_the_finger_goes_first_to_the_side_that_turns_the_object_back():
    # d > 0 turns counterclockwise whatever the push; theta is to fall, so d has to fall first.
    now = Situation(0.0, 0.1, 0.004, 0.0, 0.0)
    thetas, d, _ = turned(-0.1, 0.0, now=now, pieces=300)
    crossed = int(np.argmax(d < 0.0))
    assert 0 < crossed < 100
    assert thetas[: crossed + 1].max() == pytest.approx(thetas[crossed], abs=1e-3)
    assert np.abs(thetas[-50:] + 0.1).max() < math.radians(1.0)
