# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Many guesses of where on the edge the finger is: the mechanics moves them, readings correct them.

A hypothesis is a weight and a Gaussian of the nine numbers that the mechanics needs (`unknowns`).
A push moves points around the mean by `pushed_twist` (the cubature rule, exact to the third order),
so sticking and slipping need no derivatives. The passage between them is a kink, which points miss:
`onset` puts right what they say of it.
A reading of theta corrects the Gaussian as in a Kalman filter, and its likelihood changes the
weight. Narrow hypotheses side by side stand for any prior; where data have made them narrower than
their distance, one is enough.

The cubature rule is that of I. Arasaratnam and S. Haykin, "Cubature Kalman filters", IEEE
Transactions on Automatic Control 54 (6), 1254-1269, 2009.
"""

import math
from typing import NamedTuple

import numpy as np

from tactile_push.estimation.onset import (
    BEYOND_LEFT,
    BEYOND_RIGHT,
    COLUMNS,
    SLIP,
    Moved,
    beyond_motion_cone,
    slip_as_a_gaussian_does,
)
from tactile_push.estimation.unknowns import (
    ALPHA,
    GROWTH,
    LOG_C,
    SHAPE,
    THETA,
    TILT,
    UNKNOWNS,
    D,
    L,
    R,
)
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.motion import pushed_twist
from tactile_push.mechanics.resistance import LEAST_COSINE, Pressure, Push, cone_of_angle, settled

LASTING = 5e-3  # way over which errors last, and over which the motion is averaged [m]
SHORTEST = 1e-9  # way that counts as none [m]
STEEPEST_FORCE = 3.0  # bound on the tangent of a force's angle, or a lever would grow without end
# Bounds on ln(c/1 m) at a point of the cubature: 0.1 mm and 10 m, beyond all objects.
LEAST_LOG_C, MOST_LOG_C = math.log(1e-4), math.log(10.0)
NEVER = 1e-18  # a variance up to this is rounding of 0, in units of the unknown


class ModelErrors(NamedTuple):
    """How far objects differ from the model; standard deviations, see `Liberties`."""

    scatter: float
    skew: float
    drift: float


class End(NamedTuple):
    """Where a push takes an object."""

    theta: float  # [rad]
    d: float  # [m]
    slip: float  # to the right [m]
    beyond_left: float  # how far the finger is beyond the motion cone's edges [m], see `onset`
    beyond_right: float


@equation
def advance(
    theta: float,
    d: float,
    alpha: float,
    l: float,
    r: float,
    pressure: Pressure,
    push: Push,
    curved: bool,
) -> End:
    """Push for a short while, by the midpoint rule.

    A friction angle beyond 0 or pi/2 counts as the bound. `l` is the radius of a `curved` object, a
    disk about its centre of mass.
    """
    # On a disk d stays, and theta changes with the place of the tangent, too.
    along, around = (0.0, 1.0 / (l + r)) if curved else (1.0, 0.0)
    v_x, v_y, duration, spin = push.v_x, push.v_y, push.duration, push.spin
    half, passing = duration / 2.0, r * spin  # the disk's surface passes the contact along -t
    cos_alpha, sin_alpha = cone_of_angle(alpha)
    cos, sin = math.cos(theta), math.sin(theta)
    v_t, v_n = cos * v_x + sin * v_y - passing, cos * v_y - sin * v_x
    c_squared, d_shifted, l_shifted, omega, v_slip = settled(
        v_t, v_n, d, l, cos_alpha, sin_alpha, pressure
    )
    v_along = v_slip - omega * r + passing  # (16)
    theta_half = theta + half * (omega + around * v_along)
    d_half = d_shifted + half * along * v_along
    cos, sin = math.cos(theta_half), math.sin(theta_half)
    v_t, v_n = cos * v_x + sin * v_y - passing, cos * v_y - sin * v_x
    _, _, omega, v_slip, _ = pushed_twist(
        v_t, v_n, d_half, -l_shifted, cos_alpha, sin_alpha, math.sqrt(c_squared)
    )
    v_along = v_slip - omega * r + passing
    left, right = beyond_motion_cone(
        v_t, v_n, v_slip, d_half, -l_shifted, cos_alpha, sin_alpha, math.sqrt(c_squared)
    )
    return End(
        theta + duration * (omega + around * v_along),
        d + duration * along * v_along,
        duration * v_slip,
        duration * left,
        duration * right,
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


@equation
def place_points(root: Array, deviations: Array) -> int:
    """Write the cubature rule's points, as deviations from the mean: return how many pairs differ.

    Points along what is known for certain would be the mean itself and are left out; if all is
    known for certain, one pair at the mean remains.
    """
    uncertain = 0
    for column in range(UNKNOWNS):
        uncertain += root[column, column] > 0.0
    i = 0
    for column in range(UNKNOWNS):
        if root[column, column] > 0.0 or (uncertain == 0 and column == 0):
            for side in (math.sqrt(uncertain), -math.sqrt(uncertain)):
                for j in range(UNKNOWNS):
                    deviations[i, j] = side * root[j, column] if j >= column else 0.0
                i += 1
    return uncertain


@equation
def push_points(
    mean: Array,
    deviations: Array,
    pairs: int,
    moments: Array,
    push: Push,
    curved: bool,
    ends: Array,
) -> Moved:
    """Push every point, write down its end, and return the means."""
    theta, d, slip, slipping, weight = 0.0, 0.0, 0.0, 0.0, 0.5 / pairs
    point = np.empty(UNKNOWNS)
    for i in range(2 * pairs):
        for j in range(UNKNOWNS):
            point[j] = mean[j] + deviations[i, j]
        log_c = min(max(point[LOG_C], LEAST_LOG_C), MOST_LOG_C)
        pressure = Pressure(
            math.exp(2.0 * log_c), point[GROWTH], point[SHAPE], moments, point[TILT]
        )
        end = advance(
            point[THETA], point[D], point[ALPHA], point[L], point[R], pressure, push, curved
        )
        ends[i, THETA], ends[i, D], ends[i, SLIP] = end.theta, end.d, end.slip
        ends[i, BEYOND_LEFT], ends[i, BEYOND_RIGHT] = end.beyond_left, end.beyond_right
        theta += weight * end.theta
        d += weight * end.d
        slip += weight * end.slip
        slipping += weight * (end.slip != 0.0)
    return Moved(theta, d, slip, slipping)


@equation
def motion_of(mean: Array, moved: Moved, push: Push, curved: bool) -> tuple[float, float, float]:
    """Compute the turn of the object and way and direction of its contact [rad, m, rad]."""
    l, r = mean[L], mean[R]
    turn = moved.theta - mean[THETA]
    middle = mean[THETA] + turn / 2.0
    passed = moved.slip + r * push.spin * push.duration  # the finger's surface by the object's
    if curved:  # the tangent moves around the object, too
        turn = (turn * (l + r) - passed) / l
    cos, sin = math.cos(middle), math.sin(middle)
    aside = (cos * push.v_x + sin * push.v_y) * push.duration - passed
    forward = (cos * push.v_y - sin * push.v_x) * push.duration
    return turn, math.hypot(aside, forward), math.atan2(aside, forward)


@equation
def change_motion(motion: Array, direction: float, turn_per_l: float, way: float) -> float:
    """Follow the mean motion over some way, and return how far it has changed [rad].

    The finger's trembling is no change, so the mean forgets over `LASTING`.
    """
    share, change = way / (way + LASTING), 0.0
    for i, value in enumerate((direction, turn_per_l)):
        if math.isnan(motion[i]):
            motion[i] = value
        change += abs(share * (value - motion[i]))
        motion[i] += share * (value - motion[i])
    return change


@equation
def gather(
    covariance: Array, deviations: Array, pairs: int, ends: Array, theta: float, d: float
) -> None:
    """Put the covariances of theta and d together again from the points' ends."""
    weight = 0.5 / max(pairs, 1)
    for i in range(2 * pairs):
        deviations[i, THETA], deviations[i, D] = ends[i, 0] - theta, ends[i, 1] - d
    for j in (THETA, D):
        for k in range(UNKNOWNS):
            value = 0.0
            for i in range(2 * pairs):
                value += deviations[i, j] * deviations[i, k]
            covariance[j, k] = covariance[k, j] = weight * value


