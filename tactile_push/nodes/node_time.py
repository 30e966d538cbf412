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
"""A node's time as a number."""

import time

from builtin_interfaces.msg import Time
from rclpy.node import Node

AT_ONCE = 1e-3  # in which two clocks are read, unless something comes in between [s]
TRIES = 10


class NodeTime:
    """Gives times in seconds since the node's start.

    A float has no room for the nanoseconds of a time since 1970; two readings of one read differ
    by one.

    Parameters
    ----------
    node : Node
        The node, whose clock it is.
    """

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        self._epoch = self._clock.now().nanoseconds // 10**9

    def now(self) -> float:
        """Give the present time [s]."""
        nanoseconds = self._clock.now().nanoseconds - self._epoch * 10**9
        return nanoseconds * 1e-9

    def now_and_steady(self) -> tuple[float, float]:
        """Give the present time [s], and the same on a clock that cannot be set [s].

        If this process had to wait between the two they are read again: the wait would look like
        a clock that was set.
        """
        for _ in range(TRIES):
            before = time.monotonic()
            now = self.now()
            steady = time.monotonic()
            if steady - before < AT_ONCE:
                break
        return now, steady

    def of(self, stamp: Time) -> float:
        """Give the time of a message's stamp [s]."""
        return stamp.sec - self._epoch + stamp.nanosec * 1e-9
