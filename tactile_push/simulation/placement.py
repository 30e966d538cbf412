# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object placed on the rig, through sensor, finger and the steps that the nodes run."""

import math
import typing
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tactile_push.control import PUSHING, WAITING, Limits, PushControl, Tick
from tactile_push.control.placing.believing import Belief, BelievingLaw
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed
from tactile_push.control.placing.stages import LEARNING, MISSED
from tactile_push.estimation import ActiveSensing
from tactile_push.estimation.prior import ROUND
from tactile_push.mechanics import Slider, friction_cone
from tactile_push.mechanics.contact import D_START, L_START, LENGTH, TAU
from tactile_push.mechanics.resistance import Pressure, resistance
from tactile_push.mechanics.turning_tip import STRAIGHT, TurningTip
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.belief import belief_of
from tactile_push.simulation.experiment import control_periods
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout
from tactile_push.simulation.trace import Trace

if typing.TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig

CERTAIN = 1e-4  # deviations of what is told and not estimated [m, rad]
# Motions under which the growth is fitted, those of plans: of the centre of mass from the edge's
# normal [rad], and omega c by its speed; picked.
MOTIONS = np.radians((-60.0, -40.0, -20.0, 0.0, 20.0, 40.0, 60.0))
TURNS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)


@dataclass(frozen=True)
class Placement:
    """How an object was placed."""

    stage: str  #: the law's last one
    end: str  #: why the finger stopped; empty if the law said so
    x_error: float  #: where the centre of mass is, less where it should be [m]
    theta_error: float  #: the same of the edge's angle [rad]
    belt: float  #: belt used [m]
    learned: float  #: the part of it before the law committed itself [m]


def place(
    rig: 'Rig | MujocoRig',
    law: PlaceLaw,
    *,
    period: float = 0.1,
    sensing: ActiveSensing | None = None,
    limits: Limits | None = None,
    seed: int = 0,
    watch: 'Callable[[Rig | MujocoRig, Tick], None]' = lambda rig, tick: None,
) -> Placement:
    """Place an object on a rig.

    Parameters
    ----------
    rig : Rig or MujocoRig
        The rig. The run moves it.
    law : PlaceLaw
        The law, with its goal in `finger_base`. The run changes it.
    period : float, optional
        Control period [s].
    sensing : ActiveSensing, optional
        What it believes; by default it is told the truth.
    limits : Limits, optional
        When to stop and how fast to go at the most.
    seed : int, optional
        Of the sensor's errors.
    watch : callable, optional
        Told rig and tick as each control period begins, and once more when the object is let go.

    Returns
    -------
    Placement
        How the object lies when the finger lets go, or stops.
    """
    push = PushControl(law, rig.config.belt_speed, period, limits)
    learned, end = 0.0, ''
    for tick in believing(rig, push, law, sensing, seed):
        watch(rig, tick)
        lifting = math.isfinite(rig.free_in)
        silent = tick.silence > push.limits.contact_timeout and not tick.apart
        if not lifting and (tick.state not in (PUSHING, WAITING) or silent):
            end = tick.stop_reason or tick.state
            break
        if math.isfinite(law.tell_in):
            rig.lift(law.tell_in)
            law.told()
        if rig.lifted or rig.free_in <= period:
            if not rig.lifted:
                rig.step(tick.v_x or 0.0, rig.free_in)
            watch(rig, tick)
            break
        if law.stage == MISSED:
            break
        if law.stage == LEARNING:
            learned = law.used
    x = rig.object_in_finger_disk.x + rig.finger_pose.x
    return Placement(law.stage, end, x - law.goal.x, rig.theta - law.goal.theta, law.used, learned)


def believing(
    rig: 'Rig | MujocoRig',
    push: PushControl,
    law: BelievingLaw,
    sensing: ActiveSensing | None,
    seed: int,
) -> Iterator[Tick]:
    """Run a law on a rig, as `control_periods` does, and tell it what is believed of each reading.

    Parameters
    ----------
    rig, push, law : Rig or MujocoRig, PushControl, BelievingLaw
        The rig, and the control with its law.
    sensing : ActiveSensing or None
        What it believes; None for the truth.
    seed : int
        Of the sensor's errors.

    Yields
    ------
    Tick
        What the control used and gave in each control period, before the law is told of it.
    """
    piece = push.period * push.belt_speed
    steps = None if sensing is None else Sensing(sensing, lambda k, _: k * push.period)
    for k, tick in enumerate(control_periods(rig, push, 1, seed)):
        yield tick
        if steps is None:
            law.believe(_truth(rig, piece))
        else:
            values = steps.tick((k, 0), tick).values
            law.believe(belief_of(values, rig.finger_pose.x, tip_of(rig.config, rig.joints), piece))


