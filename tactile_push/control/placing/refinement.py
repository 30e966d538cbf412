# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Improves a push by least squares: Levenberg and Marquardt's method, with bounds."""

import math

import numpy as np
import numpy.typing as npt

from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    bounded_step,
    centre_of_mass,
    outside,
)
from tactile_push.control.placing.solving import solve
from tactile_push.mechanics.compiled import Array, compiled, equation

Counts = npt.NDArray[np.int64]

# Errors at the end that count as 1: x of the centre of mass [m] and theta [rad]. Far less than is
# asked for, so that the preferences below hardly move the end.
X_UNIT, THETA_UNIT = 2e-5, math.radians(0.02)
# What is preferred among pushes that reach the goal; picked. Belt and effort, the square of the
# command as a share of the steepest, are integrals over the belt, or each new plan would put off
# more than the last one.
BRIEF, EFFORT = 6.0, 10.0  # of a belt of `LENGTH`; a turn is cheapest at 0.77 of the steepest
BEND = 0.03  # weight of differences of commands, which keeps apart what would not matter
SHORT = 1e-4  # what is added to a length before its root [`LENGTH`]
# How far beyond a bound counts as 1: d, x [m], theta [rad] in the root mean square over the belt,
# and the belt [m].
D_OUTSIDE, X_OUTSIDE, THETA_OUTSIDE, BELT_OUTSIDE = 1e-4, 1e-4, math.radians(0.2), 1e-4
BOUNDED = 6  # where the residuals of preferences begin
RESIDUALS = BOUNDED + ARCS + (ARCS - 1) + 1
REFINED_STEP = 1.5e-3  # of the belt in a refined push [m]
FEWEST, MOST = 3, 25  # steps of an arc; a long one hardly turns the object
NUDGE = 1e-6  # for differences, of a command and of a length in units of `LENGTH`
# Of the method: factors of the diagonal tried in a round, their least, what keeps the diagonal from
# 0, and the share of the cost whose gain is not worth another round.
DAMPINGS, LEAST_DAMPING, FLOOR, ENOUGH = 6, 1e-9, 1e-9, 1e-3


@compiled
def _count(push: Array, counts: Counts) -> None:
    """Write into how many steps each arc is cut."""
    for i in range(ARCS):
        counts[i] = min(FEWEST + int(push[ARCS + i] * LENGTH / REFINED_STEP), MOST)


@compiled
def residuals(
    push: Array,
    counts: Counts,
    start: Situation,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    out: Array,
) -> float:
    """Write what a push misses and costs, and return half its square; infinite if contact is lost.

    Parameters
    ----------
    push : ndarray, shape (8,)
        Commands of the arcs and their lengths [`LENGTH`].
    counts : ndarray, shape (4,)
        Steps of each arc.
    start, goal, pushed, bounds : Situation, Goal, Pushed, Bounds
        The task.
    least, most : float
        Bounds of the whole length [m].
    out : ndarray, shape (14,)
        The residuals.
    """
    now, length = start, 0.0
    theta = d_out = x_out = theta_out = 0.0
    for i in range(ARCS):
        h = push[ARCS + i] * LENGTH / counts[i]
        length += push[ARCS + i] * LENGTH
        for _ in range(counts[i]):
            now, pushes = bounded_step(now, push[i], h, pushed, bounds)
            if not pushes:
                return math.inf
            d, x, theta = outside(now, pushed, bounds)
            d_out += h * d * d
            x_out += h * x * x
            theta_out += h * theta * theta
    whole = max(length, REFINED_STEP)
    out[0] = (centre_of_mass(now, pushed) - goal.x) / X_UNIT
    out[1] = (now.theta - goal.theta) / THETA_UNIT
    out[2] = math.sqrt(d_out / whole) / D_OUTSIDE
    out[3] = math.sqrt(x_out / whole) / X_OUTSIDE
    # An end that the sensor does not feel is short, and is none.
    out[4] = math.sqrt(theta_out / whole + theta * theta) / THETA_OUTSIDE
    out[5] = max(least - length, length - most, 0.0) / BELT_OUTSIDE
    for i in range(ARCS):
        out[BOUNDED + i] = math.sqrt(EFFORT * (push[ARCS + i] + SHORT)) * push[i] / bounds.steepest
    for i in range(ARCS - 1):
        out[BOUNDED + ARCS + i] = BEND * (push[i + 1] - push[i]) / bounds.steepest
    out[RESIDUALS - 1] = math.sqrt(BRIEF * (length / LENGTH + SHORT))
    total = 0.0
    for i in range(RESIDUALS):
        total += out[i] * out[i]
    return total / 2.0


