# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where on the edge the finger is, from the first push on (Section III, and beyond it)."""

import math
from dataclasses import dataclass, replace

import numpy as np

from tactile_push.estimation.bank import Bank, Liberties
from tactile_push.estimation.contradictions import IMPOSSIBLE, Watch
from tactile_push.estimation.guaranteed import GuaranteedSet, ModelBounds
from tactile_push.estimation.prior import Prior, friction
from tactile_push.estimation.recent import Recent
from tactile_push.estimation.unknowns import (
    ALPHA,
    GROWTH,
    LOG_C,
    SHAPE,
    THETA,
    TILT,
    D,
    L,
    R,
)
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.resistance import Pressure
from tactile_push.paper import FINGER_RADIUS

OF_POSE = np.ix_((THETA, D, L, R), (THETA, D, L, R))  # rows and columns of a covariance
NOISE_BOUND = 5.0  # largest error of a reading for what is guaranteed, in its deviations
SLENDER_DRIFT, SLENDER_SKEW = 0.1, 0.15  # of the liberties, by the logarithm of the slenderness
ANY_THETA = math.pi**2 / 12.0  # variance of a theta of which nothing is known [rad^2]


@dataclass(frozen=True)
class Quantity:
    """What is known of one number."""

    mean: float  #: mean
    lower: float  #: lower end of the 95 % interval
    upper: float  #: upper end of the 95 % interval
    least: float  #: guaranteed lower bound
    most: float  #: guaranteed upper bound


@dataclass(frozen=True)
class Estimate:
    """What is known at the last reading; with a contradiction, the prior.

    `c` is that of the ellipsoid that turns as the object does when it hardly turns, in the middle
    between the directions of its motion.
    """

    d: Quantity  #: contact along the edge [m]
    c: Quantity  #: m_max / f_max [m], see above
    mu_c: Quantity  #: friction between finger and object; its mean is that of the friction angle
    theta: float  #: angle of the edge without the readings' noise [rad]; NaN before the first one
    covariance: Array  #: of theta, d, l and `radius` [rad, m, m, m], shape (4, 4)
    l: float  #: distance from the edge to the centre of mass [m]
    radius: float  #: radius of the finger's disk [m]
    surprise: float  #: mean square of the last readings' normalised errors, 1 on average
    contradiction: str  #: why to believe no number; empty otherwise
    pressure: Pressure  #: how the object resists its turning, of the means


