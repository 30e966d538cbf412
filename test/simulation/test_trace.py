# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.mechanics import FREE, STICK
from tactile_push.simulation import Rig, paper_block
from tactile_push.simulation.trace import Trace


def test_a_mode_is_that_at_the_end_of_its_period_and_the_last_is_repeated():
    rig, trace = Rig(paper_block(0.2, 0.003)), Trace()
    for _ in range(3):
        trace.add(rig, math.pi / 2.0)
        rig.step(0.0, 0.1)
    trace.add(rig, 1.5)

    run = trace.run('done')

    assert run.mode.tolist() == [STICK] * 4
    assert run.phi.tolist() == [math.pi / 2.0] * 3 + [1.5]
    assert (run.theta[0], run.d[0]) == pytest.approx((0.2, 0.003))
    assert (run.theta[-1], run.x[-1], run.y[-1]) == (rig.theta, *rig.object_pose[:2])
    assert (len(trace), run.end) == (4, 'done')


def test_how_the_last_period_ended_may_be_told_without_another_one():
    rig, trace = Rig(paper_block(0.2, 0.003)), Trace()
    trace.add(rig, math.pi / 2.0)
    assert trace.run('').mode.tolist() == [FREE]
    rig.step(0.0, 0.1)
    trace.close(rig)
    assert trace.run('').mode.tolist() == [STICK]


def test_nothing_may_have_happened():
    trace = Trace()
    trace.close(Rig(paper_block()))
    run = trace.run('waited in vain')
    columns = run.theta, run.phi, run.d, run.x, run.y, run.mode
    assert [len(column) for column in columns] == [0] * 6
