# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.simulation import Belt
from tactile_push.simulation.servo import FLAT

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
V_Y = 0.005


def test_belt_runs_at_its_speed_to_the_bit():
    belt = Belt()
    assert belt.speed(V_Y, 3.0) == belt.mean_speed(V_Y, 3.0, 0.1) == V_Y
    assert belt.straight(V_Y) == math.inf


def test_stopped_belt_stands():
    belt = Belt(0.5, 2.0, stopped=True)
    assert belt.speed(V_Y, 0.1) == belt.mean_speed(V_Y, 0.1, 0.3) == 0.0


def test_ripple_is_a_sine_of_its_amplitude_and_frequency():
    belt = Belt(0.2, 2.0)
    quarter = 0.125
    speeds = [belt.speed(V_Y, k * quarter) for k in range(5)]
    assert speeds == pytest.approx([V_Y, 1.2 * V_Y, V_Y, 0.8 * V_Y, V_Y])


@given(st.floats(0.01, 0.99), st.floats(0.1, 20.0), st.floats(0.0, 100.0), st.floats(1e-3, 1.0))
@PROPERTY
def test_mean_speed_is_the_integral_of_the_speed(ripple, frequency, time, duration):
    belt = Belt(ripple, frequency)
    count = 2000
    middles = [time + (i + 0.5) * duration / count for i in range(count)]
    integral = sum(belt.speed(V_Y, middle) for middle in middles) / count
    assert belt.mean_speed(V_Y, time, duration) == pytest.approx(integral, rel=2e-4)


@given(st.floats(0.01, 0.99), st.floats(0.1, 20.0), st.floats(0.0, 10.0))
@PROPERTY
def test_way_is_nearly_straight_for_the_time_that_is_told(ripple, frequency, time):
    belt = Belt(ripple, frequency)
    straight = min(belt.straight(V_Y), 10.0)
    mean = belt.mean_speed(V_Y, time, straight)
    for share in (0.25, 0.5, 0.75):
        way = share * straight * belt.mean_speed(V_Y, time, share * straight)
        # Where the whole ripple is flat its way may be away from the chord by both amplitudes.
        assert abs(way - share * straight * mean) <= 2.01 * FLAT


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('ripple', -0.1),
        ('ripple', 1.0),
        ('ripple', math.nan),
        ('frequency', 0.0),
        ('frequency', math.inf),
        ('frequency', math.nan),
    ],
)
def test_number_out_of_its_range_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f'{name}: expected'):
        Belt(**{name: value})
