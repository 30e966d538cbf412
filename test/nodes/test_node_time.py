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

from types import SimpleNamespace

import pytest

rclpy = pytest.importorskip('rclpy')

from builtin_interfaces.msg import Time  # noqa: E402

from tactile_push.nodes.node_time import NodeTime  # noqa: E402

START = 1_795_000_000_500_000_000  # some day in 2026 [ns]


class Clock:
    """A clock that stands where it is put."""

    nanoseconds = START

    def now(self):
        return SimpleNamespace(nanoseconds=self.nanoseconds)


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


def test_stamp_is_a_time_of_the_same_clock(clock, node_time):
    stamp = Time(sec=START // 10**9, nanosec=START % 10**9)
    assert node_time.of(stamp) == node_time.now()


def test_nanoseconds_are_told_apart_for_days(node_time):
    days = 5 * 24 * 3600
    first, second = (Time(sec=START // 10**9 + days, nanosec=n) for n in (7, 8))
    assert node_time.of(second) > node_time.of(first)
