# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The push from which most is learned of d.

A reading of theta is the more worth, the more theta depends on d and the less on c, on friction and
on its own start. A contact far aside that sticks and one near the middle that slips turn the object
alike until the push changes, so friction has to be told apart, too. Of pushes of two arcs the one
is chosen after which d is known best (Fisher's information of its readings with the present spreads
as one more reading), among those that stay near an angle and away from the ends of the edge, of the
workspace and of theta, also if the contact slips as easily as it may.
"""

import math
from typing import NamedTuple

import numpy as np

from tactile_push.control.placing.model import Bounds, Pushed, Situation, outside, step, translating
from tactile_push.control.placing.solving import solve
from tactile_push.mechanics.compiled import compiled, equation
from tactile_push.mechanics.resistance import Pressure

STEEPNESSES = (-1.0, -0.5, 0.0, 0.5, 1.0)
ARC = 0.008  # belt of an arc [m]
STEP = 1e-3  # [m]
# Weights of what is beyond bounds, and of the mean square of how far the object is turned; picked.
D_WEIGHT, X_WEIGHT, THETA_WEIGHT, TURN_WEIGHT = 2e3, 2e3, 40.0, 80.0
FAR = 1.5  # deviations of d within which the contact is kept on the edge
# What a reading depends on, in units of their spreads.
THETA, D, LOG_C, FRICTION = range(4)
UNKNOWNS = 4


class Spread(NamedTuple):
    """How well is known what a push depends on, as standard deviations."""

    theta: float  #: of the angle of the edge [rad]
    d: float  #: of the contact [m]
    log_c: float  #: of the logarithm of c
    noise: float  #: of a reading of theta [rad]
    reading: float  #: belt from one reading to the next [m]


@compiled
def telling_command(
    now: Situation, pushed: Pushed, slippery: Pushed, bounds: Bounds, spread: Spread, aim: float
) -> float:
    """Return the command with which to begin in order to learn d.

    Parameters
    ----------
    now, pushed, bounds, spread : Situation, Pushed, Bounds, Spread
        What is believed.
    slippery : Pushed
        The same object with the least friction that it may have.
    aim : float
        Angle near which to stay [rad].
    """
    best, command = math.inf, 0.0
    # Beside steep ones: along the normal of the edge, where nothing slips outwards, and what keeps
    # theta as it is.
    others = -math.tan(now.theta), translating(now, pushed)
    for i in range(len(STEEPNESSES) + 2):
        if i < len(STEEPNESSES):
            first = STEEPNESSES[i] * bounds.steepest
        else:
            first = min(max(others[i - len(STEEPNESSES)], -bounds.steepest), bounds.steepest)
        for second in STEEPNESSES:
            value = _value(
                first, second * bounds.steepest, now, pushed, slippery, bounds, spread, aim
            )
            if value < best:
                best, command = value, first
    return command


@compiled
def _step(now: Situation, command: float, pushed: Pushed) -> tuple[Situation, bool]:
    """Move by a `STEP`; a call, as a push is made eight times over."""
    return step(now, command, STEP, pushed)


@compiled
def _value(
    first: float,
    second: float,
    now: Situation,
    pushed: Pushed,
    slippery: Pushed,
    bounds: Bounds,
    spread: Spread,
    aim: float,
) -> float:
    """Return the logarithm of the deviation of d after a push, and what is against it."""
    middle = other_c = other_friction = now
    other_d = _moved(now, now.d + spread.d / 2.0)
    low = _moved(now, max(now.d - FAR * spread.d, min(bounds.d_min, now.d)))
    high = _moved(now, min(now.d + FAR * spread.d, max(bounds.d_max, now.d)))
    low_slips, high_slips = low, high
    harder = _harder(pushed, spread.log_c / 2.0)
    # Information in units of the spreads.
    information, by = np.eye(UNKNOWNS), np.empty(UNKNOWNS)
    by[THETA] = spread.theta
    weight = STEP / spread.reading / spread.noise**2
    against = 0.0
    for k in range(int(2.0 * ARC / STEP)):
        command = first if k * STEP < ARC else second
        middle, pushes = _step(middle, command, pushed)
        other_d, pushes_d = _step(other_d, command, pushed)
        other_c, pushes_c = _step(other_c, command, harder)
        other_friction, pushes_f = _step(other_friction, command, slippery)
        if not (pushes and pushes_d and pushes_c and pushes_f):
            return math.inf
        by[D] = 2.0 * (other_d.theta - middle.theta)
        by[LOG_C] = 2.0 * (other_c.theta - middle.theta)
        by[FRICTION] = (other_friction.theta - middle.theta) / 2.0  # of the interval's end
        for i in range(UNKNOWNS):
            for j in range(UNKNOWNS):
                information[i, j] += weight * by[i] * by[j]
        low, _ = _step(low, command, pushed)
        high, _ = _step(high, command, pushed)
        low_slips, _ = _step(low_slips, command, slippery)
        high_slips, _ = _step(high_slips, command, slippery)
        for one in (low, high, low_slips, high_slips):
            d, x, theta = outside(one, pushed, bounds)
            beyond = D_WEIGHT * d + X_WEIGHT * x + THETA_WEIGHT * theta
            against += STEP / ARC * beyond / 2.0
        against += STEP / (2.0 * ARC) * TURN_WEIGHT * (middle.theta - aim) ** 2
    wanted = np.zeros(UNKNOWNS)
    wanted[D] = 1.0
    solve(information, wanted)
    return math.log(wanted[D]) / 2.0 + against


@equation
def _moved(now: Situation, d: float) -> Situation:
    """Return the same with another contact."""
    return Situation(now.x, now.theta, d, now.u, now.command)


@equation
def _harder(pushed: Pushed, more: float) -> Pushed:
    """Return an object whose ln c is greater."""
    soft = pushed.pressure
    return Pushed(
        pushed.l,
        pushed.r,
        Pressure(
            soft.c_squared * math.exp(2.0 * more),
            soft.growth,
            soft.shape,
            soft.moments,
            soft.tilt,
        ),
        pushed.cos_alpha,
        pushed.sin_alpha,
        pushed.tip,
        pushed.lag,
    )
