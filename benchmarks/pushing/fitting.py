# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers fitted on one half of a file's pushes for the other."""

import math
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from pushing.predicting import Errors, Physics, predict
from pushing.records import Pushes
from tactile_push.mechanics import ExactLimitSurface, Support
from tactile_push.mechanics.spread import largest_spread

POINTS = 200  # that stand for the support
SPREADS = np.arange(0.6, 3.01, 0.4)  # from close to the centroid to the corners
FRICTIONS = np.arange(0.05, 0.451, 0.1)
KNOWN_FRICTIONS = np.arange(0.3, 0.601, 0.05)  # of pushes on a known support
TILTS = np.arange(0.0, 9e-3, 1e-3)  # [m]
REFINEMENTS = 3  # each halves the steps of the grid around the best point
HOME = 0.1  # standard deviation of the centre of friction from the centroid [c, uniform]

Point = tuple[float, float, float, float]  # spread, mu_c, centre of friction off home (x, y) [m]


class Fitted(NamedTuple):
    """What was fitted on either half of the pushes, every second one, for the other half."""

    errors: Errors
    halves: tuple[Physics, Physics]

    @classmethod
    def crosswise(cls, pushes: Pushes, halves: tuple[Physics, Physics]) -> 'Fitted':
        """Predict every push by what is fitted on pushes that it is none of."""
        position, angle = crossed(halves, lambda physics: predict(pushes, physics))
        return cls(Errors(position, angle), halves)


def crossed(
    halves: tuple[Physics, Physics], of: Callable[[Physics], Iterable[np.ndarray]]
) -> list[np.ndarray]:
    """Take what is found for every push from the numbers of the half that it is not in."""
    first, second = map(of, halves)
    return [np.where(np.arange(len(a)) % 2 == 0, b, a) for a, b in zip(first, second, strict=True)]


class Search:
    """Losses of a file's pushes for spread, mu_c and a place of the centre of friction."""

    def __init__(self, pushes: Pushes, advance: Callable[[], None]) -> None:
        self.pushes, self.advance = pushes, advance
        self.even = Support.uniform(pushes.outline, POINTS)
        self.length = self.even.c  # weighs angles against positions
        self.most = largest_spread(pushes.outline)
        self.half = np.arange(len(pushes.ways)) % 2
        self.known: dict[Point, np.ndarray] = {}

    def physics(self, point: Point) -> Physics:
        """Return what a point says; a centre of friction off home is a tilted pressure."""
        spread, mu_c, x, y = point
        support = Support.spread(self.pushes.outline, spread, POINTS)
        if x or y:
            support = support.carrying((support.centre[0] + x, support.centre[1] + y))
        return Physics(support, mu_c, spread=spread)

    def losses(self, point: Point) -> np.ndarray:
        """Return the losses of all pushes [m]; endless where nothing bears the object."""
        try:
            physics = self.physics(point)
        except ValueError:  # the object would tip over
            return np.full(len(self.half), math.inf)
        errors = predict(self.pushes, physics)
        return errors.position + self.length * errors.angle

    def best(self, points: list[Point], fold: int, weight: float = 0.0) -> tuple[Point, float]:
        """Return the point with the least loss of a half and of the prior, and this loss."""
        new = [point for point in dict.fromkeys(points) if point not in self.known]
        with ThreadPoolExecutor() as pool:
            self.known |= zip(new, pool.map(self.losses, new), strict=True)
        self.advance()
        found = [
            self.known[point][self.half == fold].mean()
            + weight * math.hypot(*point[2:]) ** 2 / (HOME * self.length) ** 2 / 2.0
            for point in points
        ]
        return points[int(np.argmin(found))], float(min(found))

    def around(self, point: Point, steps: npt.NDArray[np.float64]) -> list[Point]:
        """Return points one step away in every direction, and the point itself."""
        signs = product(*((-1, 0, 1) if step > 0.0 else (0,) for step in steps))
        return [self.allowed(np.add(point, sign * steps)) for sign in signs]

    def allowed(self, numbers: npt.NDArray[np.float64]) -> Point:
        """Return the point with these numbers, or the nearest that has a meaning."""
        spread, mu_c, x, y = numbers.tolist()
        spread, mu_c = min(max(spread, 0.1), self.most), max(mu_c, 0.0)
        return round(spread, 6), round(mu_c, 6), round(x, 7), round(y, 7)

    def point(self, physics: Physics) -> Point:
        """Return the point that says this, see `physics`."""
        x, y = np.subtract(physics.support.centre, self.even.centre)
        return physics.spread, physics.mu_c, float(x), float(y)


def fit(search: Search) -> tuple[Fitted, Fitted]:
    """Fit spread and mu_c, and then where the centre of friction is, too."""
    pushes = search.pushes
    spreads = np.unique(np.minimum(SPREADS, search.most)).round(6)
    grid = [(float(spread), float(mu_c), 0.0, 0.0) for spread, mu_c in product(spreads, FRICTIONS)]
    scalars = np.array([SPREADS[1] - SPREADS[0], FRICTIONS[1] - FRICTIONS[0], 0.0, 0.0])
    offset = np.array([0.0, 0.0, 1.0, 1.0]) * HOME * search.length
    two, four = [], []
    for fold in (0, 1):
        point, loss = search.best(grid, fold)
        for k in range(REFINEMENTS):
            point, loss = search.best(search.around(point, scalars / 2.0 ** (k + 1)), fold)
        two.append(search.physics(point))
        # The errors are taken as Laplace's, whose width is their mean.
        weight = loss / np.count_nonzero(search.half == fold)
        for k in range(REFINEMENTS):
            for steps in (offset / 2.0**k, scalars / 2.0 ** (k + 1)):
                point, _ = search.best(search.around(point, steps), fold, weight)
        four.append(search.physics(point))
    return (
        Fitted.crosswise(pushes, (two[0], two[1])),
        Fitted.crosswise(pushes, (four[0], four[1])),
    )


ROUNDS = 2 * (1 + 3 * REFINEMENTS)  # of a fit


def fit_known(pushes: Pushes, support: Support, tilts: npt.NDArray[np.float64]) -> Fitted:
    """Fit mu_c and the tilt of a push above a known support."""
    most = ExactLimitSurface(support).largest_tilt
    grid = [
        Physics(support, float(mu_c), float(tilt))
        for mu_c, tilt in product(KNOWN_FRICTIONS, tilts[tilts <= most])
    ]
    with ThreadPoolExecutor() as pool:
        errors = list(pool.map(lambda physics: predict(pushes, physics), grid))
    half = np.arange(len(pushes.ways)) % 2
    losses = np.array([error.position + support.c * error.angle for error in errors])
    first, second = (grid[int(np.argmin(losses[:, half == k].mean(axis=1)))] for k in (0, 1))
    return Fitted.crosswise(pushes, (first, second))
