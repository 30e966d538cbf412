# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How an object turns if its limit surface is not an ellipsoid.

c^2 is (m/f)/(omega/|v|), force and motion being those at the centre of mass: one number on an
ellipsoid. Under any pressure it is the second moment of the load along the direction in which the
centre of mass moves, as long as the object hardly turns. The more it turns for its way the larger
c^2 becomes, up to a limit when it only spins.
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
) -> tuple[float, float, float]:
    """Find the c^2 [m^2] that fits the motion which it causes under a push.

    omega = A/(c^2 + B) with A and B of (11) for a sticking contact, and of (13) and (15) for one
    that slips, where the centre of mass moves as the force acts. Arguments are those of
    `pushed_twist`. Return c^2, omega [rad/s] and the velocity of slip (14) [m/s], too.
    """
    now = resistance(v_t, v_n, 0.0, pressure)
    _, _, omega, v_slip, mode = pushed_twist(v_t, v_n, d, -l, cos_alpha, sin_alpha, math.sqrt(now))
    if mode == FREE or (pressure.growth == 0.0 and pressure.shape == 0.0):
        return now, omega, v_slip
    steep, square = 0.0, d * d + l * l  # of the force, and B
    if mode != STICK:
        steep = sin_alpha / max(cos_alpha, LEAST_COSINE)
        if mode == SLIP_LEFT:
            steep = -steep
        square = d * (d + l * steep)
    turn = omega * (now + square)
    for _ in range(ROUNDS):
        forward = v_n - d * omega
        aside = v_t - l * omega if mode == STICK else steep * forward
        # Where one c^2 is too large the next is too small.
        now = (now + resistance(aside, forward, omega, pressure)) / 2.0
        omega = turn / max(now + square, LEAST * now)
    _, _, omega, v_slip, _ = pushed_twist(v_t, v_n, d, -l, cos_alpha, sin_alpha, math.sqrt(now))
    return now, omega, v_slip
