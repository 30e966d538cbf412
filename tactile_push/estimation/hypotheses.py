# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Many guesses of where on the edge the finger is, each moved by the mechanics and corrected.

A hypothesis is a Gaussian of the five numbers that the mechanics needs, in the order of the
columns below, and a weight. A push moves its mean and covariance through `pushed_twist` at points
around the mean (the cubature rule, exact to the third order), so that sticking, slipping and the
passage between them need no derivatives. A reading of theta corrects it as a Kalman filter does,
and its likelihood changes the weight. Narrow hypotheses side by side stand for any prior; where
data have made them narrower than their distance, one is enough.
"""

import math

import numpy as np

from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.motion import pushed_twist

THETA = 0  # angle of the edge [rad]
D = 1  # contact along the edge [m]
C_SQUARED = 2  # c^2 [m^2], of which the turning rate is a simple function
ALPHA = 3  # half angle of the friction cone, atan(mu_c) [rad]
L = 4  # distance from the edge to the centre of mass [m]
UNKNOWNS = 5

RIGHT_ANGLE = math.pi / 2.0
NEVER = 1e-18  # a variance up to this, in units of the unknown, is none


@equation
def rates(
    theta: float,
    d: float,
    c_squared: float,
    alpha: float,
    l: float,
    v_x: float,
    v_y: float,
    r: float,
) -> tuple[float, float]:
    """Give the rates of theta and d while a straight edge is pushed.

    Parameters
    ----------
    theta : float
        Angle of the edge [rad].
    d : float
        Contact along the edge [m].
    c_squared : float
        c^2 [m^2], positive.
    alpha : float
        Half angle of the friction cone [rad]; what is beyond 0 and pi/2 counts as the bound.
    l : float
        Distance from the edge to the centre of mass [m].
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    omega : float
        Rate of theta [rad/s].
    d_dot : float
        Rate of d [m/s], eq. (16).
    """
    cos, sin = math.cos(theta), math.sin(theta)
    cos_alpha, sin_alpha = 1.0, 0.0
    if alpha >= RIGHT_ANGLE:
        cos_alpha, sin_alpha = 0.0, 1.0
    elif alpha > 0.0:
        cos_alpha, sin_alpha = math.cos(alpha), math.sin(alpha)
    _, _, omega, v_slip, _ = pushed_twist(
        cos * v_x + sin * v_y, cos * v_y - sin * v_x, d, -l, cos_alpha, sin_alpha,
        math.sqrt(c_squared),
    )  # fmt: skip
    return omega, v_slip - omega * r  # (16)


@equation
def advance(
    theta: float,
    d: float,
    c_squared: float,
    alpha: float,
    l: float,
    v_x: float,
    v_y: float,
    duration: float,
    r: float,
) -> tuple[float, float]:
    """Push for a short while, by the midpoint rule.

    Parameters
    ----------
    theta, d, c_squared, alpha, l, v_x, v_y, r
        As `rates` takes them.
    duration : float
        How long [s].

    Returns
    -------
    theta, d : float
        Angle and contact at the end [rad, m].
    """
    half = duration / 2.0
    omega, d_dot = rates(theta, d, c_squared, alpha, l, v_x, v_y, r)
    omega, d_dot = rates(theta + half * omega, d + half * d_dot, c_squared, alpha, l, v_x, v_y, r)
    return theta + duration * omega, d + duration * d_dot


@equation
def factorise(covariance: Array, root: Array) -> None:
    """Write the lower triangular root of a covariance, whose variances may be 0."""
    for i in range(UNKNOWNS):
        for j in range(i + 1):
            rest = covariance[i, j]
            for k in range(j):
                rest -= root[i, k] * root[j, k]
            if i == j:
                root[i, i] = math.sqrt(rest) if rest > NEVER * (1.0 + covariance[i, i]) else 0.0
            else:
                root[i, j] = rest / root[j, j] if root[j, j] > 0.0 else 0.0


@compiled
def predict(
    means: Array,
    covariances: Array,
    v_x: float,
    v_y: float,
    duration: float,
    r: float,
    least_c_squared: float,
    most_c_squared: float,
    scatter: float,
    slip_scatter: float,
    drift: float,
) -> None:
    """Move all hypotheses on by a short push.

    Parameters
    ----------
    means : ndarray, shape (H, 5)
        Means, changed.
    covariances : ndarray, shape (H, 5, 5)
        Covariances, changed.
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
    duration : float
        How long [s].
    r : float
        Radius of the finger's disk [m].
    least_c_squared, most_c_squared : float
        Bounds of c^2 [m^2].
    scatter : float
        Standard deviation of the turn itself, as a share of it.
    slip_scatter : float
        The same of the slip.
    drift : float
        Standard deviation by which c^2 + l^2 changes meanwhile, as a share of it.
    """
    count = 2 * UNKNOWNS
    root = np.zeros((UNKNOWNS, UNKNOWNS))
    points = np.empty((count, 2))
    deviations = np.empty((count, UNKNOWNS))
    for h in range(len(means)):
        mean, covariance = means[h], covariances[h]
        factorise(covariance, root)
        theta, d = 0.0, 0.0
        for i in range(count):
            column = i % UNKNOWNS
            scale = math.sqrt(UNKNOWNS) if i < UNKNOWNS else -math.sqrt(UNKNOWNS)
            for j in range(UNKNOWNS):
                deviations[i, j] = scale * root[j, column] if j >= column else 0.0
            c_squared = mean[C_SQUARED] + deviations[i, C_SQUARED]
            points[i, 0], points[i, 1] = advance(
                mean[THETA] + deviations[i, THETA],
                mean[D] + deviations[i, D],
                min(max(c_squared, least_c_squared), most_c_squared),
                mean[ALPHA] + deviations[i, ALPHA],
                mean[L] + deviations[i, L],
                v_x,
                v_y,
                duration,
                r,
            )
            theta += points[i, 0] / count
            d += points[i, 1] / count
        turn = theta - mean[THETA]
        slip = d - mean[D] + r * turn
        mean[THETA], mean[D] = theta, d
        for i in range(count):
            deviations[i, THETA], deviations[i, D] = points[i, 0] - theta, points[i, 1] - d
        for j in (THETA, D):
            for k in range(UNKNOWNS):
                value = 0.0
                for i in range(count):
                    value += deviations[i, j] * deviations[i, k]
                covariance[j, k] = covariance[k, j] = value / count
        # A turn that differs from the model's rolls the contact on by -r times as much.
        extra = (scatter * turn) ** 2
        covariance[THETA, THETA] += extra
        covariance[THETA, D] -= r * extra
        covariance[D, THETA] -= r * extra
        covariance[D, D] += r * r * extra + (slip_scatter * slip) ** 2
        resistance = min(max(mean[C_SQUARED], least_c_squared), most_c_squared) + mean[L] ** 2
        covariance[C_SQUARED, C_SQUARED] += (drift * resistance) ** 2


@compiled
def correct(
    means: Array,
    covariances: Array,
    log_weights: Array,
    theta: float,
    variance: float,
    outlier: float,
) -> float:
    """Correct all hypotheses by a reading of theta.

    A reading is an outlier, anywhere in the half turn that the sensor sees, with a small
    probability. A hypothesis that finds this likelier keeps its mean.

    Parameters
    ----------
    means : ndarray, shape (H, 5)
        Means, changed.
    covariances : ndarray, shape (H, 5, 5)
        Covariances, changed.
    log_weights : ndarray, shape (H,)
        Logarithms of the weights, changed; their sum of exponentials becomes 1.
    theta : float
        The reading [rad].
    variance : float
        Variance of its noise [rad^2].
    outlier : float
        Probability of an outlier.

    Returns
    -------
    float
        Probability density of the reading, all hypotheses taken together [1/rad].
    """
    anywhere = outlier / math.pi
    gains = np.empty(UNKNOWNS)
    most = -math.inf
    for h in range(len(means)):
        mean, covariance = means[h], covariances[h]
        spread = covariance[THETA, THETA] + variance
        error = theta - mean[THETA]
        likely = (1.0 - outlier) * math.exp(-error * error / (2.0 * spread))
        likely /= math.sqrt(2.0 * math.pi * spread)
        log_weights[h] += math.log(likely + anywhere)
        most = max(most, log_weights[h])
        if likely > anywhere:
            for j in range(UNKNOWNS):
                gains[j] = covariance[j, THETA] / spread
            for j in range(UNKNOWNS):
                mean[j] += gains[j] * error
                for k in range(UNKNOWNS):
                    covariance[j, k] -= gains[j] * gains[k] * spread
    total = 0.0
    for h in range(len(means)):
        total += math.exp(log_weights[h] - most)
    density = most + math.log(total)
    for h in range(len(means)):
        log_weights[h] -= density
    return math.exp(density)
