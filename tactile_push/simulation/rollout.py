# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Mechanics and control law alone: one push after the other."""

import math
from dataclasses import astuple, dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.control import AHEAD, PushLaw, finger_velocity, push_angle
from tactile_push.mechanics import (
    FREE,
    clearance,
    contact,
    friction_cone,
    piece_at,
    push,
    reach,
    tangent_angle,
)
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.contact import TOUCH
from tactile_push.simulation.rig import RigConfig
from tactile_push.simulation.servo import Servo, lagged, quantised

THETA, PHI, D, X, Y, MODE = range(6)
QUANTITIES = 6
TIME_CONSTANT, DELAY, QUANTUM = range(3)
WHOLE = 1e-9  # rounding of a delay that is a whole number of periods

_push_angle = equation(push_angle)
_finger_velocity = equation(finger_velocity)


@dataclass(frozen=True, eq=False)
class Rollout:
    """What happened in one run; index k is the start of control period k.

    Parameters
    ----------
    theta : ndarray, shape (K + 1,)
        Angle of the pushed edge or tangent [rad].
    phi : ndarray, shape (K + 1,)
        Push angle that drives period k [rad].
    d : ndarray, shape (K + 1,)
        Contact along the edge [m].
    x, y : ndarray, shape (K + 1,)
        Centre of mass on the belt, the finger's disk starting at the origin [m].
    mode : ndarray of int, shape (K + 1,)
        How the contact moved in period k, an index of `MODES`: at the end of the period; the last
        one is that of the period before it.
    end : str
        Why it ended: 'done', or the reason for which there is no contact any more.
    """

    theta: Array
    phi: Array
    d: Array
    x: Array
    y: Array
    mode: npt.NDArray[np.int64]
    end: str


@equation
def _record(
    row: Array,
    theta: float,
    phi: float,
    sigma: float,
    x_f: float,
    y_f: float,
    mode: int,
    path: Array,
    r: float,
) -> None:
    """Write down the start of a step."""
    _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
    x, y = reach(theta, d, l, r)
    row[THETA], row[PHI], row[D], row[X], row[Y] = theta, phi, d, x_f - x, y_f - y
    row[MODE] = mode


@equation
def _left_behind(
    angle: float, sigma: float, v_x: float, v_y: float, rest: float, path: Array, r: float
) -> tuple[float, bool]:
    """Move on a finger that pushes no longer: where it is nearest, and whether it is gone."""
    _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
    x, y = reach(angle + tangent_angle(sigma, path), d, l, r)
    sigma, gap = clearance(-x, -y, angle, v_x * rest, v_y * rest, path, r)
    return sigma, gap > TOUCH


@equation
def _follow(
    angle: float,
    sigma: float,
    commands: Array,
    k: int,
    velocity: float,
    servo: Array,
    v_y: float,
    period: float,
    path: Array,
    c: float,
    points: Array | None,
    cos_alpha: float,
    sin_alpha: float,
    r: float,
) -> tuple[float, float, bool, int, float, float]:
    """Push for a period with a finger that follows the commands by its servo.

    The commands of this and of earlier periods are kept in a ring. What arrives is at first the
    older, then the newer of the two that the delay lets through in this period.
    """
    size, way, gone, mode = len(commands), 0.0, False, FREE
    late = max(0.0, servo[DELAY] - (size - 2) * period)  # of the newer one, in the period
    for age, duration in ((size - 1, late), (size - 2, period - late)):
        command = quantised(commands[(k - age) % size], servo[QUANTUM])
        while duration > 0.0 and not gone:
            elapsed, mean, velocity = lagged(velocity, command, servo[TIME_CONSTANT], duration)
            angle, sigma, pushed, mode = push(
                angle, sigma, mean, v_y, elapsed, path, c, points, cos_alpha, sin_alpha, r
            )
            if pushed < elapsed:
                sigma, gone = _left_behind(angle, sigma, mean, v_y, elapsed - pushed, path, r)
            way += mean * elapsed
            duration -= elapsed
    return angle, sigma, gone, mode, velocity, way


