# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What cannot be excluded: boxes of all unknowns, moved by bounds on the mechanics.

No probabilities. A cell is a box of theta, of d + r (theta - theta_0), which a sticking contact
keeps whatever r is, of c^2 and of alpha = atan(mu_c). theta_0 is the first reading, and turns with
the finger's disk from there. A push
moves its faces by the least and the most that any motion inside the box and within the bounds on
the model can do; a reading cuts theta off beyond the bound on its noise; a cell with nothing left
is gone, and what is left is halved as often as there is room. So the truth is in one of the cells
as long as the bounds hold.

For every contact that moves the object at (v_ot, v_n), along tangent and normal,
omega = (d v_n + l v_ot)/(c^2 + d^2 + l^2): (11) with (9) and (10), also when it slips. The true
omega may differ from it by a share, either way: under all surfaces it is 0 where the contact moves
towards or away from the centre of mass, and its sense is the same. v_ot is the finger's unless this
is outside the motion cone, whose edges may differ from the ellipsoid's by an angle.
"""

import math
from typing import NamedTuple

import numpy as np

from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.resistance import Push, cone_of_angle

THETA_LOW, THETA_HIGH = 0, 1  # [rad]
ROLLED_LOW, ROLLED_HIGH = 2, 3  # d + r (theta - theta_0) [m]
C_SQUARED_LOW, C_SQUARED_HIGH = 4, 5  # [m^2]
ALPHA_LOW, ALPHA_HIGH = 6, 7  # [rad]
FACES = 8

STEEPEST_EDGE = 100.0  # slope beyond which an edge of the motion cone is along the object's edge
LEAST_SQUARE = 1e-8  # of c^2 + d^2 + l^2 [m^2]
# More than the midpoint rule is wrong by in half a millimetre.
ANGLE_SLACK = 2e-6  # [rad]
LENGTH_SLACK = 1e-7  # [m]


class Interval(NamedTuple):
    """All numbers from low to high."""

    low: float
    high: float


class Bounds(NamedTuple):
    """What bounds every cell alike."""

    d: Interval  # ends of the edge [m]
    l: Interval  # distance from the edge to the centre of mass [m]
    r: Interval  # radius of the finger's disk [m]
    theta_0: float  # the first reading, turned as far as the disk has turned since [rad]
    turn: float  # how far omega may be from the ellipsoid's, as a share of it, below 1
    cone: float  # how far an edge of the motion cone may be from the ellipsoid's [rad]
    tilt: float = 0.0  # greatest shift of the centre of friction by a push above the support [m]


@equation
def times(a: Interval, b: Interval) -> Interval:
    """Return the interval of all products."""
    w, x, y, z = a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high
    return Interval(min(min(w, x), min(y, z)), max(max(w, x), max(y, z)))


@equation
def scaled(interval: Interval, factor: float) -> Interval:
    """Return the interval of all products with a number."""
    return times(interval, Interval(factor, factor))


@equation
def squared(a: Interval) -> Interval:
    """Return the interval of all squares."""
    least = max(0.0, max(a.low, -a.high))
    most = max(-a.low, a.high)
    return Interval(least * least, most * most)


@equation
def left_edge(
    d: Interval,
    l: Interval,
    c_squared: Interval,
    tilt: float,
    cos_alpha: float,
    sin_alpha: float,
) -> tuple[float, float, float, float]:
    """Bound the direction of the motion cone's left edge: rightmost, then leftmost (t, n).

    The force (-sin alpha, cos alpha) moves the contact at
    ((c^2 + l^2) f_t + d l f_n, d l f_t + (c^2 + d^2) f_n), by (4), (5) and (8), less than a right
    angle away from the force: an edge that does not face forward is on the left.
    """
    dl, dd = times(d, l), squared(d)
    t_low = dl.low * cos_alpha - (c_squared.high + l.high * l.high) * sin_alpha
    t_high = dl.high * cos_alpha - (c_squared.low + l.low * l.low) * sin_alpha
    n_low = (c_squared.low + dd.low) * cos_alpha - dl.high * sin_alpha
    n_high = (c_squared.high + dd.high) * cos_alpha - dl.low * sin_alpha
    # About a centre that the force has shifted by s along itself, (f_n, -f_t) s m is added.
    m_low = tilt * min(d.low * cos_alpha - l.high * sin_alpha, 0.0)
    m_high = tilt * max(d.high * cos_alpha - l.low * sin_alpha, 0.0)
    t_low, t_high = t_low + m_low * cos_alpha, t_high + m_high * cos_alpha
    n_low, n_high = n_low + m_low * sin_alpha, n_high + m_high * sin_alpha
    if n_high <= 0.0:
        return -STEEPEST_EDGE, 1.0, -STEEPEST_EDGE, 1.0
    right_n = n_high if t_high < 0.0 else max(n_low, 0.0)
    if n_low <= 0.0:
        return t_high, right_n, -STEEPEST_EDGE, 1.0
    return t_high, right_n, t_low, n_low if t_low < 0.0 else n_high


@equation
def slope(t: float, n: float) -> float:
    """Return t/n of a direction, `STEEPEST_EDGE` at the most.

    A direction that leans to the left that far has minus infinity: nothing slips there.
    """
    if n * STEEPEST_EDGE <= abs(t):
        return STEEPEST_EDGE if t > 0.0 else -math.inf
    return t / n


@equation
def left_slopes(
    d: Interval,
    l: Interval,
    c_squared: Interval,
    tilt: float,
    friction: Array,
    cos: float,
    sin: float,
) -> tuple[float, float]:
    """Bound the slope of the motion cone's left edge for all frictions in a cell: most, then least.

    `friction` holds cosine and sine of the cell's least and of its greatest alpha, `cos` and `sin`
    are those of how far the edge may be from the ellipsoid's.
    """
    t, n, _, _ = left_edge(d, l, c_squared, tilt, friction[0], friction[1])
    nearest = slope(cos * t + sin * n, cos * n - sin * t)
    _, _, t, n = left_edge(d, l, c_squared, tilt, friction[2], friction[3])
    return nearest, slope(cos * t - sin * n, cos * n + sin * t)


@equation
def slip(v_t: float, v_n: float, left: float, right: float) -> float:
    """Return the velocity of slip of a finger outside the slopes of a motion cone, 0 inside."""
    return min(0.0, v_t - v_n * left) + max(0.0, v_t + v_n * right)


@equation
def rate_bounds(
    theta: float, cell: Array, friction: Array, push: Push, bounds: Bounds, cos: float, sin: float
) -> tuple[Interval, Interval]:
    """Bound the rates for one theta and everything else in a cell, `bounds` being of that moment.

    Return bounds of omega, the rate of theta [rad/s], and of the velocity of slip, the rate of
    d + r (theta - theta_0) [m/s]. `friction`, `cos` and `sin` are as in `left_slopes`.
    """
    l, tilt = bounds.l, bounds.tilt
    cos_theta, sin_theta = math.cos(theta), math.sin(theta)
    v_t = cos_theta * push.v_x + sin_theta * push.v_y
    v_n = cos_theta * push.v_y - sin_theta * push.v_x
    passing = scaled(bounds.r, push.spin)  # the disk's surface passes the contact along -t
    t_low, t_high = v_t - passing.high, v_t - passing.low
    rolled = scaled(bounds.r, theta - bounds.theta_0)
    d = Interval(cell[ROLLED_LOW] - rolled.high, cell[ROLLED_HIGH] - rolled.low)
    c_squared = Interval(cell[C_SQUARED_LOW], cell[C_SQUARED_HIGH])
    if v_n > 0.0:
        left_most, left_least = left_slopes(d, l, c_squared, tilt, friction, cos, sin)
        # The right edge is the left one's mirror image.
        mirrored = Interval(-d.high, -d.low)
        right_most, right_least = left_slopes(mirrored, l, c_squared, tilt, friction, cos, sin)
        slip_low = slip(t_low, v_n, left_most, right_least)
        slip_high = slip(t_high, v_n, left_least, right_most)
        # What the finger does not slip, the object goes along; the faster the finger the faster.
        along = Interval(
            t_low - slip(t_low, v_n, left_least, right_most),
            t_high - slip(t_high, v_n, left_most, right_least),
        )
    else:  # pulled along, or left standing
        slip_low, slip_high = min(0.0, t_low), max(0.0, t_high)
        along = Interval(slip_low, slip_high)
    by_normal, by_tangent = scaled(d, v_n), times(l, along)
    turn_low, turn_high = by_normal.low + by_tangent.low, by_normal.high + by_tangent.high
    if v_n <= 0.0:
        turn_low, turn_high = min(turn_low, 0.0), max(turn_high, 0.0)
    dd, share = squared(d), bounds.turn
    # The force shifts the centre along itself, so c^2 + d^2 + l^2 grows by l s_n - d s_t.
    aside, farthest = tilt * friction[3], math.sqrt(dd.high)
    worst = min(max(aside / 2.0, math.sqrt(dd.low)), farthest)  # the |d| that makes it least
    least = c_squared.low + worst * (worst - aside) + l.low * l.low
    most = c_squared.high + dd.high + l.high * l.high + tilt * l.high + aside * farthest
    least = max(least, LEAST_SQUARE)  # a shift beyond all objects bounds nothing
    omega_low = turn_low * ((1.0 + share) / least if turn_low < 0.0 else (1.0 - share) / most)
    omega_high = turn_high * ((1.0 + share) / least if turn_high > 0.0 else (1.0 - share) / most)
    return Interval(omega_low, omega_high), Interval(slip_low, slip_high)


@equation
def turned_on(bounds: Bounds, angle: float) -> Bounds:
    """Return the bounds after the finger's disk has turned by an angle."""
    theta_0 = bounds.theta_0 + angle
    return Bounds(bounds.d, bounds.l, bounds.r, theta_0, bounds.turn, bounds.cone, bounds.tilt)


