# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Least squares of measured pushes over the numbers of a model, with a robust loss.

The residuals are those of the final poses and of the force's directions, each kind by its own
width. An error far beyond it counts by its size, not by its square, so a few bad records hardly
move what is fitted.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from tactile_push.identification.covariance import (
    FINEST,
    deviations_with_noise_alone,
    robust_covariance,
    robust_loss,
    widths,
)
from tactile_push.identification.models import Model
from tactile_push.identification.predicting import Physics, errors_of, residuals
from tactile_push.identification.records import Pushes
from tactile_push.mechanics import Support
from tactile_push.mechanics.compiled import Array
from tactile_push.threads import on_all_cores

ROUNDS = 2  # of least squares, after each of which the widths are taken anew
LONGEST = 15  # evaluations in a round
NEARLY = 1e-3  # change of the cost over it, from which on a round is done
SMALL = 2e-3  # change of the numbers from which on it is done
IMPOSSIBLE = 1e3  # what the residuals are over their width where the object would tip over


@dataclass(frozen=True)
class Fit:
    """Numbers fitted to pushes."""

    numbers: Array  #: as the model has them
    physics: Physics  #: what they say
    values: dict[str, float]  #: the same by name, in SI units
    covariance: Array  #: of the values; the variance of one that the pushes leave open is infinite
    #: standard deviations that the values would have at least if errors were independent, normal
    #: and as wide as their median (Cramér and Rao)
    bound: dict[str, float]

    @property
    def open(self) -> list[str]:
        """Names of the values that the pushes leave open."""
        return [name for name, of in self.deviations.items() if math.isinf(of)]

    @property
    def deviations(self) -> dict[str, float]:
        """Standard deviations of the values."""
        variances = np.maximum(np.diag(self.covariance), 0.0)  # which rounding may pass
        return dict(zip(self.values, np.sqrt(variances).tolist(), strict=True))


class Fitter:
    """Fits a model to some of an object's pushes.

    `forces` says whether the directions of measured forces count.
    """

    def __init__(self, model: Model, pushes: Pushes, forces: bool = True) -> None:
        self._model, self._pushes, self._forces = model, pushes, forces
        self._length = Support.uniform(pushes.outline, 1).c  # weighs angles against positions
        with on_all_cores() as pool:
            starts = pool.map(lambda point: self._residual(point, pushes), model.starts)
            self._starts = list(starts)

    def fit(self, chosen: Sequence[int]) -> Fit:
        """Fit to the pushes with these indices."""
        pushes = self._pushes.of(chosen)
        found = [self._size(residual[chosen]) for residual in self._starts]
        best = int(np.argmin(found))
        point, residual = self._model.starts[best], self._starts[best][chosen]
        for _ in range(ROUNDS):
            point = self._round(point, pushes, widths(residual, self._length))
            residual = self._residual(point, pushes)
        return self.judged(point, chosen)

    def judged(self, point: Array, chosen: Sequence[int]) -> Fit:
        """Say how well the pushes with these indices tell the numbers at a point."""
        pushes = self._pushes.of(chosen)
        residual = self._residual(point, pushes)
        width = widths(residual, self._length)
        sides = self._sides(point)
        rates = self._rates(sides, pushes) / width[:, np.newaxis]
        scaled, priors = residual / width, np.array([one.prior for one in self._model.unknowns])
        physics = self._model.physics(point)
        slopes = self._slopes(sides)
        covariance = robust_covariance(scaled, rates, priors)
        told = np.flatnonzero(np.isfinite(np.diag(covariance)))
        some = np.ix_(told, told)
        covariance[some] = slopes[some] @ covariance[some] @ slopes[some].T
        bound = deviations_with_noise_alone(rates, slopes)
        values = self._model.values(physics)
        names = dict(zip(values, bound.tolist(), strict=True))
        return Fit(point, physics, values, covariance, names)

    def _residual(self, point: Array, pushes: Pushes) -> Array:
        """Return the residuals; not finite in all of them where the object would tip over."""
        try:
            physics = self._model.physics(point)
        except ValueError:
            return np.full((len(pushes.pushes), 4), np.inf)
        return residuals(pushes, physics, self._forces)

    def _size(self, residual: Array) -> float:
        """Return the mean size of residuals [m]."""
        errors = errors_of(residual)
        turned = errors.angle + np.nan_to_num(errors.force)
        return float((errors.position + self._length * turned).mean())

    def _round(self, start: Array, pushes: Pushes, width: Array) -> Array:
        """Return the numbers with the least loss, from a start."""
        unknowns = self._model.unknowns
        priors = np.array([one.prior for one in unknowns])
        bounds = [one.lower for one in unknowns], [one.upper for one in unknowns]

        def all_residuals(point: Array) -> Array:
            scaled = np.nan_to_num(self._residual(point, pushes) / width, posinf=IMPOSSIBLE)
            return np.concatenate([scaled.ravel(), point / priors])

        def rates(point: Array) -> Array:
            scaled = self._rates(self._sides(point), pushes) / width[:, np.newaxis]
            return np.concatenate([scaled.reshape(-1, len(point)), np.diag(1.0 / priors)])

        data = 4 * len(pushes.pushes)
        done = least_squares(
            all_residuals,
            np.clip(start, *bounds),
            rates,
            bounds,
            loss=lambda squares: robust_loss(squares, data),
            xtol=SMALL,
            ftol=NEARLY,
            max_nfev=LONGEST,
        )
        return np.asarray(done.x, np.float64)

    def _sides(self, point: Array) -> list[tuple[float, Physics]]:
        """Return what is a step below and above in each number, within the bounds.

        The step is shorter, or none, where the object would tip over.
        """
        sides = []
        for i, one in enumerate(self._model.unknowns):
            for side in (-one.step, one.step):
                for step in (side, side / 8.0, 0.0):
                    moved = point.copy()
                    moved[i] = min(max(point[i] + step, one.lower), one.upper)
                    try:
                        physics = self._model.physics(moved)
                    except ValueError:
                        continue
                    sides.append((float(moved[i]), physics))
                    break
        return sides

    def _rates(self, sides: list[tuple[float, Physics]], pushes: Pushes) -> Array:
        """Return the derivatives of the residuals by the numbers, shape (N, 4, numbers)."""
        with on_all_cores() as pool:
            found = pool.map(lambda side: residuals(pushes, side[1], self._forces), sides)
            change = _by_pairs(sides, list(found))
        change[:, 2:] -= math.tau * np.round(change[:, 2:] / math.tau)
        return np.nan_to_num(change / _ways(sides))

    def _slopes(self, sides: list[tuple[float, Physics]]) -> Array:
        """Return the derivatives of the values by the numbers."""
        values = [np.array([*self._model.values(physics).values()]) for _, physics in sides]
        slopes: Array = _by_pairs(sides, values) / _ways(sides)
        return slopes


def _by_pairs(sides: list[tuple[float, Physics]], found: list[Array]) -> Array:
    """Return by how much what is found above is more than what is found below."""
    pairs = range(0, len(sides), 2)
    return np.stack([found[k + 1] - found[k] for k in pairs], axis=-1)


def _ways(sides: list[tuple[float, Physics]]) -> Array:
    """Return by how much each number is more above than below."""
    ways = np.diff(np.array([number for number, _ in sides]).reshape(-1, 2), axis=1)[:, 0]
    return np.maximum(ways, FINEST)
