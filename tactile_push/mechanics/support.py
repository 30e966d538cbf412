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
"""Support of an object: where it rests, and so its m_max and f_max, eqs. (1) and (2).

A load is the greatest friction that a point of the support can give, mu_s times the normal force
there. Where mu_s or the pressure is uneven, the centre of friction, the loads' mean position, takes
the place of the centre of mass. All integrals over the outline's area are turned into integrals
along its boundary b: with the origin at the centre, the integral of |x| is that of |b| b x db / 3.
"""

import math
import reprlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.outline import Outline

COUNT = 400
GAUSS = 16  # nodes on every eighth of a turn of an arc
SUBCELLS = 16
DENSITY_CHANGE = 1e-9  # relative change at which an integral has converged
DENSITY_LIMIT = 3e-3  # and the one that must be reached, as with a step in the density
DENSITY_NODES = (8, 16, 32, 64, 128, 256, 512)


@dataclass(frozen=True, eq=False)
class Support:
    """Loads on the ground.

    Made by `at_points`, `corners`, `rim`, `uniform`, `circle`, `radial` or `density`.

    Parameters
    ----------
    points : ndarray, shape (N, 2)
        Points [m] that stand for the support in an exact limit surface.
    loads : ndarray, shape (N,)
        Greatest friction of each point [N].
    centre : tuple of float
        Centre of friction (x, y) [m].
    f_max : float
        Greatest frictional force [N], eq. (2).
    m_max : float
        Greatest frictional moment about the centre [N m], eq. (1): of the continuous support where
        the points only stand for it.
    """

    points: Array
    loads: Array
    centre: tuple[float, float]
    f_max: float
    m_max: float

    @property
    def c(self) -> float:
        """The ratio m_max / f_max [m] of eqs. (4) and (5)."""
        return self.m_max / self.f_max

    @classmethod
    def at_points(cls, points: npt.ArrayLike, loads: npt.ArrayLike | None = None) -> 'Support':
        """Rest the object on points.

        Parameters
        ----------
        points : array_like, shape (N, 2)
            Support points [m].
        loads : array_like, shape (N,), optional
            Greatest friction of each point [N], or its share in any unit; by default all alike and
            1 together.

        Returns
        -------
        Support
            The support.

        Raises
        ------
        ValueError
            If the shapes do not fit, a number is not finite, a load is negative or all are zero.
        """
        p = np.asarray(points, dtype=float)
        if p.ndim != 2 or p.shape[1] != 2 or len(p) == 0 or not np.isfinite(p).all():
            raise ValueError(
                f'points: expected finite points of shape (N, 2), got {reprlib.repr(points)}'
            )
        w = np.full(len(p), 1.0 / len(p)) if loads is None else np.asarray(loads, dtype=float)
        total = len(w) * float(w.max(initial=0.0)) if w.ndim == 1 else math.nan  # or more
        if w.shape != (len(p),) or not ((w >= 0.0).all() and 0.0 < total < math.inf):
            raise ValueError(
                f'loads: expected {len(p)} loads of 0 or more, not all 0, got {reprlib.repr(loads)}'
            )
        x, y = w @ p / w.sum()
        m_max = w @ np.hypot(p[:, 0] - x, p[:, 1] - y)
        return cls(p, w, (float(x), float(y)), float(w.sum()), float(m_max))

    @classmethod
    def corners(cls, outline: Outline) -> 'Support':
        """Rest the object on the corners of its outline, all alike.

        Parameters
        ----------
        outline : Outline
            A polygon.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the outline has no corners.
        """
        corners = outline.pieces[outline.pieces[:, 3] == 0.0, :2]
        if len(corners) == 0:
            raise ValueError('outline: expected a polygon, got an outline without corners')
        return cls.at_points(corners)

    @classmethod
    def rim(cls, outline: Outline, count: int = COUNT) -> 'Support':
        """Rest the object on its rim, evenly along the outline.

        Parameters
        ----------
        outline : Outline
            The outline.
        count : int, optional
            Number of points, roughly, that stand for the rim.

        Returns
        -------
        Support
            The support; f_max is 1.
        """
        _positive('count', count)
        b, _, ds = _boundary(outline)
        centre = ds @ b / ds.sum()
        m_max = _distances(outline.about(*centre), 0) / outline.length
        points, _, ds = _spaced(outline, count)
        return cls._standing_for(points, ds / ds.sum(), centre, m_max)

    @classmethod
    def uniform(cls, outline: Outline, count: int = COUNT) -> 'Support':
        """Spread the load evenly over the area of the outline.

        Parameters
        ----------
        outline : Outline
            The outline.
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support; f_max is 1.
        """
        _positive('count', count)
        area, centre = _area(outline)
        m_max = _distances(outline.about(*centre), 1) / 3.0 / area
        points, areas = _cells(outline, area / count)
        return cls._standing_for(points, areas / areas.sum(), centre, m_max)

    @classmethod
    def circle(cls, radius: float, x: float = 0.0, y: float = 0.0, count: int = COUNT) -> 'Support':
        """Spread the load evenly over a circle: c is 2/3 of its radius.

        Parameters
        ----------
        radius : float
            Radius of the circle [m], positive.
        x, y : float, optional
            Its centre [m].
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the radius is not positive and finite.
        """
        even = cls.uniform(Outline.circle(radius), count)
        return cls._standing_for(
            even.points + np.array([x, y]), even.loads, np.array([x, y]), 2.0 * radius / 3.0
        )

    @classmethod
    def radial(cls, outline: Outline, exponent: float, count: int = COUNT) -> 'Support':
        """Spread the load by a power of the distance from the centre, as a share of the outline's.

        One number from a load in the middle to one on the rim: -2 is the limit of all load in the
        centroid, 0 is uniform, infinity leaves the load to the boundary. Along a ray from the
        centroid to the boundary at b, the pressure at the share s of it is s^exponent, so that
        c = (exponent + 2) / (exponent + 3) times the mean of |b|, taken over the area.

        Parameters
        ----------
        outline : Outline
            The outline.
        exponent : float
            Power, greater than -2.
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the exponent is not a finite number greater than -2.
        """
        _positive('count', count)
        if not (math.isfinite(exponent) and exponent > -2.0):
            raise ValueError(f'exponent: expected a finite number above -2, got {exponent}')
        area, centre = _area(outline)
        power = exponent + 2.0
        m_max = power / (power + 1.0) * _distances(outline.about(*centre), 1) / (2.0 * area)
        # Rings of equal load, each with the points that a rim would have, at its mean share.
        rings = max(1, round(math.sqrt(count / (4.0 * math.pi))))
        b, t, ds = _spaced(outline, count / rings)
        b = b - centre
        cross = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
        ends = np.linspace(0.0, 1.0, rings + 1) ** (1.0 / power)
        shares = rings * power / (power + 1.0) * np.diff(ends ** (power + 1.0))
        points = centre + (shares[:, np.newaxis, np.newaxis] * b).reshape(-1, 2)
        loads = np.tile(cross / cross.sum() / rings, rings)
        return cls._standing_for(points, loads, centre, m_max)

    @classmethod
    def density(
        cls, outline: Outline, density: Callable[[Array, Array], Array], count: int = COUNT
    ) -> 'Support':
        """Spread the load over the outline by a density.

        Parameters
        ----------
        outline : Outline
            The outline.
        density : callable
            Friction over area, mu_s p(x, y) [N/m^2], 0 or more. Called with arrays of x and y [m],
            it returns an array of the same shape.
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support.

        Raises
        ------
        ValueError
            If the density is negative or not finite somewhere, zero everywhere, or too wild for
            its integral to converge.
        """
        _positive('count', count)

        def checked(x: Array, y: Array) -> Array:
            value = np.broadcast_to(np.asarray(density(x, y), dtype=float), x.shape)
            if not (np.isfinite(value) & (value >= 0.0)).all():
                raise ValueError(
                    'density: expected finite values of 0 or more on the outline, got '
                    f'{value.min()} to {value.max()}'
                )
            return value

        area, centroid = _area(outline)
        f_max, x, y = _integrals(outline, centroid, checked, lambda x, y: (1.0, x, y))
        if not f_max > 0.0:
            raise ValueError('density: expected one that is not zero everywhere')
        centre = np.array([x, y]) / f_max
        _, m_max = _integrals(
            outline, centre, checked, lambda x, y: (1.0, np.hypot(x - centre[0], y - centre[1]))
        )
        points, areas = _cells(outline, area / count)
        loads = checked(points[:, 0], points[:, 1]) * areas
        points, loads = points[loads > 0.0], loads[loads > 0.0]
        if len(points) == 0:
            raise ValueError(f'count: expected enough points to meet the density, got {count}')
        return cls._standing_for(points, loads * (f_max / loads.sum()), centre, m_max)

    @classmethod
    def _standing_for(cls, points: Array, loads: Array, centre: Array, m_max: float) -> 'Support':
        """Make a continuous support; its points are moved by what their mean is off the centre."""
        points = points + (centre - loads @ points / loads.sum())
        x, y = centre
        return cls(points, loads, (float(x), float(y)), float(loads.sum()), float(m_max))


