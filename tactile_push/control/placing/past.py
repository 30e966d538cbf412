# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From what was known at a reading to the present, under the commands that were given since."""

import math
from collections import deque

from tactile_push.control.placing.model import Pushed, Situation, follow

REMEMBERED = 32  # commands; far more than a reading may be old
# Ways along the belt are rounded to a grid of about a picometre [1/m]. Their sums and differences
# are then exact up to 8 km, so that a replay that begins to count elsewhere has the same ones.
GRID = 2.0**40


def on_grid(way: float) -> float:
    """Round a way along the belt [m] so that sums and differences of ways are exact."""
    return round(way * GRID) / GRID


class Past:
    """What the finger was told on the last piece of the belt's way.

    Parameters
    ----------
    lag : float
        Belt on which the finger gets near to its command by a factor of e [m].

    Attributes
    ----------
    way : float
        How far the belt has come since the beginning [m].
    """

    def __init__(self, lag: float) -> None:
        self.way = 0.0
        self._lag = lag
        self._u = 0.0
        # Where each command began, what it was, and how the finger moved then.
        self._told: deque[tuple[float, float, float]] = deque(maxlen=REMEMBERED)

    def add(self, command: float, way: float) -> None:
        """Take the command, as a share of the belt's speed, that was in force over a way [m]."""
        way = on_grid(way)
        self._told.append((self.way, command, self._u))
        self._u = self._moving(command, self._u, way)
        self.way += way

    def present(
        self, x: float, theta: float, d: float, known_at: float, pushed: Pushed
    ) -> Situation:
        """Move on what was known at an earlier place of the belt.

        Parameters
        ----------
        x, theta, d : float
            Finger across the belt [m], angle of the edge [rad] and contact along it [m] there.
        known_at : float
            `way` when that was so [m].
        pushed : Pushed
            The object.

        Returns
        -------
        Situation
            Where finger and object are now.
        """
        now: Situation | None = None
        bounds = [*(begin for begin, _, _ in self._told), self.way]
        for (begin, command, u), end in zip(self._told, bounds[1:], strict=True):
            if end > known_at:
                start = max(begin, known_at)
                if now is None:
                    moving = self._moving(command, u, start - begin)
                    now = Situation(x, theta, d, moving, command)
                now = follow(now, command, end - start, pushed)
        if now is None:
            command = self._told[-1][1] if self._told else 0.0
            now = Situation(x, theta, d, self._u, command)
        return now

    def _moving(self, command: float, u: float, way: float) -> float:
        """Return how the finger moves after a way under a command."""
        decay = math.exp(-way / self._lag) if self._lag > 0.0 else 0.0
        return command + (u - command) * decay
