# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The newest of the values that arrive, whatever order they arrive in."""

import math


class Newest:
    """Keeps the newest value, by its stamp, and reports every value once.

    A value from the future is as useless as an old one, because somebody's clock is wrong. It is
    ignored and does not keep later values from counting.
    """

    def __init__(self) -> None:
        self.value = math.nan  # newest value that was believed
        self.stamp = -math.inf  # its stamp [s]
        # From when on it ages [s]: its stamp or, if that was ahead, when it was looked at. A clock
        # that is ahead must not make a value last longer.
        self.since = -math.inf
        self._arrived: tuple[float, float] | None = None

    @property
    def known(self) -> bool:
        """Whether there is a value."""
        return math.isfinite(self.stamp)

    @property
    def newest(self) -> float:
        """Newest stamp that arrived, believed or not yet looked at [s]."""
        return self.stamp if self._arrived is None else self._arrived[1]

    def take(self, value: float, stamp: float) -> None:
        """Take a value as it arrives; ignore a stamp [s] that is not newer than the newest."""
        if math.isfinite(stamp) and stamp > self.newest:
            self._arrived = value, stamp

    def fresh(self, now: float, timeout: float) -> bool:
        """Return whether a value has arrived since the last call, within the timeout of now [s]."""
        arrived, self._arrived = self._arrived, None
        if arrived is None or arrived[1] - now > timeout:
            return False
        self.value, self.stamp = arrived
        self.since = min(self.stamp, now)
        return now - self.stamp <= timeout
