# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Convex outlines, made of edges, corners and circular arcs.

An outline runs counterclockwise around the object, with the object on its left: in the direction of
increasing d, the normal into the object to the left of the tangent. A corner is an arc of radius
zero. A smooth outline becomes a chain of arcs that have the curve's points and tangents; its error
falls with the third power of their length.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.body import Pose
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.contact import (
    COLUMNS,
    CURVATURE,
    D_START,
    L_START,
    LENGTH,
    SIGMA,
    T_X,
    T_Y,
    TAU,
    clearance,
    contact,
)

ROUNDING = 1e-9  # of lengths, of the outline's size: above that of floats, below any detail
ELLIPSE_POINTS = 192  # the arcs of an ellipse twice as long as wide keep to it within 2e-7 of a
SMALLEST, LARGEST = 1e-50, 1e50  # sizes whose squares and cubes are still numbers [m]


@dataclass(frozen=True, eq=False)
class Outline:
    """A convex outline; make it by `polygon`, `circle`, `ellipse` or `smooth`.

    Parameters
    ----------
    pieces : ndarray, shape (M, 5)
        One row (x, y, tau, length, turn) a piece, counterclockwise: start [m, m], angle of the
        tangent there [rad], length [m] and angle by which the tangent turns along it [rad]. An
        edge turns by 0, a corner has the length 0. The origin is the centre of mass (or of
        friction) that d and l refer to.
    """

    pieces: Array

    @classmethod
    def polygon(cls, vertices: npt.ArrayLike) -> 'Outline':
        """Make a convex polygon.

        Parameters
        ----------
        vertices : array_like, shape (N, 2)
            Corners [m], either way around. The first edge goes from the first to the second.
            Corners on a straight line between their neighbours are left out.

        Returns
        -------
        Outline
            The outline, starting with the first edge.

        Raises
        ------
        ValueError
            If there are fewer than three corners, or the polygon is not convex or crosses itself.
        """
        corners = _convex('vertices', vertices)
        edges = np.roll(corners, -1, axis=0) - corners
        taus = np.unwrap(np.arctan2(edges[:, 1], edges[:, 0]))
        turns = np.diff(np.append(taus, taus[0] + 2.0 * math.pi))
        rows = []
        for (x, y), (to_x, to_y), edge, tau, turn in zip(
            corners, np.roll(corners, -1, axis=0), edges, taus, turns, strict=True
        ):
            rows.append((x, y, tau, math.hypot(*edge), 0.0))
            rows.append((to_x, to_y, tau, 0.0, turn))
        return cls(np.array(rows))

    @classmethod
    def rectangle(cls, width: float, height: float) -> 'Outline':
        """Make a rectangle about the origin.

        Parameters
        ----------
        width, height : float
            Sides along x and y [m]. The first edge is the lower one along x.

        Returns
        -------
        Outline
            The outline.

        Raises
        ------
        ValueError
            If a side is not positive and finite.
        """
        x, y = _length('width', width) / 2.0, _length('height', height) / 2.0
        return cls.polygon([(-x, -y), (x, -y), (x, y), (-x, y)])

    @classmethod
    def circle(cls, radius: float) -> 'Outline':
        """Make a circle about the origin.

        Parameters
        ----------
        radius : float
            Radius [m].

        Returns
        -------
        Outline
            The outline, starting at its lowest point.

        Raises
        ------
        ValueError
            If the radius is not positive and finite.
        """
        _length('radius', radius)
        return cls(np.array([(0.0, -radius, 0.0, 2.0 * math.pi * radius, 2.0 * math.pi)]))

    @classmethod
    def ellipse(cls, a: float, b: float) -> 'Outline':
        """Make an ellipse about the origin, as a chain of arcs.

        Parameters
        ----------
        a, b : float
            Half axes along x and y [m].

        Returns
        -------
        Outline
            The outline, starting at its lowest point.

        Raises
        ------
        ValueError
            If a half axis is not positive and finite.
        """
        _length('a', a)
        _length('b', b)
        # Halfway between even steps of the parameter, coarse where the ellipse is sharp, and even
        # steps of the tangent's angle, coarse where it is flat.
        even = np.arange(ELLIPSE_POINTS) * 2.0 * math.pi / ELLIPSE_POINTS
        parameter = np.arctan2(math.sqrt(a) * np.sin(even), math.sqrt(b) * np.cos(even))
        sin, cos = np.sin(parameter), np.cos(parameter)
        return cls(_arcs(np.stack([a * sin, -b * cos], 1), np.arctan2(b * sin, a * cos)))

    @classmethod
    def smooth(cls, points: npt.ArrayLike) -> 'Outline':
        """Make a smooth outline through measured or computed points.

        Parameters
        ----------
        points : array_like, shape (N, 2)
            Points on the outline [m], either way around. The tangent at each one is that of the
            circle through it and its neighbours.

        Returns
        -------
        Outline
            The outline, starting at the first point.

        Raises
        ------
        ValueError
            If there are fewer than three points, or the polygon through them is not convex or
            crosses itself.
        """
        through = _convex('points', points, straight=True)
        z = through[:, 0] + 1j * through[:, 1]
        ahead, behind = np.roll(z, -1) - z, z - np.roll(z, 1)
        # Tangent and chord enclose the angle under which the other neighbour sees the chord.
        return cls(_arcs(through, np.angle(ahead * behind / (ahead + behind))))

    def about(self, x: float, y: float) -> 'Outline':
        """Refer the outline to another point of the object.

        Parameters
        ----------
        x, y : float
            The new origin in the present frame [m]; the axes stay.

        Returns
        -------
        Outline
            The same outline.

        Raises
        ------
        ValueError
            If the point is not inside the outline.
        """
        if not (math.isfinite(x) and math.isfinite(y)):
            raise ValueError(f'x, y: expected a point inside the outline, got ({x}, {y}) m')
        moved = self.pieces.copy()
        moved[:, 0] -= x
        moved[:, 1] -= y
        outline = Outline(moved)
        if not outline.contains([(0.0, 0.0)], ROUNDING * self.length)[0]:
            raise ValueError(f'x, y: expected a point inside the outline, got ({x}, {y}) m')
        return outline

    @cached_property
    def length(self) -> float:
        """Length of the outline [m]."""
        return float(self.pieces[:, 3].sum())

    def path(self, r: float) -> Array:
        """Return the path of the finger's disk around the object.

        Parameters
        ----------
        r : float
            Radius of the disk [m].

        Returns
        -------
        ndarray, shape (M + 1, 8)
            Pieces of the path as `push` takes them, see `mechanics.contact`.

        Raises
        ------
        ValueError
            If the radius is not positive and finite.
        """
        _length('r', r)
        x, y, tau, length, turn = self.pieces.T
        sin, cos = np.sin(tau), np.cos(tau)
        lengths = length + r * turn
        path = np.empty((len(tau) + 1, COLUMNS))
        path[:-1, SIGMA] = np.cumsum(lengths) - lengths
        path[:-1, LENGTH] = lengths
        path[:-1, CURVATURE] = turn / lengths
        path[:-1, TAU] = tau
        path[:-1, T_X], path[:-1, T_Y] = cos, sin
        path[:-1, D_START], path[:-1, L_START] = x * cos + y * sin, x * sin - y * cos
        path[-1] = path[0]
        path[-1, SIGMA] += lengths.sum()
        path[-1, TAU] += 2.0 * math.pi
        return path

    def sigma(self, r: float, tau: float | None = None, d: float | None = None) -> float:
        """Find a contact by its tangent.

        Parameters
        ----------
        r : float
            Radius of the finger's disk [m].
        tau : float, optional
            Angle of the tangent in the object's frame [rad]; that of the first piece by default.
        d : float, optional
            The paper's d [m]; by default that contact with this tangent which has the smallest.

        Returns
        -------
        float
            Position along the path of the disk's centre [m].

        Raises
        ------
        ValueError
            If no contact of the outline has this tangent and d.
        """
        path = self.path(r)
        if tau is None:
            tau = path[0, TAU]
        if not math.isfinite(tau):
            raise ValueError(f'tau: expected a finite angle [rad], got {tau}')
        slack = ROUNDING * self.length
        turned = path[0, TAU] + (tau - path[0, TAU] + ROUNDING) % (2.0 * math.pi) - ROUNDING
        piece = int(np.searchsorted(path[:-1, TAU], turned - ROUNDING))
        if piece == len(path) - 1 or path[piece, TAU] > turned + ROUNDING:
            piece -= 1
        lower, upper = path[piece, D_START], path[piece, D_START] + path[piece, LENGTH]
        if path[piece, CURVATURE] > 0.0:
            turn = max(turned - path[piece, TAU], 0.0)
            sigma = path[piece, SIGMA] + turn / path[piece, CURVATURE]
            _, _, lower, _ = contact(sigma, piece, path, r)
            upper = lower
        if d is None:
            d = min(max(0.0, lower), upper)
        if not lower - slack <= d <= upper + slack:
            raise ValueError(
                f'd: expected a contact on the outline where its tangent has the angle {tau} rad, '
                f'd = {lower} to {upper} m, got {d}'
            )
        if path[piece, CURVATURE] > 0.0:
            return float(sigma)
        return float(path[piece, SIGMA] + min(max(d, lower), upper) - lower)

    def contains(self, points: npt.ArrayLike, slack: float = 0.0) -> npt.NDArray[np.bool_]:
        """Return which points lie inside the outline or on it.

        Parameters
        ----------
        points : array_like, shape (N, 2)
            Points in the object's frame [m].
        slack : float, optional
            How far outside a point may be and still count as inside [m].

        Returns
        -------
        ndarray of bool, shape (N,)
            Whether each one lies inside.
        """
        r = ROUNDING * self.length
        path, origin = self.path(r), Pose(0.0, 0.0, 0.0)  # of a finger that is almost a point
        return np.array(
            [
                math.isfinite(x)
                and math.isfinite(y)
                and clearance(origin, float(x), float(y), path, r)[1] + r <= slack
                for x, y in np.asarray(points, dtype=float)
            ],
            dtype=bool,
        )

    def points(self, spacing: float) -> Array:
        """Return points on the outline, the corners among them.

        Parameters
        ----------
        spacing : float
            Greatest distance of neighbours along arcs [m]; edges have their ends alone.

        Returns
        -------
        ndarray, shape (N, 2)
            Points [m], counterclockwise, each one once.
        """
        rows = []
        for x, y, tau, length, turn in self.pieces:
            if turn == 0.0:
                rows.append((x, y))
            elif length > 0.0:
                radius = length / turn
                turned = tau + np.linspace(0.0, turn, math.ceil(length / spacing) + 1)[:-1]
                rows += zip(
                    x + radius * (np.sin(turned) - math.sin(tau)),
                    y - radius * (np.cos(turned) - math.cos(tau)),
                    strict=True,
                )
        return np.array(rows)


