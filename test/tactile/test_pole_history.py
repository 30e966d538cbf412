# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger tip's direction at a reading's time: paired with it, and refused when it is stale."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.tactile import ReadingRejectedError
from tactile_push.tactile.pole_history import PoleHistory

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)


def history(*records, timeout=0.1):
    """Return a history of (stamp, psi)."""
    result = PoleHistory(timeout)
    for stamp, psi in records:
        result.record(stamp, psi)
    return result


def refusal(pole, stamp):
    """Return the reason for which an angle is refused."""
    with pytest.raises(ReadingRejectedError) as refused:
        pole.at(stamp)
    return str(refused.value)


def test_nothing_remembered_is_refused():
    assert refusal(history(), 0.0) == 'no joint state'


def test_angle_between_two_times_is_interpolated():
    pole = history((10.0, 1.0), (10.2, 2.0), (10.4, 0.0))
    assert pole.at(10.05) == pytest.approx(1.25)
    assert pole.at(10.1) == pytest.approx(1.5)
    assert pole.at(10.3) == pytest.approx(1.0)
    assert pole.at(10.2) == pytest.approx(2.0)
    assert pole.at(10.4) == pytest.approx(0.0)


@pytest.mark.parametrize('turns', [-1, 1])
def test_joint_may_pass_the_end_of_its_range(turns):
    # 170 degrees, and 20 degrees later -170: half way it is 180, and 190 a step further.
    pole = history((0.0, math.radians(170.0)), (0.1, math.radians(190.0 - 360.0 * max(turns, 0))))
    for stamp, degrees in ((0.05, 180.0), (0.2, 210.0)):
        error = math.remainder(pole.at(stamp) - math.radians(degrees), 2.0 * math.pi)
        assert error == pytest.approx(0.0, abs=1e-12)


def test_angle_in_a_gap_is_refused_where_neither_end_is_near():
    pole = history((0.0, 0.0), (5.0, 1.0))
    assert pole.at(0.09) == pytest.approx(0.018)
    assert pole.at(4.95) == pytest.approx(0.99)
    for stamp in (0.11, 2.5, 4.89):
        assert refusal(pole, stamp) == 'stale joint state'


def test_oldest_angle_is_used_just_before_it():
    assert history((10.0, 1.0), (10.2, 2.0)).at(9.95) == 1.0


def test_only_angle_is_used_just_before_and_after_it():
    pole = history((10.0, 1.0))
    assert (pole.at(9.95), pole.at(10.0), pole.at(10.05)) == (1.0, 1.0, 1.0)


def test_angle_goes_on_after_the_newest_as_it_turned_before():
    # 0.5 rad/s for a second, each 20 ms.
    pole = history(*((0.02 * k, 0.01 * k) for k in range(51)))
    assert pole.at(1.01) == pytest.approx(0.505)
    assert pole.at(1.09) == pytest.approx(0.545)


def test_rate_is_that_of_the_last_timeout_and_no_older():
    # It stood for a second and then turned at 1 rad/s for 0.08 s: stands 0.02 s, turns 0.08 s.
    stood = [(0.02 * k, 0.0) for k in range(51)]
    turned = [(1.0 + 0.02 * k, 0.02 * k) for k in range(1, 5)]
    pole = history(*stood, *turned, timeout=0.101)
    assert pole.at(1.13) == pytest.approx(0.08 + 0.8 * 0.05)


def test_angle_older_than_the_timeout_is_no_measure_of_the_rate():
    assert history((0.0, 0.0), (0.2, 1.0)).at(0.25) == 1.0


def test_angle_goes_on_no_longer_than_it_was_watched():
    pole = history((0.0, 0.0), (0.01, 0.1))
    assert pole.at(0.015) == pytest.approx(0.15)
    assert pole.at(0.05) == pytest.approx(0.2)
    # Two joint states at nearly one time tell nothing of the rate.
    assert history((0.0, 0.0), (1e-9, 0.001)).at(0.09) == pytest.approx(0.001, abs=0.0011)


def test_noise_of_the_joint_angles_is_hardly_magnified():
    generator = np.random.default_rng(7)
    errors = []
    for _ in range(500):
        noise = generator.normal(0.0, 1.0e-3, 10)
        pole = history(*((0.02 * k, n) for k, n in enumerate(noise)))
        errors.append(pole.at(0.18 + 0.02))
    # The newest plus a fifth of the difference over 0.1 s: sqrt(1.2^2 + 0.2^2) = 1.22; over two
    # neighbours it would be sqrt(2^2 + 1^2) = 2.24.
    assert 1.0e-3 < np.std(errors) < 1.4e-3


def test_time_further_outside_than_the_timeout_is_refused():
    pole = history((10.0, 1.0), (10.2, 2.0))
    for stamp in (9.85, 10.35, -1e9, 1e9, math.inf, -math.inf):
        assert refusal(pole, stamp) == 'stale joint state'


