# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Integrals over an outline's area and along it, and points that stand for both.

Integrals over the area are turned into integrals along the boundary b: with the origin at the
centre, that of |x| is the one of |b| b x db / 3.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.outline import Outline

GAUSS = 16  # nodes on every eighth of a turn of an arc
SUBCELLS = 16
DENSITY_CHANGE = 1e-9  # relative change at which an integral has converged
DENSITY_LIMIT = 3e-3  # and the one that must be reached, as with a step in the density
DENSITY_NODES = (8, 16, 32, 64, 128, 256, 512)


@cache
def gauss_rule(nodes: int) -> tuple[Array, Array]:
    """Return nodes and weights of Gauss's rule on (-1, 1); those of 512 take half a second."""
    return np.polynomial.legendre.leggauss(nodes)


def points_on(pieces: Array, s: Array) -> Array:
    """Return points on pieces of an outline, at lengths s from their starts, all of shape (...)."""
    x, y, tau, length, turn = np.moveaxis(pieces, -1, 0)
    half = turn * np.divide(s, length, out=np.zeros_like(s), where=length > 0.0) / 2.0
    chord = s * np.sinc(half / np.pi)  # of an arc that turns by 2 half
    return np.stack([x + chord * np.cos(tau + half), y + chord * np.sin(tau + half)], axis=-1)


def spaced(outline: Outline, count: float) -> tuple[Array, Array, Array]:
    """Return points spaced evenly on the boundary, unit tangents and the lengths they stand for."""
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
        points.append(points_on(side[piece], s))
        tangents.append(np.stack([np.cos(tau), np.sin(tau)], axis=-1))
        lengths.append(np.full(parts, ends[-1] / parts))
    return np.concatenate(points), np.concatenate(tangents), np.concatenate(lengths)


def boundary(outline: Outline, nodes: int = GAUSS) -> tuple[Array, Array, Array]:
    """Return nodes on the boundary, unit tangents and weights ds for integrals along it."""
    at, weight = gauss_rule(nodes)
    points, tangents, weights = [], [], []
    for piece in outline.pieces:
        length, turn = piece[3], piece[4]
        parts = max(1, math.ceil(turn / (math.pi / 4.0))) if length > 0.0 else 0
        for part in range(parts):
            s = length / parts * (part + (at + 1.0) / 2.0)
            points.append(points_on(np.broadcast_to(piece, (nodes, 5)), s))
            tau = piece[2] + turn * s / length
            tangents.append(np.stack([np.cos(tau), np.sin(tau)], axis=-1))
            weights.append(weight * length / parts / 2.0)
    return np.concatenate(points), np.concatenate(tangents), np.concatenate(weights)


def area_and_centroid(outline: Outline) -> tuple[float, Array]:
    """Return the area and the centroid."""
    b, t, ds = boundary(outline)
    cross = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
    area = cross.sum() / 2.0
    return float(area), cross @ b / 3.0 / area


def distances(outline: Outline, power: int) -> float:
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
            b, t, ds = boundary(Outline(piece[np.newaxis]))
            heights = b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]
            total += float((heights**power * np.hypot(b[:, 0], b[:, 1])) @ ds)
    return total


def _primitive(d: float, l: float) -> float:
    """Return a primitive of sqrt(l^2 + d^2) by d."""
    return (d * math.hypot(l, d) + l * l * math.asinh(d / l)) / 2.0


def integrals(
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
        b, t, ds = boundary(outline, max(4, min(nodes, 8 * nodes // pieces)))
        b = b - origin
        cross = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
        at, weight = gauss_rule(nodes)
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


def cells(outline: Outline, area: float) -> tuple[Array, Array]:
    """Cut the area into the cells of a grid: centroid and area of each one's part inside."""
    side = math.sqrt(area)
    polygon = outline.points(side / 8.0)
    lower, upper = polygon.min(axis=0), polygon.max(axis=0)
    across = np.maximum(np.round((upper - lower) / side), 1).astype(int)
    x, y = (
        lower[i]
        + (upper - lower)[i] * (np.arange(across[i] * SUBCELLS) + 0.5) / across[i] / SUBCELLS
        for i in (0, 1)
    )
    inside = np.ones((len(x), len(y)), dtype=bool)
    for (a_x, a_y), (b_x, b_y) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        inside &= (b_x - a_x) * (y - a_y) - np.subtract.outer(x, a_x)[:, None] * (b_y - a_y) >= 0.0
    shape = (across[0], SUBCELLS, across[1], SUBCELLS)
    share = inside.reshape(shape).sum(axis=(1, 3))
    met = share > 0
    sum_x = (inside * x[:, None]).reshape(shape).sum(axis=(1, 3))
    sum_y = (inside * y).reshape(shape).sum(axis=(1, 3))
    points = np.stack([sum_x[met] / share[met], sum_y[met] / share[met]], axis=-1)
    return points, share[met] / SUBCELLS**2 * np.prod((upper - lower) / across)
