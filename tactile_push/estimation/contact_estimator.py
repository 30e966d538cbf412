# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Where on the edge the finger is, from the first push on (Section III, and past it)."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.estimation import hypotheses
from tactile_push.estimation.guaranteed import GuaranteedSet, ModelBounds
from tactile_push.estimation.hypotheses import ALPHA, C_SQUARED, THETA, D, L
from tactile_push.estimation.mixture import quantile
from tactile_push.estimation.prior import NONE, SOME, STICKS, Prior, friction, spread
from tactile_push.mechanics.compiled import Array

WAY = 1e-3  # a longer push is taken in parts [m]
EXCLUDED = 0.05  # a kind of friction with that much of the best one's evidence is excluded
LOWER, UPPER = 0.025, 0.975
GONE = 16.0  # a hypothesis that is less likely than the best by exp(GONE) is given up
MEMORY = 20.0  # readings over which surprise is averaged
SURPRISE = 4.0  # mean of squared normalised errors, 1 on average, that contradicts the model
WRONG = 0.5  # share of outliers that does
FARTHEST = 25.0  # what one reading can add to the surprise


@dataclass(frozen=True)
class Quantity:
    """What is known of one number.

    Parameters
    ----------
    mean : float
        Its mean.
    lower, upper : float
        The 95 % interval.
    least, most : float
        Guaranteed bounds.
    """

    mean: float
    lower: float
    upper: float
    least: float
    most: float


@dataclass(frozen=True)
class Estimate:
    """What is known at the last reading.

    Parameters
    ----------
    d : Quantity
        Contact along the edge [m].
    c : Quantity
        Ratio m_max / f_max [m]: that of the ellipsoid which turns as the object does.
    mu_c : Quantity
        Friction between finger and object; its mean is that of the angle of friction.
    theta : float
        Angle of the edge, past the readings' noise [rad]; NaN before the first reading.
    covariance : ndarray, shape (3, 3)
        Covariance of theta, d and l [rad, m, m].
    l : float
        Distance from the edge to the centre of mass [m].
    surprise : float
        Mean square of the last readings' errors in units of what was expected, 1 on average.
    contradiction : str
        Why no number is to be believed; empty if data and model agree. All intervals are those
        before any data then.
    """

    d: Quantity
    c: Quantity
    mu_c: Quantity
    theta: float
    covariance: Array
    l: float
    surprise: float
    contradiction: str


