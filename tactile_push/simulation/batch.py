# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Very many rollouts, on all cores, by the same compiled function as a single one."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from tactile_push import paper
from tactile_push.control import AHEAD
from tactile_push.mechanics import Body, Finger, Slider, check_friction, friction_cone
from tactile_push.mechanics.compiled import Array, compiled, equation
from tactile_push.mechanics.contact import CURVATURE
from tactile_push.simulation.rollout import (
    QUANTITIES,
    LawNumbers,
    Periods,
    ServoNumbers,
    Start,
    check_ahead,
    check_time,
    check_towards,
    run,
)
from tactile_push.simulation.servo import Servo
from tactile_push.simulation.tip import Tip
from tactile_push.threads import on_all_cores, usable_cores

CHUNKS_PER_WORKER = 8  # so that cores whose runs end early get more; picked


@dataclass(frozen=True, eq=False)
class Rollouts:
    """What happened in B runs.

    The arrays of quantities have the shape (B, K + 1) with histories, index k being the start of
    control period k and NaN what comes after the end of a run; without them they have the shape
    (B,) and hold the last value of each run. The quantities are those of `Rollout`.
    """

    theta: Array
    phi: Array
    d: Array
    x: Array
    y: Array
    mode: Array
    # Control periods at whose start finger and object touched: fewer where contact was lost; (B,).
    steps: npt.NDArray[np.int64]
    # First step from which theta stays within the band around its desired value; -1 where it is
    # outside at the end or contact was lost; (B,).
    settle_step: npt.NDArray[np.int64]


class Bodies(NamedTuple):
    """Objects side by side: object j has rows ends[j] to ends[j + 1] of all paths and points."""

    paths: Array
    path_ends: npt.NDArray[np.int64]
    c: Array
    points: Array | None
    point_ends: npt.NDArray[np.int64]


class Runs(NamedTuple):
    """A row per run: start, law, friction cone, index of the object, and servo if there is one."""

    starts: Array
    laws: Array
    cones: Array
    objects: npt.NDArray[np.int64]
    servos: Array | None


# What may be None is an argument, or numba could not choose when it compiles.
@equation
def _support(points: Array | None, first: int, last: int) -> Array | None:
    """Cut an object's support points out of all."""
    return None if points is None else points[:, first:last]


@equation
def _servo(servos: Array | None, i: int) -> ServoNumbers | None:
    """Take the servo of a run, if there are servos."""
    return None if servos is None else ServoNumbers(servos[i, 0], servos[i, 1], servos[i, 2])


@compiled
def _run_many(
    first: int,
    last: int,
    runs: Runs,
    bodies: Bodies,
    periods: Periods,
    r: float,
    tip: Tip | None,
    band: float,
    histories: Array,
    ends: npt.NDArray[np.int64],
    stop: npt.NDArray[np.int64],
) -> None:
    """Make the runs from `first` up to `last`."""
    for i in range(first, last):
        if stop[0]:
            return
        j = runs.objects[i]
        path = bodies.paths[bodies.path_ends[j] : bodies.path_ends[j + 1]]
        support = _support(bodies.points, bodies.point_ends[j], bodies.point_ends[j + 1])
        start, law, cone = runs.starts[i], runs.laws[i], runs.cones[i]
        ends[i, 0], ends[i, 1] = run(
            Start(start[0], start[1], start[2]),
            LawNumbers(law[0], law[1], law[2], law[3], law[4]),
            None,
            periods,
            Body(path, bodies.c[j], support),
            Finger(cone[0], cone[1], r),
            _servo(runs.servos, i),
            tip,
            band,
            histories[i],
        )


