# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tactile_push.control.placing.law import NOWHERE
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.stages import OUT_OF_REACH, UNKNOWN, WITH_RESERVE, WORKSPACE
from tactile_push.mechanics.resistance import Pressure
from tactile_push.pipeline.outlook import ReachOutlook

BOUNDS = Bounds(1.54, 2000.0, -0.1, 0.1, -0.024, 0.024, 0.85)
PUSHED = Pushed(
    *(0.02375, 0.0135, Pressure(0.0187**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))),
    *(0.0, 1.0, 0.0, 0.0),
)
TASK = Task(Situation(0.0, 0.1, -0.002, 0.0, 0.0), PUSHED, BOUNDS, 0.4)
NEAR, BEYOND = Goal(-0.01, 0.0), Goal(-0.14, 0.0)


def law(task=TASK):
    return SimpleNamespace(task=lambda: task)


@pytest.fixture
def plans(monkeypatch):
    """List the goals that were planned for."""
    found = []
    plan = Task.plan

    def found_too(self, goal, **how):
        found.append(goal)
        return plan(self, goal, **how)

    monkeypatch.setattr(Task, 'plan', found_too)
    return found


def test_a_look_takes_a_plan_a_time_and_then_no_more(plans):
    outlook = ReachOutlook()
    assert (outlook.verdict, outlook.nearest) == (UNKNOWN, NOWHERE)
    for made in (1, 2, 2, 2):
        outlook.look(law(), NEAR, 1e-3)
        assert len(plans) == made
    assert (outlook.verdict, outlook.reason) == (WITH_RESERVE, '')


def test_of_a_goal_out_of_reach_the_reason_comes_first_and_the_nearest_goal_later(plans):
    outlook, before = ReachOutlook(), 0
    while math.isnan(outlook.nearest.x):
        outlook.look(law(), BEYOND, 1e-3)
        assert len(plans) <= before + 1
        before = len(plans)
        if len(plans) > 5:
            assert (outlook.verdict, outlook.reason) == (OUT_OF_REACH, WORKSPACE)
    assert TASK.arrives(outlook.nearest)


def test_it_looks_again_when_d_is_twice_as_well_known(plans):
    outlook = ReachOutlook()
    # As long as d may be nearly anywhere there is nothing to look from.
    for deviation, made in ((8e-3, 0), (2.9e-3, 1), (2e-3, 2), (1.4e-3, 3), (1e-3, 4), (0.8e-3, 4)):
        outlook.look(law(), NEAR, deviation)
        assert len(plans) == made


def test_a_look_that_was_broken_off_is_not_taken_up(plans):
    outlook = ReachOutlook()
    outlook.look(law(), NEAR, 1e-3)
    outlook.pause()
    outlook.look(law(), NEAR, 1e-3)
    assert len(plans) == 1
    outlook.look(law(), NEAR, 1e-4)
    assert len(plans) == 2


def test_without_a_place_to_look_from_it_waits(plans):
    outlook = ReachOutlook()
    outlook.look(law(None), NEAR, 1e-3)
    outlook.look(law(), NEAR, 1e-3)
    assert len(plans) == 1
