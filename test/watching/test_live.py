# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Frames of what topics said, in the units that people read, and the events beside them."""

import json
import math

import pytest

from tactile_push.control import PUSHING, STATES, STOP_REASONS, STOPPED
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.interface import (
    CONTACT,
    CONTROLLER_STATE,
    OBJECT_POSE,
    SENSING_STATE,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.watching.live import RATE, Live

PUSHED, STOOD = float(STATES.index(PUSHING)), float(STATES.index(STOPPED))


def shown(live, now):
    """Return a frame's values by name."""
    names = live.hello()['hello']['names']
    row = live.frame(now)['frame']
    json.dumps(row, allow_nan=False)  # as JSON has no NaN
    return dict(zip(names, row, strict=True))


def tick(**changes):
    values = {'theta': 0.1, 'phi': 1.6, 'v_x': 0.001, 'state': PUSHED, 'stop_reason': 0.0}
    return values | changes


def events(live, now):
    """Return level and text of what is the matter now, by lane."""
    _, content = live.events(now)
    return {e['lane']: (e['level'], e['text']) for e in content['events'] if e['end'] is None}


def test_values_are_degrees_millimetres_and_seconds():
    live = Live(60.0)
    live.take(
        1.0,
        CONTROLLER_STATE,
        tick(
            theta=math.radians(-10.0),
            theta_desired=math.radians(5.0),
            phi=math.radians(100.0),
            psi=math.radians(80.0),
            v_x=-0.0015,
            silence=0.25,
            finger_x=0.01,
        ),
    )
    live.take(1.0, SENSING_STATE, {'d': 0.002, 'd_lower': 0.001, 'd_upper': 0.003})
    live.take(1.0, TRUE_STATE, {'d': -0.004, 'v_x': 0.0025, 'belt_travel': 0.5})
    live.take(1.0, TRUE_POSE, {'x': 0.001, 'y': 0.037, 'yaw': math.radians(20.0)})
    live.take(1.0, OBJECT_POSE, {'x': 0.002, 'y': 0.036, 'yaw': math.radians(19.0)})
    frame = shown(live, 1.1)
    expected = {
        'time': 1.1,
        'theta': -10.0,
        'theta_desired': 5.0,
        'phi': 10.0,
        'psi': -10.0,
        'v_x': -1.5,
        'v_x_true': 2.5,
        'd': 2.0,
        'd_lower': 1.0,
        'd_upper': 3.0,
        'd_true': -4.0,
        'silence': 0.25,
        'finger_x': 10.0,
        'belt_travel': 500.0,
        'object_x': 1.0,
        'object_y': 37.0,
        'object_angle': 20.0,
        'estimate_x': 2.0,
        'estimate_y': 36.0,
        'estimate_angle': 19.0,
    }
    assert {name: frame[name] for name in expected} == pytest.approx(expected)
    assert frame['d_least'] is None  # which nobody told


def test_what_is_old_is_shown_no_more_and_another_topic_takes_its_place():
    live = Live(60.0)
    assert set(shown(live, 0.0).values()) == {0.0, None}
    live.take(0.0, CONTROLLER_STATE, tick(theta=0.1))
    live.take(0.5, CONTACT, {'x': 0.0, 'y': 0.0135, 'yaw': 0.2})
    live.take(1.5, TRUE_STATE, {'theta': 0.3})
    found = [shown(live, now)['theta'] for now in (0.9, 1.4, 2.4, 2.6)]
    assert found[:3] == pytest.approx([math.degrees(x) for x in (0.1, 0.2, 0.3)], abs=1e-3)
    assert found[3] is None


def test_no_contact_is_no_value_whatever_other_topics_say():
    live = Live(60.0)
    live.take(0.0, CONTROLLER_STATE, tick(theta=math.nan))
    live.take(0.0, CONTACT, {'x': 0.0, 'y': 0.0, 'yaw': 0.2})
    assert shown(live, 0.1)['theta'] is None


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf, 1.7e308])
def test_numbers_without_sense_are_no_values(value):
    live = Live(60.0)
    live.take(0.0, CONTROLLER_STATE, tick(theta=value, v_x=value, state=value, stop_reason=value))
    frame = shown(live, 0.0)
    assert [frame[name] for name in ('theta', 'v_x')] == [None, None]
    assert events(live, 0.0) == {}


def test_what_the_controller_does_is_one_of_the_words_of_the_first_message():
    live = Live(60.0)
    words = live.hello()['hello']['states']
    live.take(0.0, CONTROLLER_STATE, tick())
    assert words[int(shown(live, 0.0)['state'])] == 'pushing'
    live.take(0.1, CONTROLLER_STATE, tick(state=STOOD, stop_reason=1.0))
    assert words[int(shown(live, 0.1)['state'])] == 'stopped: contact silent'


def test_a_stop_of_one_tick_between_two_frames_is_an_event():
    live = Live(60.0)
    live.frame(0.0)
    live.take(0.01, CONTROLLER_STATE, tick(state=STOOD, stop_reason=1.0))
    live.take(0.02, CONTROLLER_STATE, tick())
    _, content = live.events(0.05)
    (event,) = content['events']
    assert (event['lane'], event['level']) == ('controller', 'error')
    assert event['text'] == f'stopped: {STOP_REASONS[1]}'
    assert (event['times'], event['start'], event['end']) == (1, 0.01, 0.02)


def test_bounds_contradictions_and_statuses_are_events_for_as_long_as_they_hold():
    live = Live(60.0)
    live.take(0.0, CONTROLLER_STATE, tick(saturated=1.0, limited=0.0))
    live.take(0.0, SENSING_STATE, {'contradiction': 1.0})
    live.take_statuses(0.0, [('sensor_driver', ('warning', 'slow')), ('sim_plant', None)])
    assert events(live, 0.1) == {
        'bounds': ('note', 'φ at its bound'),
        'object': ('error', CONTRADICTIONS[1]),
        'sensor_driver': ('warning', 'slow'),
    }
    live.take_statuses(0.2, [('sensor_driver', None)])
    live.take(0.2, SENSING_STATE, {'contradiction': 0.0})
    assert set(events(live, 0.3)) == {'bounds'}
    assert events(live, 1.1) == {}  # a tick counts for a second


def test_ticks_without_their_names_are_no_events():
    live = Live(60.0)
    live.take(0.0, CONTROLLER_STATE, {})
    live.take(0.0, SENSING_STATE, {})
    assert events(live, 0.0) == {}
    assert shown(live, 0.0)['state'] is None


def test_a_late_page_gets_the_last_frames_and_no_more_are_kept():
    live = Live(2.0)
    for k in range(1000):
        live.take(k / RATE, CONTROLLER_STATE, tick(theta=math.radians(k)))
        live.frame(k / RATE)
    hello = live.hello()['hello']
    assert hello['seconds'] == 2.0
    theta = hello['names'].index('theta')
    assert [row[theta] for row in hello['rows']] == pytest.approx(range(960, 1000))
    assert hello['rows'][-1][0] == pytest.approx(999 / RATE, abs=1e-3)


def test_when_it_was_last_spoken_to():
    live = Live(60.0)
    assert live.heard == -math.inf
    live.take(3.0, CONTACT, {})
    live.take(2.0, TRUE_POSE, {})
    assert live.heard == 3.0
