# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The command that brings the edge to an angle soonest, and keeps it there.

docs/steering.md says why it is chosen so.
"""

import math

from tactile_push.control.placing.model import (
    Bounds,
    Pushed,
    Situation,
    ahead,
    bounded_step,
    outside,
)
from tactile_push.mechanics.compiled import compiled

COMMANDS = 9  # that are tried, from one bound to the other
HALVINGS = 24  # between two of them
WITHIN = 3  # control periods in which a command shall bring the edge to its angle; picked
REST = 3.0  # lags for which the finger is then followed to its rest
STEP = 5e-4  # of the belt where the end is near [m]
# When the angle is farther away, pushes of two arcs are compared over a piece of belt.
HORIZON, COARSE = 0.03, 1e-3  # its length, and of a step [m]
SWITCHES = (0.002, 0.005, 0.01, 0.02)  # where the second arc may begin [m]
STEEPNESSES = (-1.0, -0.5, 0.0, 0.5, 1.0)  # of the arcs
AWAY = math.radians(1.0)  # a miss from which on they are compared
D_WEIGHT, X_WEIGHT = 2e3, 2e3  # of a metre beyond the ends of the edge and of the workspace
LOST = 1e3  # cost of a push that loses the object


@compiled
def _miss(
    now: Situation, command: float, theta: float, piece: float, pushed: Pushed, bounds: Bounds
) -> float:
    """Return by how much theta misses its angle if it is turned for a while and then held."""
    way = WITHIN * piece
    count = max(1, math.ceil(way / STEP))
    for _ in range(count):
        now, _ = bounded_step(now, command, way / count, pushed, bounds)
    rest = REST * pushed.lag
    count = math.ceil(rest / STEP)
    for _ in range(count):
        still = ahead(now, pushed, bounds)
        now, _ = bounded_step(now, still, rest / count, pushed, bounds)
    return now.theta - theta


@compiled
def turning_command(
    now: Situation, theta: float, piece: float, pushed: Pushed, bounds: Bounds
) -> float:
    """Return the command of the next control period.

    Parameters
    ----------
    now : Situation
        Where finger and object are.
    theta : float
        The angle that the edge shall have [rad].
    piece : float
        Belt of a control period [m].
    pushed, bounds : Pushed, Bounds
        The object, and what bounds commands and contact.

    Returns
    -------
    float
        cot(phi).
    """
    best, least, before = 0.0, math.inf, math.nan
    low = high = math.nan
    for i in range(COMMANDS):
        command = bounds.steepest * (2.0 * i / (COMMANDS - 1) - 1.0)
        miss = _miss(now, command, theta, piece, pushed, bounds)
        if abs(miss) < least:
            best, least = command, abs(miss)
        if before * miss <= 0.0 and math.isnan(low):
            low, high = command - 2.0 * bounds.steepest / (COMMANDS - 1), command
        before = miss
    if least > AWAY:
        return _of_two_arcs(now, theta, pushed, bounds)
    if math.isnan(low):
        return best
    first = _miss(now, low, theta, piece, pushed, bounds)
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        miss = _miss(now, middle, theta, piece, pushed, bounds)
        if miss * first > 0.0:
            low = middle
        else:
            high = middle
    return (low + high) / 2.0


@compiled
def _of_two_arcs(now: Situation, theta: float, pushed: Pushed, bounds: Bounds) -> float:
    """Return the first command of the push of two arcs on which theta is least away."""
    best, least = 0.0, math.inf
    for first in STEEPNESSES:
        for second in STEEPNESSES:
            for switch in SWITCHES:
                cost = _cost(
                    *(now, first * bounds.steepest, second * bounds.steepest, switch),
                    *(theta, pushed, bounds),
                )
                if cost < least:
                    best, least = first * bounds.steepest, cost
    return best


@compiled
def _cost(
    now: Situation,
    first: float,
    second: float,
    switch: float,
    theta: float,
    pushed: Pushed,
    bounds: Bounds,
) -> float:
    """Return how far theta is away over the horizon, and what is beyond bounds.

    As soon as the second arc has brought theta there, it is taken to stay.
    """
    cost, side = 0.0, 0.0
    for k in range(int(HORIZON / COARSE)):
        command = first if k * COARSE < switch else second
        now, pushes = bounded_step(now, command, COARSE, pushed, bounds)
        if not pushes:
            return cost + LOST
        off = now.theta - theta
        d, x, _ = outside(now, pushed, bounds)
        cost += COARSE * (abs(off) + D_WEIGHT * d + X_WEIGHT * x)
        if off * side < 0.0:
            break
        side = off
    return cost
