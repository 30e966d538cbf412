# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where the object is, as seen from the finger (Section III, use 2)."""

import math

import numpy as np

from tactile_push.estimation.contact_estimator import Estimate
from tactile_push.estimation.translation import centre_on_ray
from tactile_push.mechanics.compiled import Array


def object_pose(estimate: Estimate) -> tuple[Array, Array]:
    """Compute the pose of the centre of mass in the frame of the finger's disk.

    The sensed theta and the estimated d determine it completely; to first order in their errors.

    Parameters
    ----------
    estimate : Estimate
        What is known of theta, d, l and r, theta past the first reading.

    Returns
    -------
    pose : ndarray, shape (3,)
        x, y [m] and the angle of the pushed edge [rad].
    covariance : ndarray, shape (3, 3)
        Their covariance.
    """
    theta, d = estimate.theta, estimate.d.mean
    x, y = centre_on_ray(theta, d, estimate.l, estimate.radius)
    cos, sin = math.cos(theta), math.sin(theta)
    by_numbers = np.array([[-y, -cos, -sin, -sin], [x, -sin, cos, cos], [1.0, 0.0, 0.0, 0.0]])
    return np.array([x, y, theta]), by_numbers @ estimate.covariance @ by_numbers.T
