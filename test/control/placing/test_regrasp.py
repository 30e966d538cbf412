# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Another contact: the way there by elementary geometry, and goals that only it reaches."""

import math
from dataclasses import replace

import pytest

from support.sticking_block import BOUNDS, STICKING
from tactile_push.control.placing.arcs import ARCS, LENGTH
from tactile_push.control.placing.model import (
    Goal,
    Situation,
    centre_of_mass,
    follow,
)
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import Moves, Regrasp, detour, touches

BELT, ACCELERATION = 0.005, 0.05
MOVES = Moves(0.02, ACCELERATION, BELT, 0.003)
START = Situation(0.0, 0.35, 0.012, 0.0, 0.0)
ROOM = 0.05
# Pushed left of the centre of mass at this angle, it moves to the left all the way.
EXCLUDED = Goal(centre_of_mass(START, STICKING) + 0.015, 0.35)


@pytest.mark.parametrize('way', [1e-5, 1e-3, 0.008, 0.03])
def test_a_way_takes_what_speeding_up_and_slowing_down_take(way):
    # Half of it at most to speed up; what is left at the full speed.
    ramp = min(way / 2.0, MOVES.speed**2 / (2.0 * ACCELERATION))
    fastest = math.sqrt(2.0 * ACCELERATION * ramp)
    expected = 2.0 * fastest / ACCELERATION + (way - 2.0 * ramp) / fastest
    assert MOVES.time(way) == pytest.approx(expected)


@pytest.mark.parametrize('gap', [1e-4, 2e-3, 0.02])
def test_after_the_retreat_the_edge_is_as_far_away_as_it_shall_be(gap):
    back = MOVES.retreat(gap)
    assert back - BELT * MOVES.time(back) == pytest.approx(gap)


@pytest.mark.parametrize('before', [0.0, 0.013])
@pytest.mark.parametrize('way', [3e-4, -0.007, 0.0213])
def test_a_finger_speeds_up_goes_and_stops_at_the_end_of_its_way(way, before):
    period, left, v = 0.1, way, math.copysign(min(before, 5.0 * abs(way)), way)
    passed = 0.0
    while passed < 6.0:
        wanted = MOVES.towards(left, period)
        v = min(max(wanted, v - ACCELERATION * period), v + ACCELERATION * period)
        assert abs(v) <= MOVES.speed
        left, passed = left - v * period, passed + period
        if left == pytest.approx(0.0, abs=1e-9):
            break
        assert left / math.copysign(1.0, way) > -ACCELERATION * period**2 / 8.0
    assert v == pytest.approx(0.0, abs=ACCELERATION * period)
    assert passed < MOVES.time(abs(way)) + 8 * period


@pytest.mark.parametrize('theta', [-0.6, 0.0, 0.4])
@pytest.mark.parametrize('d', [-0.015, 0.011, 0.02])
def test_the_finger_keeps_clear_of_the_edge_and_meets_it_where_it_waits(theta, d):
    now = Situation(0.01, theta, 0.012, 0.0, 0.0)
    way = detour(now, d, MOVES)

    # The disk's centre touches on a line parallel to the edge, which moves with the belt.
    def gap(t, across):
        return math.tan(theta) * across - BELT * t + way.back

    retreat, over = MOVES.time(way.back), MOVES.time(abs(way.across))
    ends = gap(retreat, 0.0), gap(retreat + over, way.across)
    assert min(ends) == pytest.approx(MOVES.clearance)  # no belt is wasted
    assert gap(way.belt / BELT, way.across) == pytest.approx(0.0, abs=1e-12)
    # The contact has moved along the edge by the difference of d.
    assert way.across == pytest.approx((d - now.d) * math.cos(theta))


def test_a_finger_no_faster_than_the_belt_never_leaves_the_object():
    with pytest.raises(ValueError, match='speed: expected more than the belt has'):
        Moves(BELT, ACCELERATION, BELT)


def arriving(task, room=ROOM):
    """Return the contacts that lead to the excluded goal."""
    tried = touches(task, EXCLUDED, MOVES, room)
    return [one for one in tried if one is not None and one.plan.arrives]


def test_a_goal_that_sticking_excludes_is_reached_from_another_contact():
    task = Task(START, STICKING, BOUNDS, 0.2)
    assert not task.arrives(EXCLUDED)

    found = arriving(task)

    assert found
    for touch in found:
        now = Situation(START.x + touch.detour.across, START.theta, touch.d, 0.0, 0.0)
        still = centre_of_mass(START, STICKING)
        assert centre_of_mass(now, STICKING) == pytest.approx(still, abs=1e-9)
        for u, belt in zip(touch.plan.push[:ARCS], touch.plan.push[ARCS:], strict=True):
            now = follow(now, u, belt * LENGTH, STICKING)
        assert centre_of_mass(now, STICKING) == pytest.approx(EXCLUDED.x, abs=3e-4)
        assert now.theta == pytest.approx(EXCLUDED.theta, abs=math.radians(0.3))
        assert touch.belt < task.belt


def test_a_finger_goes_neither_out_of_the_workspace_nor_farther_back_than_it_may():
    task = Task(START, STICKING, BOUNDS, 0.3)
    assert not arriving(task, room=0.001)
    # The other contacts that lead there are to the left.
    assert not arriving(replace(task, bounds=BOUNDS._replace(x_min=0.0)))


@pytest.mark.parametrize('told', [0, 3, 20])  # in which period the finger is told where to
def test_it_goes_back_first_and_then_across_and_knows_when_the_object_is_late(told):
    way = detour(START, -0.012, MOVES)
    regrasp, period = Regrasp(MOVES), 0.1
    v, x, y, clear, gaps = (0.003, 0.0), 0.0, 0.0, [], []
    while not regrasp.is_late:
        if len(clear) == told:
            regrasp.go(way)
        wanted = regrasp.velocity(period)
        change = ACCELERATION * period
        v = tuple(min(max(a, b - change), b + change) for a, b in zip(wanted, v, strict=True))
        regrasp.pass_time(period, v)
        x, y = x + v[0] * period, y + v[1] * period
        clear.append(regrasp.is_clear)
        # How far the edge, which is straight, is away from the finger.
        gaps.append(-y - BELT * len(clear) * period + math.tan(START.theta) * x)
        if not regrasp.is_clear:
            assert abs(x) < 1e-3  # but for what it takes to stop the push
    assert x == pytest.approx(way.across, abs=1e-4)
    assert clear == sorted(clear)
    across = gaps[clear.index(True) : clear.index(True) + math.ceil(MOVES.time(abs(x)) / period)]
    assert min(across) > 0.0
    # It is late a while after the edge has come to where it waits.
    assert -0.012 < gaps[-1] < 0.0


def test_a_finger_that_is_not_told_where_to_keeps_away_from_the_edge():
    regrasp, period, gap = Regrasp(MOVES), 0.1, []
    for _ in range(40):
        v = regrasp.velocity(period)
        regrasp.pass_time(period, v)
        gap.append((gap[-1] if gap else 0.0) - (v[1] + BELT) * period)
    assert not regrasp.is_clear
    assert gap[20:] == pytest.approx([gap[20]] * 20)
    # It would be the least if speeding up took its time.
    ramp = BELT * MOVES.speed / ACCELERATION
    assert MOVES.clearance <= gap[20] <= MOVES.clearance + ramp
