# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.pipeline.stamps import epoch_of, seconds_since, stamp_before, stamp_of

NOW = 1_795_000_000  # some day in 2026 [s]


@pytest.mark.parametrize('stamp', [(0, 0), (NOW, 1), (-3, 999_999_999)])
def test_stamp_is_that_of_the_header(stamp):
    header = SimpleNamespace(stamp=SimpleNamespace(sec=stamp[0], nanosec=stamp[1]))
    assert stamp_of(SimpleNamespace(header=header)) == stamp


def test_simulated_time_counts_from_its_own_start():
    assert epoch_of(0) == 0
    assert seconds_since(0, 3, 250_000_000) == 3.25


@given(st.integers(0, 2**31 - 1))
def test_epoch_is_never_ahead_and_days_away_at_the_most(sec):
    assert 0 <= sec - epoch_of(sec) < 13 * 24 * 3600


@given(st.integers(0, 11 * 24 * 3600), st.integers(0, 999_999_998))
def test_neighbouring_nanoseconds_are_two_times(later, nanosec):
    epoch = epoch_of(NOW)
    sec = NOW + later
    assert seconds_since(epoch, sec, nanosec) < seconds_since(epoch, sec, nanosec + 1)


def test_those_who_start_an_hour_apart_count_alike():
    assert epoch_of(NOW) == epoch_of(NOW + 3600)


@given(st.integers(0, 2**31 - 1), st.integers(0, 10**9 - 1), st.integers(0, 10**9))
def test_stamp_of_what_was_older_is_earlier_by_its_age_to_the_nanosecond(sec, nanosec, age):
    before = stamp_before(sec, nanosec, age * 1e-9)
    assert 0 <= before[1] < 10**9
    expected = max(0, sec * 10**9 + nanosec - age)
    assert before[0] * 10**9 + before[1] == expected
