# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Ways that the commands tell and the joints correct."""

import math
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.estimation.joint_way import CATCH_UP, DIFFERENCE, JointWay

PERIOD = 0.1
WAYS = st.lists(st.floats(-7e-4, 7e-4), min_size=1, max_size=100)  # to 7 mm/s [m]


def corrected(told, places, start=0.0):
    """Return the corrected ways of ways that were told, and in which of them joints are doubted."""
    joints, ways, doubted = JointWay(), [], []
    joints.reset(start)
    for way, x in zip(told, places, strict=True):
        ways.append(joints.corrected(way, x, PERIOD))
        doubted.append(joints.doubted)
    return ways, doubted


@given(WAYS)
def test_finger_that_goes_as_commanded_is_not_corrected(told):
    ways, doubted = corrected(told, list(accumulate(told)))
    assert ways == pytest.approx(told, abs=1e-12)
    assert not any(doubted)


@given(WAYS, st.floats(0.75, 1.25))
def test_finger_that_goes_too_far_is_followed_and_nothing_adds_up(told, factor):
    places = [factor * x for x in accumulate(told)]
    ways, doubted = corrected(told, places)
    # A speed that is wrong by e leaves e CATCH_UP at most.
    worst = abs(factor - 1.0) * 7e-3 * CATCH_UP
    assert max(abs(np.cumsum(ways) - places)) <= worst + 1e-12
    assert not any(doubted)


def test_constant_error_of_the_speed_is_gone_after_some_time_constants():
    told = [3e-4] * 60
    ways, _ = corrected(told, [1.17 * x for x in accumulate(told)])
    after = round(5.0 * CATCH_UP / PERIOD)
    assert ways[after:] == pytest.approx([1.17 * 3e-4] * (60 - after), rel=2e-3)


def test_noise_of_the_joints_comes_through_in_part_and_does_not_add_up():
    rng = np.random.default_rng(0)
    told = [2e-4] * 1000
    noise = rng.normal(0.0, 1e-4, 1000)  # of a coarse encoder
    ways, doubted = corrected(told, np.cumsum(told) + noise)
    assert np.std(ways) < 0.3 * np.std(np.diff(noise))
    assert abs(sum(ways) - sum(told)) < 3e-4
    assert not any(doubted)


def test_joints_that_stand_still_are_doubted_until_they_move_as_commanded():
    told = [5e-4] * 20 + [0.0] * 20 + [5e-4] * 20
    places = [0.0] * 40 + list(accumulate([5e-4] * 20))
    _, doubted = corrected(told, places)
    first = doubted.index(True)
    assert sum(told[: first + 1]) > DIFFERENCE
    assert first < 10
    assert all(doubted[first:20])
    assert not any(doubted[39:])


def test_joints_of_the_wrong_sign_are_doubted():
    told = [3e-4] * 20
    _, doubted = corrected(told, [-x for x in accumulate(told)])
    assert doubted[-1]


def test_without_joints_the_commands_count():
    told = [1e-4, 2e-4, 3e-4, 4e-4]
    assert corrected(told, [math.nan] * 4) == (told, [False] * 4)
    assert corrected(told, [math.nan, 7.0, math.nan, 7.5], math.nan) == (told, [False] * 4)
