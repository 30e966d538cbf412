# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What cannot be excluded: boxes of all unknowns, moved by bounds on the mechanics.

No probabilities. A cell is a box of theta, of d + r (theta - theta_0), theta_0 being the first
reading, which a sticking contact keeps whatever r is, of c^2 and of alpha = atan(mu_c). A push
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

import numpy as np

from tactile_push.estimation.resistance import cone_of_angle
from tactile_push.mechanics.compiled import Array, compiled, equation

THETA_LOW, THETA_HIGH = 0, 1  # [rad]
ROLLED_LOW, ROLLED_HIGH = 2, 3  # d + r (theta - theta_0) [m]
C_SQUARED_LOW, C_SQUARED_HIGH = 4, 5  # [m^2]
ALPHA_LOW, ALPHA_HIGH = 6, 7  # [rad]
FACES = 8

STEEPEST = 100.0  # slope beyond which an edge of the motion cone is along the edge of the object
ANGLE_SLACK = 2e-6  # more than the midpoint rule is wrong by in half a millimetre [rad]
LENGTH_SLACK = 1e-7  # the same [m]


@equation
def times(a_low: float, a_high: float, b_low: float, b_high: float) -> tuple[float, float]:
    """Multiply two intervals.

    Parameters
    ----------
    a_low, a_high, b_low, b_high : float
        The intervals.

    Returns
    -------
    low, high : float
        The interval of all products.
    """
    w, x, y, z = a_low * b_low, a_low * b_high, a_high * b_low, a_high * b_high
    return min(min(w, x), min(y, z)), max(max(w, x), max(y, z))


@equation
def squared(low: float, high: float) -> tuple[float, float]:
    """Square an interval.

    Parameters
    ----------
    low, high : float
        The interval.

    Returns
    -------
    low, high : float
        The interval of all squares.
    """
    least = max(0.0, max(low, -high))
    most = max(-low, high)
    return least * least, most * most


@equation
def left_edge(
    d_low: float,
    d_high: float,
    c_squared_low: float,
    c_squared_high: float,
    cos_alpha: float,
    sin_alpha: float,
    l_low: float,
    l_high: float,
) -> tuple[float, float, float, float]:
    """Bound the direction of the motion cone's left edge.

    The force (-sin alpha, cos alpha) moves the contact at
    ((c^2 + l^2) f_t + d l f_n, d l f_t + (c^2 + d^2) f_n), by (4), (5) and (8), less than a right
    angle away from the force: an edge that does not face forward is on the left.

    Parameters
    ----------
    d_low, d_high, c_squared_low, c_squared_high, l_low, l_high : float
        Bounds of d [m], c^2 [m^2] and l [m].
    cos_alpha, sin_alpha : float
        The friction cone.

    Returns
    -------
    right_t, right_n, left_t, left_n : float
        The rightmost and the leftmost direction, along tangent and normal.
    """
    dl_low, dl_high = times(d_low, d_high, l_low, l_high)
    dd_low, dd_high = squared(d_low, d_high)
    t_low = dl_low * cos_alpha - (c_squared_high + l_high * l_high) * sin_alpha
    t_high = dl_high * cos_alpha - (c_squared_low + l_low * l_low) * sin_alpha
    n_low = (c_squared_low + dd_low) * cos_alpha - dl_high * sin_alpha
    n_high = (c_squared_high + dd_high) * cos_alpha - dl_low * sin_alpha
    if n_high <= 0.0:
        return -STEEPEST, 1.0, -STEEPEST, 1.0
    right_n = n_high if t_high < 0.0 else max(n_low, 0.0)
    if n_low <= 0.0:
        return t_high, right_n, -STEEPEST, 1.0
    return t_high, right_n, t_low, n_low if t_low < 0.0 else n_high


@equation
def slope(t: float, n: float) -> float:
    """Give t/n of a direction.

    Parameters
    ----------
    t, n : float
        The direction along tangent and normal.

    Returns
    -------
    float
        The slope, `STEEPEST` at the most; minus infinity of what leans to the left that far, where
        nothing slips.
    """
    if n * STEEPEST <= abs(t):
        return STEEPEST if t > 0.0 else -math.inf
    return t / n


