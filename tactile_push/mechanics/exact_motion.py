# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Motion of a pushed object under the exact limit surface of its support points.

The power that the support dissipates, sum w |v_i| over points that bear the load w and move at
v_i, is a convex function of the object's velocity, and its gradient is the wrench that keeps this
motion going: it holds the limit surface and its normals. Among the motions that move the contact
as the finger asks, the least dissipating one needs no moment about the contact; the moment grows
with omega, so this is one root. When the contact slips, the force's direction is known instead of
the contact's velocity, and the velocity's direction is one root more.

Where a support point stands still its friction is anything up to w, and the roots are jumps: both
are kept in brackets, which shrink to them.

A push above the support tilts the pressure: loads grow with the force. For a given motion the
frictions' directions are known, so the force is the root of linear equations, and the same two
roots find the motion.
"""

import math

from tactile_push.mechanics.compiled import Array, compiled, equation, reduction
from tactile_push.mechanics.motion import (
    FREE,
    SLIP_LEFT,
    STICK,
    contact_mode,
    contact_velocity,
    sticking_twist,
    twist_under_force,
)

STANDSTILL = 1e-13  # speed at which a support point's friction fades, of the contact's
STANDS = 1e-300  # speed of a finger at rest [m/s]; its inverse is still a number
EVEN = 3  # rows of a support whose loads do not depend on the force
SMALLEST_SQUARE = 1e-200  # of a speed [m^2/s^2]; its power -3/2 is still a number
CONVERGED = 1e-6  # last step of Newton's method and value before it, relative
FARTHEST = 1e6  # longest step of Newton's method, relative
BISECTED = 1e-13  # last step of a bisection, relative


@reduction
def support_force(
    u_x: float,
    u_y: float,
    omega: float,
    x_c: float,
    y_c: float,
    support: Array,
    tilting_x: float = 0.0,
    tilting_y: float = 0.0,
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Compute the wrench that keeps a motion going, and its derivatives by the motion.

    The wrench (f_x, f_y, m) refers to the reference point (x_c, y_c) of the object's frame, where
    the material moves at (u_x, u_y), not zero. The symmetric matrix of its derivatives by
    (u_x, u_y, omega) follows: h_xx, h_xy, h_yy, h_xm, h_ym, h_mm. The loads are those under the
    force (tilting_x, tilting_y).
    """
    floor = STANDSTILL**2 * (u_x * u_x + u_y * u_y) + SMALLEST_SQUARE
    f_x, f_y, m = 0.0, 0.0, 0.0
    h_xx, h_xy, h_yy, h_xm, h_ym, h_mm = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(support.shape[1]):
        x, y = support[0, i] - x_c, support[1, i] - y_c
        v_x, v_y = u_x - omega * y, u_y + omega * x
        square = max(v_x * v_x + v_y * v_y, floor)
        load = support[2, i]
        if len(support) > EVEN:
            load += tilting_x * support[3, i] + tilting_y * support[4, i]
        viscosity = load / math.sqrt(square)  # friction over speed
        f_x += viscosity * v_x
        f_y += viscosity * v_y
        m += viscosity * (x * v_y - y * v_x)
        # Friction turns with the velocity and does not grow with it.
        stiffness = viscosity / square
        along = v_x * x + v_y * y
        h_xx += stiffness * v_y * v_y
        h_xy -= stiffness * v_x * v_y
        h_yy += stiffness * v_x * v_x
        h_xm -= stiffness * v_y * along
        h_ym += stiffness * v_x * along
        h_mm += stiffness * along * along
    return f_x, f_y, m, h_xx, h_xy, h_yy, h_xm, h_ym, h_mm


@compiled
def solved(
    xx: float, xy: float, yx: float, yy: float, b_x: float, b_y: float
) -> tuple[float, float]:
    """Solve two linear equations, f = b + A f, for f."""
    determinant = (1.0 - xx) * (1.0 - yy) - xy * yx
    return (
        ((1.0 - yy) * b_x + xy * b_y) / determinant,
        ((1.0 - xx) * b_y + yx * b_x) / determinant,
    )