def _positive(name: str, value: int) -> None:
    if not value >= 1:
        raise ValueError(f'{name}: expected a whole number of 1 or more, got {value}')


def _points_on(pieces: Array, s: Array) -> Array:
    """Give points on pieces of an outline, at lengths s from their starts, all of shape (...)."""
    x, y, tau, length, turn = np.moveaxis(pieces, -1, 0)
    half = turn * np.divide(s, length, out=np.zeros_like(s), where=length > 0.0) / 2.0
    chord = s * np.sinc(half / np.pi)  # of an arc that turns by 2 half
    return np.stack([x + chord * np.cos(tau + half), y + chord * np.sin(tau + half)], axis=-1)


def _spaced(outline: Outline, count: float) -> tuple[Array, Array, Array]:
    """Give points spaced evenly on the boundary, unit tangents and the lengths they stand for."""
    points, tangents, lengths = [], [], []
    corners = np.flatnonzero(outline.pieces[:, 3] == 0.0)
    for side in np.split(outline.pieces, corners):  # which begins with a corner or is empty
        ends = np.cumsum(side[:, 3])
        if len(side) == 0 or ends[-1] == 0.0:
            continue
        parts = max(1, round(count * ends[-1] / outline.length))
        s = (np.arange(parts) + 0.5) / parts * ends[-1]
        piece = np.searchsorted(ends, s, side='right')
        s -= (ends - side[:, 3])[piece]
        tau = side[piece, 2] + side[piece, 4] * s / side[piece, 3]
        points.append(_points_on(side[piece], s))
        tangents.append(np.stack([np.cos(tau), np.sin(tau)], axis=-1))
        lengths.append(np.full(parts, ends[-1] / parts))
    return np.concatenate(points), np.concatenate(tangents), np.concatenate(lengths)


