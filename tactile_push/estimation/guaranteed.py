# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Guaranteed bounds: they hold as long as sensor and object stay within their own bounds."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.estimation.cells import (
    FACES,
    ROLLED_HIGH,
    ROLLED_LOW,
    THETA_HIGH,
    THETA_LOW,
    Bounds,
    Interval,
    cut_cells,
    hull,
    push_cells,
    split_cells,
)
from tactile_push.estimation.prior import Prior, friction
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.resistance import Push

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
        self._noise = bounds.noise
        slack = 3.0 * prior.l_sigma
        l = Interval(prior.l - slack, prior.l + slack)
        d, r = Interval(*prior.d), Interval(*radius)
        self._bounds = Bounds(d, l, r, theta, bounds.turn, bounds.cone, prior.tilt)
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
        d, c_squared, alpha = hull(self._cells[: self._count], self._bounds)
        c = [math.sqrt(square) for square in c_squared]
        return np.array([d, c, [friction(angle) for angle in alpha]])

    def push(self, v_x: float, v_y: float, duration: float, spin: float) -> None:
        """Move the cells on by a push [m/s, m/s, s, rad/s]."""
        parts = max(1, math.ceil(math.hypot(v_x, v_y) * duration / LONGEST_PART))
        push = Push(v_x, v_y, duration / parts, spin)
        for _ in range(parts):
            self._count = push_cells(self._cells[: self._count], push, self._bounds)
            theta_0 = self._bounds.theta_0 + push.duration * spin
            self._bounds = self._bounds._replace(theta_0=theta_0)

    def touch_again(self, way: float, turn: float, slip: float) -> None:
        """Go over to another contact on the same edge, to which the finger went by a way across.

        Before and after, the object may have turned and slipped unseen by so much [rad, m].
        """
        cells = self._cells[: self._count]
        cells[:, THETA_LOW] -= turn
        cells[:, THETA_HIGH] += turn
        low, high = cells[:, THETA_LOW], cells[:, THETA_HIGH]
        # Along the edge it is way / cos(theta), which is least where theta is nearest to 0.
        nearest, farthest = np.clip(0.0, low, high), np.maximum(np.abs(low), np.abs(high))
        ways = np.sort([way / np.cos(nearest), way / np.cos(farthest)], axis=0)
        cells[:, ROLLED_LOW] += ways[0] - slip
        cells[:, ROLLED_HIGH] += ways[1] + slip

    def read(self, theta: float) -> None:
        """Cut off what a reading of theta [rad] excludes."""
        low, high = theta - self._noise, theta + self._noise
        self._count = cut_cells(self._cells[: self._count], low, high)
        self._split()

    def _split(self) -> None:
        """Halve the cells while there is room."""
        while 0 < 2 * self._count <= CELLS:
            r, theta_0 = sum(self._bounds.r) / 2.0, self._bounds.theta_0
            self._count = split_cells(self._cells, self._count, self._prior.l, r, theta_0)
