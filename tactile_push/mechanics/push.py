# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One push: the motion of Section II.C integrated while the finger moves straight on.

The classical Runge-Kutta method of order 4. The rates at the end of a step, which the next step
needs anyway, give an embedded solution of order 3 and so an estimate of the error. The rates have
kinks where the contact changes between sticking and slipping or passes from an edge to a corner:
a solution of order 2 sees them, and the steps become short.
"""

import math

from tactile_push.mechanics.body import Body, Finger, Pose
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.contact import (
    SIGMA,
    TOUCH,
    clearance,
    contact,
    piece_at,
    reach,
    rotated,
    tangent_angle,
)
from tactile_push.mechanics.exact_motion import exact_pushed_twist
from tactile_push.mechanics.motion import FREE, pushed_twist

TOLERANCE = 1e-7  # estimated error of a step, of the angle [rad] and of sigma by the path's radius
SMOOTH_SHARE = 0.03  # weight of the estimate of order 2 where there is no sign of a kink
SMALLEST_STEP = 1e-9  # of the push; how finely the end of contact is located


@equation
def _turn_and_slip(
    v_px: float,
    v_py: float,
    t_x: float,
    t_y: float,
    d: float,
    l: float,
    c: float,
    support: Array | None,  # an argument, or numba could not choose when it compiles
    finger: Finger,
) -> tuple[float, float, int]:
    """Compute omega, v_slip and mode under the object's limit surface, as `pushed_twist` does."""
    cos_alpha, sin_alpha = finger.cos_alpha, finger.sin_alpha
    if support is None:
        _, _, omega, v_slip, mode = pushed_twist(v_px, v_py, d, -l, cos_alpha, sin_alpha, c)
    else:
        _, _, omega, v_slip, mode = exact_pushed_twist(
            v_px, v_py, d, -l, cos_alpha, sin_alpha, c, t_x, t_y, support
        )
    return omega, v_slip, mode


@equation
def push_rates(
    turn: float,
    sigma: float,
    piece: int,
    v_x: float,
    v_y: float,
    body: Body,
    finger: Finger,
    spin: float = 0.0,
) -> tuple[float, float, int]:
    """Compute the rates of the object's angle and of the contact during a push.

    Parameters
    ----------
    turn : float
        How far the object has turned since the start of the push [rad].
    sigma : float
        Position of the disk's centre along its path around the object [m].
    piece : int
        Piece of the path where it probably lies.
    v_x, v_y : float
        Velocity of the disk's centre relative to the support [m/s], in the axes that the object's
        frame had at the start of the push.
    body : Body
        The object.
    finger : Finger
        The finger.
    spin : float, optional
        Angular velocity of the disk [rad/s], with which the finger's surface passes the contact:
        its material there has the velocity v - r spin t. The paper's disk keeps its orientation.

    Returns
    -------
    omega : float
        Angular velocity of the object [rad/s].
    sigma_dot : float
        Velocity of the disk's centre along its path [m/s], eq. (16); the disk rolls by its own
        turning too.
    mode : int
        `FREE`, `STICK`, `SLIP_LEFT` or `SLIP_RIGHT`.
    """
    t_x, t_y, d, l = contact(sigma, piece, body.path, finger.r)
    v_x, v_y = rotated(v_x, v_y, -turn)
    v_px, v_py = t_x * v_x + t_y * v_y - finger.r * spin, t_x * v_y - t_y * v_x
    omega, v_slip, mode = _turn_and_slip(v_px, v_py, t_x, t_y, d, l, body.c, body.support, finger)
    return omega, v_slip - (omega - spin) * finger.r, mode  # (16)


