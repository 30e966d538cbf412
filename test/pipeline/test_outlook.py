# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from types import SimpleNamespace

import pytest

from support.sticking_block import PRESSURE
from tactile_push.control.placing import horizon
from tactile_push.control.placing.law import NOWHERE
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.stages import OUT_OF_REACH, UNKNOWN, WITH_RESERVE, WORKSPACE
from tactile_push.mechanics.turning_tip import STRAIGHT
from tactile_push.pipeline.outlook import ReachOutlook

BOUNDS = Bounds(1.54, 2000.0, -0.1, 0.1, -0.024, 0.024, 0.85)
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(0.0, 1.0, STRAIGHT, 0.0),
)
TASK = Task(Situation(0.0, 0.1, -0.002, 0.0, 0.0), PUSHED, BOUNDS, 0.4)
NEAR, BEYOND = Goal(-0.01, 0.0), Goal(-0.14, 0.0)


def law(task=TASK):
    return SimpleNamespace(task=lambda: task)


@pytest.fixture
def refined(monkeypatch):
    """List the goals for which a push was refined."""
    found = []
    refine = horizon.refine

    def noted(push, now, goal, *more):
        found.append(goal)
        return refine(push, now, goal, *more)

    monkeypatch.setattr(horizon, 'refine', noted)
    return found


def looked(outlook, refined, goal, deviation=1e-3):
    """Look once; return how many pushes that refined."""
    before = len(refined)
    outlook.look(law(), goal, deviation)
    return len(refined) - before


def test_a_look_refines_one_push_a_time_and_then_no_more(refined):
    outlook = ReachOutlook()
    assert (outlook.verdict, outlook.nearest) == (UNKNOWN, NOWHERE)
    while outlook.verdict == UNKNOWN:
        assert looked(outlook, refined, NEAR) <= 1
    assert (outlook.verdict, outlook.reason) == (WITH_RESERVE, '')
    assert len(refined) > 1
    assert [looked(outlook, refined, NEAR) for _ in range(2)] == [0, 0]


def test_of_a_goal_out_of_reach_the_reason_comes_first_and_the_nearest_goal_later(refined):
    outlook = ReachOutlook()
    while outlook.verdict == UNKNOWN:
        assert looked(outlook, refined, BEYOND) <= 1
    assert (outlook.verdict, outlook.reason) == (OUT_OF_REACH, WORKSPACE)
    assert outlook.nearest is NOWHERE
    while math.isnan(outlook.nearest.x):
        assert looked(outlook, refined, BEYOND) <= 1
    assert TASK.arrives(outlook.nearest)


def test_it_looks_again_when_d_is_twice_as_well_known(refined):
    outlook = ReachOutlook()
    # As long as d may be nearly anywhere there is nothing to look from.
    assert looked(outlook, refined, NEAR, 8e-3) == 0
    for deviation in (2.9e-3, 1.4e-3):
        assert looked(outlook, refined, NEAR, deviation) == 1
        outlook.verdict = UNKNOWN
        while outlook.verdict == UNKNOWN:
            looked(outlook, refined, NEAR, deviation)
        assert looked(outlook, refined, NEAR, 0.6 * deviation) == 0


def test_a_look_that_was_broken_off_is_not_taken_up(refined):
    outlook = ReachOutlook()
    assert looked(outlook, refined, NEAR) == 1
    outlook.pause()
    assert looked(outlook, refined, NEAR) == 0
    assert looked(outlook, refined, NEAR, 1e-4) == 1


def test_without_a_place_to_look_from_it_waits(refined):
    outlook = ReachOutlook()
    outlook.look(law(None), NEAR, 1e-3)
    outlook.look(law(), NEAR, 1e-3)
    assert len(refined) == 1
