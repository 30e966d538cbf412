# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Times in seconds that a float has room for.

A float resolves a time since 1970 to 240 ns only; two readings of one read differ by one. So times
count from an epoch close by. It is the same for all who take it from about the same time, live or
from a bag, so that equal stamps give equal numbers.
"""

LENGTH = 2**20  # of the time that has one epoch [s]: twelve days, in which nanoseconds differ


def epoch_of(sec: int) -> int:
    """Give the epoch for times about a given one.

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
    """Give the time of a stamp.

    Parameters
    ----------
    epoch : int
        From when on the time counts [s].
    sec, nanosec : int
        The stamp [s, ns].

    Returns
    -------
    float
        Time [s].
    """
    return sec - epoch + nanosec * 1e-9


def stamp_before(sec: int, nanosec: int, age: float) -> tuple[int, int]:
    """Give the stamp of what was older at a given one.

    Parameters
    ----------
    sec, nanosec : int
        The stamp [s, ns].
    age : float
        By how much [s].

    Returns
    -------
    sec, nanosec : int
        Its stamp [s, ns]; 0 if it is older than the clock.
    """
    return divmod(max(0, sec * 10**9 + nanosec - round(1e9 * age)), 10**9)
