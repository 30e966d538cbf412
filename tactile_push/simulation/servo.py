# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A finger that does not follow its command perfectly (Section V.D): delay, steps, lag, limits."""

import math
from collections import deque
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from tactile_push.mechanics.compiled import equation

T = TypeVar('T', float, tuple[float, ...])

FLAT = 1e-6  # how far a path may bend away from its straight pushes [m]; no sensor sees that
FOLLOWED = 1e-9  # a velocity so near to its command has reached it [m/s]


@dataclass(frozen=True)
class Servo:
    """How the finger follows its commands; by default perfectly.

    A velocity that arrives after the delay is rounded to whole quanta and then followed by a lag of
    first order.

    Raises
    ------
    ValueError
        If a number is negative or not finite.
    """

    time_constant: float = 0.0  #: of the lag [s], after which 63 % of a step of the command is made
    delay: float = 0.0  #: between a command and its first effect [s]
    velocity_quantum: float = 0.0  #: velocities are whole multiples of it [m/s]; 0 for any
    lift_delay: float = 0.0  #: from the word to lift until the object is free [s]

    def __post_init__(self) -> None:
        for name in ('time_constant', 'delay', 'velocity_quantum', 'lift_delay'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')


@dataclass(frozen=True)
class Workspace:
    """Where the centre of the finger's disk may be across the belt; by default anywhere.

    Raises
    ------
    ValueError
        If there is no place between the bounds.
    """

    lower: float = -math.inf  #: least x in `finger_base` [m]
    upper: float = math.inf  #: greatest x in `finger_base` [m]

    def __post_init__(self) -> None:
        if not self.lower < self.upper:
            raise ValueError(
                f'workspace: expected a lower bound below the upper one, got {self.lower} and '
                f'{self.upper} m'
            )

    def time_inside(self, x: float, v_x: float, duration: float) -> float:
        """Return how long a finger stays inside.

        Parameters
        ----------
        x, v_x, duration : float
            Where it is [m], its velocity [m/s] and how long it moves [s]; from beyond a bound it
            may go back.

        Returns
        -------
        float
            Time until it is at a bound that it moves to, at most `duration` [s].
        """
        if v_x > 0.0 and x + v_x * duration > self.upper:
            return max(0.0, self.upper - x) / v_x
        if v_x < 0.0 and x + v_x * duration < self.lower:
            return max(0.0, x - self.lower) / -v_x
        return duration


class DelayLine(Generic[T]):
    """Commands on their way to the finger. It may be made longer or shorter at any time."""

    def __init__(self, rest: T) -> None:
        # Since when, and the velocity.
        self._commands: deque[tuple[float, T]] = deque([(-math.inf, rest)])

    def arriving(
        self, command: T, start: float, duration: float, delay: float
    ) -> list[tuple[T, float]]:
        """Send a command; return the velocities that arrive meanwhile and for how long [m/s, s]."""
        commands = self._commands
        if command != commands[-1][1]:
            commands.append((start, command))
        while len(commands) > 1 and commands[1][0] + delay <= start:
            commands.popleft()
        arrived = []
        left = duration
        for (_, velocity), (since, _) in zip(commands, list(commands)[1:], strict=False):
            length = since + delay - (start + duration - left)
            if length >= left:
                arrived.append((velocity, left))
                return arrived
            arrived.append((velocity, length))
            left -= length
        arrived.append((commands[-1][1], left))
        return arrived


@equation
def quantised(velocity: float, quantum: float) -> float:
    """Round a velocity to whole quanta."""
    return quantum * np.rint(velocity / quantum) if quantum > 0.0 else velocity


@equation
def lagged(
    velocity: float, command: float, time_constant: float, duration: float
) -> tuple[float, float, float]:
    """Follow a command as a lag of first order does, for as long as the way is nearly straight.

    time_constant v' = command - v, hence an exponential, whose integral is the way: exact over any
    time. The time is cut where the way that goes with it on the moving belt would bend by `FLAT`.
    """
    behind = velocity - command
    if time_constant == 0.0 or abs(behind) <= FOLLOWED:
        return duration, command, command
    elapsed = duration
    if abs(behind) * time_constant > FLAT:
        # The sagitta of an arc whose slope changes by behind elapsed / time_constant.
        elapsed = min(duration, math.sqrt(8.0 * FLAT * time_constant / abs(behind)))
    gone = -math.expm1(-elapsed / time_constant)
    mean = command + behind * gone * time_constant / elapsed
    return elapsed, mean, command + behind * (1.0 - gone)