@compiled
def push_cells(cells: Array, push: Push, bounds: Bounds) -> int:
    """Move all cells on by a push of half a millimetre at the most, and return how many are left.

    Those that are left come first.
    """
    left, half = 0, push.duration / 2.0
    at_half = turned_on(bounds, half * push.spin)
    theta_0 = bounds.theta_0 + push.duration * push.spin
    middle, friction = np.empty(FACES), np.empty(4)
    cos, sin = math.cos(bounds.cone), math.sin(bounds.cone)
    speed = math.hypot(push.v_x, push.v_y)
    for h in range(len(cells)):
        cell = cells[h]
        friction[0], friction[1] = cone_of_angle(cell[ALPHA_LOW])
        friction[2], friction[3] = cone_of_angle(cell[ALPHA_HIGH])
        theta_low, theta_high = cell[THETA_LOW], cell[THETA_HIGH]
        # The midpoint rule, for the face of the least and for that of the greatest theta.
        omega_a, slip_a = rate_bounds(theta_low, cell, friction, push, bounds, cos, sin)
        omega_b, slip_b = rate_bounds(theta_high, cell, friction, push, bounds, cos, sin)
        middle[:] = cell
        middle[ROLLED_LOW] += half * min(slip_a.low, slip_b.low)
        middle[ROLLED_HIGH] += half * max(slip_a.high, slip_b.high)
        at_low, at_high = theta_low + half * omega_a.low, theta_high + half * omega_b.high
        omega_a, slip_a = rate_bounds(at_low, middle, friction, push, at_half, cos, sin)
        omega_b, slip_b = rate_bounds(at_high, middle, friction, push, at_half, cos, sin)
        # Between the faces of theta the velocity of slip bends by no more than this.
        slack = LENGTH_SLACK + speed * push.duration * (theta_high - theta_low) ** 2
        theta_low += push.duration * omega_a.low - ANGLE_SLACK
        theta_high += push.duration * omega_b.high + ANGLE_SLACK
        low = cell[ROLLED_LOW] + push.duration * min(slip_a.low, slip_b.low) - slack
        high = cell[ROLLED_HIGH] + push.duration * max(slip_a.high, slip_b.high) + slack
        rolled = times(bounds.r, Interval(theta_low - theta_0, theta_high - theta_0))
        low, high = max(low, bounds.d.low + rolled.low), min(high, bounds.d.high + rolled.high)
        if low <= high:
            middle[THETA_LOW], middle[THETA_HIGH] = theta_low, theta_high
            middle[ROLLED_LOW], middle[ROLLED_HIGH] = low, high
            cells[left] = middle
            left += 1
    return left