@equation
def add_errors(
    mean: Array,
    covariance: Array,
    moved: Moved,
    turn: float,
    way: float,
    errors: ModelErrors,
    curved: bool,
) -> None:
    """Add what an object's turn and slip may differ by from the model's.

    Both errors last for a while, and so add up to more than independent ones of every push.
    """
    l, r, slipping = mean[L], mean[R], moved.slipping
    lasting = LASTING / max(way, SHORTEST)
    turn_variance = (errors.scatter * turn) ** 2 * lasting
    spin = min(1.0, abs(turn) * l / max(way, SHORTEST))
    cos, sin = cone_of_angle(mean[ALPHA])
    slip_variance = (errors.skew * spin * 2.0 * sin * cos * slipping * way) ** 2 * lasting
    if curved:
        sticking = (1.0 - slipping) ** 2  # a tangent goes with the turn of a contact that sticks
        added = (l**2 * turn_variance * sticking + slip_variance) / (l + r) ** 2
        covariance[THETA, THETA] += added
    else:
        # A turn that differs from the model's rolls the contact on, and makes it slip: the
        # centre of friction moves along the force, and the edge there goes with the turn.
        steep = min(sin / max(cos, LEAST_COSINE), STEEPEST_FORCE)
        lever = r + slipping * (l + mean[TILT] - math.copysign(steep, moved.slip) * mean[D])
        covariance[THETA, THETA] += turn_variance
        covariance[THETA, D] -= lever * turn_variance
        covariance[D, THETA] -= lever * turn_variance
        covariance[D, D] += lever * lever * turn_variance + slip_variance


