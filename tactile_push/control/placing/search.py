# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Searches pushes of a few arcs over all the belt that is left.

The search tries pushes that turn the object, let it translate and turn it again, and pushes of two
arcs, which on a leaf without bounds are the shortest ones (docs/placing.md). Where none of them
leads to the goal, another push before the first turn may: it brings the contact elsewhere.
"""

import math

from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    outside,
    rolled,
    step,
    translating,
)
from tactile_push.mechanics.compiled import Array, compiled, equation

SEARCH_STEP = 3e-3  # of the belt in the search [m]
BRANCH = 4  # steps of the search from one place to switch to the next
STEEPNESSES = (1.0, 0.55, 0.25)  # of the arcs, of the steepest
SECOND = (-1.0, -0.4, 0.4)  # of the second of two arcs
ANGLES = 25  # at which the search lets the object translate
FAMILIES = ANGLES * len(STEEPNESSES) + 2 * len(STEEPNESSES) * len(SECOND)
LONGEST_TURN = 0.08  # belt of one turn in the search [m]
COLUMNS = 1 + UNKNOWNS  # of what the search finds: cost, commands, and belt to the end of each [m]
# Pushes before the first turn, commands as shares of the steepest and belt [m], and how often the
# search lets the object translate after each, at which steepnesses.
FIRST, FIRST_WAYS = (-1.0, -0.5, 0.5, 1.0), (0.009, 0.021, 0.042)
FEW_ANGLES, FEW_STEEPNESSES = 13, (1.0, 0.55)
ROUNDABOUT = len(FIRST) * len(FIRST_WAYS) * FEW_ANGLES * len(FEW_STEEPNESSES)
# How far the search may go beyond bounds: d, x [m], theta [rad].
D_GRACE, X_GRACE, THETA_GRACE = 1e-3, 1e-3, math.radians(3.0)


@equation
def _is_outside(now: Situation, pushed: Pushed, bounds: Bounds) -> bool:
    """Return whether anything is beyond its bounds."""
    d, x, theta = outside(now, pushed, bounds)
    return d > 0.0 or x > 0.0 or theta > 0.0


@equation
def _widened(start: Situation, pushed: Pushed, bounds: Bounds) -> Bounds:
    """Return bounds for the search, which the start keeps to."""
    d, x, theta = outside(start, pushed, bounds)
    d, x, theta = d + D_GRACE, x + X_GRACE, theta + THETA_GRACE
    return Bounds(
        bounds.steepest,
        bounds.rate,
        bounds.x_min - x,
        bounds.x_max + x,
        bounds.d_min - d,
        bounds.d_max + d,
        bounds.theta_max + theta,
        bounds.felt + theta,
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
        if not pushes or _is_outside(after, pushed, bounds):
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

    A row of `found` is cost, commands of four arcs, and the belt to the end of each [m]. The cost
    is the square of what is missed, in millimetres and degrees, and the belt in `LENGTH`s.
    """
    row, theta_max = 0, bounds.theta_max
    bounds = _widened(start, pushed, bounds)
    for i in range(ANGLES):
        angle = theta_max * (2.0 * i / (ANGLES - 1) - 1.0)
        for steepness in STEEPNESSES:
            first, first_u, first_s, there = _turn(start, angle, steepness, pushed, bounds)
            found[row, 0] = math.inf
            if there:
                cost, drift, way, last_u, length = _translate(
                    first, first_s, steepness, goal, pushed, bounds, least, most
                )
                _write(found[row], cost, first_u, drift, drift, last_u)
                _write_ends(found[row], first_s, first_s + way / 2.0, first_s + way, length)
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
                    if not pushes or _is_outside(now, pushed, bounds):
                        break
                row += 1


