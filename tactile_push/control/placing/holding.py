# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The push that brings an object to a place across the belt and carries it straight ahead there.

A push is given on pieces of the belt ahead, short ones first: on each of them, by how much the
command differs from the one under which the object would translate. It is improved by least squares
on the mechanics with friction, so that the contact slips where that helps. docs/steering.md says
what for.
"""

import math

import numpy as np

from tactile_push.control.placing.model import (
    Bounds,
    Pushed,
    Situation,
    ahead,
    bounded_step,
    centre_of_mass,
    outside,
    rolled,
)
from tactile_push.control.placing.solving import solve
from tactile_push.mechanics.compiled import Array, compiled, equation

PIECES: Array = 1e-3 * np.array((1.0, 1.5, 2.5, 4.0, 6.0, 10.0, 15.0, 25.0, 45.0, 80.0, 120.0))
COUNT = len(PIECES)
SHORTEST, FEWEST = 2e-3, 12  # a step [m], or so many in a piece if they are longer
STEPS: Array = np.ceil(PIECES / np.maximum(SHORTEST, PIECES / FEWEST)).astype(np.int64)
RATE = 14.0  # at which what is off is brought back, for each metre of belt; picked
FASTER = 1.5  # than the slow mode that is at least
AIMED = math.tan(math.radians(5.0))  # way aside on which a distant goal is approached, of the belt
# Weights beside x [mm]: of d beyond where a contact sticks [mm], of a command's difference from the
# translating one, and of what is beyond bounds or asks for more than the steepest command; picked.
BEYOND, EFFORT, OUTSIDE, TOO_STEEP = 1.0, 1.0, 3e4, 10.0
STEEP_THETA = 0.03  # by which theta beyond its bound counts as metres beyond theirs [m/rad]
LOST = 1e3  # of a push that loses the object
MILLIMETRE = 1e3  # of a metre
MOST = 3.0  # largest difference of a command
NO_LIMIT = 1e3  # of d where the contact sticks however it is pushed [m]
RESIDUALS = 4 * COUNT + 3
# Of the method: what is added for differences, factors of the diagonal tried in a round, its first
# factor and what keeps it from 0, and the share of the cost whose gain is not worth another round.
NUDGE, DAMPINGS, FIRST, FLOOR, ENOUGH = 1e-4, 5, 1e-2, 1e-9, 1e-3
GOING_ON, ANEW = 3, 6  # rounds for the push before, and for one from elsewhere
CLEARLY = 0.8  # of the cost of the push before, below which another one takes its place
# Where pushes from elsewhere begin, one in each control period: as the linear law would push, or
# one way over some belt and the other way over as much [m].
PULSES = ((1.0, 8e-3), (-1.0, 8e-3), (2.0, 5e-3), (-2.0, 5e-3), (1.0, 0.02), (-1.0, 0.02))
LOOKED, LOOK_STEP = 0.3, 2.5e-3  # belt on which the linear law is to hold, and a step of it [m]
BEGINNINGS = 1 + len(PULSES)
_PULSES: Array = np.array(PULSES)


@equation
def _off(now: Situation, goal: float, pushed: Pushed) -> tuple[float, float, float]:
    """Return by how much x is off, e, and by how much d is beyond where it sticks [mm]."""
    limit = NO_LIMIT
    if pushed.cos_alpha > 0.0:
        limit = pushed.l * pushed.sin_alpha / pushed.cos_alpha
    sticking = min(max(now.d, -limit), limit)
    x = centre_of_mass(now, pushed) - goal
    e = sticking + pushed.l * math.tan(now.theta)
    return MILLIMETRE * x, MILLIMETRE * e, MILLIMETRE * (now.d - sticking)


@equation
def linear_command(
    now: Situation, goal: float, pushed: Pushed, bounds: Bounds
) -> tuple[float, bool]:
    """Return the command of the law (S7), as far as the contact sticks, and whether it does."""
    l, r, theta, d = pushed.l, pushed.r, now.theta, now.d
    cos, sin = math.cos(theta), math.sin(theta)
    passing = rolled(now, pushed)
    q = passing / (1.0 - passing * cos)
    resisting = pushed.pressure.c_squared + d * d + l * l
    gamma = resisting / l
    e = d + l * math.tan(theta)
    x = now.x - r * sin - e * cos - goal  # (S1)
    growth = -q / l
    effect = max(l / cos**2 - r + gamma * q, 0.1 * l)
    shift = max(l - r + l * q, 0.1 * l)
    p = max(RATE, FASTER * growth)
    by_x = p * p * l / shift
    by_e = (2.0 * p + growth + (gamma - l) * by_x) / effect
    most = l * AIMED * by_e / by_x
    turn = by_x * min(max(x, -most), most) - by_e * e
    command = (turn * resisting - (d * cos + l * sin)) / (l * cos - d * sin - l * passing)
    # The force acts as the centre of mass moves; its parts along tangent and normal are linear in
    # the command, and so are the edges of the friction cone.
    wanted = command
    turn_slope = (l * (cos - passing) - d * sin) / resisting
    turn_still = (d * cos + l * sin) / resisting
    t_slope, t_still = cos - passing - l * turn_slope, sin - l * turn_still
    n_slope, n_still = -sin - d * turn_slope, cos - d * turn_still
    for side in (-1.0, 1.0):
        slope = side * pushed.cos_alpha * t_slope - pushed.sin_alpha * n_slope
        still = side * pushed.cos_alpha * t_still - pushed.sin_alpha * n_still
        if slope > 0.0:
            command = min(command, -still / slope)
        elif slope < 0.0:
            command = max(command, -still / slope)
    sticks = command == wanted
    return min(max(command, -bounds.steepest), bounds.steepest), sticks


@compiled
def linear_holds(now: Situation, goal: float, pushed: Pushed, bounds: Bounds) -> bool:
    """Return whether the contact sticks under the law (S7), and stays within bounds, for a while.

    Parameters
    ----------
    now : Situation
        Where finger and object are.
    goal : float
        Where the centre of mass shall be across the belt [m].
    pushed, bounds : Pushed, Bounds
        The object, and what bounds commands, contact and angle.
    """
    for _ in range(math.ceil(LOOKED / LOOK_STEP)):
        command, sticks = linear_command(now, goal, pushed, bounds)
        if not sticks:
            return False
        now, pushes = bounded_step(now, command, LOOK_STEP, pushed, bounds)
        d, x, theta = outside(now, pushed, bounds)
        if not pushes or d + x + theta > 0.0:
            return False
    return True


@compiled
def _follow(
    push: Array, now: Situation, goal: float, pushed: Pushed, bounds: Bounds, found: Array
) -> None:
    """Write the residuals of a push; their squares are an integral over the belt and a rest."""
    lead = 1.0 / (pushed.l * RATE)  # by how much e, until it is brought back, carries x aside
    for i in range(COUNT):
        h, beyond = PIECES[i] / STEPS[i], 0.0
        for _ in range(STEPS[i]):
            wanted = ahead(now, pushed, bounds) + push[i]
            command = min(max(wanted, -bounds.steepest), bounds.steepest)
            now, pushes = bounded_step(now, command, h, pushed, bounds)
            d, x, theta = outside(now, pushed, bounds)
            beyond += h * (
                OUTSIDE * (d + x + STEEP_THETA * theta) + TOO_STEEP * abs(wanted - command)
            )
            if not pushes:
                beyond += h * LOST
        x, e, aside = _off(now, goal, pushed)
        root = math.sqrt(PIECES[i])
        found[4 * i] = root * x
        found[4 * i + 1] = root * lead * e
        found[4 * i + 2] = root * BEYOND * aside + beyond / root
        found[4 * i + 3] = root * EFFORT * push[i]
    x, e, aside = _off(now, goal, pushed)
    left = x - lead * e
    rest = abs(left) ** 3 / (3.0 * MILLIMETRE * AIMED) + left * left / (2.0 * RATE)
    found[4 * COUNT] = math.copysign(math.sqrt(rest), left)
    found[4 * COUNT + 1] = lead * e / math.sqrt(RATE)
    found[4 * COUNT + 2] = BEYOND * aside / math.sqrt(RATE)


@compiled
def _improve(
    push: Array, now: Situation, goal: float, pushed: Pushed, bounds: Bounds, rounds: int
) -> float:
    """Improve a push in place, by Levenberg and Marquardt's method; return its cost."""
    found, nudged = np.empty(RESIDUALS), np.empty(RESIDUALS)
    slopes = np.empty((RESIDUALS, COUNT))
    matrix, step = np.empty((COUNT, COUNT)), np.empty(COUNT)
    _follow(push, now, goal, pushed, bounds, found)
    cost, damping = np.sum(found * found), FIRST
    for _ in range(rounds):
        for j in range(COUNT):
            before = push[j]
            push[j] = before + NUDGE
            _follow(push, now, goal, pushed, bounds, nudged)
            push[j] = before
            slopes[:, j] = (nudged - found) / NUDGE
        gained = 0.0
        for _ in range(DAMPINGS):
            for i in range(COUNT):
                step[i] = -np.sum(slopes[:, i] * found)
                for j in range(COUNT):
                    matrix[i, j] = np.sum(slopes[:, i] * slopes[:, j])
                matrix[i, i] = matrix[i, i] * (1.0 + damping) + FLOOR
            if solve(matrix, step):
                tried = np.minimum(np.maximum(push + step, -MOST), MOST)
                _follow(tried, now, goal, pushed, bounds, nudged)
                new = np.sum(nudged * nudged)
                if new < cost:
                    gained = cost - new
                    push[:] = tried
                    found[:] = nudged
                    cost = new
                    damping = max(0.3 * damping, 1e-6)
                    break
            damping *= 5.0
        if gained <= ENOUGH * cost:
            break
    return cost


