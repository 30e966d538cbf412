# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Guaranteed bounds: they hold as long as sensor and object stay within their own bounds."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.estimation.cells import (
    ALPHA_HIGH,
    ALPHA_LOW,
    C_SQUARED_HIGH,
    C_SQUARED_LOW,
    FACES,
    ROLLED_HIGH,
    ROLLED_LOW,
    THETA_HIGH,
    THETA_LOW,
    Bounds,
    Interval,
    cut_cells,
    push_cells,
    split_cells,
)
from tactile_push.estimation.prior import Prior, friction
from tactile_push.estimation.resistance import Push
from tactile_push.mechanics.compiled import Array

LONGEST_PART = 5e-4  # of a push of the cells [m]: what ANGLE_SLACK and LENGTH_SLACK hold for
CELLS = 256


@dataclass(frozen=True)
class ModelBounds:
    """How far sensor and object may be from the model, for what is guaranteed."""

    noise: float  # largest error of a reading [rad]
    turn: float = 0.3  # how far omega may be from the ellipsoid's, as a share of it
    cone: float = math.radians(15.0)  # how far an edge of the motion cone may be from it [rad]

    def __post_init__(self) -> None:
        for name in ('noise', 'turn', 'cone'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')
        if not self.turn < 1.0:
            raise ValueError(f'turn: expected a share below 1, got {self.turn}')


class GuaranteedSet:
    """Everything about one object that cannot be excluded, as cells."""

    def __init__(
        self,
        prior: Prior,
        bounds: ModelBounds,
        radius: tuple[float, float],  # least and most radius of the finger's disk [m]
        theta: float,  # the first reading [rad]
    ) -> None:
        self._prior = prior
        self._bounds = bounds
        self._radius = radius
        self._theta = theta
        self._cells = np.zeros((CELLS, FACES))
        low, high = theta - bounds.noise, theta + bounds.noise
        rolled = radius[1] * bounds.noise
        self._cells[0] = (
            *(low, high, prior.d[0] - rolled, prior.d[1] + rolled),
            *(prior.c[0] ** 2, prior.c[1] ** 2, *map(math.atan, prior.mu_c)),
        )
        self._count = 1
        self._split()

    @property
    def empty(self) -> bool:
        """Whether everything is excluded: a bound does not hold."""
        return self._count == 0

    def ranges(self) -> Array:
        """Return least and most d [m], c [m], mu_c; the prior's if all is excluded."""
        prior = self._prior
        if self.empty:
            return np.array([prior.d, prior.c, prior.mu_c])
        cells = self._cells[: self._count]
        # How far it has rolled is greatest or least at the ends of both radius and turn.
        turns = cells[:, [THETA_LOW, THETA_HIGH]] - self._theta
        rolled = np.concatenate([radius * turns for radius in self._radius], axis=1)
        low = (cells[:, ROLLED_LOW] - rolled.max(axis=1)).min()
        high = (cells[:, ROLLED_HIGH] - rolled.min(axis=1)).max()
        return np.array(
            [
                [max(low, prior.d[0]), min(high, prior.d[1])],
                np.sqrt([cells[:, C_SQUARED_LOW].min(), cells[:, C_SQUARED_HIGH].max()]),
                [friction(cells[:, ALPHA_LOW].min()), friction(cells[:, ALPHA_HIGH].max())],
            ]
        )

    def push(self, v_x: float, v_y: float, duration: float) -> None:
        """Move the cells on by a push [m/s, m/s, s]."""
        prior, model = self._prior, self._bounds
        slack = 3.0 * prior.l_sigma
        l = Interval(prior.l - slack, prior.l + slack)
        d, r = Interval(*prior.d), Interval(*self._radius)
        bounds = Bounds(d, l, r, self._theta, model.turn, model.cone)
        parts = max(1, math.ceil(math.hypot(v_x, v_y) * duration / LONGEST_PART))
        push = Push(v_x, v_y, duration / parts)
        for _ in range(parts):
            self._count = push_cells(self._cells[: self._count], push, bounds)

    def read(self, theta: float) -> None:
        """Cut off what a reading of theta [rad] excludes."""
        noise = self._bounds.noise
        self._count = cut_cells(self._cells[: self._count], theta - noise, theta + noise)
        self._split()

    def _split(self) -> None:
        """Halve the cells while there is room."""
        while 0 < 2 * self._count <= CELLS:
            self._count = split_cells(
                self._cells, self._count, self._prior.l, sum(self._radius) / 2.0, self._theta
            )