@compiled
def hull(cells: Array, bounds: Bounds) -> tuple[Interval, Interval, Interval]:
    """Bound d [m], c^2 [m^2] and alpha [rad] in all cells together."""
    d_low, c_squared_low, alpha_low = math.inf, math.inf, math.inf
    d_high, c_squared_high, alpha_high = -math.inf, -math.inf, -math.inf
    for h in range(len(cells)):
        cell = cells[h]
        turned = Interval(cell[THETA_LOW] - bounds.theta_0, cell[THETA_HIGH] - bounds.theta_0)
        rolled = times(bounds.r, turned)
        d_low = min(d_low, cell[ROLLED_LOW] - rolled.high)
        d_high = max(d_high, cell[ROLLED_HIGH] - rolled.low)
        c_squared_low = min(c_squared_low, cell[C_SQUARED_LOW])
        c_squared_high = max(c_squared_high, cell[C_SQUARED_HIGH])
        alpha_low, alpha_high = min(alpha_low, cell[ALPHA_LOW]), max(alpha_high, cell[ALPHA_HIGH])
    d = Interval(max(d_low, bounds.d.low), min(d_high, bounds.d.high))
    return d, Interval(c_squared_low, c_squared_high), Interval(alpha_low, alpha_high)


@compiled
def cut_cells(cells: Array, theta_low: float, theta_high: float) -> int:
    """Cut off what a reading excludes [rad]; move the rest to the front and return its number."""
    left = 0
    for h in range(len(cells)):
        low, high = max(cells[h, THETA_LOW], theta_low), min(cells[h, THETA_HIGH], theta_high)
        if low <= high:
            cells[left] = cells[h]
            cells[left, THETA_LOW], cells[left, THETA_HIGH] = low, high
            left += 1
    return left


@compiled
def split_cells(cells: Array, count: int, l: float, r: float, theta_0: float) -> int:
    """Halve each of the first `count` cells across the side that says least about the turning rate.

    Return the new count, twice the old one; the caller makes sure that there is room.
    """
    for h in range(count):
        cell = cells[h]
        turned = (cell[THETA_LOW] + cell[THETA_HIGH]) / 2.0 - theta_0
        d = (cell[ROLLED_LOW] + cell[ROLLED_HIGH]) / 2.0 - r * turned
        square = (cell[C_SQUARED_LOW] + cell[C_SQUARED_HIGH]) / 2.0 + d * d + l * l
        widest, face = -1.0, ROLLED_LOW
        for low in range(0, FACES, 2):
            width = cell[low + 1] - cell[low]
            if low == THETA_LOW:
                width *= l  # the push turns by it against the edge
            elif low == C_SQUARED_LOW:
                width *= (abs(d) + l / 4.0) / square
            elif low == ALPHA_LOW:
                width *= l / 4.0
            if width > widest:
                widest, face = width, low
        half = (cell[face] + cell[face + 1]) / 2.0
        cells[count + h] = cell
        cells[count + h, face] = half
        cells[h, face + 1] = half
    return 2 * count
