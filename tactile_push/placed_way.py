# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How an object was placed, as it is seen from above on the belt: ways, outlines and the goal."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]
"""Points across and along the belt [m], shape (K, 2)."""

BETWEEN = 0.05  # belt between two outlines on the way [m]
ROUND = 60  # points of a circle: looks round


class PlacedWay(NamedTuple):
    """How finger and object moved on the belt, from the first contact until the object was free."""

    finger: Points  #: centre of the finger's disk at each moment
    #: of the object at each moment: x, y of the centre of mass [m] and theta [rad], shape (K, 3)
    moved: npt.NDArray[np.float64]
    edge: float  #: angle of the pushed edge in the object [rad]
    #: corners about the centre of mass [m]; empty if they are not known
    outline: Sequence[tuple[float, float]]
    radius: float  #: of the finger's disk [m]
    goal: tuple[float, float]  #: x of the centre of mass [m] and theta [rad] that were wanted


class FromAbove(NamedTuple):
    """What is seen of it, the belt counted from where the finger was at first."""

    finger: Points  #: way of the centre of the disk
    centre: Points  #: way of the centre of mass
    #: centre of mass, shape (2,), and outline where the object was on its way
    passed: list[tuple[Points, Points]]
    free: Points  #: outline where it was let go, at the end of `centre`
    tip: Points  #: outline of the disk then
    #: centre of mass, shape (2,), where it was wanted. The goal says nothing about the place along
    #: the belt, so it is that where the object was let go.
    goal: Points
    wanted: Points  #: outline there


def from_above(way: PlacedWay) -> FromAbove:
    """Return what is seen of a way."""
    start = np.array([0.0, way.finger[0, 1]])
    finger, centre, theta = way.finger - start, way.moved[:, :2] - start, way.moved[:, 2]
    outline = np.reshape(np.asarray(way.outline, dtype=float), (-1, 2))

    def placed(at: Points, angle: float) -> Points:
        """Return the outline about a centre of mass [m] with the pushed edge at an angle [rad]."""
        cos, sin = math.cos(angle - way.edge), math.sin(angle - way.edge)
        return outline @ np.array([[cos, sin], [-sin, cos]]) + at

    on_the_way = np.searchsorted(finger[:, 1], np.arange(0.0, finger[-1, 1], BETWEEN))
    turns = np.linspace(0.0, 2.0 * math.pi, ROUND)
    goal = np.array([way.goal[0], centre[-1, 1]])
    return FromAbove(
        finger,
        centre,
        [(centre[k], placed(centre[k], theta[k])) for k in on_the_way],
        placed(centre[-1], theta[-1]),
        finger[-1] + way.radius * np.stack([np.cos(turns), np.sin(turns)], axis=1),
        goal,
        placed(goal, way.goal[1]),
    )
