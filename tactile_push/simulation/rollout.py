# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Mechanics and control law alone: one push after the other."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from tactile_push import paper
from tactile_push.control import AHEAD, PushLaw, finger_velocity, push_angle
from tactile_push.mechanics import (
    FREE,
    Body,
    Finger,
    Pose,
    clearance,
    contact,
    friction_cone,
    tangent_angle,
)
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.contact import TOUCH, piece_at, reach
from tactile_push.mechanics.push import push_body
from tactile_push.simulation.rig import RigConfig
from tactile_push.simulation.servo import Servo, lagged, quantised
from tactile_push.simulation.tip import EVEN_TURN, Tip, move_tip

THETA, PHI, D, X, Y, MODE = range(6)  # columns of a history
QUANTITIES = 6  # how many columns that is
WHOLE = 1e-9  # rounding of a delay that is a whole number of periods

_push_angle = equation(push_angle)
_finger_velocity = equation(finger_velocity)


class Start(NamedTuple):
    """Where a run starts: angle of the tangent [rad], contact [m] and first push angle [rad]."""

    theta: float
    sigma: float
    phi: float


class LawNumbers(NamedTuple):
    """The numbers of the law (18), in the order in which `push_angle` takes them."""

    kp: float
    kd: float
    theta_desired: float
    phi_min: float
    phi_max: float


class ServoNumbers(NamedTuple):
    """The numbers of a `Servo` that decide how it moves [s, s, m/s]."""

    time_constant: float
    delay: float
    quantum: float


class Periods(NamedTuple):
    """How many control periods a run has, how long each one is [s], and the belt's speed [m/s]."""

    steps: int
    period: float
    belt_speed: float


@dataclass(frozen=True, eq=False)
class Rollout:
    """What happened in one run; index k is the start of control period k."""

    theta: Array  #: angle of the pushed edge or tangent [rad], shape (K + 1,)
    phi: Array  #: push angle that drives period k [rad], shape (K + 1,)
    d: Array  #: contact along the edge [m], shape (K + 1,)
    x: Array  #: centre of mass on the belt [m], shape (K + 1,); the finger starts at (0, 0)
    y: Array  #: the same along the belt [m], shape (K + 1,)
    #: how the contact moved at the end of period k, an index of `MODES`; the last is repeated
    mode: npt.NDArray[np.int64]
    end: str  #: 'done', or why contact was lost


@equation
def _record(
    row: Array, start: Start, x_f: float, y_f: float, mode: int, path: Array, r: float
) -> None:
    """Write down the start of a control period."""
    _, _, d, l = contact(start.sigma, piece_at(start.sigma, path), path, r)
    x, y = reach(start.theta, d, l, r)
    row[THETA], row[PHI], row[D] = start.theta, start.phi, d
    row[X], row[Y], row[MODE] = x_f - x, y_f - y, mode


@equation
def _left_behind(
    angle: float, sigma: float, v_x: float, v_y: float, rest: float, path: Array, r: float
) -> tuple[float, bool]:
    """Move on a finger that no longer pushes; return where it is nearest and whether it is gone."""
    _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
    x, y = reach(angle + tangent_angle(sigma, path), d, l, r)
    sigma, gap = clearance(Pose(-x, -y, angle), v_x * rest, v_y * rest, path, r)
    return sigma, gap > TOUCH


class Pushed(NamedTuple):
    """Object, contact and finger in the course of a run."""

    angle: float  #: orientation of the object [rad]
    sigma: float  #: position of the disk's centre along its path around the object [m]
    gone: bool  #: whether the contact is lost
    mode: int  #: how the contact moved last
    x: float  #: centre of the disk across the belt, from its start [m]
    psi: float  #: angle of the finger tip [rad]


@equation
def _push(
    pushed: Pushed,
    v_x: float,
    spin: float,
    duration: float,
    periods: Periods,
    body: Body,
    finger: Finger,
) -> Pushed:
    """Push while the disk's centre goes at v_x [m/s] and the disk turns by `spin` [rad/s]."""
    v_y, gone = periods.belt_speed, False
    angle, sigma, elapsed, mode = push_body(
        pushed.angle, pushed.sigma, v_x, v_y, duration, body, finger, spin
    )
    if elapsed < duration:
        sigma, gone = _left_behind(angle, sigma, v_x, v_y, duration - elapsed, body.path, finger.r)
    x, psi = pushed.x + v_x * duration, pushed.psi + spin * duration
    return Pushed(angle, sigma, gone, mode, x, psi)


