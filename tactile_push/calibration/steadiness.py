# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Decides when a touch is held still."""

from collections import deque
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from tactile_push.tactile.sphere import Array

HOLD = 0.6  # for so long a touch has to stay as it is [s]; picked
M = TypeVar('M')


class Sight(NamedTuple):
    """What one message shows of the tip."""

    touched: bool  #: whether something surely touches the tip
    free: bool  #: whether surely nothing does
    #: numbers that stay where they are while the touch does; one that moves by 1 has moved
    features: Array


class _Seen(NamedTuple, Generic[M]):
    """A message of a touch."""

    time: float  # when it came [s]
    features: Array
    message: M


class SteadyTouch(Generic[M]):
    """Waits until a touch has been the same for `HOLD`.

    The means of the features in the first and in the second half of that time are compared, so
    noise does not look like motion.

    Parameters
    ----------
    least : int
        Number of messages that a touch needs at least, two or more.
    """

    def __init__(self, least: int) -> None:
        self._least = least
        self._window: deque[_Seen[M]] = deque()

    def take(self, time: float, sight: Sight, message: M) -> list[M]:
        """Take a message.

        Parameters
        ----------
        time : float
            When it came [s].
        sight : Sight
            What it shows.
        message : object
            The message.

        Returns
        -------
        list
            The messages of the steady touch, once there is one; empty until then.
        """
        window = self._window
        if not sight.touched or (window and time < window[-1].time):
            window.clear()
        if not sight.touched:
            return []
        window.append(_Seen(time, sight.features, message))
        while len(window) > self._least and time - window[1].time >= HOLD:
            window.popleft()
        if len(window) < self._least or time - window[0].time < HOLD:
            return []
        features = np.array([seen.features for seen in window])
        half = len(window) // 2
        moved = np.abs(features[:half].mean(axis=0) - features[half:].mean(axis=0))
        return [seen.message for seen in window] if np.all(moved < 1.0) else []

    def restart(self) -> None:
        """Forget the touch."""
        self._window.clear()