@compiled
def run(
    theta: float,
    sigma: float,
    phi: float,
    kp: float,
    kd: float,
    theta_desired: float,
    phi_min: float,
    phi_max: float,
    pushes: Array | None,
    steps: int,
    period: float,
    belt_speed: float,
    path: Array,
    c: float,
    points: Array | None,
    cos_alpha: float,
    sin_alpha: float,
    r: float,
    servo: Array | None,
    band: float,
    history: Array,
) -> tuple[int, int]:
    """Run the law (18) or, open loop, given pushes.

    Parameters
    ----------
    theta, sigma : float
        Angle of the tangent [rad] and contact along the disk's path [m] at the start.
    phi : float
        First push angle [rad].
    kp, kd, theta_desired, phi_min, phi_max : float
        The law, see `push_angle`.
    pushes : ndarray, shape (steps + 1,), or None
        Push angles [rad] instead of the law; the last one drives nothing.
    steps : int
        Number of control periods.
    period : float
        Control period [s].
    belt_speed : float
        Speed of the belt, v_y [m/s].
    path, c, points, cos_alpha, sin_alpha, r
        As `push` takes them.
    servo : ndarray, shape (3,), or None
        Time constant [s], delay [s] and velocity quantum [m/s] of a finger that does not follow
        its command perfectly.
    band : float
        How near theta must stay to its desired value to have settled [rad].
    history : ndarray, shape (steps + 1, 6) or (1, 6)
        Takes what happens at the start of every step or of the last one.

    Returns
    -------
    done : int
        Number of the step at whose start finger and object touched for the last time.
    settled : int
        First step from which theta stays in the band, or -1.
    """
    angle = theta - tangent_angle(sigma, path)
    x_f, y_f, mode, before, settled = 0.0, 0.0, FREE, theta, 0
    all_steps = len(history) > steps
    if servo is not None:
        velocity = 0.0
        commands = np.zeros(math.floor(servo[DELAY] / period + WHOLE) + 2)  # under way
    for k in range(steps + 1):
        row = k if all_steps else 0
        theta = angle + tangent_angle(sigma, path)
        if pushes is None:
            if k > 0:
                phi = _push_angle(phi, theta, before, kp, kd, theta_desired, phi_min, phi_max)
        else:
            phi = pushes[k]
        before = theta
        if not abs(theta - theta_desired) <= band:
            settled = k + 1
        if all_steps or k == steps:
            _record(history[row], theta, phi, sigma, x_f, y_f, mode, path, r)
        if k == steps:
            break
        sigma_before, v_x = sigma, _finger_velocity(phi, belt_speed)
        gone = False
        if servo is None:
            way = v_x * period
            angle, sigma, elapsed, mode = push(
                angle, sigma, v_x, belt_speed, period, path, c, points, cos_alpha, sin_alpha, r
            )
            if elapsed < period:
                sigma, gone = _left_behind(angle, sigma, v_x, belt_speed, period - elapsed, path, r)
        else:
            commands[k % len(commands)] = v_x
            angle, sigma, gone, mode, velocity, way = _follow(
                *(angle, sigma, commands, k, velocity, servo),
                *(belt_speed, period, path, c, points, cos_alpha, sin_alpha, r),
            )
        if gone:
            _record(history[row], theta, phi, sigma_before, x_f, y_f, mode, path, r)
            return k, -1
        history[row, MODE] = mode
        x_f, y_f = x_f + way, y_f + belt_speed * period
    return steps, settled if settled <= steps else -1


def rollout(
    config: RigConfig,
    law: PushLaw | npt.ArrayLike,
    steps: int,
    period: float = 0.1,
    servo: Servo | None = None,
) -> Rollout:
    """Push an object with the control law or, open loop, with given push angles.

    Parameters
    ----------
    config : RigConfig
        The object, the belt and where they start; the finger goes where it is told.
    law : PushLaw or array_like, shape () or (steps,)
        The control law, which is not changed and starts as after a reset to its present push
        angle, or the push angles themselves [rad], each in (0, pi).
    steps : int
        Number of control periods.
    period : float, optional
        Control period [s].
    servo : Servo, optional
        How the finger follows its command, at rest in the beginning; perfectly by default.

    Returns
    -------
    Rollout
        The trajectory, shorter than `steps` if contact is lost.

    Raises
    ------
    ValueError
        If `steps` is negative, the period not positive, a push angle not against the belt, or the
        first one points away from the object.
    """
    check_time(steps, period)
    pushes = None
    if not isinstance(law, PushLaw):
        pushes = np.asarray(law, dtype=float)
        if pushes.shape not in ((), (steps,)):
            raise ValueError(
                f'law: expected one push angle or {steps}, got the shape {pushes.shape}'
            )
        pushes = np.broadcast_to(pushes, (steps,))
        pushes = np.append(pushes, pushes[-1:] if steps else AHEAD)
        check_ahead('law', pushes)
        law = PushLaw(0.0, 0.0, config.theta)
    check_towards(law.phi if pushes is None else pushes[0], config.theta)
    history = np.empty((steps + 1, QUANTITIES))
    done, _ = run(
        config.theta,
        config.slider.outline.sigma(config.radius, d=config.d),
        law.phi,
        law.kp,
        law.kd,
        law.theta_desired,
        law.phi_min,
        law.phi_max,
        pushes,
        steps,
        period,
        config.belt_speed,
        config.slider.outline.path(config.radius),
        config.slider.c,
        config.slider.points,
        *friction_cone(config.mu_c),
        config.radius,
        None if servo is None else np.array(astuple(servo)),
        math.inf,
        history,
    )
    theta, phi, d, x, y, mode = history[: done + 1].T
    return Rollout(
        theta,
        phi,
        d,
        x,
        y,
        mode.astype(np.int64),
        'done' if done == steps else f'the finger lost the object in step {done}',
    )


def check_time(steps: int, period: float) -> None:
    """Refuse a negative number of steps and a period that is none."""
    if not steps >= 0:
        raise ValueError(f'steps: expected a whole number of 0 or more, got {steps}')
    if not (math.isfinite(period) and period > 0.0):
        raise ValueError(f'period: expected a positive time [s], got {period}')


def check_ahead(name: str, phi: Array) -> None:
    """Refuse push angles that do not point against the belt."""
    ahead = (phi > 0.0) & (phi < math.pi)
    if not ahead.all():
        raise ValueError(
            f'{name}: expected push angles in (0, pi) rad, against the belt, got {phi[~ahead][0]}'
        )


def check_towards(phi: npt.ArrayLike, theta: npt.ArrayLike) -> None:
    """Refuse first pushes that do not go towards the object."""
    beta = np.asarray(phi) - np.asarray(theta)
    away = ~((beta > 0.0) & (beta < math.pi))
    if away.any():
        wrong = np.broadcast_to(phi, beta.shape)[away][0]
        edge = np.broadcast_to(theta, beta.shape)[away][0]
        raise ValueError(
            f'phi: expected a first push towards the object, {edge} to {edge + math.pi} rad for an '
            f'edge at theta = {edge} rad, got {wrong}'
        )