@compiled
def _move(
    pushed: Pushed,
    v_x: float,
    duration: float,
    periods: Periods,
    body: Body,
    finger: Finger,
    tip: Tip | None,  # an argument, or numba could not choose when it compiles
) -> Pushed:
    """Let the commanded point of the finger go at v_x [m/s] for a while."""
    if tip is None:
        return _push(pushed, v_x, 0.0, duration, periods, body, finger)
    parts = max(1, math.ceil(abs(v_x) * duration / EVEN_TURN))
    share = duration / parts
    for _ in range(parts):
        x = tip.x + pushed.x
        theta = pushed.angle + tangent_angle(pushed.sigma, body.path)
        after, psi = move_tip(tip, x, pushed.psi, v_x * share, theta, finger.r)
        if math.isnan(psi):  # at the end of its reach the finger stays
            after, psi = x, pushed.psi
        spin = (psi - pushed.psi) / share
        pushed = _push(pushed, (after - x) / share, spin, share, periods, body, finger)
        if pushed.gone:
            break
    return pushed


@equation
def _follow(
    pushed: Pushed,
    commands: Array,
    k: int,
    velocity: float,
    servo: ServoNumbers,
    periods: Periods,
    body: Body,
    finger: Finger,
    tip: Tip | None,
) -> tuple[Pushed, float]:
    """Push for a period with a finger that follows the commands by its servo.

    A ring keeps the commands of this and of earlier periods. The delay lets two of them through in
    this period, first the older, then the newer.
    """
    size = len(commands)
    late = max(0.0, servo.delay - (size - 2) * periods.period)  # of the newer one, in the period
    for age, duration in ((size - 1, late), (size - 2, periods.period - late)):
        command = quantised(commands[(k - age) % size], servo.quantum)
        while duration > 0.0 and not pushed.gone:
            elapsed, mean, velocity = lagged(velocity, command, servo.time_constant, duration)
            pushed = _move(pushed, mean, elapsed, periods, body, finger, tip)
            duration -= elapsed
    return pushed, velocity


@compiled
def run(
    start: Start,
    law: LawNumbers,
    pushes: Array | None,
    periods: Periods,
    body: Body,
    finger: Finger,
    servo: ServoNumbers | None,
    tip: Tip | None,
    band: float,
    history: Array,
) -> tuple[int, int]:
    """Run the law (18) or, open loop, given pushes [rad], the last of which drives nothing.

    Without a servo the finger follows its command perfectly, and without a tip its disk keeps its
    orientation. `history` takes the quantities at the
    start of every period, shape (steps + 1, 6), or of the last one, (1, 6). Return the number of
    the period at whose start finger and object touched for the last time, and the first period from
    which theta stays within the `band` around its desired value [rad], or -1.
    """
    path, r = body.path, finger.r
    steps, period, belt_speed = periods
    theta, sigma, phi = start
    pushed = Pushed(theta - tangent_angle(sigma, path), sigma, False, FREE, 0.0, math.pi / 2.0)
    y_f, before, settled = 0.0, theta, 0
    all_steps = len(history) > steps
    if servo is not None:
        velocity = 0.0
        commands = np.zeros(math.floor(servo.delay / period + WHOLE) + 2)  # under way
    for k in range(steps + 1):
        row = k if all_steps else 0
        theta = pushed.angle + tangent_angle(pushed.sigma, path)
        if pushes is None:
            if k > 0:
                phi = _push_angle(
                    phi, theta, before, law.kp, law.kd, law.theta_desired, law.phi_min, law.phi_max
                )
        else:
            phi = pushes[k]
        before = theta
        if not abs(theta - law.theta_desired) <= band:
            settled = k + 1
        now, x_f = Start(theta, pushed.sigma, phi), pushed.x
        if all_steps or k == steps:
            _record(history[row], now, x_f, y_f, pushed.mode, path, r)
        if k == steps:
            break
        v_x = _finger_velocity(phi, belt_speed)
        if servo is None:
            pushed = _move(pushed, v_x, period, periods, body, finger, tip)
        else:
            commands[k % len(commands)] = v_x
            pushed, velocity = _follow(
                pushed, commands, k, velocity, servo, periods, body, finger, tip
            )
        if pushed.gone:
            _record(history[row], now, x_f, y_f, pushed.mode, path, r)
            return k, -1
        history[row, MODE] = pushed.mode
        y_f += belt_speed * period
    return steps, settled if settled <= steps else -1


def rollout(
    config: RigConfig,
    law: PushLaw | npt.ArrayLike,
    steps: int,
    period: float = paper.CONTROL_PERIOD,
    servo: Servo | None = None,
) -> Rollout:
    """Push an object with the control law or, open loop, with given push angles.

    Parameters
    ----------
    config : RigConfig
        The object, the belt and where they start; the finger follows its commands, and its tip
        turns if the rig's does.
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

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, Sections II.C and IV.
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
    cos_alpha, sin_alpha = friction_cone(config.mu_c)
    done, _ = run(
        Start(config.theta, config.sigma, law.phi),
        LawNumbers(law.kp, law.kd, law.theta_desired, law.phi_min, law.phi_max),
        pushes,
        Periods(steps, period, config.belt_speed),
        config.body,
        Finger(cos_alpha, sin_alpha, config.radius),
        None
        if servo is None
        else ServoNumbers(servo.time_constant, servo.delay, servo.velocity_quantum),
        config.tip if config.tip_turns else None,
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
    """Refuse a negative number of steps or a period that is not positive."""
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