@reduction
def frictions_by_force(
    u_x: float, u_y: float, omega: float, x_c: float, y_c: float, support: Array
) -> tuple[float, float, float, float, float, float, float, float]:
    """Compute how the wrench of a motion depends on the force that tilts the pressure.

    Returned are the force under no tilt and the derivatives of the wrench (f_x, f_y, m) by the
    tilting force: f_x, f_y, xx, xy, yx, yy, mx, my.
    """
    floor = STANDSTILL**2 * (u_x * u_x + u_y * u_y) + SMALLEST_SQUARE
    f_x, f_y, xx, xy, yx, yy, mx, my = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(support.shape[1]):
        x, y = support[0, i] - x_c, support[1, i] - y_c
        v_x, v_y = u_x - omega * y, u_y + omega * x
        speed = math.sqrt(max(v_x * v_x + v_y * v_y, floor))
        e_x, e_y = v_x / speed, v_y / speed
        f_x += support[2, i] * e_x
        f_y += support[2, i] * e_y
        xx += support[3, i] * e_x
        xy += support[4, i] * e_x
        yx += support[3, i] * e_y
        yy += support[4, i] * e_y
        arm = x * e_y - y * e_x
        mx += support[3, i] * arm
        my += support[4, i] * arm
    return f_x, f_y, xx, xy, yx, yy, mx, my


@compiled
def pushing_force(
    u_x: float, u_y: float, omega: float, x_c: float, y_c: float, support: Array
) -> tuple[float, float, float, float, float, float, float, float, float, float, float, float]:
    """Compute the wrench that keeps a motion going under the loads that it causes itself.

    As `support_force`; the matrix of derivatives is not symmetric if loads depend on the force,
    and three more numbers follow: h_yx, h_mx, h_my.
    """
    if len(support) == EVEN:
        f_x, f_y, m, h_xx, h_xy, h_yy, h_xm, h_ym, h_mm = support_force(
            u_x, u_y, omega, x_c, y_c, support
        )
        return f_x, f_y, m, h_xx, h_xy, h_yy, h_xm, h_ym, h_mm, h_xy, h_xm, h_ym
    f_x, f_y, xx, xy, yx, yy, mx, my = frictions_by_force(u_x, u_y, omega, x_c, y_c, support)
    f_x, f_y = solved(xx, xy, yx, yy, f_x, f_y)
    f_x, f_y, m, h_xx, h_xy, h_yy, h_xm, h_ym, h_mm = support_force(
        u_x, u_y, omega, x_c, y_c, support, f_x, f_y
    )
    # Derivatives under fixed loads, and by the loads that change with the force.
    p_xx, p_yx = solved(xx, xy, yx, yy, h_xx, h_xy)
    p_xy, p_yy = solved(xx, xy, yx, yy, h_xy, h_yy)
    p_xm, p_ym = solved(xx, xy, yx, yy, h_xm, h_ym)
    p_mx = h_xm + mx * p_xx + my * p_yx
    p_my = h_ym + mx * p_xy + my * p_yy
    p_mm = h_mm + mx * p_xm + my * p_ym
    return f_x, f_y, m, p_xx, p_xy, p_yy, p_xm, p_ym, p_mm, p_yx, p_mx, p_my


@equation
def next_guess(
    x: float,
    value: float,
    slope: float,
    before: float,
    lower: float,
    upper: float,
    scale: float,
    size: float,
) -> tuple[float, bool, bool]:
    """Go on to the root of a function that never decreases.

    Newton's method, or a bisection where that does not halve the value or leaves the bracket.
    `before` is the value's magnitude at the last guess. A step counts as short beside |x| + scale,
    a value as small beside `size`: near a support point it changes steeply, and a short step is no
    sign of a root. Returned are the next guess, whether Newton's method gave it, and whether it is
    the root.
    """
    open_ended = math.isinf(upper - lower)
    if not abs(value) > 0.0:  # also if it is not a number
        return x, True, True
    if slope > 0.0 and (open_ended or abs(value) <= before / 2.0):
        after = x - value / slope
        # A slope that is 0 but for rounding leads nowhere.
        if lower < after < upper and abs(after - x) <= FARTHEST * (abs(x) + scale):
            short = abs(after - x) <= CONVERGED * (abs(after) + scale)
            return after, True, short and abs(value) <= CONVERGED * size
    if open_ended:
        return x + math.copysign(abs(x) + scale, -value), False, False
    after = (lower + upper) / 2.0
    return after, False, upper - lower <= BISECTED * (abs(after) + scale)


