# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import numpy as np
import pytest

from tactile_push.calibration.steadiness import HOLD, Sight, SteadyTouch

LEAST = 4
PERIOD = 0.05  # [s]


def touched(*features):
    return Sight(True, False, np.array(features))


FREE = Sight(False, True, np.array([np.nan]))


def take_all(sights, period=PERIOD, least=LEAST):
    """Return after how many sights the touch is steady, and the messages then; None if never."""
    steady = SteadyTouch(least)
    for number, sight in enumerate(sights):
        if taken := steady.take(number * period, sight, number):
            return number, taken
    return None


def test_touch_that_stays_is_steady_after_the_time_to_hold():
    assert take_all([touched(3.0, -1.0)] * 30) == (12, list(range(13)))
    assert pytest.approx(12 * PERIOD) == HOLD


def test_few_messages_take_longer():
    assert take_all([touched(3.0)] * 30, period=0.5) == (3, [0, 1, 2, 3])


def test_touch_that_moves_is_steady_only_once_it_stands():
    # The halves of the time differ by half of the way in it: six steps of 0.25.
    moving = [touched(0.25 * number) for number in range(40)]
    assert take_all(moving) is None
    number, taken = take_all([*moving, *[touched(10.0)] * 20])
    assert taken[-1] == number >= 40
    assert number < 40 + 13


def test_slow_creep_is_no_motion():
    assert take_all([touched(0.1 * number) for number in range(20)]) is not None


def test_noise_is_no_motion():
    random = np.random.default_rng(1)
    noisy = [touched(*random.normal(5.0, 0.5, 3)) for _ in range(60)]
    # The means of two halves of 30 differ by 0.13 in the mean: far from 1.
    assert take_all(noisy, period=HOLD / 59, least=10) is not None


def test_lost_contact_starts_over():
    sights = [*[touched(0.0)] * 10, FREE, *[touched(0.0)] * 20]
    assert take_all(sights) == (23, list(range(11, 24)))


def test_clock_that_is_set_back_starts_over():
    steady = SteadyTouch(LEAST)
    for number in range(10):
        assert steady.take(100.0 + number * PERIOD, touched(0.0), number) == []
    times = [number * PERIOD for number in range(13)]
    assert [len(steady.take(time, touched(0.0), 0)) for time in times] == [0] * 12 + [13]


def test_restart_forgets_the_touch():
    steady = SteadyTouch(LEAST)
    for number in range(12):
        steady.take(number * PERIOD, touched(0.0), number)
    steady.restart()
    assert steady.take(12 * PERIOD, touched(0.0), 12) == []
