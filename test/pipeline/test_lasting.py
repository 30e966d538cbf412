# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What laws have in common whose goals last until they are given up."""

import math

import pytest

from support.placed_run import Line
from tactile_push.control import CONTACT_SILENT, PUSHING
from tactile_push.control.placing import STAGES
from tactile_push.control.placing.stages import SETTLES, STEERS
from tactile_push.pipeline.believing import OLDEST

LAWS = pytest.mark.parametrize(('law', 'stages'), [('settle', SETTLES), ('steer', STEERS)])
DOUBT = 'nothing is known of the object, so law (18) acts'


def pushed(law, periods=8):
    """Return a line with a goal after some control periods."""
    line = Line(0.2, -0.003, law=law)
    line.ask(0.005, 0.1)
    for _ in range(periods):
        line.period()
    return line


def stage_of(line):
    return STAGES[int(line.states[-1]['stage'])]


@LAWS
def test_an_estimate_of_before_a_stop_is_not_believed_after_it(law, stages):
    line = pushed(law)
    assert stage_of(line) == stages[0]
    line.senses = line.feels = False
    line.until(lambda: line.ticks[-1].stop_reason == CONTACT_SILENT)
    for _ in range(OLDEST):
        line.period()
    assert line.placing.doubt == ''  # the finger rests
    line.feels = True
    line.period()
    assert line.ticks[-1].state == PUSHING
    assert (stage_of(line), line.placing.doubt) == (stages[1], DOUBT)


@LAWS
def test_a_goal_lasts_until_it_is_given_up_once(law, stages):
    line = pushed(law, 3)
    assert line.placing.goals == 1
    assert not math.isnan(line.control.push.law.goal)
    assert [line.placing.cancel(), line.placing.cancel()] == [True, False]
    assert math.isnan(line.control.push.law.goal)
    assert line.placing.stage in stages
