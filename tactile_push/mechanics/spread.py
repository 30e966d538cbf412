# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Loads between the centroid and the corners of an outline, by one number, the spread.

0 is all load in the centroid, 1 an even pressure, 2 the rim, 3 the corners. Up to the rim, load
moves outwards along the rays from the centroid: on the ray to the boundary at b, the pressure at
the share s of it is a power of s. From the rim on, load moves along each edge from its middle to
both its ends: its density is a power of the share of the way. Each edge keeps the load of its
triangle with the centroid, and the load's middle, so the centre of friction stays at the centroid.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.outline import Outline
from tactile_push.mechanics.quadrature import area_and_centroid, distances, gauss_rule, spaced

RIM, CORNERS = 2.0, 3.0
NODES = 100  # of a Gauss rule on a part of an edge
HALVINGS = 40  # of a range of spreads


def largest_spread(outline: Outline) -> float:
    """Return how far load can spread: to the corners, or to the rim of what has none."""
    return CORNERS if (outline.pieces[:, 3:] == 0.0).any(axis=1).all() else RIM


def radial_power(spread: float) -> float:
    """Return by which power of the load within it a ring's share of the ray grows.

    The load within the share s is s^(1/power), so the mean share is 1/(1 + power): 0 in the
    centroid, 2/3 under even pressure, 1 on the rim. The mean depth, 1 less the mean share, is
    u^2 (5 - u)/12 with u = 2 - spread, and smooth at the rim.
    """
    u = max(RIM - spread, 0.0)
    depth = u * u * (5.0 - u) / 12.0
    return math.inf if depth >= 1.0 else depth / (1.0 - depth)


def edge_power(spread: float) -> float:
    """Return by which power of the load within it the share of the way along an edge grows.

    As `radial_power`, from the edge's middle to its ends: 1 up to the rim, 0 on the corners. The
    mean share of the way grows with the square of what the spread is above the rim's.
    """
    share = (1.0 + max(spread - RIM, 0.0) ** 2) / 2.0
    return (1.0 - share) / share


def mean_distance(outline: Outline, spread: float) -> float:
    """Return the mean distance of the load from the centroid [m], the origin of the outline."""
    power = edge_power(spread)
    if power == 1.0:
        area, _ = area_and_centroid(outline)
        return distances(outline, 1) / (2.0 * area) / (1.0 + radial_power(spread))
    total = area = 0.0
    for x, y, tau, length, _ in outline.pieces[outline.pieces[:, 3] > 0.0]:
        height = x * math.sin(tau) - y * math.cos(tau)
        middle, half = x * math.cos(tau) + y * math.sin(tau) + length / 2.0, length / 2.0
        total += height * length * _mean_on_edge(height, middle, half, power)
        area += height * length
    return float(total / area)


def spread_at(outline: Outline, distance: float) -> float:
    """Return how far a load is spread whose mean distance from the centroid is this [m].

    0 or the largest spread, if no load is as close to the centroid, the origin of the outline, or
    as far from it.
    """
    at_rim = mean_distance(outline, RIM)
    if distance <= at_rim:
        return _bisected(0.0, RIM, lambda s: at_rim / (1.0 + radial_power(s)) < distance)
    return _bisected(RIM, largest_spread(outline), lambda s: mean_distance(outline, s) < distance)


def _bisected(lower: float, upper: float, is_below: Callable[[float], bool]) -> float:
    for _ in range(HALVINGS):
        middle = (lower + upper) / 2.0
        lower, upper = (middle, upper) if is_below(middle) else (lower, middle)
    return (lower + upper) / 2.0


def _mean_on_edge(height: float, middle: float, half: float, power: float) -> float:
    """Return the mean of sqrt(height^2 + (middle + half w)^2), w the share of the way.

    By parts: its value at the ends less the integral of its slope times the load within. The parts
    begin and end where that is steep or the way is nearest to the centroid.
    """
    ends = [math.hypot(height, middle + side * half) for side in (-1.0, 1.0)]
    if power == 0.0:
        return sum(ends) / 2.0
    at, weight = _nodes()
    nearest = min(abs(middle) / half, 1.0)
    w = np.concatenate([nearest * at, nearest + (1.0 - nearest) * at])
    weights = np.concatenate([nearest * weight, (1.0 - nearest) * weight])
    slope = np.zeros_like(w)
    for side in (-1.0, 1.0):
        d = middle + side * half * w
        slope += side * half * d / np.hypot(height, d) / 2.0
    return float(sum(ends) / 2.0 - (w ** (1.0 / power) * slope) @ weights)


@cache
def _nodes() -> tuple[Array, Array]:
    """Return nodes and weights on (0, 1), close to each other at both ends."""
    x, weight = gauss_rule(NODES)
    t = (x + 1.0) / 2.0
    return t * t * (3.0 - 2.0 * t), 3.0 * t * (1.0 - t) * weight


def standing_points(outline: Outline, spread: float, count: int) -> tuple[Array, Array]:
    """Return points that stand for the load, and their shares of it.

    Rings of equal load, each at its mean share of the rays; on the rim and beyond it all rings lie
    in one place and are one.
    """
    rings = max(1, round(math.sqrt(count / (4.0 * math.pi))))
    _, centre = area_and_centroid(outline)
    if largest_spread(outline) == CORNERS:
        b, loads = _on_edges(outline.about(*centre), count / rings, edge_power(spread))
    else:
        b, t, ds = spaced(outline, count / rings)
        b = b - centre
        loads = (b[:, 0] * t[:, 1] - b[:, 1] * t[:, 0]) * ds
    power = radial_power(spread)
    if power == 0.0:
        return centre + b, loads / loads.sum()
    shares = rings * np.diff(np.linspace(0.0, 1.0, rings + 1) ** (1.0 + power)) / (1.0 + power)
    points = centre + (shares[:, np.newaxis, np.newaxis] * b).reshape(-1, 2)
    return points, np.tile(loads / loads.sum() / rings, rings)


def _on_edges(outline: Outline, count: float, power: float) -> tuple[Array, Array]:
    """Return points on the edges of a polygon about its centroid, as many on either half."""
    points, loads = [], []
    for x, y, tau, length, _ in outline.pieces[outline.pieces[:, 3] > 0.0]:
        half = 1 if power == 0.0 else max(1, round(count * length / outline.length / 2.0))
        parts = 2 * half
        ends = np.linspace(-1.0, 1.0, parts + 1)  # of parts of equal load
        within = np.diff(np.abs(ends) ** (1.0 + power)) / np.diff(ends) / (1.0 + power)
        along = length * (1.0 + within) / 2.0
        points.append(np.stack([x + along * math.cos(tau), y + along * math.sin(tau)], axis=-1))
        height = x * math.sin(tau) - y * math.cos(tau)
        loads.append(np.full(parts, height * length / parts))
    return np.concatenate(points), np.concatenate(loads)