@compiled
def push_body(
    angle: float,
    sigma: float,
    v_x: float,
    v_y: float,
    duration: float,
    body: Body,
    finger: Finger,
    spin: float = 0.0,
) -> tuple[float, float, float, int]:
    """Push an object that the finger touches, straight on for a while, as `push` does."""
    path = body.path
    v_x, v_y = rotated(v_x, v_y, -angle)
    piece = piece_at(sigma, path)
    scale = 2.0 * math.pi / path[-1, SIGMA]
    turn, elapsed, step = 0.0, 0.0, duration
    omega_1, rate_1, mode = push_rates(turn, sigma, piece, v_x, v_y, body, finger, spin)
    while elapsed < duration and mode != FREE:
        last = elapsed + step >= duration
        if last:
            step = duration - elapsed
        turn_2, sigma_2 = turn + step / 2.0 * omega_1, sigma + step / 2.0 * rate_1
        omega_2, rate_2, mode_2 = push_rates(turn_2, sigma_2, piece, v_x, v_y, body, finger, spin)
        turn_3, sigma_3 = turn + step / 2.0 * omega_2, sigma + step / 2.0 * rate_2
        omega_3, rate_3, mode_3 = push_rates(turn_3, sigma_3, piece, v_x, v_y, body, finger, spin)
        turn_4, sigma_4 = turn + step * omega_3, sigma + step * rate_3
        omega_4, rate_4, mode_4 = push_rates(turn_4, sigma_4, piece, v_x, v_y, body, finger, spin)
        turn_5 = turn + step / 6.0 * (omega_1 + 2.0 * omega_2 + 2.0 * omega_3 + omega_4)
        sigma_5 = sigma + step / 6.0 * (rate_1 + 2.0 * rate_2 + 2.0 * rate_3 + rate_4)
        omega_5, rate_5, mode_5 = push_rates(turn_5, sigma_5, piece, v_x, v_y, body, finger, spin)
        # The solution with omega_5 in the place of omega_4 is of order 3.
        error = step / 6.0 * max(abs(omega_5 - omega_4), abs(rate_5 - rate_4) * scale)
        # One of order 2 sees kinks anywhere in the step, and is strict where there is one.
        bend = (
            step
            / 6.0
            * max(
                abs(omega_1 - omega_2 - omega_3 + omega_4),
                abs(rate_1 - rate_2 - rate_3 + rate_4) * scale,
            )
        )
        piece_5 = piece_at(sigma_5, path)
        smooth = mode_2 == mode and mode_3 == mode and mode_4 == mode and mode_5 == mode
        if smooth and piece_5 == piece:
            bend *= SMOOTH_SHARE
        error = max(error, bend) / TOLERANCE
        smallest = step <= SMALLEST_STEP * duration
        if mode_5 == FREE and not smallest:
            step /= 2.0  # up to where the finger stops pushing, no further
            continue
        if not error > 1.0 or smallest:  # also if it is not a number
            turn, sigma, omega_1, rate_1 = turn_5, sigma_5, omega_5, rate_5
            mode, piece = mode_5, piece_5
            elapsed += step
            if last:
                return angle + turn, sigma, duration, mode
        step *= min(4.0, max(0.2, 0.9 / math.sqrt(math.sqrt(max(error, 1e-3)))))
    return angle + turn, sigma, elapsed, mode


@compiled
def push(
    angle: float,
    sigma: float,
    v_x: float,
    v_y: float,
    duration: float,
    path: Array,
    c: float,
    support: Array | None,
    cos_alpha: float,
    sin_alpha: float,
    r: float,
    spin: float = 0.0,
) -> tuple[float, float, float, int]:
    """Push an object that the finger touches, straight on for a while.

    For calls from Python: it takes the numbers of a `Body` and a `Finger` one by one, because
    numba needs longer to recognise two named tuples that come from Python than for the push.

    Parameters
    ----------
    angle : float
        Orientation of the object at the start [rad].
    sigma : float
        Position of the disk's centre along its path around the object at the start [m].
    v_x, v_y : float
        Velocity of the disk's centre relative to the support [m/s].
    duration : float
        Duration of the push [s].
    path : ndarray, shape (M + 1, 8)
        Pieces of the path, see `Outline.path`.
    c : float
        Ratio m_max / f_max [m].
    support : ndarray, shape (3, N) or (5, N), or None
        Rows of an exact limit surface, see `ExactLimitSurface.points`; None for the ellipsoid.
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    r : float
        Radius of the finger's disk [m].
    spin : float, optional
        Angular velocity of the finger's disk [rad/s]; the paper's disk keeps its orientation.

    Returns
    -------
    angle, sigma : float
        Orientation and contact at the end [rad, m].
    elapsed : float
        How long the finger pushed [s]: less than `duration` if it came to move along or away from
        the object, for instance because the object turned out of its way.
    mode : int
        How the contact moved at the end: `FREE`, `STICK`, `SLIP_LEFT` or `SLIP_RIGHT`.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, Section II.C and eq. (16).
    """
    body, finger = Body(path, c, support), Finger(cos_alpha, sin_alpha, r)
    return push_body(angle, sigma, v_x, v_y, duration, body, finger, spin)