def followed(
    rig: Rig,
    push: PushControl,
    law: BelievingLaw,
    sensing: ActiveSensing,
    seed: int,
    steps: int,
) -> Rollout:
    """Run a law on a rig, as `believing` does, for some control periods or until the finger stops.

    Returns
    -------
    Rollout
        What happened.
    """
    trace, end = Trace(), 'done'
    for tick in believing(rig, push, law, sensing, seed):
        if tick.state != PUSHING:
            trace.close(rig)
            end = tick.stop_reason or tick.state
            break
        trace.add(rig, tick.phi)
        if len(trace) > steps:
            break
    return trace.run(end)


def pressure_of(slider: Slider, tangent: float = 0.0) -> Pressure:
    """Return how an object resists its turning, as the estimator and the planner see it.

    While the object hardly turns it is exact: c^2 is the load's second moment along the way of the
    centre of mass. The growth is the one that is nearest to the exact limit surface, by least
    squares over `MOTIONS` of the centre about the edge's normal and over `TURNS`. It is then within
    15 % on areas and rims, and within 40 % on four corners.

    Parameters
    ----------
    slider : Slider
        The object.
    tangent : float, optional
        Angle of the pushed edge's tangent in the object's frame [rad].
    """
    if slider.points is None:
        return Pressure(slider.c**2, 0.0, 0.0, np.array(ROUND))
    cos, sin = math.cos(tangent), math.sin(tangent)
    x, y, load = slider.points[:3]
    along, across = cos * x + sin * y, cos * y - sin * x
    moments = np.array(
        [load @ (a * b) for a, b in ((along, along), (along, across), (across, across))]
    )
    moments /= load.sum()
    c_squared = math.sqrt(moments[0] * moments[2] - moments[1] ** 2)
    without = Pressure(c_squared, 0.0, 1.0, moments / c_squared)
    missing, slopes = [], []
    for way in MOTIONS:
        v_t, v_n = math.sin(way), math.cos(way)
        for turn in TURNS:
            omega = turn / math.sqrt(c_squared)
            f_x, f_y, m = slider.wrench((cos * v_t - sin * v_n, sin * v_t + cos * v_n, omega))
            least = resistance(v_t, v_n, omega, without)
            missing.append(m / math.hypot(f_x, f_y) / omega - least)
            slopes.append(resistance(v_t, v_n, omega, without._replace(growth=1.0)) - least)
    return without._replace(growth=float(np.dot(slopes, missing) / np.dot(slopes, slopes)))


def pushed_of(config: RigConfig) -> Pushed:
    """Return the numbers of object and finger of a rig, as long as the tip does not turn."""
    cos_alpha, sin_alpha = friction_cone(config.mu_c)
    l = float(config.body.path[0, L_START])
    pressure = pressure_of(config.slider, float(config.body.path[0, TAU]))
    return Pushed(l, config.radius, pressure, cos_alpha, sin_alpha, STRAIGHT, 0.0)


def edge_ends(config: RigConfig) -> tuple[float, float]:
    """Return the least and the most d of the edge that is pushed [m]."""
    path = config.body.path
    start = float(path[0, D_START])
    return start, start + float(path[0, LENGTH])


def tip_of(config: RigConfig, joints: Sequence[float]) -> TurningTip:
    """Return how the tip of a rig turns on its way across the belt from given joints on [rad]."""
    finger = config.finger
    return TurningTip(finger.proximal_length, finger.distal_length, *finger.line(joints))


def _truth(rig: 'Rig | MujocoRig', piece: float) -> Belief:
    config = rig.config
    spread = Spread(CERTAIN, CERTAIN, CERTAIN, CERTAIN, piece)
    pushed = pushed_of(config)._replace(tip=tip_of(config, rig.joints))
    friction = config.mu_c, config.mu_c
    return Belief(rig.finger_pose.x, rig.theta, rig.d, pushed, friction, edge_ends(config), spread)
