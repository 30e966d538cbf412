# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The best push from where the object is to a goal, over the belt that is left."""

import math

import numpy as np

from tactile_push.control.placing.arcs import UNKNOWNS
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation
from tactile_push.control.placing.refinement import refine
from tactile_push.control.placing.search import (
    COLUMNS,
    FAMILIES,
    ROUNDABOUT,
    arcs,
    search,
    search_roundabout,
)
from tactile_push.mechanics.compiled import Array, compiled

# What more tries are not worth: a miss at the end [m, rad].
X_ENOUGH, THETA_ENOUGH = 1e-4, math.radians(0.1)


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
    roundabout: bool,
    push: Array,
) -> tuple[float, float, float, float]:
    """Search from nothing and refine the best few; write the best push."""
    found = np.empty((ROUNDABOUT if roundabout else FAMILIES, COLUMNS))
    if roundabout:
        search_roundabout(start, goal, pushed, bounds, least, most, found)
    else:
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
