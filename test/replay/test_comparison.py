# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is counted of a replay, which commands differ, and all of it as JSON."""

import json
import math
from types import SimpleNamespace

import pytest

from tactile_push.replay.comparison import Comparison, ReplayedTick, SensedTick


def tick(v_x, theta=0.1, v_y=0.0):
    told = {'phi': 1.5, 'state': 'pushing', 'stop_reason': ''}
    return SimpleNamespace(v_x=v_x, v_y=v_y, theta=theta, **told)


def compared(*pairs):
    """Return the comparison of commands as they are now with those that were recorded [m/s]."""
    comparison = Comparison('left')
    for k, (now, then) in enumerate(pairs):
        comparison.add(0.1 * k, tick(now), tick(then))
    return comparison


def test_readings_and_their_outcomes_are_counted():
    comparison = Comparison('')
    for contact, refusal in [(object(), ''), (None, 'no contact'), (None, 'out of plane')] * 2:
        comparison.count(SimpleNamespace(contact=contact, refusal=refusal))
    assert (comparison.readings, comparison.contacts) == (6, 2)
    assert comparison.refused == {'no contact': 2, 'out of plane': 2}


def test_stamps_that_go_back_are_counted_among_what_is_kept():
    comparison = Comparison('')
    for stamp in (10, 20, 20, 15, 16, 5):
        comparison.keep(stamp)
    assert (comparison.kept, comparison.went_back) == (6, 2)


def test_command_differs_by_its_last_bit():
    comparison = compared((0.002, 0.002), (math.nextafter(0.002, 1.0), 0.002), (-0.001, 0.001))
    assert [found.time for found in comparison.different()] == pytest.approx([0.1, 0.2])


def test_no_command_is_the_same_as_none_and_another_than_any():
    comparison = compared((None, None), (None, 0.0), (0.0, None), (0.0, -0.0))
    assert [found.time for found in comparison.different()] == pytest.approx([0.1, 0.2])


def test_command_along_the_belt_differs_by_its_last_bit_too():
    comparison = Comparison('')
    comparison.add(0.0, tick(0.002, v_y=-0.01), tick(0.002, v_y=-0.01))
    comparison.add(0.1, tick(0.002, v_y=-0.01), tick(0.002, v_y=math.nextafter(-0.01, 0.0)))
    assert [found.time for found in comparison.different()] == [0.1]


def test_nothing_differs_from_what_was_not_recorded():
    comparison = Comparison('')
    comparison.add(0.0, tick(0.002), None)
    assert not comparison.recorded
    assert comparison.different() == []
    assert math.isnan(comparison.ticks[0].v_x_recorded)
    assert comparison.as_json()['different'] is None


def test_json_has_null_where_there_is_no_number():
    comparison = compared((0.002, None))
    comparison.sensed = [SensedTick(0.0, math.nan, -0.01, 0.01, -math.inf, math.inf)]
    plain = json.loads(json.dumps(comparison.as_json(), allow_nan=False))
    assert plain == {
        'finger': 'left',
        'readings': 0,
        'contacts': 0,
        'refused': {},
        'kept': 0,
        'different': 1,
        'ticks': [
            {
                'time': 0.0,
                'theta': 0.1,
                'phi': 1.5,
                'v_x': 0.002,
                'v_x_recorded': None,
                'state': 'pushing',
                'stop_reason': '',
                'v_y': 0.0,
                'v_y_recorded': 0.0,
            }
        ],
        'sensed': [
            {
                'time': 0.0,
                'd': None,
                'd_lower': -0.01,
                'd_upper': 0.01,
                'd_least': None,
                'd_most': None,
            }
        ],
    }
    assert list(plain['ticks'][0]) == list(ReplayedTick._fields)


def test_sensed_numbers_are_taken_by_their_names():
    values = {'d_most': 5.0, 'd_least': 4.0, 'd_upper': 3.0, 'd_lower': 2.0, 'd': 1.0, 'c': 9.0}
    assert SensedTick.of(0.5, values) == (0.5, 1.0, 2.0, 3.0, 4.0, 5.0)
