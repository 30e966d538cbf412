# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a Gaussian becomes where the contact may be about to slip.

A contact slips by as much as the finger is beyond an edge of its motion cone, and not at all inside
it: the slip is the positive part of a number that grows evenly through 0. The few points that stand
for a Gaussian miss this kink. They lie some deviations off their mean, so a contact begins to slip
in them too early, and later slips too little; data that know better then pull at every unknown.

If the number is Gaussian, the mean and the variance of its positive part have closed forms, and its
covariance with any other Gaussian is that of the number itself, times the probability that it is
positive (Stein's lemma). What the points say of the slip is exchanged for that.

References
----------
J. Tobin, "Estimation of relationships for limited dependent variables", Econometrica 26 (1), 24-36,
1958. C. M. Stein, "Estimation of the mean of a multivariate normal distribution", The Annals of
Statistics 9 (6), 1135-1151, 1981.
"""

import math
from typing import NamedTuple

from tactile_push.estimation.mixture import REACH
from tactile_push.estimation.unknowns import LOG_C, THETA, UNKNOWNS, D, L, R
from tactile_push.mechanics.compiled import Array, equation
from tactile_push.mechanics.motion import motion_cone

# Columns of the points' ends, after theta and d.
SLIP, BEYOND_LEFT, BEYOND_RIGHT = 2, 3, 4  # [m]
COLUMNS = 5


class Moved(NamedTuple):
    """Where a push takes a hypothesis: means over its points [rad, m, m] and what share slips."""

    theta: float
    d: float
    slip: float
    slipping: float


@equation
def beyond_motion_cone(
    v_t: float,
    v_n: float,
    v_slip: float,
    x_c: float,
    y_c: float,
    cos_alpha: float,
    sin_alpha: float,
    c: float,
) -> tuple[float, float]:
    """Compute how far a finger is beyond the left and the right edge of the motion cone [m/s].

    Outside it is the velocity of slip. Inside it is less than 0 and goes on with the sine of the
    angle between finger and edge, which has a bound wherever the edge points.
    """
    speed = math.hypot(v_t, v_n)
    if v_n > 0.0:
        v_lx, v_ly, v_rx, v_ry = motion_cone(x_c, y_c, cos_alpha, sin_alpha, c)
        left = speed / v_n * (v_n * v_lx - v_t * v_ly) / math.hypot(v_lx, v_ly)
        right = speed / v_n * (v_t * v_ry - v_n * v_rx) / math.hypot(v_rx, v_ry)
    else:  # pulled along, or left standing: no edge is near
        left = right = -speed
    if v_slip < 0.0:
        left = -v_slip
    elif v_slip > 0.0:
        right = v_slip
    return left, right


@equation
def positive_part(mean: float, variance: float) -> tuple[float, float, float]:
    """Compute a Gaussian's probability of being positive, and its positive part's moments.

    Parameters
    ----------
    mean, variance : float
        Moments of the Gaussian.

    Returns
    -------
    share, part_mean, part_variance : float
        The probability, and mean and variance of max(0, x).
    """
    deviation = math.sqrt(variance)
    if abs(mean) >= REACH * deviation:
        return (1.0, mean, variance) if mean > 0.0 else (0.0, 0.0, 0.0)
    z = mean / deviation
    share = math.erfc(-z / math.sqrt(2.0)) / 2.0
    part = z * share + math.exp(-z * z / 2.0) / math.sqrt(math.tau)
    return share, deviation * part, variance * (share + z * part - part * part)


@equation
def slip_as_a_gaussian_does(
    mean: Array,
    covariance: Array,
    deviations: Array,
    pairs: int,
    ends: Array,
    moved: Moved,
    curved: bool,
    missed: Array,
) -> Moved:
    """Exchange the slip of a hypothesis' points for that of the Gaussian that they stand for.

    With the slip q, theta and d end where a sticking contact would take them, plus q times what a
    unit of slip takes away from them. The former is as Gaussian as the points say; q has the
    moments of this module. `mean` is that before the push, `covariance` that after it, which this
    puts right; `deviations` are the points' from the means. `missed` is room for a row.
    """
    weight = 0.5 / pairs
    left, right, left_square, right_square, slip_square = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(2 * pairs):
        left += weight * ends[i, BEYOND_LEFT]
        right += weight * ends[i, BEYOND_RIGHT]
    for i in range(2 * pairs):
        left_square += weight * (ends[i, BEYOND_LEFT] - left) ** 2
        right_square += weight * (ends[i, BEYOND_RIGHT] - right) ** 2
        slip_square += weight * (ends[i, SLIP] - moved.slip) ** 2
    certain = REACH**2
    if left * left >= certain * left_square and right * right >= certain * right_square:
        return moved  # every slip is certain, or certainly none
    left_share, left_mean, left_variance = positive_part(left, left_square)
    right_share, right_mean, right_variance = positive_part(right, right_square)
    slip = right_mean - left_mean
    # A contact slips to one side at a time: the product of both parts is 0.
    missed_variance = left_variance + right_variance + 2.0 * left_mean * right_mean - slip_square
    # By (11), omega = (d v_n + l v_ot)/(c^2 + d^2 + l^2), and slip is missing in v_ot.
    l, r, d = mean[L], mean[R], mean[D]
    along, around = (0.0, 1.0 / (l + r)) if curved else (1.0, 0.0)
    turn_of_slip = -l / (math.exp(2.0 * mean[LOG_C]) + d * d + l * l)
    d_of_slip = along * (1.0 - r * turn_of_slip)  # (16)
    theta_of_slip = turn_of_slip + around * (1.0 - r * turn_of_slip)
    slip_left, slip_right = 0.0, 0.0  # covariances
    for i in range(2 * pairs):
        slip_left += weight * (ends[i, SLIP] - moved.slip) * ends[i, BEYOND_LEFT]
        slip_right += weight * (ends[i, SLIP] - moved.slip) * ends[i, BEYOND_RIGHT]
    for k in range(UNKNOWNS):
        # Covariances with what the unknown would be if the contact stuck.
        of_slip = theta_of_slip if k == THETA else d_of_slip if k == D else 0.0
        with_left, with_right = -of_slip * slip_left, -of_slip * slip_right
        with_slip = -of_slip * slip_square
        for i in range(2 * pairs):
            with_left += weight * deviations[i, k] * ends[i, BEYOND_LEFT]
            with_right += weight * deviations[i, k] * ends[i, BEYOND_RIGHT]
            with_slip += weight * deviations[i, k] * ends[i, SLIP]
        missed[k] = right_share * with_right - left_share * with_left - with_slip
    for k in range(UNKNOWNS):
        if k not in (THETA, D):
            covariance[THETA, k] += theta_of_slip * missed[k]
            covariance[D, k] += d_of_slip * missed[k]
            covariance[k, THETA], covariance[k, D] = covariance[THETA, k], covariance[D, k]
    for j, of_slip in ((THETA, theta_of_slip), (D, d_of_slip)):
        covariance[j, j] += of_slip * (2.0 * missed[j] + of_slip * missed_variance)
    mixed = theta_of_slip * missed[D] + d_of_slip * missed[THETA]
    covariance[THETA, D] += mixed + theta_of_slip * d_of_slip * missed_variance
    covariance[D, THETA] = covariance[THETA, D]
    more = slip - moved.slip
    return Moved(
        moved.theta + theta_of_slip * more,
        moved.d + d_of_slip * more,
        slip,
        left_share + right_share,
    )
