# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes that hold an object at a place, against the mechanics and the equations of the docs."""

import math

import numpy as np
import pytest

from tactile_push.control.placing.holding import (
    BEGINNINGS,
    COUNT,
    PIECES,
    holding_push,
    later,
    linear_command,
    linear_holds,
)
from tactile_push.control.placing.model import (
    Bounds,
    Pushed,
    Situation,
    ahead,
    centre_of_mass,
    follow,
    step,
    translating,
)
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT, TurningTip

L, R, C = 0.02375, 0.0135, 0.0187
BOUNDS = Bounds(1.54, 2e3, -0.1, 0.1, -0.02, 0.02, math.radians(40.0))
USUAL = TurningTip(0.06, 0.08, 0.08, -1.0)  # -12.5 rad/m at x = 0
HOUSE = 14.0  # both poles of (S7) by the belt's way [1/m]


def pushed(mu_c=math.inf, tip=STRAIGHT):
    pressure = Pressure(C**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
    return Pushed(L, R, pressure, *friction_cone(mu_c), tip, 0.0)


def aside(x, theta, d):
    """Return the situation in which the centre of mass is at x."""
    return Situation(x + d * math.cos(theta) + (L + R) * math.sin(theta), theta, d, 0.0, 0.0)


def test_what_is_left_of_a_push_is_the_same_push():
    push = np.arange(1.0, COUNT + 1.0)
    assert later(push, 0.0) == pytest.approx(push)
    assert later(np.full(COUNT, 0.3), 0.0123) == pytest.approx(np.full(COUNT, 0.3))
    # The mean over each piece: half of the second one is on the first one now.
    half = later(push, PIECES[0] + PIECES[1] / 2.0)
    of_second = PIECES[1] / 2.0
    mean = (2.0 * of_second + 3.0 * (PIECES[0] - of_second)) / PIECES[0]
    assert half[0] == pytest.approx(mean)
    assert half[-1] == pytest.approx(push[-1])


@pytest.mark.parametrize(('x', 'e'), [(1e-3, 0.0), (0.0, 1e-4), (-5e-4, -2e-4)])
def test_the_linear_command_turns_the_edge_as_s7_asks(x, e):
    now = aside(x, 0.0, e)
    by_x = HOUSE**2 * L / (L - R)
    gain = (C**2 + e**2) / L
    by_e = (2.0 * HOUSE + gain * by_x) / (L - R)
    command, sticks = linear_command(now, 0.0, pushed(), BOUNDS)
    assert sticks
    after, _ = step(now._replace(u=command), command, 1e-6, pushed())
    assert (after.theta - now.theta) / 1e-6 == pytest.approx(by_x * x - by_e * e, rel=1e-3)


@pytest.mark.parametrize('mu_c', [0.05, 0.1, 0.3])
@pytest.mark.parametrize('x', [-0.02, 0.02])
def test_no_contact_slips_under_the_linear_command_where_it_can_stick(mu_c, x):
    now = aside(x, 0.02, -0.8 * L * mu_c)
    thing = pushed(mu_c)
    command, sticks = linear_command(now, 0.0, thing, BOUNDS)
    assert sticks == (command == linear_command(now, 0.0, pushed(), BOUNDS)[0])
    assert command != pytest.approx(translating(now, thing))
    after, _ = step(now._replace(u=command), command, 1e-5, thing)
    turn = after.theta - now.theta
    assert after.d - now.d == pytest.approx(-R * turn, abs=1e-9)  # (16) without slip


def held(now, thing, goal, rounds):
    """Push towards a goal; return the last situation and where the object was."""
    push, places = np.zeros(COUNT), []
    for k in range(rounds):
        push = holding_push(push, k % BEGINNINGS, now, goal, thing, BOUNDS)
        for i in range(3):
            u = ahead(now, thing, BOUNDS) + push[i]
            u = min(max(u, -BOUNDS.steepest), BOUNDS.steepest)
            now = follow(now, u, PIECES[i], thing)
        places.append(centre_of_mass(now, thing))
        push = later(push, PIECES[:3].sum())
    return now, np.array(places)


@pytest.mark.parametrize(('mu_c', 'd', 'holds'), [(math.inf, 0.001, True), (0.3, -0.008, False)])
def test_the_linear_law_holds_where_the_contact_sticks(mu_c, d, holds):
    assert linear_holds(aside(0.01, 0.0, d), 0.0, pushed(mu_c), BOUNDS) is holds


def test_the_linear_law_does_not_hold_an_object_that_it_carries_out_of_the_workspace():
    near_the_end = BOUNDS._replace(x_max=0.012)
    assert not linear_holds(aside(0.01, 0.0, 0.0), 0.0, pushed(), near_the_end)


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.5, math.inf])
def test_an_object_is_brought_to_its_place_and_held_whatever_the_friction(mu_c):
    # At first with a contact that has to slip: |d| > l mu_c for the smaller two.
    thing = pushed(mu_c, USUAL)
    now, places = held(aside(0.006, 0.1, -0.003), thing, 0.0, 50)
    assert np.abs(places[40:]).max() < 2e-3
    # Straight ahead, and the contact sticks: docs/placing.md.
    assert now.d + L * math.tan(now.theta) == pytest.approx(0.0, abs=3e-4)
    assert abs(now.d) <= L * mu_c + 3e-4
