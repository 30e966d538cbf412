# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Words for what the nodes say in numbers."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tactile_push.control import STATES, STOP_REASONS
from tactile_push.control.placing.stages import STAGES
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.report.labels import (
    DOING,
    bound_label,
    contradiction_label,
    doing,
    refusal_label,
    stage_label,
    status_label,
    stop_label,
)
from tactile_push.tactile import REFUSALS


def test_what_the_controller_does_is_its_state_or_why_it_stands():
    stopped = STATES.index('stopped')
    silent = STOP_REASONS.index('contact silent')
    found = doing([STATES.index('pushing'), stopped, stopped], [0.0, silent, 0.0])
    assert [DOING[int(k)] for k in found] == ['pushing', 'stopped: contact silent', 'stopped']
    assert math.isnan(doing(math.nan, math.nan))
    assert [DOING[int(doing(stopped, k))] for k in range(1, len(STOP_REASONS))] == [
        f'stopped: {reason}' for reason in STOP_REASONS[1:]
    ]


def test_a_stop_is_an_error_waiting_a_note_and_pushing_nothing():
    assert stop_label(3.0, 1.0) == ('error', 'stopped: contact silent')
    assert stop_label(STATES.index('waiting for contact'), 0.0) == ('note', 'waiting for contact')
    assert stop_label(STATES.index('pushing'), 0.0) is None
    done = STOP_REASONS.index('nothing to do')
    assert stop_label(3.0, done) == ('note', 'stopped: nothing to do')


def test_bounds_are_notes():
    assert bound_label('saturated', 1.0) == ('note', 'φ at its bound')
    assert bound_label('limited', 0.0) is None


def test_refusals_are_warnings_but_for_those_that_are_no_fault():
    found = {REFUSALS[k]: refusal_label(k) for k in range(1, len(REFUSALS))}
    assert found.pop('no contact') == ('note', 'no contact')
    assert found.pop('not newer') is None
    assert all(label == ('warning', f'refused: {why}') for why, label in found.items())


def test_contradictions_are_errors():
    assert contradiction_label(1.0) == ('error', CONTRADICTIONS[1])
    assert contradiction_label(0.0) is None


@pytest.mark.parametrize('number', [math.nan, math.inf, -1.0, 1e300])
def test_numbers_of_nothing_say_nothing(number):
    assert stop_label(number, number) is None
    assert bound_label('limited', number) in (None, ('note', 'v_x at its bound'))
    assert refusal_label(number) is contradiction_label(number) is None


@pytest.mark.parametrize(
    ('level', 'found'), [(0, None), (1, 'warning'), (2, 'error'), (3, 'error'), (255, 'error')]
)
def test_level_of_a_status_is_a_number_or_a_byte(level, found):
    expected = found and (found, 'words')
    for given in (level, bytes([level]), np.uint8(level)):
        assert status_label(SimpleNamespace(level=given, message='words')) == expected


@pytest.mark.parametrize(
    ('stage', 'level'),
    [
        ('learning', 'note'),
        ('released', 'note'),
        ('cancelled', 'note'),
        ('missed', 'warning'),
        ('object lost', 'warning'),
    ],
)
def test_a_goal_that_failed_is_a_warning(stage, level):
    assert stage_label(STAGES.index(stage)) == (level, stage)


def test_nothing_is_said_without_a_goal_or_of_an_unknown_stage():
    assert stage_label(STAGES.index('no goal')) is None
    for number in (-1.0, len(STAGES), math.nan):
        assert stage_label(number) is None
