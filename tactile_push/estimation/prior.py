# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is known of an object before it is pushed, and the hypotheses that stand for it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from tactile_push.estimation.unknowns import ALPHA, GROWTH, LOG_C, SHAPE, TILT, UNKNOWNS, D, L, R
from tactile_push.mechanics import check_friction
from tactile_push.mechanics.compiled import Array

D_SPACING = 6e-3  # of the hypotheses [m]
OVERLAP = 3.0  # spacing in standard deviations: side by side their density is nearly even
D_COUNTS = (4, 40)  # the fewest and the most along an edge
C_COUNT, ALPHA_COUNT = 3, 16  # how many share c and a finite friction
NONE, SOME, STICKS = range(3)  # kinds of friction: mu_c = 0, between, infinite
ROUND = (1.0, 0.0, 1.0)  # second moments of an area without preferred direction
NEAR_ONE = 1e-6
SLENDER = 1.5  # ratio of the principal second moments from which directions differ much
TILT_SHARE = 1.0 / 3.0  # standard deviation of the tilt, of the greatest one
SHARES = (0.25, 0.5, 0.25)  # of the kinds, before any data


@dataclass(frozen=True)
class Prior:
    """What is known of an object before it is pushed.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """

    d: tuple[float, float]  #: ends of the edge [m]; the same twice if d is known and stays so
    l: float  #: distance from the edge to the centre of mass [m]
    l_sigma: float = 0.0  #: standard deviation of `l` [m]; bounds hold within three of them
    c: tuple[float, float] = (0.005, 0.036)  #: least and most c [m]
    mu_c: tuple[float, float] = (0.0, math.inf)  #: least and most friction of finger and object
    moments: tuple[float, float, float] = ROUND  #: second moments of the object's area, see `Edge`
    #: greatest tilt, mu_s times the height of the push above the support [m]; the least is 0
    tilt: float = 0.0
    #: probability density over (d, c, mu_c), up to a factor; by default even over d, c and the
    #: angle of friction, with 0 and infinity as likely as half of what is between, each
    density: Callable[[float, float, float], float] | None = None

    def __post_init__(self) -> None:
        for name in ('d', 'c'):
            low, high = getattr(self, name)
            grow = low < high or (name == 'd' and low == high)
            if not (math.isfinite(low) and math.isfinite(high) and grow):
                raise ValueError(f'{name}: expected two lengths that grow [m], got {low}, {high}')
        if not self.c[0] > 0.0:
            raise ValueError(f'c: expected positive lengths [m], got {self.c}')
        if not (math.isfinite(self.l) and self.l > 0.0):
            raise ValueError(f'l: expected a positive length [m], got {self.l}')
        if not 0.0 <= 3.0 * self.l_sigma < self.l:
            raise ValueError(f'l_sigma: expected 0 to a third of l [m], got {self.l_sigma}')
        xx, xy, yy = self.moments
        if not (xx > 0.0 and abs(xx * yy - xy * xy - 1.0) < NEAR_ONE):
            raise ValueError(
                f'moments: expected a positive form of determinant 1, got {xx, xy, yy}'
            )
        if not (math.isfinite(self.tilt) and self.tilt >= 0.0):
            raise ValueError(f'tilt: expected a finite length of 0 or more [m], got {self.tilt}')
        for mu_c in self.mu_c:
            check_friction(mu_c)
        if not self.mu_c[0] <= self.mu_c[1]:
            raise ValueError(f'mu_c: expected the least friction first, got {self.mu_c}')

    @property
    def slenderness(self) -> float:
        """Ratio of the principal second moments, 1 or more."""
        half = (self.moments[0] + self.moments[2]) / 2.0
        return (half + math.sqrt(max(half * half - 1.0, 0.0))) ** 2


def friction(alpha: float) -> float:
    """Return the coefficient for an angle of friction."""
    return math.inf if alpha >= math.pi / 2.0 else max(0.0, math.tan(alpha))


def spread(
    prior: Prior,
    radius: tuple[float, float],
    growth: tuple[float, float],
    shape: tuple[float, float],
) -> tuple[Array, Array, npt.NDArray[np.int64], Array]:
    """Spread hypotheses over a prior: means, covariances, kinds of friction and weights, by kind.

    The finger's radius, growth and shape (`resistance`) are means and standard deviations. The
    shape of an area that has hardly a preferred direction is left out.
    """
    if prior.slenderness < SLENDER:
        shape = 0.0, 0.0
    few, many = D_COUNTS if prior.d[0] < prior.d[1] else (1, 1)
    count = min(max(math.ceil((prior.d[1] - prior.d[0]) / D_SPACING), few), many)
    d_edges = np.linspace(*prior.d, count + 1)
    c_edges = np.geomspace(*prior.c, C_COUNT + 1)
    least, most = map(math.atan, prior.mu_c)
    frictions = []  # angle, variance, kind, weight
    if prior.mu_c[0] == 0.0:
        frictions.append((0.0, 0.0, NONE, SHARES[NONE]))
    if least < most:
        # The smaller the friction, the more of the contact's way it decides on.
        edges = least + (most - least) * np.linspace(0.0, 1.0, ALPHA_COUNT + 1) ** 1.5
        for low, high in pairwise(edges.tolist()):
            share = SHARES[SOME] * (high - low) / (most - least)
            frictions.append(((low + high) / 2.0, (high - low) ** 2 / 12.0, SOME, share))
    elif 0.0 < prior.mu_c[0] < math.inf:
        frictions.append((least, 0.0, SOME, SHARES[SOME]))
    if math.isinf(prior.mu_c[1]):
        frictions.append((math.pi / 2.0, 0.0, STICKS, SHARES[STICKS]))
    means, covariances, kinds, weights = [], [], [], []
    for angle, variance, kind, share in frictions:
        for d_low, d_high in pairwise(d_edges):
            for c_low, c_high in pairwise(c_edges):
                mean = np.zeros(UNKNOWNS)
                mean[D], mean[LOG_C] = (d_low + d_high) / 2.0, math.log(c_low * c_high) / 2.0
                mean[ALPHA], mean[L] = angle, prior.l
                mean[R], mean[GROWTH], mean[SHAPE] = radius[0], growth[0], shape[0]
                mean[TILT] = prior.tilt / 2.0
                weight = share * (c_high - c_low)
                if prior.density is not None:
                    middle = math.exp(mean[LOG_C])
                    weight *= prior.density(mean[D], middle, friction(angle))
                means.append(mean)
                variances = np.zeros(UNKNOWNS)
                variances[D] = ((d_high - d_low) / OVERLAP) ** 2
                variances[LOG_C] = math.log(c_high / c_low) ** 2 / 12.0
                variances[ALPHA], variances[L] = variance, prior.l_sigma**2
                variances[R], variances[GROWTH] = radius[1] ** 2, growth[1] ** 2
                variances[SHAPE], variances[TILT] = shape[1] ** 2, (TILT_SHARE * prior.tilt) ** 2
                covariances.append(np.diag(variances))
                kinds.append(kind)
                weights.append(weight)
    total = np.array(weights)
    if not (np.isfinite(total).all() and (total >= 0.0).all() and total.any()):
        raise ValueError('density: expected numbers of 0 or more, not all 0')
    positive = total > 0.0
    return (
        np.array(means)[positive],
        np.array(covariances)[positive],
        np.array(kinds)[positive],
        total[positive] / total.sum(),
    )
