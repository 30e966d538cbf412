# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.sticking_block import PRESSURE
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation
from tactile_push.control.placing.reachability import (
    AT_THE_LIMITS,
    OUT_OF_REACH,
    WITH_RESERVE,
    Task,
    reach,
)
from tactile_push.control.placing.reachable_set import ReachableSet, reachable_set
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT

TASK = Task(
    Situation(0.0, 0.1, -0.002, 0.0, 0.0),
    Pushed(0.02375, 0.0135, PRESSURE, *friction_cone(math.inf), STRAIGHT, 0.0),
    Bounds(1.54, 2000.0, -0.1, 0.1, -0.024, 0.024, 0.85),
    0.15,
)
XS, THETAS = (-0.12, -0.04, 0.0), (-0.2, 0.3)


def test_each_goal_is_told_what_it_is_told_alone_row_by_row():
    done = []
    found = reachable_set(TASK, XS, THETAS, done.append)
    assert (found.xs, found.thetas) == (XS, THETAS)
    for theta, row in zip(THETAS, found.told, strict=True):
        for x, told in zip(XS, row, strict=True):
            alone = reach(TASK, Goal(x, theta))
            assert told == (alone.verdict, alone.reason)
    assert done == [1, 2, 3, 4, 5, 6]
    assert OUT_OF_REACH in {verdict for row in found.told for verdict, _ in row}


def test_goals_are_counted_by_verdict_and_reason():
    row = ((WITH_RESERVE, ''), (OUT_OF_REACH, 'belt'), (OUT_OF_REACH, 'edge'))
    found = ReachableSet((0.0, 0.1, 0.2), (0.0, 0.1), (row, (row[1], row[1], row[0])))
    assert found.count(WITH_RESERVE) == 2
    assert found.count(OUT_OF_REACH, 'belt') == 3
    assert found.count(AT_THE_LIMITS) == 0


def test_what_interrupts_it_ends_it_without_the_other_goals():
    done = []

    def interrupt(count):
        done.append(count)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reachable_set(TASK, np.linspace(-0.1, 0.1, 100), THETAS, interrupt)
    assert done == [1]