def _length(name: str, value: float) -> float:
    if not SMALLEST <= value <= LARGEST:
        raise ValueError(f'{name}: expected a positive length [m], got {value}')
    return value


def _convex(name: str, points: npt.ArrayLike, straight: bool = False) -> Array:
    """Check a convex polygon, turn it counterclockwise and drop what lies on straight lines."""
    p = np.asarray(points, dtype=float)
    if p.ndim != 2 or p.shape[1] != 2 or len(p) < 3 or not np.isfinite(p).all():
        raise ValueError(f'{name}: expected three or more finite points (x, y), got {_shown(p)}')
    edges = np.roll(p, -1, axis=0) - p
    size = np.abs(edges).max()
    if not SMALLEST <= size <= LARGEST:
        raise ValueError(
            f'{name}: expected an outline of {SMALLEST} to {LARGEST} m, got {_shown(p)}'
        )
    if (np.hypot(edges[:, 0], edges[:, 1]) <= ROUNDING * size).any():
        raise ValueError(f'{name}: expected points that differ, got {_shown(p)}')
    directions = edges[:, 0] + 1j * edges[:, 1]
    turn = np.angle(directions / np.roll(directions, 1))
    spiky = (np.abs(turn) > math.pi - ROUNDING).any()
    if turn.sum() < -math.pi and not spiky:  # the first edge stays the first
        return _convex(name, np.roll(p[::-1], 2, axis=0), straight)
    if spiky or (turn < -ROUNDING).any() or abs(turn.sum() - 2.0 * math.pi) > 1e-6:
        raise ValueError(
            f'{name}: expected a convex outline that does not cross itself, got {_shown(p)}'
        )
    if straight:
        return p
    corners = p[turn > ROUNDING]
    return corners if turn[0] > ROUNDING else np.roll(corners, 1, axis=0)