def test_timeout_is_the_one_given_and_may_change():
    pole = history((10.0, 1.0), timeout=2.0)
    assert pole.at(11.9) == 1.0
    assert refusal(pole, 12.1) == 'stale joint state'
    pole.timeout = 3.0
    assert pole.at(12.1) == 1.0


def test_age_is_that_of_the_nearest_angle():
    pole = history((10.0, 1.0), (10.05, 1.0), (20.0, 1.0))
    assert math.isnan(pole.age)
    for stamp, age in ((9.97, 0.03), (10.02, 0.02), (10.04, 0.01), (20.06, 0.06)):
        pole.at(stamp)
        assert pole.age == pytest.approx(age)
    refusal(pole, 21.0)
    assert pole.age == pytest.approx(1.0)


def test_stamp_that_is_no_number_is_refused():
    assert refusal(history((10.0, 1.0)), math.nan) == 'stale joint state'


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_not_remembered(bad):
    pole = history((1.0, 0.5))
    assert not pole.record(1.1, bad)
    assert not pole.record(bad, 0.7)
    assert pole.at(1.05) == 0.5
    assert pole.record(1.1, 0.6)
    assert pole.at(1.05) == pytest.approx(0.55)


def test_late_joint_state_does_not_wipe_the_others():
    pole = history((1.0, 0.0), (1.02, 0.02), (1.04, 0.04))
    for late in (1.01, 0.5, 0.9):  # the last is newer than the one before it, but only the second
        assert not pole.record(late, 3.0)
    assert pole.at(1.03) == pytest.approx(0.03)
    assert pole.record(1.06, 0.06)
    assert not pole.record(1.05, 3.0)  # late again, and the count begins anew
    assert not pole.record(1.055, 3.0)
    assert pole.at(1.05) == pytest.approx(0.05)


def test_joint_state_that_comes_twice_counts_once():
    pole = history((1.0, 1.0), (1.02, 1.2))
    for _ in range(10):
        assert not pole.record(1.02, 2.0)
    assert pole.at(1.02) == 1.2


@pytest.mark.parametrize('back', [0.07, 0.5, 1000.0])
def test_clock_that_was_set_back_starts_over_with_the_third_joint_state(back):
    pole = history(*((1000.0 + 0.02 * k, 0.1) for k in range(100)))
    set_back = [1002.0 - back + 0.02 * k for k in range(4)]
    taken = [pole.record(stamp, 0.5 + 0.1 * k) for k, stamp in enumerate(set_back)]
    assert taken[:3] == [False, False, True]
    assert pole.at(set_back[0]) == pytest.approx(0.5)
    assert pole.at(set_back[2] + 0.01) == pytest.approx(0.75)
    assert refusal(pole, set_back[3] + 0.11) == 'stale joint state'


def test_one_stamp_in_the_future_is_overcome_by_three():
    pole = history((1.0, 0.0), (1.02, 0.0), (1e6, 3.0), (1.04, 0.0), (1.06, 0.0))
    assert refusal(pole, 1.2) == 'stale joint state'
    assert pole.record(1.08, 0.0)
    assert pole.at(1.1) == 0.0


def test_oldest_are_forgotten():
    pole = PoleHistory(0.6, length=3)
    for number in range(10):
        pole.record(float(number), 0.1 * number)
    assert pole.at(7.5) == pytest.approx(0.75)
    assert refusal(pole, 5.0) == 'stale joint state'


@given(
    gaps=st.lists(st.floats(0.001, 0.2), min_size=1, max_size=20),
    fraction=st.floats(0.0, 1.0),
    slope=st.floats(-5.0, 5.0),
)
@PROPERTY
def test_steady_turn_is_given_exactly_at_every_time_between(gaps, fraction, slope):
    stamps = [sum(gaps[:count]) for count in range(len(gaps) + 1)]
    pole = history(*((stamp, 1.0 + slope * stamp) for stamp in stamps))
    stamp = fraction * stamps[-1]
    error = math.remainder(pole.at(stamp) - (1.0 + slope * stamp), 2.0 * math.pi)
    assert error == pytest.approx(0.0, abs=1e-9)


numbers = st.one_of(st.floats(), st.floats(0.0, 1.0), st.integers(0, 10).map(lambda k: 0.05 * k))


@given(records=st.lists(st.tuples(numbers, numbers), max_size=30), stamp=numbers)
@PROPERTY
def test_whatever_comes_an_angle_is_given_or_refused(records, stamp):
    pole = history(*records)
    try:
        assert abs(pole.at(stamp)) <= 4.0 * math.pi
        assert pole.age <= pole.timeout
    except ReadingRejectedError as refused:
        assert str(refused) in ('no joint state', 'stale joint state')
