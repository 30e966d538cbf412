# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's motion from its commands, against the simulated servo and by properties."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.estimation import FingerMotion

VELOCITIES = st.floats(-0.02, 0.02)
DURATIONS = st.floats(1e-3, 0.5)
COMMANDS = st.lists(st.tuples(DURATIONS, VELOCITIES), min_size=1, max_size=8)


@given(COMMANDS)
def test_finger_that_follows_at_once_goes_as_commanded(commands):
    motion, now, expected = FingerMotion(), 0.0, 0.0
    motion.reset(now)
    for duration, velocity in commands:
        motion.command(now, velocity)
        now += duration
        expected += velocity * duration
    assert motion.way(now) == pytest.approx(expected, abs=1e-12)


def test_step_is_answered_after_the_delay_with_an_exponential():
    motion = FingerMotion(lag=0.1, delay=0.3)
    motion.reset(5.0)
    motion.command(5.0, 0.01)
    assert motion.way(5.3) == pytest.approx(0.0, abs=1e-15)
    # Way of a lag of first order after a step, by its transfer function 1 / (s^2 (lag s + 1)).
    expected = 0.01 * (0.2 - 0.1 * (1.0 - math.exp(-2.0)))
    assert motion.way(5.5) == pytest.approx(expected, rel=1e-12)


@given(COMMANDS, st.floats(1e-3, 0.3), st.floats(0.0, 0.3), st.lists(DURATIONS, max_size=6))
def test_ways_add_up_however_often_one_asks(commands, lag, delay, questions):
    once, often = FingerMotion(lag, delay), FingerMotion(lag, delay)
    now = 0.0
    for motion in (once, often):
        now = 0.0
        motion.reset(now)
        for duration, velocity in commands:
            motion.command(now, velocity)
            now += duration
    end = now + sum(questions)
    total = often.way(now)
    for question in questions:
        now += question
        total += often.way(now)
    total += often.way(end)
    assert total == pytest.approx(once.way(end), abs=1e-12)


@given(
    st.lists(st.tuples(DURATIONS, VELOCITIES, st.floats(0.0, 1.0)), min_size=1, max_size=8),
    st.floats(0.0, 0.3),
    st.floats(0.0, 0.3),
    st.floats(0.0, 1.0),
    VELOCITIES,
)
def test_ways_add_up_although_the_finger_is_followed_ahead_of_its_commands(
    commands, lag, delay, start, velocity
):
    once, ahead = FingerMotion(lag, delay), FingerMotion(lag, delay)
    once.reset(0.0, velocity)
    ahead.reset(start, velocity)
    now, asked, total = 0.0, start, 0.0
    for duration, wanted, further in commands:
        once.command(now, wanted)
        ahead.command(now, wanted)
        asked = max(asked, now + further)
        total += ahead.way(asked)
        now += duration
    end = max(asked, now)
    total += ahead.way(end)
    until_start = FingerMotion(lag, delay)
    until_start.reset(0.0, velocity)
    now = 0.0
    for duration, wanted, _ in commands:
        until_start.command(now, wanted)
        now += duration
    assert total == pytest.approx(once.way(end) - until_start.way(start), abs=1e-12)


def test_it_may_start_while_it_moves():
    motion = FingerMotion(lag=0.1)
    motion.reset(1.0, 0.004)
    assert motion.way(1.5) == pytest.approx(0.002, rel=1e-12)


@pytest.mark.parametrize('value', [-0.1, math.nan, math.inf])
@pytest.mark.parametrize('name', ['lag', 'delay'])
def test_times_that_are_none_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        FingerMotion(**{name: value})
