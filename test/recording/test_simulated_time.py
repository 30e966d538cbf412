# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.recording.simulated_time import SimulatedTime


def test_time_is_that_of_the_last_tick_before():
    time = SimulatedTime()
    assert not time.running
    for received, tick in ((100, 5), (200, 7), (300, 6)):
        time.tick(received, tick)
    assert time.running
    expected = {100: 5, 199: 5, 200: 7, 299: 7, 300: 6, 10_000: 6}
    assert {received: time.at(received, latched=False) for received in expected} == expected


def test_before_the_first_tick_only_what_is_latched_has_a_time():
    time = SimulatedTime()
    assert time.at(50, latched=True) is None
    time.tick(60, 0)  # the clock does not run yet
    assert not time.running
    assert time.at(65, latched=True) is None
    time.tick(100, 5)
    time.tick(200, 7)
    assert time.at(50, latched=False) is None
    assert time.at(50, latched=True) == 5


def test_time_0_counts_once_the_clock_has_run():
    time = SimulatedTime()
    time.tick(100, 5)
    time.tick(200, 0)  # the simulation starts over
    assert time.at(250, latched=False) == 0


def test_system_clock_that_was_set_back():
    time = SimulatedTime()
    time.tick(1_000_000, 5)
    time.tick(500, 6)
    assert time.at(600, latched=False) == 6


@given(st.lists(st.integers(1, 10**12), min_size=1, max_size=3000), st.data())
def test_any_ticks(ticks, data):
    time = SimulatedTime()
    for k, tick in enumerate(ticks):
        time.tick(10 * k, tick)
    k = data.draw(st.integers(max(len(ticks) - 900, 0), len(ticks) - 1))
    assert time.at(10 * k + data.draw(st.integers(0, 9)), latched=False) == ticks[k]
