# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Motion of a pushed object under the ellipsoidal limit surface (Section II.C).

All vectors are in the edge frame: x along the tangent (the direction of increasing d), y along
the normal into the object, origin at the centre of mass. The contact lies at (x_c, y_c) =
(d, -l). The equations hold in any frame; this one spares every rotation.
"""

from tactile_push.mechanics.compiled import equation

FREE, STICK, SLIP_LEFT, SLIP_RIGHT = 0, 1, 2, 3
MODES = ('free', 'stick', 'slip_left', 'slip_right')


@equation
def contact_velocity(
    v_x: float, v_y: float, omega: float, x_c: float, y_c: float
) -> tuple[float, float]:
    """Give the velocity of the object's material at the contact.

    Parameters
    ----------
    v_x, v_y, omega : float
        Velocity of the object at its centre of mass [m/s, m/s, rad/s].
    x_c, y_c : float
        Contact relative to the centre of mass [m].

    Returns
    -------
    v_ox, v_oy : float
        Velocity [m/s].
    """
    return v_x - omega * y_c, v_y + omega * x_c


@equation
def twist_under_force(
    f_x: float, f_y: float, x_c: float, y_c: float, c: float
) -> tuple[float, float, float]:
    """Give the motion under a force at the contact, up to a positive factor.

    Parameters
    ----------
    f_x, f_y : float
        Force at the contact, in any unit.
    x_c, y_c : float
        Contact relative to the centre of mass [m].
    c : float
        Ratio m_max / f_max [m].

    Returns
    -------
    v_x, v_y, omega : float
        Direction of the generalized velocity at the centre of mass, eqs. (4), (5), (8).
    """
    m = x_c * f_y - y_c * f_x  # (8)
    return f_x, f_y, m / c**2  # (4), (5)


@equation
def motion_cone(
    x_c: float, y_c: float, cos_alpha: float, sin_alpha: float, c: float
) -> tuple[float, float, float, float]:
    """Give the edges of the motion cone: contact velocities under the friction cone's edges.

    Parameters
    ----------
    x_c, y_c : float
        Contact relative to the centre of mass [m].
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    c : float
        Ratio m_max / f_max [m].

    Returns
    -------
    v_lx, v_ly, v_rx, v_ry : float
        Left and right edge, up to a positive factor.
    """
    v_x, v_y, omega = twist_under_force(-sin_alpha, cos_alpha, x_c, y_c, c)
    v_lx, v_ly = contact_velocity(v_x, v_y, omega, x_c, y_c)
    v_x, v_y, omega = twist_under_force(sin_alpha, cos_alpha, x_c, y_c, c)
    v_rx, v_ry = contact_velocity(v_x, v_y, omega, x_c, y_c)
    return v_lx, v_ly, v_rx, v_ry


@equation
def sticking_twist(
    v_px: float, v_py: float, x_c: float, y_c: float, c: float
) -> tuple[float, float, float]:
    """Give the motion of the object when the contact sticks.

    Parameters
    ----------
    v_px, v_py : float
        Velocity of the finger [m/s].
    x_c, y_c : float
        Contact relative to the centre of mass [m].
    c : float
        Ratio m_max / f_max [m].

    Returns
    -------
    v_x, v_y, omega : float
        Velocity of the object at its centre of mass [m/s, m/s, rad/s], eqs. (9), (10), (11).
    """
    square = c**2 + x_c**2 + y_c**2
    v_x = ((c**2 + x_c**2) * v_px + x_c * y_c * v_py) / square  # (9)
    v_y = (x_c * y_c * v_px + (c**2 + y_c**2) * v_py) / square  # (10)
    omega = (x_c * v_y - y_c * v_x) / c**2  # (11)
    return v_x, v_y, omega


@equation
def slipping_twist(
    v_py: float, f_x: float, f_y: float, x_c: float, y_c: float, c: float
) -> tuple[float, float, float]:
    """Give the motion of the object when the contact slips under the force of a cone's edge.

    Parameters
    ----------
    v_py : float
        Velocity of the finger along the normal [m/s].
    f_x, f_y : float
        Edge of the friction cone, in any unit.
    x_c, y_c : float
        Contact relative to the centre of mass [m].
    c : float
        Ratio m_max / f_max [m].

    Returns
    -------
    v_x, v_y, omega : float
        Velocity of the object at its centre of mass [m/s, m/s, rad/s], eqs. (13), (15).
    """
    v_x, v_y, omega = twist_under_force(f_x, f_y, x_c, y_c, c)
    _, v_by = contact_velocity(v_x, v_y, omega, x_c, y_c)
    kappa = v_py / v_by  # the object gives way to the finger along the normal
    return kappa * v_x, kappa * v_y, kappa * omega


@equation
def contact_mode(
    v_px: float, v_py: float, f_x: float, f_y: float, cos_alpha: float, sin_alpha: float
) -> int:
    """Tell whether the contact sticks or slips.

    The velocity of the contact turns in the same sense as the force that causes it, since a limit
    surface is convex. So the finger's velocity is inside the motion cone if, and only if, the force
    that it takes to stick is inside the friction cone; and the finger slips to that side of the
    motion cone to which the force would leave the friction cone.

    Parameters
    ----------
    v_px, v_py : float
        Velocity of the finger [m/s].
    f_x, f_y : float
        Force at the contact if it sticks, in any unit.
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.

    Returns
    -------
    int
        `STICK`, `SLIP_LEFT`, `SLIP_RIGHT`, or `FREE` when the finger moves away, slides along
        without a force or rests. A finger inside the motion cone sticks even if it moves away
        from the edge: the paper's "pulling", for which there must be friction.
    """
    from_left = sin_alpha * f_y + cos_alpha * f_x
    from_right = sin_alpha * f_y - cos_alpha * f_x
    pushes = f_y > 0.0 or (sin_alpha > 0.0 and f_x != 0.0)
    if from_left >= 0.0 and from_right >= 0.0 and pushes:
        return STICK
    if v_py <= 0.0:
        return FREE
    return SLIP_LEFT if f_x < 0.0 else SLIP_RIGHT


@equation
def pushed_twist(
    v_px: float,
    v_py: float,
    x_c: float,
    y_c: float,
    cos_alpha: float,
    sin_alpha: float,
    c: float,
) -> tuple[float, float, float, float, int]:
    """Give the motion of an object that a finger pushes, whether the contact sticks or slips.

    Parameters
    ----------
    v_px, v_py : float
        Velocity of the finger [m/s].
    x_c, y_c : float
        Contact relative to the centre of mass [m].
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    c : float
        Ratio m_max / f_max [m].

    Returns
    -------
    v_x, v_y, omega : float
        Velocity of the object at its centre of mass [m/s, m/s, rad/s].
    v_slip : float
        Velocity of the finger along the tangent relative to the object [m/s], eq. (14).
    mode : int
        `STICK`, `SLIP_LEFT`, `SLIP_RIGHT` or `FREE`, see `contact_mode`.
    """
    v_x, v_y, omega = sticking_twist(v_px, v_py, x_c, y_c, c)
    # (4), (5): the force is parallel to (v_x, v_y).
    mode = contact_mode(v_px, v_py, v_x, v_y, cos_alpha, sin_alpha)
    if mode == STICK:
        return v_x, v_y, omega, 0.0, STICK
    if mode == FREE:
        return 0.0, 0.0, 0.0, v_px, FREE
    f_x = -sin_alpha if mode == SLIP_LEFT else sin_alpha
    v_x, v_y, omega = slipping_twist(v_py, f_x, cos_alpha, x_c, y_c, c)
    v_ox, _ = contact_velocity(v_x, v_y, omega, x_c, y_c)
    return v_x, v_y, omega, v_px - v_ox, mode  # (12), (14)