def _boundary(outline: Outline, nodes: int = GAUSS) -> tuple[Array, Array, Array]:
    """Give nodes on the boundary, unit tangents and weights ds for integrals along it."""
    at, weight = np.polynomial.legendre.leggauss(nodes)
    points, tangents, weights = [], [], []
    for piece in outline.pieces:
        length, turn = piece[3], piece[4]
        parts = max(1, math.ceil(turn / (math.pi / 4.0))) if length > 0.0 else 0
        for part in range(parts):
            s = length / parts * (part + (at + 1.0) / 2.0)
            points.append(_points_on(np.broadcast_to(piece, (nodes, 5)), s))
            tau = piece[2] + turn * s / length
            tangents.append(np.stack([np.cos(tau), np.sin(tau)], axis=-1))
            weights.append(weight * length / parts / 2.0)
    return np.concatenate(points), np.concatenate(tangents), np.concatenate(weights)


def _area(outline: Outline) -> tuple[float, Array]:
    """Give the area and the centroid."""
    b, t, ds = _boundary(outline)
    cross = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
    area = cross.sum() / 2.0
    return float(area), cross @ b / 3.0 / area


def _distances(outline: Outline, power: int) -> float:
    """Integrate l to a power times the distance from the origin along the outline.

    In closed form on edges, where the distance is sqrt(l^2 + d^2).
    """
    total = 0.0
    for piece in outline.pieces[outline.pieces[:, 3] > 0.0]:
        x, y, tau, length, turn = (float(value) for value in piece)
        if turn == 0.0:
            d, l = x * math.cos(tau) + y * math.sin(tau), x * math.sin(tau) - y * math.cos(tau)
            total += l**power * (_primitive(d + length, l) - _primitive(d, l))
        else:
            b, t, ds = _boundary(Outline(piece[np.newaxis]))
            heights = b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]
            total += float((heights**power * np.hypot(b[:, 0], b[:, 1])) @ ds)
    return total


