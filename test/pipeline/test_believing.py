# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What all laws that believe are told, with one that does nothing about it."""

import math

import pytest

from support.placed_run import SENSING, seconds
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.control.placing.stages import HELD_STILL, NO_GOAL, STAGES
from tactile_push.interface import PLACE_STATE, TOPICS
from tactile_push.parameters.active_sensing import ActiveSensingParameters, make_sensing
from tactile_push.parameters.push_controller import PushControllerParameters, make_control
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.believing import Believing
from tactile_push.pipeline.messages import joint_state_fields

STRAIGHT = (0.0, 0.0, 0.0, 1.0)
AHEAD = math.pi / 2.0
FIRST = 1_795_000_000  # [s]


class Served(Believing):
    """Keeps the newest estimate, and no goal."""

    stage, doubt, _acts = NO_GOAL, '', True

    def cancel(self):
        return False

    def begin(self):
        self.is_new = self._take_estimate()

    def look_ahead(self):
        pass

    @property
    def belief(self):
        return self._belief


@pytest.fixture
def served():
    push = make_control(PushControllerParameters())
    push.activate(seconds(FIRST, 0))
    return push, Served(push, SettleLaw(0.0, 0.005, 0.1), seconds)


def period(push, served, k, sensing=None):
    """Let a control period pass at a whole second; return what active sensing says of it."""
    stamp = FIRST + k, 0
    now = seconds(*stamp)
    push.locate_finger(1e-3 * k, now, AHEAD)
    push.feel(0.1, now)
    served.begin()
    tick = push.tick(now)
    served.finish(now, tick, -12.5, (0.06, 0.08, 0.09, -1.0))
    if sensing is None:
        return None
    said = joint_state_fields(stamp, sensing.tick(stamp, tick).values)
    return stamp, said['name'], said['position']


def test_an_estimate_counts_once_if_it_is_newer_and_about_a_period_of_this_control(served):
    push, steps = served
    sensing = Sensing(make_sensing(ActiveSensingParameters.of(SENSING)), seconds)
    said = [period(push, steps, k, sensing) for k in range(3)]
    (_, *rest), _, newest = said
    steps.sensed(*newest)
    steps.begin()
    assert steps.is_new
    # That is where the finger was and what was sensed, at the reading of the period.
    assert (steps.belief.x, steps.belief.theta) == pytest.approx((2e-3, 0.1), abs=2e-3)
    steps.begin()
    assert not steps.is_new
    steps.sensed(*said[1])  # older
    steps.sensed((FIRST + 2, 5), *rest)  # of no period
    steps.begin()
    assert not steps.is_new
    steps.sensed(*period(push, steps, 3, sensing)[:1], [], [])
    steps.begin()
    assert steps.is_new
    assert steps.belief is None


def test_an_estimate_is_awaited_while_the_finger_pushes(served):
    push, steps = served
    assert not steps.awaits_estimate
    sensing = Sensing(make_sensing(ActiveSensingParameters.of(SENSING)), seconds)
    said = period(push, steps, 0, sensing)
    assert steps.awaits_estimate
    steps.sensed(*said)
    assert not steps.awaits_estimate


def test_each_number_of_the_state_is_there_and_unknown_where_nothing_is(served):
    push, steps = served
    period(push, steps, 0)
    values = steps.values()
    assert tuple(values) == TOPICS[PLACE_STATE].field_names
    known = {name: value for name, value in values.items() if not math.isnan(value)}
    assert known == {
        'stage': float(STAGES.index(NO_GOAL)),
        **dict.fromkeys(('refusal', 'goals', 'refused', 'released'), 0.0),
        **{'turning': -12.5, 'finger_y': 0.09, 'bend': -1.0},
    }


def test_goals_are_counted_and_the_last_refusal_is_told(served):
    push, steps = served
    assert steps.goal('left/finger_base', 0.0, STRAIGHT) == ''
    period(push, steps, 0)
    push.notice_another_command()
    assert steps.goal('', 0.0, STRAIGHT) == steps.refusal == HELD_STILL
    assert (steps.goals, steps.refused) == (1, 1)
    push.resume()
    steps.goal('', 0.0, STRAIGHT)
    assert (steps.goals, steps.refused, steps.refusal) == (2, 1, '')
