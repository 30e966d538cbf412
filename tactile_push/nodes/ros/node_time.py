# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node's time in seconds."""

import time

from builtin_interfaces.msg import Time
from rclpy.node import Node

from tactile_push.pipeline.stamps import epoch_of, seconds_since

AT_ONCE = 1e-3  # two clocks are read within microseconds unless something comes in between [s]
TRIES = 10  # to read them at once; picked


class NodeTime:
    """Times of a node's clock since an epoch close by, see `tactile_push.pipeline.stamps` [s]."""

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        self._epoch = 0

    def now(self) -> float:
        """Return the present time [s]."""
        return self.of(self._clock.now().to_msg())

    def now_and_steady(self) -> tuple[Time, float]:
        """Return the present time, and the same on a clock that cannot be set [s].

        Both are read again if this process had to wait between them: the wait would look like a
        clock that was set.
        """
        for _ in range(TRIES):
            before = time.monotonic()
            now = self._clock.now()
            steady = time.monotonic()
            if steady - before < AT_ONCE:
                break
        return now.to_msg(), steady

    def of(self, stamp: Time) -> float:
        """Return the time of a message's stamp [s]."""
        return self.seconds(stamp.sec, stamp.nanosec)

    def seconds(self, sec: int, nanosec: int) -> float:
        """Return the time [s] of a stamp [s, ns]."""
        if not self._epoch:  # simulated time, which may not run yet, starts at 0
            self._epoch = epoch_of(self._clock.now().nanoseconds // 10**9)
        return seconds_since(self._epoch, sec, nanosec)