@compiled
def exact_sticking(
    u_x: float, u_y: float, omega: float, x_c: float, y_c: float, c: float, support: Array
) -> tuple[float, float, float, float, float, float, float, float]:
    """Compute the motion that dissipates least when the contact's velocity is given.

    The material at the contact (x_c, y_c) moves at (u_x, u_y), not zero; `omega` is a first guess.
    Returned are omega, the force (f_x, f_y), and by the contact's velocity the derivatives of the
    force (s_xx, s_xy, s_yy) and of omega (o_x, o_y). Where loads depend on the force, s_xy is the
    mean of the two mixed derivatives.
    """
    scale = math.hypot(u_x, u_y) / (c + math.hypot(x_c, y_c))
    lower, upper, before, smooth, found = -math.inf, math.inf, math.inf, True, False
    f_x = f_y = h_xx = h_xy = h_yy = h_xm = h_ym = h_mm = h_yx = h_mx = h_my = 0.0
    f_lx = f_ly = m_l = f_ux = f_uy = m_u = 0.0
    while not found:
        f_x, f_y, m, h_xx, h_xy, h_yy, h_xm, h_ym, h_mm, h_yx, h_mx, h_my = pushing_force(
            u_x, u_y, omega, x_c, y_c, support
        )
        if m < 0.0:
            lower, f_lx, f_ly, m_l = omega, f_x, f_y, m
        else:
            upper, f_ux, f_uy, m_u = omega, f_x, f_y, m
        size = (f_x * u_x + f_y * u_y + m * omega) / (scale + abs(omega))  # of the moments
        after, smooth, found = next_guess(omega, m, h_mm, before, lower, upper, scale, size)
        step, omega, before = after - omega, after, abs(m)
        f_x, f_y = f_x + h_xm * step, f_y + h_ym * step
    if not smooth:  # a standing point's friction lies between those of both sides
        share = m_l / (m_l - m_u)
        f_x, f_y = f_lx + share * (f_ux - f_lx), f_ly + share * (f_uy - f_ly)
    o_x, o_y = (-h_mx / h_mm, -h_my / h_mm) if h_mm > 0.0 else (0.0, 0.0)
    s_xy = h_xy + h_xm * o_y
    if len(support) > EVEN:
        s_xy = (s_xy + h_yx + h_ym * o_x) / 2.0
    return omega, f_x, f_y, h_xx + h_xm * o_x, s_xy, h_yy + h_ym * o_y, o_x, o_y


@compiled
def exact_slipping(
    e_x: float,
    e_y: float,
    slope: float,
    omega: float,
    x_c: float,
    y_c: float,
    c: float,
    support: Array,
) -> tuple[float, float]:
    """Compute the motion under a force along the unit vector (e_x, e_y) at the contact.

    The contact moves at (e_x, e_y) + slope (-e_y, e_x), up to a positive factor, and the object
    turns at omega [rad/m] with it; both arguments are first guesses of what is returned.
    """
    lower, upper, before, found = -math.inf, math.inf, math.inf, False
    while not found:
        omega, f_x, f_y, s_xx, s_xy, s_yy, o_x, o_y = exact_sticking(
            e_x - slope * e_y, e_y + slope * e_x, omega, x_c, y_c, c, support
        )
        across = e_x * f_y - e_y * f_x
        if across < 0.0:
            lower = slope
        else:
            upper = slope
        stiffness = s_xx * e_y * e_y - 2.0 * s_xy * e_x * e_y + s_yy * e_x * e_x
        size = math.hypot(f_x, f_y)
        after, smooth, found = next_guess(slope, across, stiffness, before, lower, upper, 1.0, size)
        step, slope, before = after - slope, after, abs(across)
        if smooth:
            omega += step * (o_y * e_x - o_x * e_y)
    return slope, omega