@compiled
def predict(
    means: Array,
    covariances: Array,
    motions: Array,
    moments: Array,
    push: Push,
    errors: ModelErrors,
    curved: bool,
) -> None:
    """Move all hypotheses on by a short push, longer than 0 s: means, covariances and motions.

    `motions` says how the object moved in the last pushes: direction of the contact's velocity in
    the frame of the edge [rad] and turn per l of its way [rad]; NaN before the first push.
    """
    root = np.zeros((UNKNOWNS, UNKNOWNS))
    ends = np.empty((2 * UNKNOWNS, COLUMNS))
    deviations = np.empty((2 * UNKNOWNS, UNKNOWNS))
    missed = np.empty(UNKNOWNS)
    for h in range(len(means)):
        mean, covariance = means[h], covariances[h]
        factorise(covariance, root)
        uncertain = place_points(root, deviations)
        pairs = max(uncertain, 1)
        moved = push_points(mean, deviations, pairs, moments, push, curved, ends)
        gather(covariance, deviations, uncertain, ends, moved.theta, moved.d)
        moved = slip_as_a_gaussian_does(
            mean, covariance, deviations, pairs, ends, moved, curved, missed
        )
        turn, way, direction = motion_of(mean, moved, push, curved)
        if way > 0.0:
            change = change_motion(motions[h], direction, turn * mean[L] / way, way)
            covariance[LOG_C, LOG_C] += errors.drift**2 * change
        mean[THETA], mean[D] = moved.theta, moved.d
        add_errors(mean, covariance, moved, turn, way, errors, curved)


@compiled
def correct(
    means: Array,
    covariances: Array,
    log_weights: Array,
    theta: float,
    variance: float,
    outlier: float,
) -> float:
    """Correct all hypotheses by a reading of theta [rad] whose noise has the `variance` [rad^2].

    With the probability `outlier` a reading is an outlier, anywhere in the half turn that the
    sensor sees. A hypothesis under which this is likelier keeps its mean. Return the probability
    density of the reading under all hypotheses together [1/rad]; the weights then add up to 1.
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
