# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What wrenches show of the tip, before anybody knows where it is on the sensor."""

import math
from collections.abc import Sequence

import numpy as np

from tactile_push.calibration.steadiness import Sight
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError
from tactile_push.tactile.wrench_reader import LEAST_OF_A_TARE, NOT_FINITE, WrenchSensing

TURNED = 0.05  # by which the direction of a force visibly turns [rad]
SHIFTED = 0.001  # by which its line visibly shifts [m]
GROWN = 0.3  # change of the logarithm of its size


class WrenchSense:
    """Finds touches by their force, after a tare."""

    LEAST = LEAST_OF_A_TARE  #: wrenches of a touch
    LEAST_FREE = LEAST_OF_A_TARE  #: wrenches of the untouched tip
    FREE_TIME = WrenchSensing.tare_time  #: over which they are taken [s]
    HINT = 'press, and push sideways a little, each time to another side'  #: how to touch

    def take_free(self, values: Sequence[Sequence[float]]) -> None:
        """Tare.

        Parameters
        ----------
        values : sequence of sequence of float
            Wrenches of the untouched tip, shape (n, 6) [N, N m].

        Raises
        ------
        NotUntouchedError
            If they are not finite, or change too much.
        """
        wrenches = np.array(values)
        if not np.isfinite(wrenches).all():
            raise NotUntouchedError(f'a wrench is {NOT_FINITE}')
        spread = float(np.sqrt(wrenches[:, :3].var(axis=0).sum()))
        if spread > WrenchSensing.release_force:
            raise NotUntouchedError(
                f'the force varies by {spread:.2f} N; touch nothing, hold the finger still'
            )
        self._tare = wrenches.mean(axis=0)

    def sight(self, value: Sequence[float]) -> Sight:
        """Find whether a wrench is of a touch.

        Parameters
        ----------
        value : sequence of float
            Force and moment, shape (6,) [N, N m].

        Returns
        -------
        Sight
            The touch, or none.

        Raises
        ------
        ReadingRejectedError
            If it is not finite.
        """
        wrench = np.asarray(value) - self._tare
        if not np.isfinite(wrench).all():
            raise ReadingRejectedError(NOT_FINITE)
        size = math.hypot(*wrench[:3])
        unit = wrench / max(size, 1e-9)
        features = [*unit[:3] / TURNED, *unit[3:] / SHIFTED, math.log(max(size, 1e-9)) / GROWN]
        touched, free = size >= WrenchSensing.contact_force, size < WrenchSensing.release_force
        return Sight(touched, free, np.array(features))

    def words(self, values: Sequence[Sequence[float]]) -> str:
        """Say how strong a touch is.

        Parameters
        ----------
        values : sequence of sequence of float
            Its wrenches, shape (n, 6).

        Returns
        -------
        str
            For people.
        """
        force = np.mean(values, axis=0)[:3] - self._tare[:3]
        x, y, z = force + 0.0
        return f'felt {math.hypot(*force):.2f} N: x {x:.2f}, y {y:.2f}, z {z:.2f} N'
