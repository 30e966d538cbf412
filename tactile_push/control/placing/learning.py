# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The push from which most is learned of d.

A reading of theta is the more worth, the more theta depends on d and the less on c and on its own
start. Of pushes of two arcs the one is chosen after which d is known best (Fisher's information of
its readings with the present spreads as one more reading), among those that stay away from the
ends of the edge, of the workspace and of theta.
"""

import math
from typing import NamedTuple

from tactile_push.control.placing.model import Bounds, Pushed, Situation, outside, step
from tactile_push.mechanics.compiled import compiled
from tactile_push.mechanics.resistance import Pressure

STEEPNESSES = (-1.0, -0.5, 0.0, 0.5, 1.0)
ARC = 0.008  # belt of an arc [m]
STEP = 1e-3  # [m]
# Weights of what is beyond bounds, and of how far the object is turned; picked.
D_WEIGHT, X_WEIGHT, THETA_WEIGHT, TURN_WEIGHT = 2e3, 2e3, 40.0, 2.0


class Spread(NamedTuple):
    """How well is known what a push depends on, as standard deviations."""

    theta: float  #: of the angle of the edge [rad]
    d: float  #: of the contact [m]
    log_c: float  #: of the logarithm of c
    noise: float  #: of a reading of theta [rad]
    reading: float  #: belt from one reading to the next [m]


@compiled
def telling_command(
    now: Situation, pushed: Pushed, bounds: Bounds, spread: Spread, aim: float
) -> float:
    """Return the command with which to begin in order to learn d.

    Parameters
    ----------
    now, pushed, bounds, spread : Situation, Pushed, Bounds, Spread
        What is believed.
    aim : float
        Angle near which to stay [rad].
    """
    best, command = math.inf, 0.0
    for first in STEEPNESSES:
        for second in STEEPNESSES:
            value = _value(
                first * bounds.steepest, second * bounds.steepest, now, pushed, bounds, spread, aim
            )
            if value < best:
                best, command = value, first * bounds.steepest
    return command


@compiled
def _value(
    first: float,
    second: float,
    now: Situation,
    pushed: Pushed,
    bounds: Bounds,
    spread: Spread,
    aim: float,
) -> float:
    """Return the logarithm of the variance of d after a push, and what is against it."""
    middle = now
    other_d = Situation(now.x, now.theta, now.d + spread.d / 2.0, now.u, now.command)
    other_c = now
    soft = pushed.pressure
    harder = Pushed(
        pushed.l,
        pushed.r,
        Pressure(
            soft.c_squared * math.exp(spread.log_c),
            soft.growth,
            soft.shape,
            soft.moments,
            soft.tilt,
        ),
        pushed.cos_alpha,
        pushed.sin_alpha,
        pushed.turning,
        pushed.lag,
    )
    # Information in units of the spreads: of theta at the start, d and ln c.
    tt, td, tc, dd, dc, cc = 1.0, 0.0, 0.0, 1.0, 0.0, 1.0
    weight = STEP / spread.reading / spread.noise**2
    against = 0.0
    for k in range(int(2.0 * ARC / STEP)):
        command = first if k * STEP < ARC else second
        middle, pushes = step(middle, command, STEP, pushed)
        other_d, pushes_d = step(other_d, command, STEP, pushed)
        other_c, pushes_c = step(other_c, command, STEP, harder)
        if not (pushes and pushes_d and pushes_c):
            return math.inf
        by_t = spread.theta
        by_d = 2.0 * (other_d.theta - middle.theta)
        by_c = 2.0 * (other_c.theta - middle.theta)
        tt += weight * by_t * by_t
        td += weight * by_t * by_d
        tc += weight * by_t * by_c
        dd += weight * by_d * by_d
        dc += weight * by_d * by_c
        cc += weight * by_c * by_c
        low = Situation(middle.x, middle.theta, middle.d - 1.5 * spread.d, 0.0, 0.0)
        high = Situation(middle.x, middle.theta, middle.d + 1.5 * spread.d, 0.0, 0.0)
        for end in (low, high):
            d, x, theta = outside(end, bounds)
            against += STEP / ARC * (D_WEIGHT * d + X_WEIGHT * x + THETA_WEIGHT * theta)
    determinant = tt * (dd * cc - dc * dc) - td * (td * cc - dc * tc) + tc * (td * dc - dd * tc)
    variance = (tt * cc - tc * tc) / determinant
    return math.log(variance) / 2.0 + against + TURN_WEIGHT * (middle.theta - aim) ** 2
