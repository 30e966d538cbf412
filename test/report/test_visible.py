# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What of a long series is kept: bounds, extremes and gaps, and the value at each moment."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.report.visible import frame_times, held, visible

VALUES = st.lists(st.one_of(st.floats(-1e3, 1e3), st.just(math.nan)), min_size=1, max_size=400).map(
    np.array
)


def times_of(values):
    return np.linspace(3.0, 9.0, len(values))


@given(VALUES)
def test_short_series_stays_as_it_is(values):
    assert visible(times_of(values), values, 400).tolist() == list(range(len(values)))


@given(VALUES, st.integers(5, 100))
def test_ends_and_extremes_stay_and_no_more_points_than_may(values, most):
    kept = visible(times_of(values), values, most)
    assert len(kept) <= most
    assert (np.diff(kept) > 0).all()
    assert {0, len(values) - 1} <= set(kept.tolist())
    if not np.isnan(values).all():
        assert np.nanmax(values[kept]) == np.nanmax(values)
        assert np.nanmin(values[kept]) == np.nanmin(values)


@given(VALUES, st.integers(5, 100))
def test_each_part_of_the_time_keeps_its_own_extremes_and_its_gap(values, most):
    time = times_of(values)
    kept = visible(time, values, most)
    if len(values) <= most:
        return
    parts = most // 5
    part = np.minimum(((time - 3.0) / 6.0 * parts).astype(int), parts - 1)
    for number in range(parts):
        there, left = values[part == number], values[kept][part[kept] == number]
        assert np.isnan(there).any() == np.isnan(left).any()
        if not np.isnan(there).all():
            assert np.nanmin(there) == np.nanmin(left)
            assert np.nanmax(there) == np.nanmax(left)


def test_ten_minutes_of_ticks_stay_whole_and_an_hour_of_readings_does_not():
    assert len(visible(np.arange(6000) / 10.0, np.ones(6000))) == 6000
    time = np.arange(360_000) / 100.0
    values = np.sin(time)
    values[123_456] = 7.0
    kept = visible(time, values)
    assert len(kept) <= 6000
    assert 123_456 in kept


def test_series_without_extent_in_time():
    assert len(visible(np.zeros(50), np.arange(50.0), 10)) <= 10


@pytest.mark.parametrize(
    ('duration', 'count'), [(0.0, 2), (0.05, 2), (46.25, 464), (600.0, 6001), (36_000.0, 6001)]
)
def test_moments_are_a_tenth_of_a_second_apart_unless_there_were_too_many(duration, count):
    moments = frame_times(duration)
    assert len(moments) == count
    assert moments[0] == 0.0
    assert moments[-1] == duration
    assert np.diff(moments) == pytest.approx(duration / (count - 1))


@given(
    st.lists(st.floats(0.0, 10.0), max_size=30).map(sorted),
    st.lists(st.floats(-1.0, 12.0), max_size=30),
    st.floats(0.1, 5.0),
)
def test_value_that_was_the_last_one_holds_for_a_while(times, moments, longest):
    values = np.arange(len(times), dtype=float)
    found = held(np.array(times), values, np.array(moments), longest)
    for moment, value in zip(moments, found, strict=True):
        before = [k for k, time in enumerate(times) if time <= moment]
        if before and moment - times[before[-1]] <= longest:
            assert value == before[-1]
        else:
            assert math.isnan(value)