def _shown(points: Array) -> str:
    return f'{points.tolist()}' if points.size <= 16 else f'an array of shape {points.shape}'


def _arcs(points: Array, taus: Array) -> Array:
    """Join points with given tangents by two arcs each, whose joint is parallel to the chord."""
    rows: list[Sequence[float]] = []
    steps = np.diff(taus) % (2.0 * math.pi)
    steps[steps > 2.0 * math.pi - ROUNDING] = 0.0
    taus = taus[0] + np.cumsum([0.0, *steps])
    taus = np.append(taus, taus[0] + 2.0 * math.pi)
    for i, start in enumerate(points):
        chord = points[(i + 1) % len(points)] - start
        direction = math.atan2(chord[1], chord[0])
        direction += 2.0 * math.pi * math.ceil((taus[i] - direction - ROUNDING) / (2.0 * math.pi))
        first, second = max(direction - taus[i], 0.0), max(taus[i + 1] - direction, 0.0)
        if first + second <= ROUNDING:
            rows.append((*start, taus[i], math.hypot(*chord), 0.0))
            continue
        # Half the turns lie between chord and sub-chords: the sine rule gives their lengths.
        scale = math.hypot(*chord) / math.sin((first + second) / 2.0)
        chords = scale * math.sin(second / 2.0), scale * math.sin(first / 2.0)
        joint = start + chords[0] * np.array(
            [math.cos(direction - first / 2.0), math.sin(direction - first / 2.0)]
        )
        for (x, y), tau, turn, part in (
            (start, taus[i], first, chords[0]),
            (joint, direction, second, chords[1]),
        ):
            rows.append((x, y, tau, part / np.sinc(turn / 2.0 / math.pi), turn))
    return np.array(rows)
