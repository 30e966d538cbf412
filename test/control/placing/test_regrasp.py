# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Another contact: the way there by elementary geometry, and goals that only it reaches."""

import math

import numpy as np
import pytest

from tactile_push.control.placing.arcs import ARCS, LENGTH
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    follow,
)
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import detour, touches
from tactile_push.mechanics.resistance import Pressure

PRESSURE = Pressure(0.0187**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
NUMBERS = Pushed(0.02375, 0.0135, PRESSURE, 0.0, 1.0, 0.0, 0.0)  # which sticks
BOUNDS = Bounds(1.5, 1e9, -0.1, 0.1, -0.022, 0.022, 0.8)
MOVES = {'speed': 0.02, 'belt_speed': 0.005, 'clearance': 0.003}
START = Situation(0.0, 0.35, 0.012, 0.0, 0.0)


@pytest.mark.parametrize('theta', [-0.6, 0.0, 0.4])
@pytest.mark.parametrize('d', [-0.015, 0.011, 0.02])
def test_the_finger_keeps_clear_of_the_edge_and_meets_it_where_it_waits(theta, d):
    now = Situation(0.01, theta, 0.012, 0.0, 0.0)
    way = detour(now, d, **MOVES)

    # The disk's centre touches on a line parallel to the edge, which moves with the belt.
    def gap(t, x, y):
        return math.tan(theta) * (x - now.x) - MOVES['belt_speed'] * t - y

    retreat = way.back / MOVES['speed']
    over = abs(way.across) / MOVES['speed']
    gaps = [
        gap(retreat + share * over, now.x + share * way.across, -way.back)
        for share in np.linspace(0.0, 1.0, 11)
    ]
    assert min(gaps) == pytest.approx(MOVES['clearance'])  # no belt is wasted
    end = now.x + way.across
    assert gap(way.time, end, -way.back) == pytest.approx(0.0, abs=1e-12)
    assert way.belt == pytest.approx(MOVES['belt_speed'] * way.time)
    # The contact has moved along the edge by the difference of d.
    assert way.across == pytest.approx((d - now.d) * math.cos(theta))


def test_a_finger_no_faster_than_the_belt_never_leaves_the_object():
    with pytest.raises(ValueError, match='speed: expected more than the belt has'):
        detour(START, 0.0, speed=0.005, belt_speed=0.005, clearance=0.003)


def test_a_goal_that_sticking_excludes_is_reached_from_another_contact():
    # Pushed left of the centre of mass at this angle, it moves to the left all the way.
    goal = Goal(centre_of_mass(START, NUMBERS) + 0.015, 0.35)
    task = Task(START, NUMBERS, BOUNDS, 0.15)
    assert not task.arrives(goal)

    *_, touch = touches(task, goal, **MOVES)

    now = Situation(START.x + touch.detour.across, START.theta, touch.d, 0.0, 0.0)
    assert centre_of_mass(now, NUMBERS) == pytest.approx(centre_of_mass(START, NUMBERS), abs=1e-9)
    for u, belt in zip(touch.plan.push[:ARCS], touch.plan.push[ARCS:], strict=True):
        now = follow(now, u, belt * LENGTH, NUMBERS)
    assert centre_of_mass(now, NUMBERS) == pytest.approx(goal.x, abs=3e-4)
    assert now.theta == pytest.approx(goal.theta, abs=math.radians(0.3))
    assert touch.detour.belt + touch.plan.length <= task.belt


def test_the_best_so_far_only_gets_better():
    goal = Goal(centre_of_mass(START, NUMBERS) + 0.015, 0.35)
    found = [*touches(Task(START, NUMBERS, BOUNDS, 0.3), goal, **MOVES)]
    belts = [one.detour.belt + one.plan.length for one in found if one is not None]
    assert belts
    assert belts == sorted(belts, reverse=True)
