# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Trims theta_d until the object is carried straight ahead.

docs/theory.md, "The slow mode", says why that is needed, what it can do and what it cannot.
"""

import math
from dataclasses import dataclass

from tactile_push import paper

GAIN = 4.0  # by how much farther the object is turned back than it was carried aside; see docs
RATE = math.radians(1.0)  # fastest change of the trim [rad/s]; the law itself is slower


@dataclass
class Steadying:
    """Turns theta_d against the way that the object is carried across the belt.

    The object's point that lies 2 l from the edge hardly moves sideways when the object is turned,
    so its way tells translation from turning. The trim is proportional to this way. It begins when
    theta is first within `bound` of theta_d, and ends when the finger stops.
    """

    bound: float = 0.0  #: largest trim [rad]; 0 trims nothing
    l: float = paper.BLOCK_L  #: distance from the edge to the centre of mass [m]
    r: float = paper.FINGER_RADIUS  #: effective radius of the finger's disk [m]

    def __post_init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Take theta_d as it is, until theta is near it again."""
        self.trim = 0.0  #: what is added to theta_d [rad]
        self._wanted = 0.0
        self._begun = False
        self._far = math.nan

    def holds(self, turning: float) -> bool:
        """Return whether a trim can hold the object where the tip turns so fast.

        Parameters
        ----------
        turning : float
            By how much the tip turns for each metre across the belt, dpsi/dx [rad/m].

        Returns
        -------
        bool
            Whether the trim moves the contact by more than the tip rolls away, if c is no larger
            than l.
        """
        rolled = self.r * turning
        trimmed = GAIN / (1.0 + GAIN) * (1.0 - rolled) / (2.0 * self.l)  # by metre across the belt
        return trimmed * (self.l - self.r) + rolled > 0.0

    def follow(
        self, theta: float, theta_desired: float, x: float, psi: float, period: float
    ) -> float:
        """Trim theta_d by what has happened since the last reading.

        Parameters
        ----------
        theta, theta_desired : float
            Sensed angle of the edge, and the desired one without the trim [rad].
        x, psi : float
            Where the finger's disk is across the belt [m], and the angle of its pole [rad]. While
            one of them is NaN the trim stays.
        period : float
            Time since the last reading [s].

        Returns
        -------
        float
            The trim [rad].
        """
        if not self.bound > 0.0:
            self.reset()
            return self.trim
        reach = 2.0 * self.l
        before, self._far = self._far, x - self.r * psi - reach * math.sin(theta)
        self._begun |= abs(theta - theta_desired) <= self.bound
        aside = self._far - before
        if self._begun and math.isfinite(aside):
            self._wanted = _within(self.bound, self._wanted + GAIN * aside / reach)
        change = _within(RATE * period, self._wanted - self.trim)
        self.trim = _within(self.bound, self.trim + change)
        return self.trim


def _within(bound: float, value: float) -> float:
    return min(max(value, -bound), bound)
