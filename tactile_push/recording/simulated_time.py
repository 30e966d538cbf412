# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a simulated clock showed when something was received."""

import math
from bisect import bisect_right

_TICKS = 1000  # that are remembered: a second of a clock at 1 kHz


class SimulatedTime:
    """The latest ticks of a simulated clock, and when they were received.

    Messages and ticks arrive separately: only the middleware's stamps tell which came first.
    """

    def __init__(self) -> None:
        self._since: float = math.inf
        self._ticks: list[tuple[int, int]] = []

    @property
    def running(self) -> bool:
        """Whether the clock runs; as in rcl, time 0 means that it has not started."""
        return bool(self._ticks)

    def tick(self, received: int, time: int) -> None:
        """Take in a tick that shows `time` and was `received` by the system's clock [ns]."""
        if self._ticks and received < self._ticks[-1][0]:
            # The system's clock was set back.
            self._ticks.clear()
            self._since = 0
        if time or self._ticks:
            self._since = min(self._since, received)
            self._ticks.append((received, time))
            del self._ticks[:-_TICKS]

    def at(self, received: int, *, latched: bool) -> int | None:
        """Return the simulated time at which a message was received by the system's clock [ns].

        None if the message came before the clock ran, unless it is latched: then it is still there
        when the clock starts.
        """
        if not self._ticks or (received < self._since and not latched):
            return None
        following = bisect_right(self._ticks, (received, math.inf))
        return self._ticks[max(following - 1, 0)][1]