@compiled
def refine(
    push: Array,
    start: Situation,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    rounds: int,
) -> tuple[float, float, float, float]:
    """Improve a push in place.

    Parameters
    ----------
    push : ndarray, shape (8,)
        Commands and lengths, changed in place.
    start, goal, pushed, bounds : Situation, Goal, Pushed, Bounds
        The task.
    least, most : float
        Bounds of the whole length [m].
    rounds : int
        Steps of the method at the most.

    Returns
    -------
    cost : float
        Half the sum of squares; infinite if contact is lost.
    x_error, theta_error : float
        By how much the end misses the goal [m, rad].
    beyond : float
        How far it is beyond bounds, in their units.
    """
    low, high = np.zeros(UNKNOWNS), np.empty(UNKNOWNS)
    low[:ARCS], high[:ARCS], high[ARCS:] = -bounds.steepest, bounds.steepest, most / LENGTH
    for i in range(UNKNOWNS):
        push[i] = min(max(push[i], low[i]), high[i])
    counts = np.empty(ARCS, np.int64)
    here, there = np.empty(RESIDUALS), np.empty(RESIDUALS)
    slopes = np.empty((RESIDUALS, UNKNOWNS))
    trial, gradient = np.empty(UNKNOWNS), np.empty(UNKNOWNS)
    normal, matrix = np.empty((UNKNOWNS, UNKNOWNS)), np.empty((UNKNOWNS, UNKNOWNS))
    cost, damping = math.inf, 1e-3
    for _ in range(rounds):
        _count(push, counts)
        cost = residuals(push, counts, start, goal, pushed, bounds, least, most, here)
        if not cost < math.inf:
            break
        for j in range(UNKNOWNS):
            trial[:] = push
            nudge = NUDGE if push[j] + NUDGE <= high[j] else -NUDGE
            trial[j] += nudge
            residuals(trial, counts, start, goal, pushed, bounds, least, most, there)
            for i in range(RESIDUALS):
                slopes[i, j] = (there[i] - here[i]) / nudge
        for j in range(UNKNOWNS):
            gradient[j] = 0.0
            for i in range(RESIDUALS):
                gradient[j] += slopes[i, j] * here[i]
            for m in range(j + 1):
                normal[j, m] = 0.0
                for i in range(RESIDUALS):
                    normal[j, m] += slopes[i, j] * slopes[i, m]
        after = math.inf
        for _ in range(DAMPINGS):
            for j in range(UNKNOWNS):
                for m in range(j):
                    free = not (
                        _held(push, low, high, gradient, j) or _held(push, low, high, gradient, m)
                    )
                    matrix[j, m] = matrix[m, j] = normal[j, m] if free else 0.0
                matrix[j, j] = normal[j, j] + damping * (normal[j, j] + FLOOR)
                trial[j] = 0.0 if _held(push, low, high, gradient, j) else -gradient[j]
            if solve(matrix, trial):
                for j in range(UNKNOWNS):
                    trial[j] = min(max(push[j] + trial[j], low[j]), high[j])
                after = residuals(trial, counts, start, goal, pushed, bounds, least, most, there)
                if after < cost:
                    break
            damping *= 8.0
        if not after < cost:
            break
        gain = cost - after
        push[:], here[:] = trial, there
        cost = after
        damping = max(damping / 8.0, LEAST_DAMPING)
        if gain < ENOUGH * (1.0 + cost):
            break
    beyond = math.sqrt(here[2] ** 2 + here[3] ** 2 + here[4] ** 2 + here[5] ** 2)
    return cost, here[0] * X_UNIT, here[1] * THETA_UNIT, beyond


@equation
def _held(push: Array, low: Array, high: Array, gradient: Array, j: int) -> bool:
    """Return whether a number is at a bound and would leave it."""
    return (push[j] <= low[j] and gradient[j] > 0.0) or (push[j] >= high[j] and gradient[j] < 0.0)
