# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How a finger tip turns with its last link while it moves across the belt.

The finger has two links. The first begins at the origin of `finger_base`, the second ends at the
centre of the tip and points along its pole. The centre goes straight across the belt. Origin,
centre and the joint between the links are a triangle with the sides a, b and rho, so the second
link leads on from the direction of the centre, turned by the angle beta with
cos beta = (rho^2 + b^2 - a^2) / (2 b rho).
"""

import math
from typing import NamedTuple

from tactile_push.mechanics.compiled import equation


class TurningTip(NamedTuple):
    """A tip that turns with the last link, or one that a wrist holds straight."""

    a: float  #: length of the first link [m]
    b: float  #: length of the second link [m]
    y: float  #: where the centre of the tip stays along the belt, in `finger_base` [m]
    #: where the second link is bent to from the first: 1 counterclockwise, -1 clockwise; 0 for a
    #: tip that does not turn and points along the belt
    bend: float


STRAIGHT = TurningTip(0.0, 0.0, 0.0, 0.0)


@equation
def tip_direction(x: float, tip: TurningTip) -> float:
    """Return psi [rad], where the pole points with the tip's centre at x [m]; NaN out of reach."""
    if tip.bend == 0.0:
        return math.pi / 2.0
    rho = math.hypot(x, tip.y)
    cos = (rho * rho + tip.b * tip.b - tip.a * tip.a) / (2.0 * tip.b * rho)
    if abs(cos) > 1.0:
        return math.nan
    return math.atan2(tip.y, x) + tip.bend * math.acos(cos)


@equation
def tip_turning(x: float, tip: TurningTip) -> float:
    """Return dpsi/dx [rad/m] with the tip's centre at x [m]; NaN out of reach."""
    if tip.bend == 0.0:
        return 0.0
    square = x * x + tip.y * tip.y
    rho = math.sqrt(square)
    more = tip.b * tip.b - tip.a * tip.a
    cos = (square + more) / (2.0 * tip.b * rho)
    if abs(cos) >= 1.0:
        return math.nan
    by_rho = (1.0 - more / square) / (2.0 * tip.b)  # of cos beta
    return -tip.y / square - tip.bend * by_rho * x / (rho * math.sqrt(1.0 - cos * cos))
