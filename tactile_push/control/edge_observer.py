# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Follows a pushed edge from its readings and the finger's way: theta, d and c.

A Kalman filter on equations (9) to (11) and (16) of a contact that sticks. It takes a tenth of a
millisecond and knows neither friction nor outline: it serves a law that corrects itself. To find
out where the finger is on an object there is `tactile_push.estimation`.
"""

import math

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

NOISE = math.radians(0.3)  # standard deviation of a reading; picked
# What is believed at first: that d is 0 and c^2 half of l^2, with these standard deviations, of d
# as a share of l. A block's c is between 0.2 l, on a small patch, and 1.5 l, on its corners.
D_SPREAD, LOG_SPREAD, HALF = 0.5, 1.0, math.log(0.5)
LEAST_LOG, MOST_LOG = 2.0 * math.log(0.2), 2.0 * math.log(1.5)
LARGEST_D = 1.5  # as a share of l
# How far the model is wrong, as standard deviations; picked. Of a turn, as a share of it; of d over
# a millimetre of belt [m], where the force is nearly normal to the edge, and what is added where it
# is along the edge and the contact may slip; of ln c^2 over a turn of 1 rad.
TURN_ERROR, ROLLING, SLIPPING, SOFTENING = 0.05, 2e-5, 3e-4, 0.1
MILLIMETRE = 1e-3
FAR_OFF = 4.0  # deviations beyond which a reading pulls no more: it is an outlier


class EdgeObserver:
    """Believes what the readings of an edge tell of theta, d and c.

    Parameters
    ----------
    l, r : float
        Distance from the edge to the centre of mass, and effective radius of the finger's disk [m].
    theta : float
        First reading [rad].
    """

    def __init__(self, l: float, r: float, theta: float) -> None:
        self._l, self._r = l, r
        self._round = 2.0 * math.log(l)  # ln c^2 of an object with c = l
        self._mean: Array = np.array((theta, 0.0, self._round + HALF))
        self._covariance: Array = np.diag((NOISE, D_SPREAD * l, LOG_SPREAD)) ** 2

    @property
    def theta(self) -> float:
        """Angle of the edge [rad]."""
        return float(self._mean[0])

    @property
    def d(self) -> float:
        """Contact along the edge [m]."""
        return float(self._mean[1])

    @property
    def c_squared(self) -> float:
        """Square of the ratio m_max / f_max [m^2]."""
        return math.exp(self._mean[2])

    @property
    def d_variance(self) -> float:
        """Variance of d [m^2]."""
        return float(self._covariance[1, 1])

    def follow(self, theta: float, way: float, turn: float, belt: float) -> None:
        """Take a reading.

        Parameters
        ----------
        theta : float
            The reading [rad].
        way, turn, belt : float
            By how much the finger's disk has moved across the belt [m], the tip has turned [rad]
            and the belt has moved [m] since the last reading.
        """
        self._predict(way, turn, belt)
        mean, covariance = self._mean, self._covariance
        spread = math.sqrt(covariance[0, 0] + NOISE**2)
        gain = covariance[:, 0] / spread**2
        most = FAR_OFF * spread
        mean = mean + gain * min(max(theta - mean[0], -most), most)
        bound, middle = LARGEST_D * self._l, self._round
        mean[1] = min(max(mean[1], -bound), bound)
        mean[2] = min(max(mean[2], middle + LEAST_LOG), middle + MOST_LOG)
        self._mean, self._covariance = mean, covariance - np.outer(gain, covariance[0])

    def _predict(self, way: float, turn: float, belt: float) -> None:
        """Move on by a push."""
        l, r = self._l, self._r
        theta, d, log_c = map(float, self._mean)
        c_squared = math.exp(log_c)
        resisting = c_squared + d * d + l * l
        turned = 0.0
        for _ in range(2):  # the second time with the angle in the middle
            cos, sin = math.cos(theta + turned / 2.0), math.sin(theta + turned / 2.0)
            x, y = way - r * turn * cos, belt - r * turn * sin  # of the tip's surface
            along, across = cos * x + sin * y, cos * y - sin * x
            turned = (d * across + l * along) / resisting  # (9) to (11)
        by_theta = (l * across - d * along) / resisting
        by_d = (across - 2.0 * d * turned) / resisting
        by_c = -c_squared * turned / resisting
        slopes = np.array((by_theta, by_d, by_c))
        moved = np.eye(3)
        moved[0] += slopes
        moved[1] -= r * slopes
        self._mean = np.array((theta + turned, d + r * (turn - turned), log_c))  # (16)
        # The force acts as the centre of mass moves.
        aside, forward = along - l * turned, across - d * turned
        steep = abs(math.sin(math.atan2(aside, max(forward, 0.0))))
        errors = (
            (TURN_ERROR * turned) ** 2,
            (ROLLING**2 + (SLIPPING * steep * steep) ** 2) * belt / MILLIMETRE,
            SOFTENING**2 * abs(turned),
        )
        self._covariance = moved @ self._covariance @ moved.T + np.diag(errors)