@compiled
def _begun(beginning: int, now: Situation, goal: float, pushed: Pushed, bounds: Bounds) -> Array:
    """Return one of the pushes from which to look for a better one."""
    push, way = np.zeros(COUNT), 0.0
    for i in range(COUNT):
        way += PIECES[i]
        if beginning > 0:
            size, belt = _PULSES[beginning - 1, 0], _PULSES[beginning - 1, 1]
            push[i] = size if way <= belt else (-size if way <= 2.0 * belt else 0.0)
            continue
        for _ in range(STEPS[i]):
            command, _ = linear_command(now, goal, pushed, bounds)
            push[i] += (command - ahead(now, pushed, bounds)) / STEPS[i]
            now, _ = bounded_step(now, command, PIECES[i] / STEPS[i], pushed, bounds)
    return push


@compiled
def later(push: Array, way: float) -> Array:
    """Return what is left of a push some way [m] later, on the same pieces."""
    new, ends = np.zeros(COUNT), np.cumsum(PIECES)
    for i in range(COUNT):
        first, last = ends[i] - PIECES[i] + way, ends[i] + way
        for j in range(COUNT):
            end = ends[j] if j < COUNT - 1 else math.inf
            new[i] += max(min(last, end) - max(first, ends[j] - PIECES[j]), 0.0) * push[j]
        new[i] /= PIECES[i]
    return new


@compiled
def holding_push(
    push: Array,
    beginning: int,
    now: Situation,
    goal: float,
    pushed: Pushed,
    bounds: Bounds,
) -> Array:
    """Return the push on the belt ahead, better than the one before.

    Parameters
    ----------
    push : ndarray
        What is left of the one before, or zeros, one number for each of `PIECES`.
    beginning : int
        From where another one is looked for besides, 0 to `BEGINNINGS` - 1.
    now : Situation
        Where finger and object are.
    goal : float
        Where the centre of mass shall be across the belt [m].
    pushed, bounds : Pushed, Bounds
        The object, and what bounds commands, contact and angle.

    Returns
    -------
    ndarray
        By how much the command differs from `ahead` on each of `PIECES`.
    """
    kept = push.copy()
    cost = _improve(kept, now, goal, pushed, bounds, GOING_ON)
    other = _begun(beginning, now, goal, pushed, bounds)
    if _improve(other, now, goal, pushed, bounds, ANEW) < CLEARLY * cost:
        return other
    return kept