@equation
def left_slopes(
    d_low: float,
    d_high: float,
    cell: Array,
    friction: Array,
    l_low: float,
    l_high: float,
    cos: float,
    sin: float,
) -> tuple[float, float]:
    """Bound the slope of the motion cone's left edge, for all frictions in a cell.

    Parameters
    ----------
    d_low, d_high, l_low, l_high : float
        Bounds of d and l [m].
    cell : ndarray, shape (8,)
        The cell.
    friction : ndarray, shape (4,)
        Cosine and sine of its least and of its greatest alpha.
    cos, sin : float
        Cosine and sine of how far the edge may be from the ellipsoid's.

    Returns
    -------
    nearest, farthest : float
        The greatest and the least slope.
    """
    low, high = cell[C_SQUARED_LOW], cell[C_SQUARED_HIGH]
    t, n, _, _ = left_edge(d_low, d_high, low, high, friction[0], friction[1], l_low, l_high)
    nearest = slope(cos * t + sin * n, cos * n - sin * t)
    _, _, t, n = left_edge(d_low, d_high, low, high, friction[2], friction[3], l_low, l_high)
    return nearest, slope(cos * t - sin * n, cos * n + sin * t)


@equation
def rate_bounds(
    theta: float,
    cell: Array,
    friction: Array,
    v_x: float,
    v_y: float,
    l_low: float,
    l_high: float,
    r_low: float,
    r_high: float,
    theta_0: float,
    share: float,
    lean: tuple[float, float],
) -> tuple[float, float, float, float]:
    """Bound the rates for one theta and everything else in a cell.

    Parameters
    ----------
    theta : float
        Angle of the edge [rad].
    cell, friction
        As `left_slopes` takes them.
    v_x, v_y : float
        Velocity of the finger relative to the support [m/s].
    l_low, l_high : float
        Bounds of l [m].
    r_low, r_high : float
        Bounds of the radius of the finger's disk [m].
    theta_0 : float
        The first reading [rad].
    share : float
        How far omega may be from the ellipsoid's, as a share of it, below 1.
    lean : tuple of float
        Cosine and sine of how far an edge of the motion cone may be from the ellipsoid's.

    Returns
    -------
    omega_low, omega_high : float
        Bounds of the rate of theta [rad/s].
    slip_low, slip_high : float
        Bounds of the velocity of slip, the rate of d + r (theta - theta_0) [m/s].
    """
    cos, sin = math.cos(theta), math.sin(theta)
    v_t, v_n = cos * v_x + sin * v_y, cos * v_y - sin * v_x
    turned = theta - theta_0
    rolled_low, rolled_high = times(r_low, r_high, turned, turned)
    d_low, d_high = cell[ROLLED_LOW] - rolled_high, cell[ROLLED_HIGH] - rolled_low
    low, high = cell[C_SQUARED_LOW], cell[C_SQUARED_HIGH]
    if v_n > 0.0:
        nearest, farthest = left_slopes(d_low, d_high, cell, friction, l_low, l_high, *lean)
        slip_low = min(0.0, v_t - v_n * nearest)
        slip_high = min(0.0, v_t - v_n * farthest)
        # The right edge is the left one's mirror image.
        nearest, farthest = left_slopes(-d_high, -d_low, cell, friction, l_low, l_high, *lean)
        slip_low += max(0.0, v_t + v_n * farthest)
        slip_high += max(0.0, v_t + v_n * nearest)
    else:  # pulled along, or left standing
        slip_low, slip_high = min(0.0, v_t), max(0.0, v_t)
    turn_low, turn_high = times(d_low, d_high, v_n, v_n)
    along_low, along_high = times(l_low, l_high, v_t - slip_high, v_t - slip_low)
    turn_low, turn_high = turn_low + along_low, turn_high + along_high
    if v_n <= 0.0:
        turn_low, turn_high = min(turn_low, 0.0), max(turn_high, 0.0)
    dd_low, dd_high = squared(d_low, d_high)
    least, most = low + dd_low + l_low * l_low, high + dd_high + l_high * l_high
    omega_low = turn_low * ((1.0 + share) / least if turn_low < 0.0 else (1.0 - share) / most)
    omega_high = turn_high * ((1.0 + share) / least if turn_high > 0.0 else (1.0 - share) / most)
    return omega_low, omega_high, slip_low, slip_high