@compiled
def exact_pushed_twist(
    v_px: float,
    v_py: float,
    x_c: float,
    y_c: float,
    cos_alpha: float,
    sin_alpha: float,
    c: float,
    t_x: float,
    t_y: float,
    support: Array,
) -> tuple[float, float, float, float, int]:
    """Compute the motion of an object that a finger pushes, whether the contact sticks or slips.

    As `pushed_twist`, in the edge frame; the support points alone are in the object's frame.

    Parameters
    ----------
    v_px, v_py : float
        Velocity of the finger [m/s].
    x_c, y_c : float
        Contact relative to the centre of friction [m].
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    c : float
        Ratio m_max / f_max [m], the scale of lengths.
    t_x, t_y : float
        Tangent of the edge in the object's frame.
    support : ndarray, shape (3, N) or (5, N)
        Support points (x, y, load) in the object's frame; for a push above the support two rows
        more, the derivatives of the loads by the force (f_x, f_y), see `ExactLimitSurface`.

    Returns
    -------
    v_x, v_y, omega : float
        Velocity of the object at its centre of friction [m/s, m/s, rad/s].
    v_slip : float
        Velocity of the finger along the tangent relative to the object [m/s].
    mode : int
        `STICK`, `SLIP_LEFT`, `SLIP_RIGHT` or `FREE`, see `contact_mode`.

    References
    ----------
    S. Goyal, A. Ruina and J. Papadopoulos, "Planar sliding with dry friction Part 1. Limit surface
    and moment function", Wear 143, 307-330, 1991.
    """
    speed = math.hypot(v_px, v_py)
    if speed <= STANDS:
        return 0.0, 0.0, 0.0, 0.0, FREE
    # The equations know no unit of time, and are solved at the speed 1.
    along = v_px
    v_px, v_py = v_px / speed, v_py / speed
    x_o, y_o = t_x * x_c - t_y * y_c, t_y * x_c + t_x * y_c
    _, _, omega = sticking_twist(v_px, v_py, x_c, y_c, c)
    omega, f_x, f_y, _, _, _, _, _ = exact_sticking(
        t_x * v_px - t_y * v_py, t_y * v_px + t_x * v_py, omega, x_o, y_o, c, support
    )
    f_x, f_y = t_x * f_x + t_y * f_y, t_x * f_y - t_y * f_x
    mode = contact_mode(v_px, v_py, f_x, f_y, cos_alpha, sin_alpha)
    if mode == STICK:
        v_x, v_y = v_px + omega * y_c, v_py - omega * x_c  # (6), (7)
        return speed * v_x, speed * v_y, speed * omega, 0.0, STICK
    if mode == FREE:
        return 0.0, 0.0, 0.0, along, FREE
    stuck = omega
    f_x, f_y = -sin_alpha if mode == SLIP_LEFT else sin_alpha, cos_alpha
    v_x, v_y, omega = twist_under_force(f_x, f_y, x_c, y_c, c)
    v_bx, v_by = contact_velocity(v_x, v_y, omega, x_c, y_c)
    power = f_x * v_bx + f_y * v_by
    slope, omega = exact_slipping(
        t_x * f_x - t_y * f_y,
        t_y * f_x + t_x * f_y,
        (f_x * v_by - f_y * v_bx) / power,
        omega / power,
        x_o,
        y_o,
        c,
        support,
    )
    v_bx, v_by = f_x - slope * f_y, f_y + slope * f_x
    past = v_px * v_by - v_py * v_bx
    if not (v_by > 0.0 and (past < 0.0 if mode == SLIP_LEFT else past > 0.0)):
        # Only rounding tells the force that it takes to stick from the friction cone's edge.
        v_x, v_y = v_px + stuck * y_c, v_py - stuck * x_c
        return speed * v_x, speed * v_y, speed * stuck, 0.0, STICK
    kappa = v_py / v_by  # the object gives way to the finger along the normal
    v_ox, omega = kappa * v_bx, kappa * omega
    v_x, v_y, v_slip = v_ox + omega * y_c, v_py - omega * x_c, v_px - v_ox  # (12), (14)
    return speed * v_x, speed * v_y, speed * omega, speed * v_slip, mode