@compiled
def search_roundabout(
    start: Situation,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
    found: Array,
) -> None:
    """Find pushes of four arcs, another push before turn, translation and turn.

    The arguments are those of `search`, but for `ROUNDABOUT` rows.
    """
    row, theta_max = 0, bounds.theta_max
    bounds = _widened(start, pushed, bounds)
    found[:ROUNDABOUT, 0] = math.inf
    for share in FIRST:
        now, s, inside = start, 0.0, True
        command = share * bounds.steepest
        for end in FIRST_WAYS:
            while inside and s < end - SEARCH_STEP / 2.0:
                now, pushes = step(now, command, SEARCH_STEP, pushed)
                inside = pushes and not _is_outside(now, pushed, bounds)
                s += SEARCH_STEP
            for i in range(FEW_ANGLES):
                angle = theta_max * (2.0 * i / (FEW_ANGLES - 1) - 1.0)
                for steepness in FEW_STEEPNESSES:
                    if inside:
                        first, first_u, first_s, there = _turn(
                            now, angle, steepness, pushed, bounds
                        )
                        if there:
                            cost, drift, way, last_u, length = _translate(
                                first, s + first_s, steepness, goal, pushed, bounds, least, most
                            )
                            _write(found[row], cost, command, first_u, drift, last_u)
                            _write_ends(found[row], s, s + first_s, s + first_s + way, length)
                    row += 1


@equation
def _write(row: Array, cost: float, a: float, b: float, c: float, d: float) -> None:
    """Write cost and commands of a push."""
    row[0], row[1], row[2], row[3], row[4] = cost, a, b, c, d


@equation
def _write_ends(row: Array, a: float, b: float, c: float, d: float) -> None:
    """Write the belt to the end of each arc [m]."""
    row[5], row[6], row[7], row[8] = a, b, c, d


@compiled
def _translate(
    now: Situation,
    first_s: float,
    steepness: float,
    goal: Goal,
    pushed: Pushed,
    bounds: Bounds,
    least: float,
    most: float,
) -> tuple[float, float, float, float, float]:
    """Translate from where the first turn ended, as long as the last one asks for.

    Returns cost, command and belt of the translation [m], command of the last turn and belt in all
    [m]; an infinite cost if it is not possible.
    """
    nothing = math.inf, 0.0, 0.0, 0.0, 0.0
    # What turns on the way there goes on while the finger gets to its new command.
    drift = translating(now, pushed)
    if abs(drift) > bounds.steepest:
        return nothing
    rest = Situation(now.x, now.theta, now.d, drift, drift)
    after, last_u, last_s, there = _turn(rest, goal.theta, steepness, pushed, bounds)
    if not there:
        return nothing
    missing = goal.x - centre_of_mass(after, pushed)
    rate = drift * (1.0 - rolled(now, pushed) * math.cos(now.theta))  # of the object's x
    way = missing / rate if rate != 0.0 else 0.0
    longest = max(most - first_s - last_s, 0.0)
    way = min(max(way, least - first_s - last_s, 0.0), longest)
    end = now.x + drift * way
    if first_s + last_s > most or end < bounds.x_min or end > bounds.x_max:
        return nothing
    x_error = (missing - rate * way) / 1e-3
    length = first_s + way + last_s
    return x_error * x_error + length / LENGTH, drift, way, last_u, length


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
        if not pushes or _is_outside(now, pushed, bounds):
            return
        if s >= least:
            x_error = (centre_of_mass(now, pushed) - goal.x) / 1e-3
            theta_error = math.degrees(now.theta - goal.theta)
            cost = x_error * x_error + theta_error * theta_error + s / LENGTH
            if cost < best[0]:
                _write(best, cost, first, second, second, second)
                _write_ends(best, switch, switch, switch, s)


@compiled
def arcs(row: Array, push: Array) -> None:
    """Write a row of the search as a push."""
    for i in range(ARCS):
        push[i] = row[1 + i]
        push[ARCS + i] = row[1 + ARCS + i] / LENGTH
    for i in range(UNKNOWNS - 1, ARCS, -1):
        push[i] -= push[i - 1]