@compiled
def approach(
    pose: Pose,
    x_f: float,
    y_f: float,
    v_x: float,
    v_y: float,
    duration: float,
    path: Array,
    r: float,
) -> tuple[float, float, bool]:
    """Move the finger straight on until it touches an object at rest.

    The outline is convex, and so is the gap over time: Newton's method comes from before the
    contact and never passes it.
    """
    elapsed = 0.0
    while True:
        sigma, gap = clearance(pose, x_f + v_x * elapsed, y_f + v_y * elapsed, path, r)
        if gap <= TOUCH:
            return elapsed, sigma, True
        t_x, t_y, _, _ = contact(sigma, piece_at(sigma, path), path, r)
        v_t, v_o = rotated(v_x, v_y, -pose.angle)
        closing = t_x * v_o - t_y * v_t
        if not closing * (duration - elapsed) > gap:
            return duration, sigma, False
        if elapsed + gap / closing == elapsed:  # no number lies between
            return elapsed, sigma, True
        elapsed += gap / closing


@compiled
def move_finger(
    pose: Pose,
    sigma: float,
    touching: bool,
    x_f: float,
    y_f: float,
    v_x: float,
    v_y: float,
    duration: float,
    body: Body,
    finger: Finger,
    spin: float = 0.0,
) -> tuple[Pose, float, bool, int]:
    """Move the finger straight on, whether it touches the object from the start, later or never.

    Parameters
    ----------
    pose : Pose
        Pose of the object.
    sigma : float
        Position of the disk's centre along its path around the object [m], if it touches.
    touching : bool
        Whether finger and object touch.
    x_f, y_f : float
        Centre of the finger's disk at the start [m].
    v_x, v_y : float
        Velocity of the disk's centre relative to the support [m/s].
    duration : float
        Duration of the motion [s].
    body : Body
        The object.
    finger : Finger
        The finger.
    spin : float, optional
        Angular velocity of the finger's disk [rad/s].

    Returns
    -------
    pose : Pose
        Pose of the object at the end.
    sigma : float
        Contact, or the nearest position along the path [m].
    touching : bool
        Whether finger and object touch at the end.
    mode : int
        How the contact moved at the end: `FREE`, `STICK`, `SLIP_LEFT` or `SLIP_RIGHT`.
    """
    path, r, mode = body.path, finger.r, FREE
    around = path[-1, SIGMA]
    if not touching:
        near = sigma
        elapsed, sigma, touching = approach(pose, x_f, y_f, v_x, v_y, duration, path, r)
        sigma += around * math.floor((near - sigma) / around + 0.5)
        x_f, y_f, duration = x_f + v_x * elapsed, y_f + v_y * elapsed, duration - elapsed
    if touching:
        angle, sigma, elapsed, mode = push_body(
            pose.angle, sigma, v_x, v_y, duration, body, finger, spin
        )
        x_f, y_f, duration = x_f + v_x * elapsed, y_f + v_y * elapsed, duration - elapsed
        if elapsed > 0.0:
            _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
            x, y = reach(angle + tangent_angle(sigma, path), d, l, r)
            pose = Pose(x_f - x, y_f - y, angle)
    if mode == FREE:  # the object is convex and stands still: a finger that leaves it is gone
        near = sigma
        sigma, gap = clearance(pose, x_f + v_x * duration, y_f + v_y * duration, path, r)
        touching = gap <= TOUCH
        sigma += around * math.floor((near - sigma) / around + 0.5)
    return pose, sigma, touching, mode
