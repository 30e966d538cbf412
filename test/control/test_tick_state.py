# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A control period as numbers with names, and back."""

import math
from dataclasses import asdict, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.control import PushLaw, Tick, tick_of, tick_values
from tactile_push.control.states import (
    CONTACT_SILENT,
    NO_REASON,
    PUSHING,
    STATES,
    STOP_REASONS,
    STOPPED,
)
from tactile_push.interface import CONTROLLER_STATE, TOPICS

LAW = PushLaw(0.05, 5.0, -0.17)
TICK = Tick(
    *(PUSHING, NO_REASON, 0.1, 1.5, -0.004, 0.02, True, False, -0.03, 12, 1, 0.1, 0.01, 1.6, 0.02),
    *(-0.01, True),
)

numbers = st.floats() | st.just(math.nan)
ticks = st.builds(
    Tick,
    state=st.sampled_from(STATES),
    stop_reason=st.sampled_from(STOP_REASONS),
    theta=numbers,
    phi=numbers,
    v_x=st.none() | st.floats(allow_nan=False),
    silence=numbers,
    saturated=st.booleans(),
    limited=st.booleans(),
    finger_x=numbers,
    ticks=st.integers(0, 2**53),
    ticks_lost=st.integers(0, 2**53),
    elapsed=numbers,
    finger_age=numbers,
    psi=numbers,
    trim=numbers,
    v_y=numbers,
    apart=st.booleans(),
)


def test_every_number_stands_under_its_name():
    values = tick_values(TICK, LAW)
    assert tuple(values) == TOPICS[CONTROLLER_STATE].field_names
    assert values == {
        **{'theta': 0.1, 'theta_desired': -0.17, 'phi': 1.5, 'v_x': -0.004},
        **{'kp': 0.05, 'kd': 5.0, 'silence': 0.02, 'saturated': 1.0, 'limited': 0.0},
        **{'finger_x': -0.03, 'state': 2.0, 'stop_reason': 0.0, 'ticks': 12.0},
        **{'ticks_lost': 1.0, 'elapsed': 0.1, 'finger_age': 0.01, 'psi': 1.6, 'trim': 0.02},
        **{'v_y': -0.01, 'apart': 1.0},
    }


def test_between_joint_states_and_reading_the_finger_followed_its_command():
    # The joints were read 30 ms before the reading.
    tick = replace(TICK, finger_age=0.05, silence=0.02)
    assert tick.x_at_reading(0.01) == pytest.approx(-0.03 + 0.03 * 0.01)
    assert math.isnan(tick.x_at_reading(math.nan))


def test_the_desired_angle_is_told_as_the_law_used_it():
    law = PushLaw(0.05, 5.0, -0.17)
    law.trim = 0.02
    assert tick_values(TICK, law)['theta_desired'] == -0.17 + 0.02


def test_no_command_is_no_number():
    assert math.isnan(tick_values(replace(TICK, v_x=None), LAW)['v_x'])


def test_a_reason_to_stop_is_a_number_of_its_own():
    tick = replace(TICK, state=STOPPED, stop_reason=CONTACT_SILENT)
    values = tick_values(tick, LAW)
    assert STATES[int(values['state'])] == STOPPED
    assert STOP_REASONS[int(values['stop_reason'])] == CONTACT_SILENT


@given(ticks)
def test_the_numbers_tell_the_control_period(tick):
    again = asdict(tick_of(tick_values(tick, LAW)))
    # NaN is no number, and not even itself.
    assert {name: repr(value) for name, value in again.items()} == {
        name: repr(value) for name, value in asdict(tick).items()
    }


def test_old_bags_lack_two_times_and_two_angles():
    values = tick_values(TICK, LAW)
    del values['elapsed'], values['finger_age'], values['psi'], values['trim']
    tick = tick_of(values)
    assert math.isnan(tick.elapsed)
    assert math.isnan(tick.finger_age)
    assert tick.psi == math.pi / 2.0
    assert tick.trim == 0.0
    assert replace(tick, elapsed=0.1, finger_age=0.01, psi=1.6, trim=0.02) == TICK


@pytest.mark.parametrize('name', ['theta', 'v_x', 'state', 'stop_reason', 'ticks'])
def test_a_missing_number_is_refused_by_name(name):
    values = tick_values(TICK, LAW)
    del values[name]
    with pytest.raises(ValueError, match=f'no control period: .*{name}'):
        tick_of(values)


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('state', 4.0),
        ('state', -1.0),
        ('state', math.nan),
        ('state', math.inf),
        ('stop_reason', 9.0),
        ('stop_reason', -0.5),
        ('ticks', math.nan),
        ('ticks_lost', math.inf),
    ],
)
def test_an_impossible_number_is_refused(name, value):
    with pytest.raises(ValueError, match='no control period: '):
        tick_of({**tick_values(TICK, LAW), name: value})
