# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.calibration.wrench_sense import WrenchSense
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError

OFFSET = np.array([0.5, -0.4, 3.0, 0.01, 0.02, -0.03])
TOUCH = np.array([0.3, 0.4, -2.0, 0.01, 0.0, 0.0])


def noisy(count, wrench=OFFSET, size=0.05, seed=0):
    random = np.random.default_rng(seed)
    return wrench + random.normal(0.0, [size] * 3 + [0.01 * size] * 3, (count, 6))


@pytest.fixture
def sense():
    sense = WrenchSense()
    sense.take_free(np.tile(OFFSET, (10, 1)))
    return sense


def test_touch_is_told_by_its_force_without_the_offset(sense):
    assert sense.sight(OFFSET)[:2] == (False, True)
    assert sense.sight(OFFSET + TOUCH)[:2] == (True, False)
    between = OFFSET + [0.0, 0.0, 0.15, 0.0, 0.0, 0.0]
    assert sense.sight(between)[:2] == (False, False)


@pytest.mark.parametrize(
    ('change', 'moves'),
    [
        ([0.0, 0.0, -0.2, 0.0, 0.0, 0.0], False),  # 10 % stronger
        ([0.0, 0.0, -1.5, 0.0, 0.0, 0.0], True),
        ([0.2, 0.0, 0.0, 0.0, 0.0, 0.0], True),  # turned by 0.1 rad
        ([0.0, 0.0, 0.0, 0.0, 0.001, 0.0], False),  # shifted by 0.5 mm
        ([0.0, 0.0, 0.0, 0.0, 0.004, 0.0], True),
    ],
)
def test_touch_has_moved_when_its_force_turns_shifts_or_grows(sense, change, moves):
    before, after = (sense.sight(OFFSET + TOUCH + c).features for c in (np.zeros(6), change))
    assert (np.max(np.abs(after - before)) > 1.0) == moves


def test_tare_is_the_mean(sense):
    sense.take_free(noisy(50))
    felt = sense.words([OFFSET + TOUCH]).replace(',', '').split()
    # sqrt(0.3² + 0.4² + 2²) N; the mean of 50 is within three times 0.05 N/sqrt(50).
    expected = [math.sqrt(4.25), *TOUCH[:3]]
    assert [float(felt[k]) for k in (1, 4, 6, 8)] == pytest.approx(expected, abs=0.03)


def test_force_that_varies_is_no_tare(sense):
    with pytest.raises(NotUntouchedError, match=r'varies by 0\.[234]\d N'):
        sense.take_free(noisy(50, size=0.2))


def test_wrench_that_is_not_finite_is_refused(sense):
    with pytest.raises(ReadingRejectedError, match='not finite'):
        sense.sight([np.nan, *TOUCH[1:]])
    with pytest.raises(NotUntouchedError, match='not finite'):
        sense.take_free([[np.inf] * 6] * 10)
