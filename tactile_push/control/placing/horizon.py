# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes that bring an object to a goal: searched over the belt, refined by least squares.

A push is a few arcs, each a command and the belt on which it is given. The search tries pushes that
turn the object, let it translate and turn it again, and pushes of two arcs, which on a leaf
without bounds are the shortest ones (docs/placing.md). Levenberg and Marquardt's method then frees
all commands and lengths.
"""

import math

import numpy as np
import numpy.typing as npt

from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    outside,
    step,
)
from tactile_push.mechanics.compiled import Array, compiled, equation

Counts = npt.NDArray[np.int64]

ARCS = 4
UNKNOWNS = 2 * ARCS  # commands, then lengths in units of `LENGTH`
LENGTH = 0.1  # [m]
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
# What more tries are not worth: a miss at the end [m, rad].
X_ENOUGH, THETA_ENOUGH = 1e-4, math.radians(0.1)
SEARCH_STEP = 3e-3  # of the belt in the search [m]
BRANCH = 4  # steps of the search from one place to switch to the next
STEEPNESSES = (1.0, 0.55, 0.25)  # of the arcs, of the steepest
SECOND = (-1.0, -0.4, 0.4)  # of the second of two arcs
ANGLES = 25  # at which the search lets the object translate
FAMILIES = ANGLES * len(STEEPNESSES) + 2 * len(STEEPNESSES) * len(SECOND)
LONGEST_TURN = 0.08  # belt of one turn in the search [m]
# How far the search may go beyond bounds: d, x [m], theta [rad].
D_GRACE, X_GRACE, THETA_GRACE = 1e-3, 1e-3, math.radians(3.0)
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
    d_out = x_out = theta_out = 0.0
    for i in range(ARCS):
        h = push[ARCS + i] * LENGTH / counts[i]
        length += push[ARCS + i] * LENGTH
        change = bounds.rate * h
        for _ in range(counts[i]):
            command = min(max(push[i], now.command - change), now.command + change)
            now, pushes = step(now, command, h, pushed)
            if not pushes:
                return math.inf
            d, x, theta = outside(now, bounds)
            d_out += h * d * d
            x_out += h * x * x
            theta_out += h * theta * theta
    whole = max(length, REFINED_STEP)
    out[0] = (centre_of_mass(now, pushed) - goal.x) / X_UNIT
    out[1] = (now.theta - goal.theta) / THETA_UNIT
    out[2] = math.sqrt(d_out / whole) / D_OUTSIDE
    out[3] = math.sqrt(x_out / whole) / X_OUTSIDE
    out[4] = math.sqrt(theta_out / whole) / THETA_OUTSIDE
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
def _solve(matrix: Array, vector: Array) -> bool:
    """Solve a positive definite system in place, by Cholesky's method; False if it is not."""
    n = len(vector)
    for i in range(n):
        for j in range(i + 1):
            value = matrix[i, j]
            for k in range(j):
                value -= matrix[i, k] * matrix[j, k]
            if i == j:
                if not value > 0.0:
                    return False
                matrix[i, i] = math.sqrt(value)
            else:
                matrix[i, j] = value / matrix[j, j]
    for i in range(n):
        for k in range(i):
            vector[i] -= matrix[i, k] * vector[k]
        vector[i] /= matrix[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            vector[i] -= matrix[k, i] * vector[k]
        vector[i] /= matrix[i, i]
    return True


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
            if _solve(matrix, trial):
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


@equation
def _is_outside(now: Situation, bounds: Bounds) -> bool:
    """Return whether anything is beyond its bounds."""
    d, x, theta = outside(now, bounds)
    return d > 0.0 or x > 0.0 or theta > 0.0


@equation
def _widened(start: Situation, bounds: Bounds) -> Bounds:
    """Return bounds for the search, which the start keeps to."""
    d, x, theta = outside(start, bounds)
    d, x, theta = d + D_GRACE, x + X_GRACE, theta + THETA_GRACE
    return Bounds(
        bounds.steepest,
        bounds.rate,
        bounds.x_min - x,
        bounds.x_max + x,
        bounds.d_min - d,
        bounds.d_max + d,
        bounds.theta_max + theta,
    )


@compiled
def _turn(
    now: Situation, theta: float, steepness: float, pushed: Pushed, bounds: Bounds
) -> tuple[Situation, float, float, bool]:
    """Turn the object to an angle as fast as a steepness allows.

    Returns what is then, the command, the belt that it took [m], and whether it got there.
    """
    command = math.copysign(steepness * bounds.steepest, theta - now.theta)
    s, h = 0.0, SEARCH_STEP
    while s < LONGEST_TURN:
        after, pushes = step(now, command, h, pushed)
        if not pushes or _is_outside(after, bounds):
            return now, command, s, False
        if (after.theta - theta) * command >= 0.0 and (after.theta - now.theta) * command > 0.0:
            share = (theta - now.theta) / (after.theta - now.theta)
            if share <= 0.0:  # it was there
                return now, command, s, True
            after, pushes = step(now, command, share * h, pushed)
            return after, command, s + share * h, True
        now = after
        s += h
    return now, command, s, False


@compiled
def search(
    start: Situation,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    found: Array,
) -> None:
    """Find pushes of three arcs (turn, translate, turn) and of two, over every length.

    A row of `found` is cost, commands of the three arcs, and the belt to the end of each [m]. The
    cost is the square of what is missed, in millimetres and degrees, and the belt in `LENGTH`s.
    """
    row, theta_max = 0, bounds.theta_max
    bounds = _widened(start, bounds)
    for i in range(ANGLES):
        angle = theta_max * (2.0 * i / (ANGLES - 1) - 1.0)
        for steepness in STEEPNESSES:
            found[row, 0] = math.inf
            first, first_u, first_s, there = _turn(start, angle, steepness, pushed, bounds)
            if there:
                _translate(
                    *(first, first_u, first_s, steepness, goal, pushed, bounds, least, most),
                    found[row],
                )
            row += 1
    h = SEARCH_STEP
    for sign in (-1.0, 1.0):
        for out in STEEPNESSES:
            for back in SECOND:
                first_u, second_u = sign * out * bounds.steepest, sign * back * bounds.steepest
                found[row, 0] = math.inf
                now = start
                for k in range(int(most / h)):
                    if k % BRANCH == 0:
                        _branch(
                            *(now, k * h, first_u, second_u, goal, pushed, bounds, least, most),
                            found[row],
                        )
                    now, pushes = step(now, first_u, h, pushed)
                    if not pushes or _is_outside(now, bounds):
                        break
                row += 1


@compiled
def _translate(
    now: Situation,
    first_u: float,
    first_s: float,
    steepness: float,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    best: Array,
) -> None:
    """Translate from where the first turn ended, as long as the last one asks for."""
    # What turns on the way there goes on while the finger gets to its new command.
    drift = -math.tan(now.theta + math.atan2(now.d, pushed.l))
    if abs(drift) > bounds.steepest:
        return
    rest = Situation(now.x, now.theta, now.d, drift, drift)
    after, last_u, last_s, there = _turn(rest, goal.theta, steepness, pushed, bounds)
    if not there:
        return
    missing = goal.x - centre_of_mass(after, pushed)
    way = missing / drift if drift != 0.0 else 0.0
    longest = max(most - first_s - last_s, 0.0)
    way = min(max(way, least - first_s - last_s, 0.0), longest)
    end = now.x + drift * way
    if first_s + last_s > most or end < bounds.x_min or end > bounds.x_max:
        return
    x_error = (missing - drift * way) / 1e-3
    length = first_s + way + last_s
    cost = x_error * x_error + length / LENGTH
    best[0], best[1], best[2], best[3] = cost, first_u, drift, last_u
    best[4], best[5], best[6] = first_s, first_s + way, length


@compiled
def _branch(
    now: Situation,
    switch: float,
    first: float,
    second: float,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    best: Array,
) -> None:
    """Go on with the second arc, and note where the goal is nearest."""
    h = SEARCH_STEP
    s = switch
    while s + h <= most:
        now, pushes = step(now, second, h, pushed)
        s += h
        if not pushes or _is_outside(now, bounds):
            return
        if s >= least:
            x_error = (centre_of_mass(now, pushed) - goal.x) / 1e-3
            theta_error = math.degrees(now.theta - goal.theta)
            cost = x_error * x_error + theta_error * theta_error + s / LENGTH
            if cost < best[0]:
                best[0], best[1], best[2], best[3] = cost, first, second, second
                best[4], best[5], best[6] = switch, switch, s


@compiled
def arcs(row: Array, push: Array) -> None:
    """Write a row of the search as a push; what it translates is two arcs."""
    push[0], push[1], push[2], push[3] = row[1], row[2], row[2], row[3]
    half = (row[5] - row[4]) / 2.0
    push[4], push[5], push[6], push[7] = row[4], half, half, row[6] - row[5]
    for i in range(ARCS, UNKNOWNS):
        push[i] /= LENGTH


@compiled
def rest_of(push: Array, way: float, rest: Array) -> None:
    """Write what is left of a push after a piece of belt [m].

    For an arc that is over the longest of the others becomes two.
    """
    rest[:] = push
    left = way / LENGTH
    while left > 0.0 or rest[ARCS] == 0.0:
        used = min(left, rest[ARCS])
        rest[ARCS] -= used
        left -= used
        if rest[ARCS] > 0.0:
            break
        longest = 1
        for i in range(2, ARCS):
            if rest[ARCS + i] > rest[ARCS + longest]:
                longest = i
        if rest[ARCS + longest] == 0.0:
            break
        for i in range(longest):
            rest[i] = rest[i + 1]
            rest[ARCS + i] = rest[ARCS + i + 1]
        rest[ARCS + longest - 1] /= 2.0
        rest[ARCS + longest] /= 2.0


@compiled
def plan(
    start: Situation,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    tries: int,
    more: int,
    rounds: int,
    push: Array,
) -> tuple[float, float, float, float]:
    """Search from nothing and refine the best few; write the best push."""
    found = np.empty((FAMILIES, 7))
    search(start, goal, pushed, bounds, least, most, found)
    best = (math.inf, math.inf, math.inf, math.inf)
    trial = np.empty(UNKNOWNS)
    for k in range(more):
        missed = abs(best[1]) > X_ENOUGH or abs(best[2]) > THETA_ENOUGH
        if k >= tries and not missed:
            break
        i = np.argmin(found[:, 0])
        if not found[i, 0] < math.inf:
            break
        arcs(found[i], trial)
        found[i, 0] = math.inf
        told = refine(trial, start, goal, pushed, bounds, least, most, rounds)
        if told[0] < best[0]:
            best = told
            push[:] = trial
    return best
