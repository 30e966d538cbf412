# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import itertools
from types import SimpleNamespace

import pytest

rclpy = pytest.importorskip('rclpy')

from builtin_interfaces.msg import Time  # noqa: E402
from rclpy.time import Time as RclpyTime  # noqa: E402

from tactile_push.nodes.ros.node_time import NodeTime  # noqa: E402

START = 1_795_000_000_500_000_000  # some day in 2026 [ns]


class Clock:
    """A clock that stands where it is put."""

    nanoseconds = START

    def now(self):
        return RclpyTime(nanoseconds=self.nanoseconds)


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def node_time(clock):
    return NodeTime(SimpleNamespace(get_clock=lambda: clock))


def test_time_passes_as_on_the_clock(clock, node_time):
    before = node_time.now()
    clock.nanoseconds += 2_250_000_000
    assert node_time.now() - before == pytest.approx(2.25, abs=1e-12)


def test_wait_between_the_two_clocks_does_not_look_like_a_jump(clock, node_time, monkeypatch):
    def later(seconds):
        steady[0] += seconds
        clock.nanoseconds += round(seconds * 1e9)

    waits = itertools.cycle([0.0, 0.0, 0.5, 0.0])

    def read_steady():
        later(next(waits))  # as good as at any other place between the readings
        return steady[0]

    steady = [7.0]
    monkeypatch.setattr('tactile_push.nodes.ros.node_time.time.monotonic', read_steady)
    before = node_time.now_and_steady()
    later(0.25)
    after = node_time.now_and_steady()
    passed = node_time.of(after[0]) - node_time.of(before[0])
    assert passed == pytest.approx(after[1] - before[1], abs=1e-9)


def test_steady_clock_does_not_follow_one_that_is_set(clock, node_time):
    before = node_time.now_and_steady()
    clock.nanoseconds += 3600 * 10**9
    after = node_time.now_and_steady()
    passed = node_time.of(after[0]) - node_time.of(before[0])
    assert passed == pytest.approx(3600.0, abs=1e-9)
    assert 0.0 <= after[1] - before[1] < 60.0


def test_stamp_is_a_time_of_the_same_clock(clock, node_time):
    stamp = Time(sec=START // 10**9, nanosec=START % 10**9)
    assert node_time.of(stamp) == node_time.now()


def test_nanoseconds_are_told_apart_for_days(node_time):
    days = 5 * 24 * 3600
    first, second = (Time(sec=START // 10**9 + days, nanosec=n) for n in (7, 8))
    assert node_time.of(second) > node_time.of(first)


def test_simulated_time_that_starts_late_is_told_from_its_own_start(clock):
    clock.nanoseconds = 0
    node_time = NodeTime(SimpleNamespace(get_clock=lambda: clock))
    assert node_time.now() == 0.0
    clock.nanoseconds = 250_000_000
    assert node_time.now() == 0.25


def test_clock_of_a_bag_that_starts_late_still_tells_nanoseconds_apart(clock):
    clock.nanoseconds = 0
    node_time = NodeTime(SimpleNamespace(get_clock=lambda: clock))
    node_time.now()
    clock.nanoseconds = START
    first, second = (Time(sec=START // 10**9, nanosec=n) for n in (7, 8))
    assert node_time.of(second) > node_time.of(first)


def test_two_nodes_that_start_at_other_times_give_one_stamp_the_same_number(clock):
    early = NodeTime(SimpleNamespace(get_clock=lambda: clock))
    early.now()
    clock.nanoseconds += 1234 * 10**9
    late = NodeTime(SimpleNamespace(get_clock=lambda: clock))
    stamp = Time(sec=START // 10**9 + 2000, nanosec=123_456_789)
    assert early.of(stamp) == late.of(stamp)
