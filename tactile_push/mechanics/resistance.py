# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How an object turns if its limit surface is not an ellipsoid, or the push is above its support.

c^2 is (m/f)/(omega/|v|), force and motion being those at the centre of mass: one number on an
ellipsoid. Under any pressure it is the second moment of the load along the direction in which the
centre of mass moves, as long as the object hardly turns. The more it turns for its way the larger
c^2 becomes, up to a limit when it only spins.

A push above the support moves the centre of friction along the force, from the centre of mass by
`tilt` f / f_max. The force's moment stays as it is; the object turns about the shifted centre.
"""

import math
from typing import NamedTuple

from tactile_push.mechanics.compiled import Array, equation
from tactile_push.mechanics.motion import FREE, SLIP_LEFT, STICK, pushed_twist

RIGHT_ANGLE = math.pi / 2.0
ROUNDS = 3  # until c^2 and the motion agree
LEAST_COSINE = 1e-6  # a steeper force is one along the edge
SLOWEST = 1e-24  # squared speed of an object that only spins [m^2/s^2]
LEAST = 0.1  # c^2 does not shrink to less than this share of it


class Pressure(NamedTuple):
    """How the pressure under an object resists its turning."""

    c_squared: float  # of a load without preferred direction while the object hardly turns [m^2]
    # By how much c^2 is greater when the object spins than on average over the directions, as a
    # share of it.
    growth: float
    shape: float  # share of the load that is spread as the outline's area is
    # Second moments of the area along the tangent, mixed and along the normal, divided by the root
    # of their determinant, shape (3,).
    moments: Array
    # mu_s times the height of the push above the support [m]; below 0 only in a hypothesis' points,
    # whose mean would be wrong if they were cut off.
    tilt: float = 0.0


class Push(NamedTuple):
    """A straight push: velocity of the disk's centre relative to the support [m/s].

    It lasts for `duration` [s], in which the disk turns with the angular velocity `spin` [rad/s].
    """

    v_x: float
    v_y: float
    duration: float
    spin: float = 0.0


@equation
def resistance(v_x: float, v_y: float, omega: float, pressure: Pressure) -> float:
    """Compute c^2 [m^2] of a motion of the centre of mass, along tangent and normal."""
    c_squared, shape, growth = pressure.c_squared, pressure.shape, pressure.growth
    moments = pressure.moments
    xx, xy, yy = moments[0], moments[1], moments[2]
    mean = 1.0 + shape * ((xx + yy) / 2.0 - 1.0)
    square = v_x * v_x + v_y * v_y
    if square < SLOWEST:
        return c_squared * max(mean + growth, LEAST)
    along = (xx * v_x * v_x + 2.0 * xy * v_x * v_y + yy * v_y * v_y) / square
    directed = 1.0 + shape * (along - 1.0)
    spin = omega * omega * c_squared * mean
    share = spin / math.sqrt(spin * spin + square * square)
    return c_squared * max(directed + (mean + growth - directed) * share, LEAST)


@equation
def cone_of_angle(alpha: float) -> tuple[float, float]:
    """Return cos and sin of the friction cone's half angle, which counts as within 0 to pi/2."""
    if alpha >= RIGHT_ANGLE:
        return 0.0, 1.0
    if alpha <= 0.0:
        return 1.0, 0.0
    return math.cos(alpha), math.sin(alpha)


@equation
def settled(
    v_t: float,
    v_n: float,
    d: float,
    l: float,
    cos_alpha: float,
    sin_alpha: float,
    pressure: Pressure,
) -> tuple[float, float, float, float, float]:
    """Find the c^2 [m^2] and the shifted contact that fit the motion which they cause under a push.

    omega = A/(c^2 + B) with A and B of (11) for a sticking contact, and of (13) and (15) for one
    that slips, where the centre of friction moves as the force acts. A is the same about the
    centre of mass and about the shifted centre. Arguments are those of `pushed_twist`. Return c^2,
    d and l of the contact from the shifted centre [m], omega [rad/s] and the velocity of slip (14)
    [m/s].
    """
    now = resistance(v_t, v_n, 0.0, pressure)
    _, _, omega, v_slip, mode = pushed_twist(v_t, v_n, d, -l, cos_alpha, sin_alpha, math.sqrt(now))
    tilt = pressure.tilt
    if mode == FREE or (pressure.growth == 0.0 and pressure.shape == 0.0 and tilt == 0.0):
        return now, d, l, omega, v_slip
    steep, square = 0.0, d * d + l * l  # of the force, and B
    if mode != STICK:
        steep = sin_alpha / max(cos_alpha, LEAST_COSINE)
        if mode == SLIP_LEFT:
            steep = -steep
        square = d * (d + l * steep)
    turn = omega * (now + square)
    d_shifted, l_shifted = d, l
    for _ in range(ROUNDS):
        forward = v_n - d_shifted * omega
        aside = v_t - l_shifted * omega if mode == STICK else steep * forward
        # Where one c^2 is too large the next is too small.
        now = (now + resistance(aside, forward, omega, pressure)) / 2.0
        if tilt != 0.0:
            # |f| / f_max on the ellipsoid, which the centre's velocity is parallel to.
            spread = aside * aside + forward * forward + now * omega * omega
            lever = tilt / math.sqrt(max(spread, SLOWEST))
            d_shifted, l_shifted = d - lever * aside, l + lever * forward
            square = d_shifted * d + l_shifted * l
            if mode != STICK:
                square = d_shifted * (d + l * steep)
        omega = turn / max(now + square, LEAST * now)
    _, _, omega, v_slip, _ = pushed_twist(
        v_t, v_n, d_shifted, -l_shifted, cos_alpha, sin_alpha, math.sqrt(now)
    )
    return now, d_shifted, l_shifted, omega, v_slip