def _primitive(d: float, l: float) -> float:
    """Give a primitive of sqrt(l^2 + d^2) by d."""
    return (d * math.hypot(l, d) + l * l * math.asinh(d / l)) / 2.0


def _integrals(
    outline: Outline,
    origin: Array,
    density: Callable[[Array, Array], Array],
    moments: Callable[[Array, Array], tuple[Array | float, ...]],
) -> Array:
    """Integrate density times moments over the area, in rays from an origin, until it converges."""
    before: Array | None = None
    change = math.inf
    pieces = np.count_nonzero(outline.pieces[:, 3])
    for nodes in DENSITY_NODES:
        b, t, ds = _boundary(outline, max(4, min(nodes, 8 * nodes // pieces)))
        b = b - origin
        cross = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
        at, weight = np.polynomial.legendre.leggauss(nodes)
        share = (at + 1.0) / 2.0
        x, y = origin[0] + np.outer(share, b[:, 0]), origin[1] + np.outer(share, b[:, 1])
        values = density(x, y) * np.outer(weight / 2.0 * share, cross)
        now = np.array([(values * moment).sum() for moment in moments(x, y)])
        if before is not None:
            scale = abs(now[0]) * np.append(1.0, np.full(len(now) - 1, outline.length / 4.0))
            change = float((np.abs(now - before) / np.where(scale > 0.0, scale, 1.0)).max())
        if change <= DENSITY_CHANGE:
            break
        before = now
    if change > DENSITY_LIMIT:
        raise ValueError(
            'density: expected one whose integral converges, got relative changes of '
            f'{change:.1e} with {DENSITY_NODES[-1]} nodes'
        )
    return now


def _cells(outline: Outline, area: float) -> tuple[Array, Array]:
    """Cut the area into the cells of a grid: centroid and area of each one's part inside."""
    side = math.sqrt(area)
    polygon = outline.points(side / 8.0)
    lower, upper = polygon.min(axis=0), polygon.max(axis=0)
    cells = np.maximum(np.round((upper - lower) / side), 1).astype(int)
    x, y = (
        lower[i] + (upper - lower)[i] * (np.arange(cells[i] * SUBCELLS) + 0.5) / cells[i] / SUBCELLS
        for i in (0, 1)
    )
    inside = np.ones((len(x), len(y)), dtype=bool)
    for (a_x, a_y), (b_x, b_y) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        inside &= (b_x - a_x) * (y - a_y) - np.subtract.outer(x, a_x)[:, None] * (b_y - a_y) >= 0.0
    shape = (cells[0], SUBCELLS, cells[1], SUBCELLS)
    share = inside.reshape(shape).sum(axis=(1, 3))
    met = share > 0
    sum_x = (inside * x[:, None]).reshape(shape).sum(axis=(1, 3))
    sum_y = (inside * y).reshape(shape).sum(axis=(1, 3))
    points = np.stack([sum_x[met] / share[met], sum_y[met] / share[met]], axis=-1)
    return points, share[met] / SUBCELLS**2 * np.prod((upper - lower) / cells)
