# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's way, which the commands tell at once and the joints tell truly."""

import math

CATCH_UP = 0.5  # time constant with which the joints correct the commands [s]; five control periods
# Commands and joints may differ by so much before the joints are not believed [m]. Joints that
# stand still reach it at a speed of 3 mm/s. They are believed again below a quarter of it.
DIFFERENCE = 1.5e-3


class JointWay:
    """Corrects the way that follows from the commands by where the joints say the finger is.

    A finger may follow its commands too far, or with another point than it was told. The joints
    know. Their noise would spoil a way as short as that between two readings, so each correction is
    a part of what is missing, and none adds up.

    Attributes
    ----------
    doubted : bool
        Whether the joints tell of another motion than any that the commands could lead to.
    """

    def __init__(self) -> None:
        self.doubted = False
        self.reset(math.nan)

    def reset(self, x: float) -> None:
        """Start anew at a place [m]; NaN if the joints do not tell it."""
        self._x = x
        self._missing = 0.0  # from the way that was told [m]

    def corrected(self, way: float, x: float, duration: float) -> float:
        """Return the way to a place.

        Parameters
        ----------
        way : float
            Way since the last place according to the commands [m].
        x : float
            Where the joints say that the finger is [m]; NaN if they do not.
        duration : float
            Time since the last place [s].

        Returns
        -------
        float
            The way [m].
        """
        moved = x - self._x
        self._x = x
        if math.isnan(moved):
            return way
        self._missing += moved - way
        self.doubted = abs(self._missing) > (DIFFERENCE / 4.0 if self.doubted else DIFFERENCE)
        correction = self._missing * -math.expm1(-duration / CATCH_UP)
        self._missing -= correction
        return way + correction
