# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The straight edges of an outline, one of which is pushed."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.estimation.prior import ROUND
from tactile_push.mechanics import Outline
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.contact import D_START, L_START, LENGTH, TAU

ANY_RADIUS = 1.0  # of the finger's disk [m]: where its path is straight does not depend on it


@dataclass(frozen=True)
class Edge:
    """A straight edge that may be pushed."""

    number: int  #: from 0, counterclockwise; from vertex `number` to the next one
    d: tuple[float, float]  #: its ends, least and most d [m]
    l: float  #: distance from the edge to the centre of mass [m]
    angle: float  #: direction in the object's frame [rad]; the object's angle is theta less it
    #: second moments of the object's area along the edge, mixed and along the normal, divided by
    #: the root of their determinant, on which a slender object's resistance to turning depends
    moments: tuple[float, float, float] = ROUND

    @property
    def length(self) -> float:
        """Its length [m]."""
        return self.d[1] - self.d[0]

    def same_place(self, other: 'Edge', slack: float) -> bool:
        """Return whether another edge lies the same way to the centre of mass.

        Parameters
        ----------
        other : Edge
            The other edge; its direction does not matter.
        slack : float
            By how much a length may differ [m].

        Returns
        -------
        bool
            Whether no reading of theta can tell them apart.
        """
        pairs = zip((*self.d, self.l), (*other.d, other.l), strict=True)
        return all(abs(one - two) <= slack for one, two in pairs)


def edges_of(vertices: npt.ArrayLike) -> tuple[Edge, ...]:
    """Return the edges of a convex polygon.

    Parameters
    ----------
    vertices : array_like, shape (N, 2)
        Its corners about the centre of mass [m], counterclockwise, none on a straight line between
        its neighbours.

    Returns
    -------
    tuple of Edge
        The edges, as many as corners.

    Raises
    ------
    ValueError
        If the corners are not of this kind, or the centre of mass is not inside.
    """
    outline = Outline.polygon(vertices)
    corners = np.asarray(vertices, dtype=float)
    kept = outline.pieces[::2, :2]  # an edge and a corner by turns
    if len(kept) != len(corners) or not np.array_equal(kept, corners):
        raise ValueError(
            'vertices: expected corners in counterclockwise order, none between two others on a '
            f'straight line, got {corners.tolist()}'
        )
    rows = outline.path(ANY_RADIUS)[:-1:2]
    if not (rows[:, L_START] > 0.0).all():
        raise ValueError(
            f'vertices: expected a polygon about its centre of mass, (0, 0), got {corners.tolist()}'
        )
    moments = _moments(corners)
    return tuple(
        Edge(
            number,
            (float(row[D_START]), float(row[D_START] + row[LENGTH])),
            float(row[L_START]),
            float(row[TAU]),
            _seen_from(moments, float(row[TAU])),
        )
        for number, row in enumerate(rows)
    )


def _moments(corners: Array) -> Array:
    """Return the second moments about the origin over the root of their determinant, (2, 2)."""
    following = np.roll(corners, -1, axis=0)
    areas = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    # Of every triangle at the origin, from its corners and the sum of them.
    moments = sum(
        (points.T * areas) @ points for points in (corners, following, corners + following)
    )
    return moments / math.sqrt(np.linalg.det(moments))


def _seen_from(moments: Array, angle: float) -> tuple[float, float, float]:
    """Return second moments in a frame that is turned."""
    cos, sin = math.cos(angle), math.sin(angle)
    turn = np.array([[cos, sin], [-sin, cos]])
    turned = turn @ moments @ turn.T
    return float(turned[0, 0]), float(turned[0, 1]), float(turned[1, 1])
