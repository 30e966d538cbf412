# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The last pushes and readings, and how likely they are if nothing is known before them."""

from collections import deque

from tactile_push.estimation.bank import Bank

REMEMBERED = 150  # readings


class Recent:
    """Remembers the last readings and the pushes between them, from a first reading on."""

    def __init__(self, theta: float) -> None:
        self._pushes: list[tuple[float, float, float, float]] = []  # since the last reading
        self._taken = deque([(self._pushes, theta, 0.0)], REMEMBERED)

    def push(self, v_x: float, v_y: float, duration: float, spin: float) -> None:
        """Remember a push [m/s, m/s, s, rad/s]."""
        self._pushes.append((v_x, v_y, duration, spin))

    def read(self, theta: float, log_density: float) -> None:
        """Remember a reading [rad] and the logarithm of its probability density [1/rad]."""
        self._taken.append((self._pushes, theta, log_density))
        self._pushes = []

    def gain(self, bank: Bank, readings: int) -> float:
        """Return how much likelier the last readings are if the bank begins anew before them.

        It is the logarithm of the ratio. The bank remains as it is after these readings.
        """
        (_, theta, _), *taken = list(self._taken)[-readings - 1 :]
        bank.start(theta)
        gain = 0.0
        for pushes, theta, log_density in taken:
            for push in pushes:
                bank.push(*push)
            gain += bank.read(theta) - log_density
        return gain
