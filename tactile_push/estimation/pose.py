# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where the object is, as seen from the finger (Section III, use 2)."""

import math

import numpy as np

from tactile_push.estimation.contact_estimator import Estimate
from tactile_push.estimation.translation import centre_on_ray
from tactile_push.mechanics.compiled import Array


def object_pose(estimate: Estimate) -> tuple[Array, Array]:
    """Compute the pose of the centre of mass in the frame of the finger's disk, and its covariance.

    The pose is x, y [m] and the angle of the pushed edge [rad]: the sensed theta and the estimated
    d determine it completely. The covariance holds to first order in their errors.
    """
    theta, d = estimate.theta, estimate.d.mean
    x, y = centre_on_ray(theta, d, estimate.l, estimate.radius)
    cos, sin = math.cos(theta), math.sin(theta)
    by_numbers = np.array([[-y, -cos, -sin, -sin], [x, -sin, cos, cos], [1.0, 0.0, 0.0, 0.0]])
    return np.array([x, y, theta]), by_numbers @ estimate.covariance @ by_numbers.T
