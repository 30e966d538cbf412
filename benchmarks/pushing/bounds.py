# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well measured pushes can tell the fitted numbers, whoever fits them (Cramér and Rao)."""

import math

import numpy as np
import numpy.typing as npt

from pushing.fitting import Point, Search
from pushing.predicting import final_poses

STEP_SPREAD, STEP_MU_C, STEP_OFFSET = 0.05, 0.01, 0.01  # of differences; the last in c
FINEST = 1e-7  # residual that a measurement leaves at least [m]
MAD = 1.4826  # standard deviation of a normal distribution over its median absolute value


def standard_deviations(search: Search, point: Point) -> dict[str, float]:
    """Return the least standard deviations of c, mu_c and the centre of friction.

    From the sensitivities of the final poses, if errors were independent, normal, and as wide as
    the residuals of the prediction are at their median. Empty if the pushes leave one of the
    numbers open.
    """
    poses = _scaled(search, point)
    ends = np.array([tuple(end) for end in search.pushes.ends])
    residuals = poses - ends * [1.0, 1.0, search.length]
    turn = math.tau * search.length
    residuals[:, 2] -= turn * np.round(residuals[:, 2] / turn)
    sigma = np.maximum(MAD * np.median(np.abs(residuals), axis=0), FINEST)
    sensitivities = []
    steps = np.array([STEP_SPREAD, STEP_MU_C, *[STEP_OFFSET * search.length] * 2])
    for i, step in enumerate(np.diag(steps)):
        lower, upper = (search.allowed(np.add(point, sign * step)) for sign in (-1.0, 1.0))
        change = _scaled(search, upper) - _scaled(search, lower)
        if i == 0:  # c, whose rate by the spread may be 0
            by = search.physics(upper).support.c - search.physics(lower).support.c
        else:
            by = upper[i] - lower[i]
        sensitivities.append((change / by / sigma).ravel())
    rates = np.array(sensitivities)
    if np.linalg.matrix_rank(rates) < len(rates):
        return {}
    c, mu_c, x, y = np.sqrt(np.diag(np.linalg.inv(rates @ rates.T))).tolist()
    return {'c_mm': 1000.0 * c, 'mu_c': mu_c, 'x_mm': 1000.0 * x, 'y_mm': 1000.0 * y}


def _scaled(search: Search, point: Point) -> npt.NDArray[np.float64]:
    """Return predicted final poses, the angles as lengths [m]."""
    poses = final_poses(search.pushes, search.physics(point))
    return np.array([tuple(pose) for pose in poses]) * [1.0, 1.0, search.length]
