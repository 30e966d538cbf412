# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The finger tip's direction at a reading's time: interpolated, and refused when it is stale."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.tactile import PoleHistory, StaleJointsError

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)


def history(*records, timeout=0.1):
    """Return a history of (stamp, psi)."""
    result = PoleHistory(timeout)
    for stamp, psi in records:
        result.record(stamp, psi)
    return result


def test_nothing_remembered_is_refused():
    with pytest.raises(StaleJointsError, match='^no joint state$'):
        history().at(0.0)


def test_angle_between_two_times_is_interpolated():
    pole = history((10.0, 1.0), (10.2, 2.0), (10.4, 0.0))
    assert pole.at(10.05) == pytest.approx(1.25)
    assert pole.at(10.1) == pytest.approx(1.5)
    assert pole.at(10.3) == pytest.approx(1.0)
    assert pole.at(10.2) == pytest.approx(2.0)


def test_gap_between_two_times_may_be_longer_than_the_timeout():
    assert history((0.0, 0.0), (5.0, 10.0)).at(1.0) == pytest.approx(2.0)


def test_nearest_angle_is_used_just_before_and_after():
    pole = history((10.0, 1.0), (10.2, 2.0))
    assert pole.at(9.95) == 1.0
    assert pole.at(10.25) == 2.0


def test_time_further_outside_than_the_timeout_is_refused():
    pole = history((10.0, 1.0), (10.2, 2.0))
    for stamp in (9.85, 10.35, -1e9, 1e9):
        with pytest.raises(StaleJointsError, match='^stale joint state$'):
            pole.at(stamp)


def test_timeout_is_the_one_given():
    assert history((10.0, 1.0), timeout=2.0).at(11.9) == 1.0
    with pytest.raises(StaleJointsError):
        history((10.0, 1.0), timeout=2.0).at(12.1)


def test_stamp_that_is_no_number_is_refused():
    with pytest.raises(StaleJointsError):
        history((10.0, 1.0)).at(math.nan)


def test_clock_that_goes_back_starts_over():
    pole = history((100.0, 1.0), (100.1, 1.0), (5.0, 3.0))
    assert pole.at(5.05) == 3.0
    assert pole.at(4.95) == 3.0
    with pytest.raises(StaleJointsError):
        pole.at(100.1)
    pole.record(5.1, 4.0)
    assert pole.at(5.05) == pytest.approx(3.5)


def test_two_angles_of_one_time_leave_the_later_one_valid():
    pole = history((1.0, 1.0), (1.0, 2.0))
    assert pole.at(1.0) == 2.0
    pole.record(1.1, 4.0)
    assert pole.at(1.05) == pytest.approx(3.0)


def test_oldest_are_forgotten():
    pole = PoleHistory(0.1, length=3)
    for number in range(10):
        pole.record(float(number), float(number))
    assert pole.at(7.5) == pytest.approx(7.5)
    with pytest.raises(StaleJointsError):
        pole.at(5.0)


@given(
    gaps=st.lists(st.floats(0.001, 1.0), min_size=1, max_size=20),
    fraction=st.floats(0.0, 1.0),
    slope=st.floats(-5.0, 5.0),
)
@PROPERTY
def test_steady_turn_is_given_exactly_at_every_time_between(gaps, fraction, slope):
    stamps = [sum(gaps[:count]) for count in range(len(gaps) + 1)]
    pole = history(*((stamp, 1.0 + slope * stamp) for stamp in stamps))
    stamp = fraction * stamps[-1]
    assert pole.at(stamp) == pytest.approx(1.0 + slope * stamp, abs=1e-9)
