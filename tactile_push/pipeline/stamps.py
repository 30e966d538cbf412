# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of messages as times in seconds that a float can tell apart.

A float resolves a time since 1970 to 240 ns only, but the stamps of two readings that were read
together differ by 1 ns. So times count from an epoch close by. All who take the epoch from about
the same time, live or from a bag, get the same one, so that equal stamps give equal numbers.
"""

from collections.abc import Callable

LENGTH = 2**20  # of an epoch [s]: twelve days, within which nanoseconds can be told apart

Stamp = tuple[int, int]
"""Time of a message [s, ns]."""
Seconds = Callable[[int, int], float]
"""Returns the time [s] of a stamp."""


def epoch_of(sec: int) -> int:
    """Return the epoch for times about a given one.

    Parameters
    ----------
    sec : int
        Seconds since 1970, or since the start of simulated time.

    Returns
    -------
    int
        The epoch [s], on the same clock.
    """
    return sec // LENGTH * LENGTH


def seconds_since(epoch: int, sec: int, nanosec: int) -> float:
    """Return the time of a stamp.

    Parameters
    ----------
    epoch : int
        Time from which the result counts [s].
    sec, nanosec : int
        The stamp [s, ns].

    Returns
    -------
    float
        Time [s].
    """
    return sec - epoch + nanosec * 1e-9


def stamp_before(sec: int, nanosec: int, age: float) -> tuple[int, int]:
    """Return the stamp of something that was older at a given stamp.

    Parameters
    ----------
    sec, nanosec : int
        The stamp [s, ns].
    age : float
        How much older it was [s].

    Returns
    -------
    sec, nanosec : int
        The earlier stamp [s, ns]; 0 if it lies before the start of the clock.
    """
    return divmod(max(0, sec * 10**9 + nanosec - round(1e9 * age)), 10**9)
