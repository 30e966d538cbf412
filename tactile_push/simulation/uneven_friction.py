# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A pushed edge whose friction varies along it."""

import math
from dataclasses import dataclass

PIECES = 64  # of a ripple, in which friction counts as even: it changes by 0.1 of the ripple


@dataclass(frozen=True)
class UnevenFriction:
    """How mu_c varies around the object; by default not at all.

    Without friction there is nothing to vary, and infinite friction stays infinite.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """

    ripple: float = 0.0  #: amplitude of a sine in mu_c, relative to mu_c; below 1
    length: float = 0.005  #: wavelength along the path of the finger's disk around the object [m]

    def __post_init__(self) -> None:
        if not 0.0 <= self.ripple < 1.0:
            raise ValueError(f'ripple: expected a number from 0 to less than 1, got {self.ripple}')
        if not (math.isfinite(self.length) and self.length > 0.0):
            raise ValueError(f'length: expected a positive length [m], got {self.length}')

    def mu_c(self, mean: float, sigma: float) -> float:
        """Return the friction at a contact.

        Parameters
        ----------
        mean, sigma : float
            The mean coefficient of friction, 0 to infinity, and the position along the path of the
            finger's disk around the object [m].

        Returns
        -------
        float
            mu_c there.
        """
        return mean * (1.0 + self.ripple * math.sin(2.0 * math.pi * sigma / self.length))

    def even(self, speed: float) -> float:
        """Return for how long the friction is nearly the same.

        Parameters
        ----------
        speed : float
            Of the finger on the belt [m/s].

        Returns
        -------
        float
            Time in which the finger moves on by a small part of the wavelength [s].
        """
        if self.ripple == 0.0 or speed == 0.0:
            return math.inf
        return self.length / PIECES / speed
