# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From wrenches to readings: what `wrench_sensor` does with each message."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tactile_push.interface import TACTILE
from tactile_push.pipeline.geometry import NEGATIVE_STAMP
from tactile_push.pipeline.messages import Output, tactile_fields
from tactile_push.pipeline.stamps import Seconds, Stamp, stamp_before
from tactile_push.tactile import ReadingRejectedError, Touch, WrenchReader


class Touched(NamedTuple):
    """What came of one wrench."""

    stamp: Stamp  #: when it was measured [s, ns]
    told: Touch | None  #: what it tells; None if it was refused, or no reading was due
    refusal: str  #: why it was refused; empty if it was not

    def outputs(self) -> Iterator[Output]:
        """Yield the reading, if there is one, stamped with the mean time of what it is made of."""
        if self.told is not None:
            told = self.told
            stamp = stamp_before(*self.stamp, told.age)
            yield TACTILE, tactile_fields(stamp, told.reading, told.tangential_force)


class Wrenches:
    """Finds the reading that each wrench tells.

    Parameters
    ----------
    reader : WrenchReader
        Tares, filters and finds the contact.
    seconds : callable
        Returns the time [s] of a stamp.
    """

    def __init__(self, reader: WrenchReader, seconds: Seconds) -> None:
        self.reader = reader
        self._seconds = seconds

    def wrench(
        self, stamp: Stamp, frame: str, force: Sequence[float], moment: Sequence[float]
    ) -> Touched:
        """Take a message of `wrench`.

        Parameters
        ----------
        stamp, frame : tuple of int, str
            When it was measured [s, ns], and the sensor's frame.
        force, moment : sequence of float
            Force [N] and moment [N m], three each.

        Returns
        -------
        Touched
            What came of it.
        """
        if stamp[0] < 0:  # the reading would have it, too
            return Touched(stamp, None, NEGATIVE_STAMP)
        try:
            touch = self.reader.touch(self._seconds(*stamp), frame, force, moment)
        except ReadingRejectedError as reason:
            return Touched(stamp, None, str(reason))
        return Touched(stamp, touch, '')