def rollouts(
    slider: Slider | Sequence[Slider],
    *,
    theta: npt.ArrayLike,
    d: npt.ArrayLike = 0.0,
    phi: npt.ArrayLike = AHEAD,
    mu_c: npt.ArrayLike = math.inf,
    kp: npt.ArrayLike = 0.0,
    kd: npt.ArrayLike = 0.0,
    theta_desired: npt.ArrayLike = 0.0,
    phi_min: npt.ArrayLike = paper.PHI_MIN,
    phi_max: npt.ArrayLike = paper.PHI_MAX,
    steps: int,
    period: float = paper.CONTROL_PERIOD,
    belt_speed: float = paper.BELT_SPEED,
    radius: float = paper.FINGER_RADIUS,
    servo: Servo | Sequence[Servo] | None = None,
    tip: Tip | None = None,
    band: float = paper.TOLERANCE,
    history: bool = False,
) -> Rollouts:
    """Push very many objects with the control law, on all cores.

    Arguments that are array_like are broadcast against each other, the sliders and the servos to
    the shape (B,). With both gains 0 the pushes are open loop.

    Parameters
    ----------
    slider : Slider or sequence of Slider, length 1 or B
        The objects, either all with the ellipsoid or all with exact limit surfaces. The same object
        may come as often as wanted.
    theta : array_like
        Angle of the pushed edge or tangent at the start [rad], of the outline's first piece.
    d : array_like, optional
        Contact along the edge at the start [m].
    phi : array_like, optional
        First push angle [rad], within the bounds.
    mu_c : array_like, optional
        Coefficient of friction between finger and object, 0 to infinity.
    kp, kd : array_like, optional
        Gains of the law [rad/rad].
    theta_desired : array_like, optional
        Desired angle of the edge [rad].
    phi_min, phi_max : array_like, optional
        Bounds of the push angle [rad], in (0, pi).
    steps : int
        Number of control periods.
    period, belt_speed, radius : float, optional
        Control period [s], speed of the belt, v_y [m/s], and effective radius of the finger's disk
        [m].
    servo : Servo or sequence of Servo, length 1 or B, optional
        How the finger follows its command, at rest in the beginning; perfectly by default.
    tip : Tip, optional
        How the finger's disk turns as it moves, see `RigConfig.tip`; it keeps its orientation by
        default, as in the paper's equations.
    band : float, optional
        How near theta must stay to its desired value to have settled [rad].
    history : bool, optional
        Whether to return every step instead of the last ones alone. The memory needed is that of
        what is returned.

    Returns
    -------
    Rollouts
        The runs.

    Raises
    ------
    ValueError
        If a number is out of its range or not finite, a start is no contact of its object, the
        shapes do not fit, or the sliders are of both kinds.
    """
    check_time(steps, period)
    for name, value in (('belt_speed', belt_speed), ('radius', radius)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f'{name}: expected a positive finite number, got {value}')
    if not band >= 0.0:
        raise ValueError(f'band: expected an angle of 0 or more [rad], got {band}')
    sliders = [slider] if isinstance(slider, Slider) else list(slider)
    if not sliders:
        raise ValueError('slider: expected one or more, got none')
    gains = {'kp': kp, 'kd': kd, 'theta_desired': theta_desired}
    numbers = {'theta': theta, 'd': d, 'phi': phi, **gains, 'phi_min': phi_min, 'phi_max': phi_max}
    arrays = {name: np.asarray(value, dtype=float) for name, value in numbers.items()}
    for name, array in arrays.items():
        if not np.isfinite(array).all():
            wrong = array[~np.isfinite(array)][0]
            raise ValueError(f'{name}: expected finite numbers, got {wrong}')
        if name.startswith('phi'):
            check_ahead(name, array)
    arrays['mu_c'] = np.asarray(mu_c, dtype=float)
    for friction in np.unique(arrays['mu_c']):
        check_friction(float(friction))
    if servo is not None:
        several = [servo] if isinstance(servo, Servo) else list(servo)
        arrays |= {
            f'servo.{one.name}': np.array([getattr(each, one.name) for each in several])
            for one in fields(Servo)
        }
    index = {id(one): position for position, one in reversed(list(enumerate(sliders)))}
    which = np.array([index[id(one)] for one in sliders])
    shapes = {'slider': which.shape, **{name: array.shape for name, array in arrays.items()}}
    try:
        which, *fitting = np.broadcast_arrays(which, *arrays.values())
        if which.ndim != 1 or which.size == 0:
            raise ValueError
    except ValueError:
        given = ', '.join(f'{name} {shape}' for name, shape in shapes.items())
        raise ValueError(
            f'expected numbers or arrays of one shape (B,) that is not empty, got {given}'
        ) from None
    start = dict(zip(arrays, fitting, strict=True))
    count = len(which)
    check_towards(start['phi'], start['theta'])
    beyond = (start['phi'] < start['phi_min']) | (start['phi'] > start['phi_max'])
    if beyond.any():
        wrong, least, most = (start[name][beyond][0] for name in ('phi', 'phi_min', 'phi_max'))
        raise ValueError(f'phi: expected phi_min to phi_max, {least} to {most} rad, got {wrong}')
    distinct, which = np.unique(which, return_inverse=True)
    objects = [sliders[position] for position in distinct]
    paths = _distinct_paths(objects, radius)
    sigma = np.empty(count)
    for j, one in enumerate(objects):
        mine = which == j if len(objects) > 1 else slice(None)
        sigma[mine] = _sigmas(one, radius, paths[j], start['d'][mine])
    supports = [one.points for one in objects if one.points is not None]
    if len(supports) not in (0, len(objects)):
        raise ValueError('slider: expected all with points or all without, got both')
    if len({len(points) for points in supports}) > 1:
        raise ValueError('slider: expected all with a tilt or all without, got both')
    histories = np.full((count, steps + 1 if history else 1, QUANTITIES), np.nan)
    ends = np.empty((count, 2), dtype=np.int64)
    servos = None
    if servo is not None:
        servos = np.stack([start[f'servo.{one.name}'] for one in fields(Servo)], axis=1)
    runs = Runs(
        np.stack([start['theta'], sigma, start['phi']], axis=1),
        np.stack([start[name] for name in LawNumbers._fields], axis=1),
        np.array([friction_cone(friction) for friction in start['mu_c'].tolist()]),
        which,
        servos,
    )
    bodies = Bodies(
        np.concatenate(paths),
        np.cumsum([0, *(len(path) for path in paths)]),
        np.array([one.c for one in objects]),
        np.concatenate(supports, axis=1) if supports else None,
        np.cumsum([0, *(points.shape[1] for points in supports)]),
    )
    periods = Periods(steps, period, belt_speed)

    def run_chunk(borders: tuple[int, int]) -> None:
        _run_many(*borders, runs, bodies, periods, radius, tip, band, histories, ends, stop)

    stop = np.zeros(1, dtype=np.int64)  # what the user's interrupt sets
    chunks = min(count, usable_cores() * CHUNKS_PER_WORKER)
    borders = np.linspace(0, count, chunks + 1).astype(int).tolist()
    with on_all_cores() as pool:
        try:
            list(pool.map(run_chunk, pairwise(borders)))
        except BaseException:
            stop[0] = 1
            raise
    reached_theta, reached_phi, reached_d, x, y, mode = np.moveaxis(
        histories if history else histories[:, 0], -1, 0
    )
    return Rollouts(reached_theta, reached_phi, reached_d, x, y, mode, ends[:, 0], ends[:, 1])


def _distinct_paths(objects: Sequence[Slider], radius: float) -> list[Array]:
    """Return the path around each object, made once for each outline."""
    made: dict[int, Array] = {}
    for one in objects:
        if id(one.outline) not in made:
            made[id(one.outline)] = one.outline.path(radius)
    return [made[id(one.outline)] for one in objects]


def _sigmas(slider: Slider, radius: float, path: Array, d: Array) -> Array:
    """Find contacts on the first piece of an outline."""
    bounds = [slider.outline.sigma(radius, d=float(extreme)) for extreme in (d.min(), d.max())]
    if path[0, CURVATURE] > 0.0:  # an arc has one contact with a tangent
        return np.full(len(d), bounds[0])
    return np.clip(d - d.min() + bounds[0], bounds[0], bounds[1])