class ContactEstimator:
    """Follows theta, and with it everything that it depends on (Section III, and beyond it).

    Every push is informative, not only those of a translating object: omega depends on d, c, mu_c
    and l. A bank of Gaussian hypotheses (`hypotheses`) gives the mean and the 95 % interval; cells
    moved by bounds (`cells`) give what is guaranteed. The model is the mechanics with liberties,
    because no real limit surface is an ellipsoid (`resistance`): c grows by an unknown share when
    the object turns, depends on the direction of motion by another, and wanders as the motion
    changes; turn and slip scatter.

    mu_c is fixed, not random: an interval that is right on average over frictions would be wrong
    for one of them. The 95 % interval is therefore the hull of those for no friction, for some
    friction and for a contact that always sticks, without the kinds that the data exclude.

    `log_evidence` is the logarithm of the probability density of all readings but the first: it
    shows which of several priors, for instance edges of an outline, fits best.

    Parameters
    ----------
    prior : Prior
        What is known before.
    noise : float
        Standard deviation of the readings of theta [rad], positive.
    radius : float, optional
        Effective radius of the finger's disk [m].
    radius_sigma : float, optional
        Its standard deviation [m]; the guaranteed bounds hold within three of them.
    outlier : float, optional
        Probability that a reading is wrong altogether.
    disk : bool, optional
        Whether the object is a disk about its centre of mass, whose radius is l.

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
        radius: float = FINGER_RADIUS,
        radius_sigma: float = 0.0,
        outlier: float = 0.001,
        disk: bool = False,
    ) -> None:
        for name, value in (('noise', noise), ('radius', radius)):
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')
        if not 0.0 <= 3.0 * radius_sigma < radius:
            raise ValueError(
                f'radius_sigma: expected 0 to a third of the radius [m], got {radius_sigma}'
            )
        if not 0.0 < outlier < 1.0:
            raise ValueError(f'outlier: expected a probability between 0 and 1, got {outlier}')
        if disk and prior.d != (0.0, 0.0):
            raise ValueError(f'disk: expected a prior whose d is 0, got {prior.d}')
        self.prior = prior
        self.noise = noise
        self.radius = radius
        self.radius_sigma = radius_sigma
        self.outlier = outlier
        self.bounds = _bounds(prior.slenderness, noise)
        self.disk = disk
        liberties = _liberties(prior.slenderness)
        self._bank = Bank(prior, (radius, radius_sigma), liberties, noise, outlier, disk)
        self.reset()
        mean, covariance = self._bank.moments()
        covariance[THETA] = covariance[:, THETA] = 0.0
        covariance[THETA, THETA] = ANY_THETA
        known = np.array([prior.d, prior.c, prior.mu_c])
        self._before = self._put_together(mean, covariance, known, known)

    def reset(self) -> None:
        """Forget everything but the prior, as when the finger has lost the object."""
        self._watch: Watch | None = None  # from the first reading on
        self._guaranteed: GuaranteedSet | None = None
        self.log_evidence = 0.0

    def push(
        self, theta: float, v_x: float, v_y: float, duration: float, spin: float = 0.0
    ) -> Estimate:
        """Take a push and the reading at its end.

        Parameters
        ----------
        theta : float
            Reading of the edge's angle [rad]; NaN without one.
        v_x, v_y : float
            Mean velocity of the disk's centre relative to the support since the last call [m/s].
        duration : float
            Time since the last call [s]; 0 for a reading without a push, as the first one is.
        spin : float, optional
            Mean angular velocity of the finger's disk since the last call [rad/s].

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
        if not math.isfinite(spin):
            raise ValueError(f'spin: expected a finite angular velocity [rad/s], got {spin}')
        if not (math.isfinite(duration) and duration >= 0.0):
            raise ValueError(f'duration: expected a time of 0 or more [s], got {duration}')
        if self._watch is not None:
            self._move(v_x, v_y, duration, spin)
        if math.isfinite(theta):
            self._theta = theta
            if self._watch is not None:
                self._read(theta, self._watch)
            else:
                self._start(theta)
        return self.estimate()

    def touch_again(self, theta: float, way: float, unfelt: float) -> Estimate:
        """Take the first reading of another contact on the same edge.

        The object lay still while the finger went there, so all that is known of it stays.

        Parameters
        ----------
        theta : float
            Reading of the edge's angle [rad].
        way : float
            How far the finger has gone across [m].
        unfelt : float
            How far it may have pushed before and after without a reading [m].

        Returns
        -------
        Estimate
            What is known now.
        """
        if self._watch is None:
            return self.push(theta, 0.0, 0.0, 0.0)
        if not self.contradiction:
            turn = 0.5 / self.prior.l * unfelt  # by (11) no object turns farther
            self._bank.touch_again(way, turn / math.sqrt(3.0))  # all less are as likely
            if self._guaranteed is not None:
                self._guaranteed.touch_again(way, turn, unfelt)
            self._watch = Watch(self.noise, self.outlier, self.prior.l, theta)
            self._recent = Recent(theta)
            self._way = 0.0
            self._read(theta, self._watch)
        self._theta = theta
        return self.estimate()

    @property
    def contradiction(self) -> str:
        """Why no number is to be believed; empty if data and model agree."""
        if self._watch is None:
            return ''
        return self._watch.reason or (IMPOSSIBLE if self.impossible else '')

    def reconsider(self) -> str:
        """Find out whether another contact on the edge explains a contradiction as well.

        It goes through the last readings again, which takes as long as so many pushes. After a
        contradiction only.

        Returns
        -------
        str
            Why no number is to be believed.
        """
        watch = self._watch
        if watch is not None and watch.doubtful:
            watch.compare(self._recent.gain(self._bank, watch.doubtful))
        return self.contradiction

    @property
    def impossible(self) -> bool:
        """Whether the data exclude everything within the bounds."""
        return self._guaranteed is not None and self._guaranteed.empty

    def estimate(self) -> Estimate:
        """Return what is known; before any data and after a contradiction, the prior.

        Returns
        -------
        Estimate
            The estimate.
        """
        if self._watch is None:
            return self._before
        if self.contradiction:
            return replace(self._before, theta=self._theta, contradiction=self.contradiction)
        prior, bank = self.prior, self._bank
        mean, covariance = bank.moments()
        alpha = bank.interval(ALPHA, *map(math.atan, prior.mu_c))
        known = np.array(
            [
                bank.interval(D, *prior.d),
                np.exp(bank.interval(LOG_C, *map(math.log, prior.c))),
                [friction(angle) for angle in alpha],
            ]
        )
        bounds = np.array([prior.d, prior.c, prior.mu_c])
        if self._guaranteed is not None:
            bounds = self._guaranteed.ranges()
        return self._put_together(mean, covariance, known, bounds)

    def _put_together(
        self, mean: Array, covariance: Array, known: Array, bounds: Array
    ) -> Estimate:
        """Put an estimate together from moments, intervals and bounds."""
        prior = self.prior
        middles = (
            min(max(float(mean[D]), prior.d[0]), prior.d[1]),
            min(max(math.exp(mean[LOG_C]), prior.c[0]), prior.c[1]),
            friction(mean[ALPHA]),
        )
        d, c, mu_c = (
            Quantity(middle, *map(float, interval), *map(float, bound))
            for middle, interval, bound in zip(middles, known, bounds, strict=True)
        )
        return Estimate(
            d,
            c,
            mu_c,
            float(mean[THETA]),
            covariance[OF_POSE],
            float(mean[L]),
            float(mean[R]),
            1.0 if self._watch is None else self._watch.surprise,
            '',
            Pressure(
                math.exp(2.0 * mean[LOG_C]),
                float(mean[GROWTH]),
                float(mean[SHAPE]),
                np.array(prior.moments),
                float(mean[TILT]),
            ),
        )

    def _start(self, theta: float) -> None:
        """Take the first reading."""
        prior = self.prior
        self._bank.start(theta)
        self._watch = Watch(self.noise, self.outlier, prior.l, theta)
        self._recent = Recent(theta)
        self._way = 0.0
        if not self.disk:
            slack = 3.0 * self.radius_sigma
            radii = self.radius - slack, self.radius + slack
            self._guaranteed = GuaranteedSet(prior, self.bounds, radii, theta)

    def _move(self, v_x: float, v_y: float, duration: float, spin: float) -> None:
        """Take a push."""
        if not self.contradiction:
            self._way += math.hypot(v_x, v_y) * duration
            self._bank.push(v_x, v_y, duration, spin)
            self._recent.push(v_x, v_y, duration, spin)
            if self._guaranteed is not None:
                self._guaranteed.push(v_x, v_y, duration, spin)

    def _read(self, theta: float, watch: Watch) -> None:
        """Take a reading that is not the first."""
        if self.contradiction:
            return
        mean, variance = self._bank.theta()
        error = (theta - mean) / math.sqrt(variance + self.noise**2)
        log_density = self._bank.read(theta)
        self.log_evidence += log_density
        self._recent.read(theta, log_density)
        watch.read(theta, self._way, error, log_density, self._bank.off)
        self._way = 0.0
        # What is rather an outlier than not has no bounds.
        if self._guaranteed is not None and log_density > watch.outlier:
            self._guaranteed.read(theta)


def _liberties(slenderness: float) -> Liberties:
    """Return the liberties of an object; a slender one's motion and force agree less."""
    liberties, log = Liberties(), math.log(slenderness)
    return replace(
        liberties,
        drift=math.hypot(liberties.drift, SLENDER_DRIFT * log),
        skew=math.hypot(liberties.skew, SLENDER_SKEW * log),
    )


def _bounds(slenderness: float, noise: float) -> ModelBounds:
    """Return the bounds of an object that resists turning by the direction of its motion.

    The ratio of most and least turn grows by the root of the slenderness.
    """
    bounds = ModelBounds(NOISE_BOUND * noise)
    turn = math.tanh(math.atanh(bounds.turn) + math.log(slenderness) / 4.0)
    return replace(bounds, turn=turn)
