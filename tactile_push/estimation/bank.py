# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bank of hypotheses: what they say together."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.estimation import hypotheses
from tactile_push.estimation.hypotheses import ModelErrors
from tactile_push.estimation.mixture import hull_of_intervals
from tactile_push.estimation.prior import Prior, spread
from tactile_push.estimation.unknowns import THETA, D, R
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.resistance import Push

LONGEST_PUSH = 1e-3  # of the hypotheses [m]: a longer one is taken in parts
HYPOTHESIS_GONE = 11.0  # one less likely than the best by exp(11), 6e4 times, is dropped


@dataclass(frozen=True)
class Liberties:
    """How far a real object may be from one with an ellipsoidal limit surface."""

    # Means and standard deviations. `growth` is how much c^2 grows while the object turns, as a
    # share of it (`resistance`): 0 on an ellipsoid, 1.9 to 2.9 under most pressures. `shape` is how
    # far c^2 depends on the direction of motion as the second moment of the outline's area does:
    # 0 on an ellipsoid, 1 under uniform pressure.
    growth: tuple[float, float] = (1.5, 1.2)
    shape: tuple[float, float] = (0.5, 0.5)
    # Standard deviations. `drift` is the change of ln(c) while the direction in which the contact
    # moves changes by 1 rad, or the turn per l of way does; it grows with the root of the change.
    # `scatter` is the share by which the turn over 5 mm of way differs. `skew` is the angle between
    # the force and the motion of the centre of mass over 5 mm of way, for a force at 45 degrees to
    # the normal and a turn of 1 rad per l [rad].
    drift: float = 0.04
    scatter: float = 0.013
    skew: float = 0.1

    def __post_init__(self) -> None:
        for name in ('drift', 'scatter', 'skew'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')
        for name in ('growth', 'shape'):
            mean, deviation = getattr(self, name)
            if not (math.isfinite(mean) and math.isfinite(deviation) and deviation >= 0.0):
                raise ValueError(
                    f'{name}: expected a mean and a standard deviation, got {mean}, {deviation}'
                )


class Bank:
    """A bank of hypotheses about one object; a share `off` of them has run off the edge."""

    def __init__(
        self,
        prior: Prior,
        radius: tuple[float, float],  # of the finger's disk, and its standard deviation [m]
        liberties: Liberties,
        noise: float,  # standard deviation of the readings [rad]
        outlier: float,  # probability that a reading is wrong altogether
        curved: bool,  # whether the object is a disk about its centre of mass
    ) -> None:
        self._prior = prior
        self._liberties = liberties
        self._noise = noise
        self._outlier = outlier
        self._curved = curved
        self._first = spread(prior, radius, liberties.growth, liberties.shape)
        self._moments = np.array(prior.moments)
        self.start(math.nan)

    def start(self, theta: float) -> None:
        """Begin, or begin anew, at the first reading of theta [rad]."""
        self._means, self._covariances, self._kinds, weights = (part.copy() for part in self._first)
        self._means[:, THETA] = theta
        self._covariances[:, THETA, THETA] = self._noise**2
        self._motions = np.full((len(weights), 2), math.nan)
        self._log_weights = np.log(weights)
        self._shares = np.maximum(np.bincount(self._kinds, weights, minlength=3), 1e-300)
        self.off = 0.0

    @property
    def weights(self) -> Array:
        """Weights of the hypotheses, whose sum is 1."""
        return np.exp(self._log_weights)

    def moments(self) -> tuple[Array, Array]:
        """Return mean and covariance of all unknowns, shapes (9,) and (9, 9)."""
        weights = self.weights
        mean = weights @ self._means
        offsets = self._means - mean
        within = np.tensordot(weights, self._covariances, 1)
        return mean, within + (offsets.T * weights) @ offsets

    def theta(self) -> tuple[float, float]:
        """Return mean and variance of theta [rad, rad^2]."""
        weights, means = self.weights, self._means[:, THETA]
        mean = float(weights @ means)
        return mean, float(weights @ (self._covariances[:, THETA, THETA] + (means - mean) ** 2))

    def interval(self, which: int, low: float, high: float) -> tuple[float, float]:
        """Return the hull of the 95 % intervals under each kind of friction, within bounds.

        Kinds whose evidence is far below the best one's are left out.
        """
        means, variances = self._means[:, which], self._covariances[:, which, which]
        lower, upper = hull_of_intervals(self.weights, means, variances, self._kinds, self._shares)
        return min(max(lower, low), high), max(min(upper, high), low)

    def push(self, v_x: float, v_y: float, duration: float, spin: float) -> None:
        """Move the hypotheses on by a push [m/s, m/s, s, rad/s]."""
        liberties = self._liberties
        parts = math.ceil(math.hypot(v_x, v_y) * duration / LONGEST_PUSH)
        errors = ModelErrors(liberties.scatter, liberties.skew, liberties.drift)
        for _ in range(parts):
            hypotheses.predict(
                *(self._means, self._covariances, self._motions, self._moments),
                *(Push(v_x, v_y, duration / parts, spin), errors, self._curved),
            )

    def read(self, theta: float) -> float:
        """Correct the hypotheses by a reading of theta [rad].

        Return the logarithm of the probability density of the reading and of the contact's being
        still on the edge [1/rad].
        """
        density = hypotheses.correct(
            self._means, self._covariances, self._log_weights, theta, self._noise**2, self._outlier
        )
        return math.log(density) + self._give_up()

    def touch_again(self, way: float, turn: float) -> None:
        """Go over to another contact on the same edge, to which the finger went by a way across.

        The object lay still meanwhile. Before and after, it may have turned unseen by an angle of
        the standard deviation `turn` [rad], with which the contact rolls.
        """
        theta, r = self._means[:, THETA], self._means[:, R]
        cos = np.cos(theta)
        slope = (way * np.sin(theta) / cos**2)[:, None]  # of the way along the edge, by theta
        self._means[:, D] += way / cos
        self._covariances[:, D, :] += slope * self._covariances[:, THETA, :]
        self._covariances[:, :, D] += slope * self._covariances[:, :, THETA]
        self._covariances[:, THETA, THETA] += turn**2
        self._covariances[:, THETA, D] -= r * turn**2
        self._covariances[:, D, THETA] -= r * turn**2
        self._covariances[:, D, D] += (r * turn) ** 2
        self._motions[:] = math.nan

    def _give_up(self) -> float:
        """Drop unlikely hypotheses and those off the edge; return the log of what stays on it."""
        low, high = self._prior.d
        deviations = 3.0 * np.sqrt(self._covariances[:, D, D])
        off = (self._means[:, D] + deviations < low) | (self._means[:, D] - deviations > high)
        share = float(self.weights[off].sum())
        self.off += (1.0 - self.off) * share
        kept = ~off & (self._log_weights > self._log_weights.max() - HYPOTHESIS_GONE)
        if not kept.all() and kept.any():
            self._means = self._means[kept]
            self._covariances = self._covariances[kept]
            self._motions = self._motions[kept]
            self._kinds = self._kinds[kept]
            self._log_weights = self._log_weights[kept]
            self._log_weights -= np.log(np.exp(self._log_weights).sum())
        return math.log(max(1.0 - share, self._outlier))
