# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Many guesses of where on the edge the finger is, each moved by the mechanics and corrected.

A hypothesis is a Gaussian of the eight numbers that the mechanics needs, in the order of the
columns below, and a weight. A push moves its mean and covariance through `pushed_twist` at points
around the mean (the cubature rule, exact to the third order), so that sticking, slipping and the
passage between them need no derivatives. A reading of theta corrects it as a Kalman filter does,
and its likelihood changes the weight. Narrow hypotheses side by side stand for any prior; where
data have made them narrower than their distance, one is enough.
"""

import math

import numpy as np

from tactile_push.estimation.resistance import LEAST_COSINE, cone_of_angle, settled
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.motion import pushed_twist

THETA = 0  # angle of the edge [rad]
D = 1  # contact along the edge [m]
LOG_C = 2  # ln(c/1 m), which has no bound that a Gaussian could cross
ALPHA = 3  # half angle of the friction cone, atan(mu_c) [rad]
L = 4  # distance from the edge to the centre of mass [m]
R = 5  # radius of the finger's disk [m]
GROWTH = 6  # by how much c^2 grows while the object turns, see `resistance`
SHAPE = 7  # how far c^2 depends on the direction of motion, see `resistance`
UNKNOWNS = 8

SMOOTH = 5e-3  # way over which a change of the motion is felt [m]
SHORTEST = 1e-9  # way that counts as none [m]
STEEPEST = 3.0  # tangent of a force's angle that counts
SMALLEST, LARGEST = math.log(1e-4), math.log(10.0)  # c that counts as none, and as any [ln m]
NEVER = 1e-18  # a variance up to this, in units of the unknown, is none


@equation
def advance(
    theta: float,
    d: float,
    c_squared: float,
    alpha: float,
    l: float,
    r: float,
    growth: float,
    shape: float,
    moments: Array,
    v_x: float,
    v_y: float,
    duration: float,
    curved: bool,
) -> tuple[float, float, float]:
    """Push for a short while, by the midpoint rule.

    Parameters
    ----------
    theta : float
        Angle of the edge, or of the tangent [rad].
    d, l : float
        Contact along the edge and distance from there to the centre of mass [m].
    alpha : float
        Half angle of the friction cone [rad]; what is beyond 0 and pi/2 counts as the bound.
    r : float
        Radius of the finger's disk [m].
    c_squared, growth, shape, moments
        As `resistance` takes them.
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
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
    cos_alpha, sin_alpha = cone_of_angle(alpha)
    cos, sin = math.cos(theta), math.sin(theta)
    v_t, v_n = cos * v_x + sin * v_y, cos * v_y - sin * v_x
    now, omega, v_slip = settled(
        v_t, v_n, d, l, cos_alpha, sin_alpha, c_squared, growth, shape, moments
    )
    way = v_slip - omega * r  # (16)
    theta_half, d_half = theta + half * (omega + around * way), d + half * along * way
    cos, sin = math.cos(theta_half), math.sin(theta_half)
    v_t, v_n = cos * v_x + sin * v_y, cos * v_y - sin * v_x
    _, _, omega, v_slip, _ = pushed_twist(
        v_t, v_n, d_half, -l, cos_alpha, sin_alpha, math.sqrt(now)
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
    moments: Array,
    v_x: float,
    v_y: float,
    duration: float,
    scatter: float,
    skew: float,
    drift: float,
    curved: bool,
) -> None:
    """Move all hypotheses on by a short push.

    Parameters
    ----------
    means : ndarray, shape (H, 8)
        Means, changed.
    covariances : ndarray, shape (H, 8, 8)
        Covariances, changed.
    motions : ndarray, shape (H, 2)
        How the object moved in the last pushes, changed: direction of the contact's velocity in
        the frame of the edge [rad] and turn per l of its way [rad]; NaN before the first push.
    moments : ndarray, shape (3,)
        As `resistance.resistance` takes them.
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
    duration : float
        How long [s], more than 0.
    scatter : float
        Standard deviation of the turn itself, as a share of it, over 5 mm of way.
    skew : float
        Standard deviation of the angle between the force and the motion of the centre of mass,
        over 5 mm of way, for a force at 45 degrees and a turn of 1 rad per l [rad].
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
        i, theta, d, slip, slips = 0, 0.0, 0.0, 0.0, 0.0
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
                        moved[SHAPE],
                        moments,
                        v_x,
                        v_y,
                        duration,
                        curved,
                    )
                    theta += weight * points[i, 0]
                    d += weight * points[i, 1]
                    slip += weight * along
                    slips += weight * (along != 0.0)
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
        # Both errors last for a while, and so add up to more than independent ones of every push.
        lasting = SMOOTH / max(way, SHORTEST)
        turned = (scatter * turn) ** 2 * lasting
        spin = min(1.0, abs(turn) * l / max(way, SHORTEST))
        cos, sin = cone_of_angle(mean[ALPHA])
        skewed = (skew * spin * 2.0 * sin * cos * slips * way) ** 2 * lasting
        if curved:
            sticks = (1.0 - slips) ** 2  # a tangent goes with the turn of a contact that sticks
            covariance[THETA, THETA] += (l**2 * turned * sticks + skewed) / (l + r) ** 2
        else:
            # A turn that differs from the model's rolls the contact on, and makes it slip: the
            # centre of mass moves along the force, and the edge there goes with the turn.
            steep = min(sin / max(cos, LEAST_COSINE), STEEPEST)
            lever = r + slips * (l - math.copysign(steep, slip) * d)
            covariance[THETA, THETA] += turned
            covariance[THETA, D] -= lever * turned
            covariance[D, THETA] -= lever * turned
            covariance[D, D] += lever * lever * turned + skewed


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
    means : ndarray, shape (H, 8)
        Means, changed.
    covariances : ndarray, shape (H, 8, 8)
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
