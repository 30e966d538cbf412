# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A belt that does not run evenly."""

import math
from dataclasses import dataclass

from tactile_push.simulation.servo import FLAT


@dataclass(frozen=True)
class Belt:
    """How the belt runs; by default at its speed all the time.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """

    #: amplitude of the sine by which the speed goes up and down, relative to the speed; below 1,
    #: as the belt never runs backwards
    ripple: float = 0.0
    frequency: float = 1.0  #: of the ripple [Hz]
    stopped: bool = False  #: whether the belt stands

    def __post_init__(self) -> None:
        if not 0.0 <= self.ripple < 1.0:
            raise ValueError(f'ripple: expected a number from 0 to less than 1, got {self.ripple}')
        if not (math.isfinite(self.frequency) and self.frequency > 0.0):
            raise ValueError(f'frequency: expected a positive frequency [Hz], got {self.frequency}')

    def speed(self, nominal: float, time: float) -> float:
        """Return the belt's speed at a moment.

        Parameters
        ----------
        nominal, time : float
            Speed without a fault, v_y [m/s], and time [s].

        Returns
        -------
        float
            Speed [m/s].
        """
        if self.stopped:
            return 0.0
        return nominal * (1.0 + self.ripple * math.sin(2.0 * math.pi * self.frequency * time))

    def mean_speed(self, nominal: float, time: float, duration: float) -> float:
        """Return the belt's mean speed over a while.

        Parameters
        ----------
        nominal, time, duration : float
            Speed without a fault, v_y [m/s], when the while begins and how long it is [s].

        Returns
        -------
        float
            Way by time [m/s].
        """
        if self.stopped:
            return 0.0
        half = math.pi * self.frequency * duration
        if self.ripple == 0.0 or half == 0.0:
            return self.speed(nominal, time)
        # The integral of the sine, with its difference of cosines as a product.
        middle = math.sin(2.0 * math.pi * self.frequency * time + half)
        return nominal * (1.0 + self.ripple * middle * math.sin(half) / half)

    def straight(self, nominal: float) -> float:
        """Return for how long the finger's way on the belt is nearly straight.

        Parameters
        ----------
        nominal : float
            Speed without a fault, v_y [m/s].

        Returns
        -------
        float
            Time in which it bends by `FLAT` at the most [s].
        """
        rate = 2.0 * math.pi * self.frequency
        amplitude = self.ripple * nominal / rate  # of the way
        if self.stopped or amplitude <= FLAT:
            return math.inf
        return math.sqrt(8.0 * FLAT / amplitude) / rate
