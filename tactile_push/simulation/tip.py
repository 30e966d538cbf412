# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How a finger tip turns while the commanded point of it moves across the belt."""

import math
from typing import NamedTuple

from tactile_push.mechanics.commanded_point import CENTRE, CONTACT, added_way
from tactile_push.mechanics.compiled import compiled
from tactile_push.mechanics.turning_tip import TurningTip, tip_direction, tip_turning

# Way over which the tip turns as fast as on average [m]. Of the default finger within 4 cm psi is
# then at most 1.2e-5 rad off on the way, and right at its end.
EVEN_TURN = 0.5e-3
LEAST_FOLLOWING = 0.1  # share of the centre's way that the commanded point goes at least; picked
NEWTON_STEPS = 12  # it takes three
EXACT = 1e-13  # error of the commanded point's way [m]


class Tip(NamedTuple):
    """The last link of a finger whose disk goes straight across the belt."""

    a: float  #: length of the first link [m]
    b: float  #: length of the second link [m]
    x: float  #: where the disk's centre starts, in `finger_base` [m]
    y: float  #: where it stays, in `finger_base` [m]
    point: int  #: which point follows the command, an index of `interface.POINTS`


@compiled
def tip_angle(tip: Tip, x: float) -> tuple[float, float]:
    """Return psi [rad] and dpsi/dx [rad/m] with the disk's centre at x; NaN out of reach."""
    turning = TurningTip(tip.a, tip.b, tip.y, -1.0)  # the knuckle is to the left of the belt
    return tip_direction(x, turning), tip_turning(x, turning)


@compiled
def move_tip(
    tip: Tip, x: float, psi: float, way: float, theta: float, r: float
) -> tuple[float, float]:
    """Return x [m] and psi [rad] after the commanded point has moved by `way` [m].

    psi is NaN where the finger cannot follow: out of its reach, or where the commanded point would
    hardly move although the centre does.
    """
    after = x + way
    for _ in range(NEWTON_STEPS):
        turned, slope = tip_angle(tip, after)
        error = after - x - way - added_way(tip.point, psi, turned, theta, r)
        if abs(error) < EXACT or tip.point == CENTRE or math.isnan(error):
            break
        sine = math.cos(theta) if tip.point == CONTACT else math.sin(turned)
        follows = 1.0 - r * sine * slope
        if not follows > LEAST_FOLLOWING:
            return after, math.nan
        after -= error / follows
    return after, turned
