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

A hypothesis is a Gaussian of the seven numbers that the mechanics needs, in the order of the
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
LOG_C = 2  # ln(c/1 m), which has no bound that a Gaussian could cross
ALPHA = 3  # half angle of the friction cone, atan(mu_c) [rad]
L = 4  # distance from the edge to the centre of mass [m]
R = 5  # radius of the finger's disk [m]
GROWTH = 6  # by how much c^2 grows, as a share of it, with (omega c/|v|)^2
UNKNOWNS = 7

RIGHT_ANGLE = math.pi / 2.0
SMOOTH = 5e-3  # way over which a change of the motion is felt [m]
SLOWEST = 1e-24  # squared speed of a finger that stands [m^2/s^2]
SMALLEST, LARGEST = math.log(1e-4), math.log(10.0)  # c that counts as none, and as any [ln m]
LEAST_GROWN = 0.1  # c^2 does not shrink to less than this share of it
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
) -> tuple[float, float]:
    """Give the rates of turning and slipping while a straight edge, or a tangent, is pushed.

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

    Returns
    -------
    omega : float
        Rate of turning [rad/s].
    v_slip : float
        Velocity of slip [m/s], eq. (14).
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
    return omega, v_slip


@equation
def advance(
    theta: float,
    d: float,
    c_squared: float,
    alpha: float,
    l: float,
    r: float,
    growth: float,
    v_x: float,
    v_y: float,
    duration: float,
    curved: bool,
) -> tuple[float, float, float]:
    """Push for a short while, by the midpoint rule.

    Parameters
    ----------
    theta, d, c_squared, alpha, l, v_x, v_y
        As `rates` takes them; c^2 is that of an object that hardly turns.
    r : float
        Radius of the finger's disk [m].
    growth : float
        By how much c^2 grows, as a share of it, with (omega c/|v|)^2.
    duration : float
        How long [s].
    curved : bool
        Whether the object is a disk about its centre of mass, l its radius.

    Returns
    -------
    theta, d : float
        Angle and contact at the end [rad, m].
    slip : float
        How far the contact has slipped [m].
    """
    # On a disk d stays, and theta changes with the place of the tangent, too.
    along, around = (0.0, 1.0 / (l + r)) if curved else (1.0, 0.0)
    half = duration / 2.0
    omega, v_slip = rates(theta, d, c_squared, alpha, l, v_x, v_y)
    way = v_slip - omega * r  # (16)
    grown = 1.0 + growth * omega * omega * c_squared / max(v_x * v_x + v_y * v_y, SLOWEST)
    omega, v_slip = rates(
        theta + half * (omega + around * way),
        d + half * along * way,
        c_squared * max(grown, LEAST_GROWN),
        alpha,
        l,
        v_x,
        v_y,
    )
    way = v_slip - omega * r
    return (
        theta + duration * (omega + around * way),
        d + duration * along * way,
        duration * v_slip,
    )


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
    motions: Array,
    v_x: float,
    v_y: float,
    duration: float,
    scatter: float,
    slip_scatter: float,
    drift: float,
    curved: bool,
) -> None:
    """Move all hypotheses on by a short push.

    Parameters
    ----------
    means : ndarray, shape (H, 7)
        Means, changed.
    covariances : ndarray, shape (H, 7, 7)
        Covariances, changed.
    motions : ndarray, shape (H, 2)
        How the object moved in the last pushes, changed: direction of the contact's velocity in
        the frame of the edge [rad] and turn per l of its way [rad]; NaN before the first push.
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
    duration : float
        How long [s], more than 0.
    scatter : float
        Standard deviation of the turn itself, as a share of it.
    slip_scatter : float
        The same of the slip.
    drift : float
        Standard deviation of the change of ln(c) while the motion changes by 1 rad; it grows with
        the root of the change.
    curved : bool
        Whether the object is a disk about its centre of mass.
    """
    root = np.zeros((UNKNOWNS, UNKNOWNS))
    points = np.empty((2 * UNKNOWNS, 2))
    deviations = np.empty((2 * UNKNOWNS, UNKNOWNS))
    moved = np.empty(UNKNOWNS)
    for h in range(len(means)):
        mean, covariance = means[h], covariances[h]
        factorise(covariance, root)
        # Of the points, those along what is known for certain are the mean itself.
        uncertain = 0
        for column in range(UNKNOWNS):
            uncertain += root[column, column] > 0.0
        count, weight = 2 * uncertain, 0.5 / max(uncertain, 1)
        i, theta, d, slip = 0, 0.0, 0.0, 0.0
        for column in range(UNKNOWNS):
            if root[column, column] > 0.0 or (uncertain == 0 and column == 0):
                for side in (math.sqrt(uncertain), -math.sqrt(uncertain)):
                    for j in range(UNKNOWNS):
                        deviations[i, j] = side * root[j, column] if j >= column else 0.0
                        moved[j] = mean[j] + deviations[i, j]
                    points[i, 0], points[i, 1], along = advance(
                        moved[THETA],
                        moved[D],
                        math.exp(2.0 * min(max(moved[LOG_C], SMALLEST), LARGEST)),
                        moved[ALPHA],
                        moved[L],
                        moved[R],
                        moved[GROWTH],
                        v_x,
                        v_y,
                        duration,
                        curved,
                    )
                    theta += weight * points[i, 0]
                    d += weight * points[i, 1]
                    slip += weight * along
                    i += 1
        change, l, r = theta - mean[THETA], mean[L], mean[R]
        turn = change
        if curved:
            turn = (change * (l + r) - slip) / l
        middle = mean[THETA] + change / 2.0
        cos, sin = math.cos(middle), math.sin(middle)
        along = (cos * v_x + sin * v_y) * duration - slip
        forward = (cos * v_y - sin * v_x) * duration
        way = math.hypot(along, forward)
        if way > 0.0:
            # The finger's trembling is no change: what counts is the motion's mean over some way.
            share, changed = way / (way + SMOOTH), 0.0
            for i, value in enumerate((math.atan2(along, forward), turn * l / way)):
                if math.isnan(motions[h, i]):
                    motions[h, i] = value
                changed += abs(share * (value - motions[h, i]))
                motions[h, i] += share * (value - motions[h, i])
            covariance[LOG_C, LOG_C] += drift**2 * changed
        mean[THETA], mean[D] = theta, d
        for i in range(count):
            deviations[i, THETA], deviations[i, D] = points[i, 0] - theta, points[i, 1] - d
        for j in (THETA, D):
            for k in range(UNKNOWNS):
                value = 0.0
                for i in range(count):
                    value += deviations[i, j] * deviations[i, k]
                covariance[j, k] = covariance[k, j] = weight * value
        extra = (scatter * turn) ** 2
        slipped = (slip_scatter * slip) ** 2
        if curved:
            covariance[THETA, THETA] += (l**2 * extra + slipped) / (l + r) ** 2
        else:
            # A turn that differs from the model's rolls the contact on by -r times as much.
            covariance[THETA, THETA] += extra
            covariance[THETA, D] -= r * extra
            covariance[D, THETA] -= r * extra
            covariance[D, D] += r * r * extra + slipped


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
    means : ndarray, shape (H, 7)
        Means, changed.
    covariances : ndarray, shape (H, 7, 7)
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
