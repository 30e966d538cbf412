# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How the finger moves between two moments, from its commands."""

import math
from collections import deque


class FingerMotion:
    """Follows a finger that answers its commands after a pure delay with a lag of first order.

    Parameters
    ----------
    lag : float, optional
        Time constant of the answer [s]; 0 for a finger that follows at once.
    delay : float, optional
        Time before a command has any effect [s].

    Raises
    ------
    ValueError
        If a time is negative or not finite.
    """

    def __init__(self, lag: float = 0.0, delay: float = 0.0) -> None:
        for name, value in (('lag', lag), ('delay', delay)):
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a time of 0 or more [s], got {value}')
        self.lag = lag
        self.delay = delay
        self.reset(-math.inf)

    def reset(self, time: float, velocity: float = 0.0) -> None:
        """Start anew.

        Parameters
        ----------
        time : float
            When that is [s].
        velocity : float, optional
            Velocity that the finger has and goes on with until a command [m/s].
        """
        self._start = self._time = time  # from and up to which it has been followed
        self._velocity = self._wanted = velocity
        self._owed = 0.0  # way that was told of too little [m]
        self._commands: deque[tuple[float, float]] = deque()

    def command(self, time: float, velocity: float) -> None:
        """Take a command.

        Parameters
        ----------
        time : float
            When it was given [s], not before the one before it.
        velocity : float
            Velocity from then on [m/s]. If the finger has been followed further already, without
            this command, the next way makes up for the difference.
        """
        begin = time + self.delay
        if begin < self._time:
            # Answers add up: what is missing is the answer to the step between two commands.
            step = velocity - self._wanted
            way, gained = self._answer(self._time - begin)
            before, _ = self._answer(max(self._start - begin, 0.0))
            self._owed += step * (way - before)
            self._velocity += step * gained
            self._wanted = velocity
        else:
            self._commands.append((begin, velocity))

    def way(self, time: float) -> float:
        """Return how far the finger moves from the last moment asked for to a later one.

        Parameters
        ----------
        time : float
            The moment [s], not before the last one.

        Returns
        -------
        float
            The way [m].
        """
        way, self._owed = self._owed, 0.0
        while self._commands and self._commands[0][0] <= time:
            begin, velocity = self._commands.popleft()
            way += self._follow(begin)
            self._wanted = velocity
        return way + self._follow(time)

    def _answer(self, duration: float) -> tuple[float, float]:
        """Return way [s] and velocity of the answer to a step of 1, so long after it [s]."""
        share = 1.0 - math.exp(-duration / self.lag) if self.lag > 0.0 else 1.0
        return duration - self.lag * share, share

    def _follow(self, time: float) -> float:
        """Go on with the wanted velocity."""
        duration = time - self._time
        if not duration > 0.0:
            return 0.0
        self._time = time
        behind = self._velocity - self._wanted
        if self.lag > 0.0:
            decay = math.exp(-duration / self.lag)
            self._velocity = self._wanted + behind * decay
            return self._wanted * duration + behind * self.lag * (1.0 - decay)
        self._velocity = self._wanted
        return self._wanted * duration