@compiled
def push_cells(
    cells: Array,
    v_x: float,
    v_y: float,
    duration: float,
    d_low: float,
    d_high: float,
    l_low: float,
    l_high: float,
    r_low: float,
    r_high: float,
    theta_0: float,
    share: float,
    angle: float,
) -> int:
    """Move all cells on by a short push, as long as the contact stays on the edge.

    Parameters
    ----------
    cells : ndarray, shape (H, 8)
        The cells, changed; those that are left come first.
    v_x, v_y, l_low, l_high, r_low, r_high, theta_0, share
        As `rate_bounds` takes them.
    angle : float
        How far an edge of the motion cone may be from the ellipsoid's [rad].
    duration : float
        How long [s], for half a millimetre at the most.
    d_low, d_high : float
        Ends of the edge [m].

    Returns
    -------
    int
        How many are left.
    """
    left, half = 0, duration / 2.0
    middle, friction = np.empty(FACES), np.empty(4)
    lean = math.cos(angle), math.sin(angle)
    speed = math.hypot(v_x, v_y)
    known = v_x, v_y, l_low, l_high, r_low, r_high, theta_0, share, lean
    for h in range(len(cells)):
        cell = cells[h]
        friction[0], friction[1] = cone_of_angle(cell[ALPHA_LOW])
        friction[2], friction[3] = cone_of_angle(cell[ALPHA_HIGH])
        theta_low, theta_high = cell[THETA_LOW], cell[THETA_HIGH]
        a, _, low_a, high_a = rate_bounds(theta_low, cell, friction, *known)
        _, b, low_b, high_b = rate_bounds(theta_high, cell, friction, *known)
        middle[:] = cell
        middle[ROLLED_LOW] += half * min(low_a, low_b)
        middle[ROLLED_HIGH] += half * max(high_a, high_b)
        a, _, low_a, high_a = rate_bounds(theta_low + half * a, middle, friction, *known)
        _, b, low_b, high_b = rate_bounds(theta_high + half * b, middle, friction, *known)
        # Between the faces of theta the velocity of slip bends by no more than this.
        slack = LENGTH_SLACK + speed * duration * (theta_high - theta_low) ** 2
        theta_low += duration * a - ANGLE_SLACK
        theta_high += duration * b + ANGLE_SLACK
        low = cell[ROLLED_LOW] + duration * min(low_a, low_b) - slack
        high = cell[ROLLED_HIGH] + duration * max(high_a, high_b) + slack
        rolled_low, rolled_high = times(r_low, r_high, theta_low - theta_0, theta_high - theta_0)
        low, high = max(low, d_low + rolled_low), min(high, d_high + rolled_high)
        if low <= high:
            middle[THETA_LOW], middle[THETA_HIGH] = theta_low, theta_high
            middle[ROLLED_LOW], middle[ROLLED_HIGH] = low, high
            cells[left] = middle
            left += 1
    return left


@compiled
def cut_cells(cells: Array, theta_low: float, theta_high: float) -> int:
    """Cut off what a reading excludes.

    Parameters
    ----------
    cells : ndarray, shape (H, 8)
        The cells, changed; those that are left come first.
    theta_low, theta_high : float
        Bounds that the reading sets to theta [rad].

    Returns
    -------
    int
        How many are left.
    """
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
    """Halve every cell across the side that says least about the turning rate.

    Parameters
    ----------
    cells : ndarray, shape (H, 8)
        The cells, of which the first ones are in use; twice as many have room.
    count : int
        How many are in use.
    l : float
        Distance from the edge to the centre of mass [m].
    r : float
        Radius of the finger's disk [m].
    theta_0 : float
        The first reading [rad].

    Returns
    -------
    int
        How many are in use now.
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
