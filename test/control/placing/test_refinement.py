# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0


import numpy as np
from scipy.optimize import least_squares

from support.sticking_block import STICKING
from tactile_push.control.placing import refinement
from tactile_push.control.placing.arcs import ARCS
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Situation,
)

STEEPEST = 1.5
BOUNDS = Bounds(STEEPEST, 1e9, -0.1, 0.1, -0.022, 0.022, 0.8)


def test_the_least_squares_agree_with_scipy():
    start, goal, numbers = Situation(0.0, 0.2, 0.003, 0.0, 0.0), Goal(-0.03, -0.1), STICKING
    first = np.array((0.5, -0.4, -0.6, -1.2, 0.08, 0.08, 0.08, 0.18))
    counts = np.array((9, 9, 9, 16))

    def missed(push):
        out = np.empty(refinement.RESIDUALS)
        refinement.residuals(push, counts, start, goal, numbers, BOUNDS, 0.0, 0.3, out)
        return out

    high = np.array((STEEPEST,) * ARCS + (3.0,) * ARCS)
    low = np.array((-STEEPEST,) * ARCS + (0.0,) * ARCS)
    oracle = least_squares(missed, first, bounds=(low, high), x_scale='jac', xtol=1e-10, ftol=1e-10)
    push = first.copy()
    cost, x, theta, beyond = refinement.refine(push, start, goal, numbers, BOUNDS, 0.0, 0.3, 60)
    assert 0.999 * oracle.cost <= cost <= 1.03 * oracle.cost
    assert abs(x) < 2e-6
    assert abs(theta) < 1e-4
    assert beyond < 1.0
