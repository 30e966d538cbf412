# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The newest of the values that arrive, whatever order they arrive in."""

import math


class Newest:
    """Keeps the newest value, by its stamp, and gives every value once.

    A value from the future is as useless as an old one, because somebody's clock is wrong. It is
    ignored and does not keep later values from counting.

    Attributes
    ----------
    value : float
        Newest value that was believed; NaN before the first one.
    stamp : float
        Its stamp [s]; minus infinity before the first one.
    since : float
        From when on it ages [s]: its stamp or, if that was ahead, when it was looked at. A clock
        that is ahead must not make a value last longer.
    """

    def __init__(self) -> None:
        self.value = math.nan
        self.stamp = -math.inf
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
        """Take a value as it arrives.

        Parameters
        ----------
        value : float
            The value.
        stamp : float
            When it was measured [s]. One that is not newer than the newest is ignored.
        """
        if math.isfinite(stamp) and stamp > self.newest:
            self._arrived = value, stamp

    def fresh(self, now: float, timeout: float) -> bool:
        """Return whether a value has arrived since the last call that is not older than a timeout.

        Parameters
        ----------
        now : float
            Present time [s].
        timeout : float
            Largest age, and largest lead [s].

        Returns
        -------
        bool
            Whether `value` is new.
        """
        arrived, self._arrived = self._arrived, None
        if arrived is None or arrived[1] - now > timeout:
            return False
        self.value, self.stamp = arrived
        self.since = min(self.stamp, now)
        return now - self.stamp <= timeout