class ContactEstimator:
    """Follows theta, and with it everything that it depends on.

    Each push tells something, not only those of a translating object: omega depends on d, c,
    mu_c and l. A bank of Gaussian hypotheses (`hypotheses`) gives the mean and the 95 % interval,
    cells moved by bounds (`cells`) give what is guaranteed. The object is the mechanics' own, with
    liberties, for its limit surface is no ellipsoid: turn and slip of each push scatter by a share
    of themselves, and c^2 + l^2, its resistance to turning, wanders as the contact moves on.

    mu_c is no chance variable, and an interval that is right on average over frictions would be
    wrong for one. The 95 % interval is therefore the hull of those for no friction, for some and
    for a contact that always sticks, as far as data do not exclude the kind.

    Deterministic: the same pushes give the same estimates.

    Parameters
    ----------
    prior : Prior
        What is known before.
    noise : float
        Standard deviation of the readings of theta [rad], positive.
    radius : float, optional
        Effective radius of the finger's disk [m].
    lag : float, optional
        Time constant by which the finger follows its command [s], if `push` gets commands; 0 if
        it gets what the finger does.
    outlier : float, optional
        Probability that a reading is wrong altogether.
    scatter : float, optional
        Standard deviation of a push's turn, as a share of it.
    slip_scatter : float, optional
        Standard deviation of a push's slip, as a share of it.
    drift : float, optional
        Standard deviation by which the resistance to turning changes in a push of a metre, as a
        share of it; it grows with the root of the way [1/sqrt(m)].
    bounds : ModelBounds, optional
        For what is guaranteed; by default noise up to five standard deviations and the bounds on
        the model that `ModelBounds` has.

    Attributes
    ----------
    log_evidence : float
        Logarithm of the probability density of all readings but the first: what tells which of
        several priors, for instance edges of an outline, fits best.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """

    def __init__(
        self,
        prior: Prior,
        noise: float,
        *,
        radius: float = 0.0135,
        lag: float = 0.0,
        outlier: float = 0.001,
        scatter: float = 0.1,
        slip_scatter: float = 0.5,
        drift: float = 0.2,
        bounds: ModelBounds | None = None,
    ) -> None:
        for name, value in (('noise', noise), ('radius', radius)):
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')
        numbers = {'lag': lag, 'scatter': scatter, 'slip_scatter': slip_scatter, 'drift': drift}
        for name, value in numbers.items():
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')
        if not 0.0 < outlier < 1.0:
            raise ValueError(f'outlier: expected a probability between 0 and 1, got {outlier}')
        self.prior = prior
        self.noise = noise
        self.radius = radius
        self.lag = lag
        self.outlier = outlier
        self.scatter = scatter
        self.slip_scatter = slip_scatter
        self.drift = drift
        self.bounds = bounds or ModelBounds(5.0 * noise)
        self.reset()

    def reset(self) -> None:
        """Forget everything but the prior, as when the finger has lost the object."""
        self._means, self._covariances, self._kinds, weights = spread(self.prior)
        self._log_weights = np.log(weights)
        self._kind_shares = np.maximum(np.bincount(self._kinds, weights, minlength=3), 1e-300)
        self._guaranteed: GuaranteedSet | None = None
        self._v_x = 0.0
        self._surprise = 1.0
        self._wrong = 0.0
        self.log_evidence = 0.0

    def push(self, theta: float, v_x: float, v_y: float, duration: float) -> Estimate:
        """Take a push and the reading at its end.

        Parameters
        ----------
        theta : float
            Reading of the edge's angle [rad]; NaN without one.
        v_x, v_y : float
            Mean velocity of the finger relative to the support since the last call [m/s]; with a
            `lag` v_x is what was commanded.
        duration : float
            Time since the last call [s]; 0 for a reading without a push, as the first one is.

        Returns
        -------
        Estimate
            What is known now.

        Raises
        ------
        ValueError
            If a velocity is not finite, or the duration negative or not finite.
        """
        if not (math.isfinite(v_x) and math.isfinite(v_y)):
            raise ValueError(f'v_x, v_y: expected finite velocities [m/s], got {v_x}, {v_y}')
        if not (math.isfinite(duration) and duration >= 0.0):
            raise ValueError(f'duration: expected a time of 0 or more [s], got {duration}')
        if self.lag > 0.0 and duration > 0.0:
            behind, passed = self._v_x - v_x, duration / self.lag
            self._v_x = v_x + behind * math.exp(-passed)
            v_x -= behind * math.expm1(-passed) / passed
        if self._guaranteed is not None:
            self._move(v_x, v_y, duration)
            self._guaranteed.push(v_x, v_y, duration)
        if math.isfinite(theta):
            if self._guaranteed is not None:
                self._read(theta, self._guaranteed)
            else:
                self._start(theta)
        return self.estimate()

    def estimate(self) -> Estimate:
        """Tell what is known.

        Returns
        -------
        Estimate
            The estimate; before any data, the prior.
        """
        prior, means, covariances = self.prior, self._means, self._covariances
        weights = np.exp(self._log_weights)
        evidence = np.bincount(self._kinds, weights, minlength=3) / self._kind_shares
        kinds = [kind for kind in (NONE, SOME, STICKS) if evidence[kind] > EXCLUDED * max(evidence)]
        mean = weights @ means
        offsets = means - mean
        covariance = np.einsum('h,hjk->jk', weights, covariances) + (offsets.T * weights) @ offsets
        c_squared = prior.c[0] ** 2, prior.c[1] ** 2
        known = bounds = np.array([prior.d, prior.c, prior.mu_c])
        contradiction = self._contradiction
        if self._guaranteed is not None and not contradiction:
            alpha = self._hull(weights, kinds, ALPHA, *map(math.atan, prior.mu_c))
            known = np.array(
                [
                    self._hull(weights, kinds, D, *prior.d),
                    np.sqrt(self._hull(weights, kinds, C_SQUARED, *c_squared)),
                    [friction(angle) for angle in alpha],
                ]
            )
            bounds = self._guaranteed.ranges()
        middles = (
            min(max(float(mean[D]), prior.d[0]), prior.d[1]),
            math.sqrt(min(max(mean[C_SQUARED], c_squared[0]), c_squared[1])),
            friction(mean[ALPHA]),
        )
        d, c, mu_c = (
            Quantity(middle, *map(float, interval), *map(float, bound))
            for middle, interval, bound in zip(middles, known, bounds, strict=True)
        )
        chosen = np.ix_((THETA, D, L), (THETA, D, L))
        return Estimate(
            d,
            c,
            mu_c,
            math.nan if self._guaranteed is None else float(mean[THETA]),
            covariance[chosen],
            float(mean[L]),
            self._surprise,
            contradiction,
        )

    @property
    def _contradiction(self) -> str:
        """Why data and model do not agree."""
        if self._wrong > WRONG:
            return 'the readings jump'
        if self._surprise > SURPRISE:
            return 'the object does not turn as one that is pushed here'
        if self._guaranteed is not None and self._guaranteed.empty:
            return 'no object within the bounds turns like this'
        return ''

    def _hull(
        self, weights: Array, kinds: list[int], which: int, low: float, high: float
    ) -> tuple[float, float]:
        """Give the hull of the 95 % intervals under each kind of friction, within bounds."""
        lower, upper = math.inf, -math.inf
        for kind in kinds:
            members = self._kinds == kind
            means = self._means[members, which]
            variances = self._covariances[members, which, which]
            lower = min(lower, quantile(weights[members], means, variances, LOWER))
            upper = max(upper, quantile(weights[members], means, variances, UPPER))
        return min(max(lower, low), high), max(min(upper, high), low)

    def _start(self, theta: float) -> None:
        """Take the first reading."""
        self._started = True
        self._means[:, THETA] = theta
        self._covariances[:, THETA, THETA] = self.noise**2
        self._guaranteed = GuaranteedSet(self.prior, self.bounds, self.radius, theta)

    def _move(self, v_x: float, v_y: float, duration: float) -> None:
        """Move the hypotheses on."""
        way = math.hypot(v_x, v_y) * duration
        prior, parts = self.prior, max(1, math.ceil(way / WAY))
        for _ in range(parts):
            hypotheses.predict(
                self._means,
                self._covariances,
                v_x,
                v_y,
                duration / parts,
                self.radius,
                prior.c[0] ** 2,
                prior.c[1] ** 2,
                self.scatter,
                self.slip_scatter,
                self.drift * math.sqrt(way / parts),
            )

    def _read(self, theta: float, guaranteed: GuaranteedSet) -> None:
        """Correct hypotheses and cells by a reading."""
        mean, variance = self._moments(THETA)
        error = (theta - mean) ** 2 / (variance + self.noise**2)
        density = hypotheses.correct(
            self._means,
            self._covariances,
            self._log_weights,
            theta,
            self.noise**2,
            self.outlier,
        )
        self.log_evidence += math.log(density)
        wrong = density <= 2.0 * self.outlier / math.pi  # rather an outlier than not
        self._wrong += (wrong - self._wrong) / MEMORY
        if not wrong:
            self._surprise += (min(error, FARTHEST) - self._surprise) / MEMORY
            guaranteed.read(theta)
        self._give_up()

    def _moments(self, which: int) -> tuple[float, float]:
        """Give mean and variance of one unknown over all hypotheses."""
        weights, means = np.exp(self._log_weights), self._means[:, which]
        mean = weights @ means
        variance = weights @ (self._covariances[:, which, which] + (means - mean) ** 2)
        return float(mean), float(variance)

    def _give_up(self) -> None:
        """Drop hypotheses that have become too unlikely, or whose contact has left the edge."""
        low, high = self.prior.d
        deviations = 3.0 * np.sqrt(self._covariances[:, D, D])
        beyond = (self._means[:, D] + deviations < low) | (self._means[:, D] - deviations > high)
        kept = ~beyond & (self._log_weights > self._log_weights.max() - GONE)
        if not kept.all() and kept.any():
            self._means = self._means[kept]
            self._covariances = self._covariances[kept]
            self._kinds = self._kinds[kept]
            self._log_weights = self._log_weights[kept]
            self._log_weights -= np.log(np.exp(self._log_weights).sum())
