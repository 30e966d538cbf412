# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of messages as times in seconds that a float can tell apart.

A float resolves a time since 1970 to 240 ns only, but the stamps of two readings that were read
together differ by 1 ns. So times count from an epoch close by. All who take the epoch from about
the same time, live or from a bag, get the same one, so that equal stamps give equal numbers.
"""

from collections.abc import Callable
from typing import Any

LENGTH = 2**20  # of an epoch [s]: twelve days, within which nanoseconds can be told apart

Stamp = tuple[int, int]
"""Time of a message [s, ns]."""
Seconds = Callable[[int, int], float]
"""Returns the time [s] of a stamp."""


def stamp_of(message: Any) -> Stamp:
    """Return the stamp of a message with a header."""
    stamp = message.header.stamp
    return stamp.sec, stamp.nanosec


def epoch_of(sec: int) -> int:
    """Return the epoch [s] for times about a given one [s], on the same clock."""
    return sec // LENGTH * LENGTH


def seconds_since(epoch: int, sec: int, nanosec: int) -> float:
    """Return the time of a stamp [s, ns] since an epoch [s]."""
    return sec - epoch + nanosec * 1e-9


def stamp_before(sec: int, nanosec: int, age: float) -> tuple[int, int]:
    """Return the stamp [s, ns] of what was older by an age [s]; at least 0."""
    return divmod(max(0, sec * 10**9 + nanosec - round(1e9 * age)), 10**9)
