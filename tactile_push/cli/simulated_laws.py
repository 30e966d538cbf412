# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The laws that `tactile_push simulate` runs, and the options that each of them takes."""

import argparse
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Refused
from tactile_push.paper import KD, KP, THETA_DESIRED, TOLERANCE

if TYPE_CHECKING:
    from tactile_push.control import PushLaw
    from tactile_push.simulation import RigConfig, Rollout
    from tactile_push.simulation.placed_run import PlacedRun

# Options of law (18) and of the one that places, with their defaults, and goals.
AXES = 'axes'
DEFAULTS = {
    'kp': KP,
    'kd': KD,
    'theta_desired_deg': math.degrees(THETA_DESIRED),
    'phi0_deg': 90.0,
    'open_loop': False,
    AXES: 1,
}
X_GOAL, THETA_GOAL = 'x_goal_mm', 'theta_goal_deg'


@dataclass(frozen=True)
class Simulated:
    """A simulated run and what came of it."""

    run: 'Rollout'
    settled: int | None  #: from which step on what the law is for is near its goal
    near: str  #: how near that is, such as 'within 3° of -10°'
    theta_wanted: float  #: the angle that the law was told [rad]; NaN if it was told none
    rows: tuple[str, ...] = ()  #: more lines for people
    told: dict[str, Any] = field(default_factory=dict)  #: more numbers for JSON
    #: draws the run into a file; None for theta and phi against the step
    draw: Callable[[Path], None] | None = None


Runner = Callable[[argparse.Namespace, 'RigConfig'], Simulated]


@dataclass(frozen=True)
class Law:
    """A law of the command."""

    run: Runner
    goals: tuple[str, ...] = ()  #: options that it needs
    options: tuple[str, ...] = ()  #: options that it takes besides, of `DEFAULTS`


def check_law(options: argparse.Namespace) -> None:
    """Refuse options that the law does not take, and the lack of a goal; fill in the defaults.

    Raises
    ------
    Refused
        If there is one.
    """
    law = LAWS[options.law]
    for name in law.goals:
        if not hasattr(options, name):
            raise Refused(f'--law: expected {_flag(name)} with {options.law}, got none')
    for name in (*DEFAULTS, X_GOAL, THETA_GOAL):
        if hasattr(options, name) and name not in (*law.goals, *law.options):
            takers = (key for key, other in LAWS.items() if name in (*other.goals, *other.options))
            raise Refused(f'{_flag(name)}: expected --law {" or ".join(takers)}, got {options.law}')
    for name, value in DEFAULTS.items():
        if not hasattr(options, name):
            setattr(options, name, value)


def _flag(name: str) -> str:
    return f'--{name.replace("_", "-")}'


def _law_18(options: argparse.Namespace) -> 'PushLaw':
    from tactile_push.control import PushLaw

    law = PushLaw(options.kp, options.kd, math.radians(options.theta_desired_deg))
    phi = math.radians(options.phi0_deg)
    if not options.open_loop and not law.phi_min <= phi <= law.phi_max:
        raise ValueError(
            f'phi: expected {law.phi_min} to {law.phi_max} rad, the bounds of the law, got {phi}'
        )
    law.reset(phi)
    return law


def _push(options: argparse.Namespace, config: 'RigConfig') -> Simulated:
    """Push by law (18) or open loop, mechanics and law alone."""
    from tactile_push.simulation import rollout

    law = _law_18(options)
    run = rollout(
        config, math.radians(options.phi0_deg) if options.open_loop else law, options.steps
    )
    return _to_angle(run, options.theta_desired_deg)


def _place(options: argparse.Namespace, config: 'RigConfig') -> Simulated:
    """Bring the centre of mass to a place and the edge to an angle, and let go there."""
    from tactile_push.control.placing.model import Goal
    from tactile_push.simulation.placed_run import placed_run

    goal = Goal(options.x_goal_mm / 1000.0, math.radians(options.theta_goal_deg))
    done = placed_run(config, goal, options.steps, axes=options.axes)
    run, placed = done.run, done.placement
    off = f'{1000.0 * placed.x_error:.2f} mm, {math.degrees(placed.theta_error):.2f}°'
    belt, learned = 1000.0 * placed.belt, 1000.0 * placed.learned
    told = asdict(placed)
    del told['end']  # which the run has
    told |= {'regrasps': done.regrasps}
    return Simulated(
        run,
        len(run.theta) - 1 if run.end == 'done' else None,
        'where it is let go',
        goal.theta,
        (
            _x_row(run),
            f'error      {off}',
            f'belt       {belt:.1f} mm, {learned:.1f} mm of it to learn where the finger touches',
            *([f'regrasps   {done.regrasps}'] if done.regrasps else []),
        ),
        {'finger': done.finger.tolist(), 'goal': goal._asdict(), **told},
        lambda file: _draw_placed(done, config, f'off by {off}', file),
    )


def _draw_placed(done: 'PlacedRun', config: 'RigConfig', title: str, file: Path) -> None:
    """Draw ways and goal from above."""
    import numpy as np

    from tactile_push.figures import plot_placed  # which loads matplotlib
    from tactile_push.mechanics.contact import TAU
    from tactile_push.placed_way import PlacedWay

    run = done.run
    way = PlacedWay(
        done.finger,
        np.stack([run.x, run.y, run.theta], axis=1),
        edge=float(config.body.path[0, TAU]),
        outline=[(x, y) for x, y in config.slider.outline.points(math.inf).tolist()],
        radius=config.radius,
        goal=done.goal,
    )
    plot_placed({title: way}, [file])


def _settle(options: argparse.Namespace, config: 'RigConfig') -> Simulated:
    """Bring theta to its goal by all that the pushes tell."""
    from tactile_push.simulation.settled_run import settled_run

    goal = options.theta_goal_deg
    return _to_angle(settled_run(config, math.radians(goal), options.steps), goal)


def _to_angle(run: 'Rollout', wanted_deg: float) -> Simulated:
    """Say from when on theta is near an angle."""
    from tactile_push.control import settle_step

    wanted = math.radians(wanted_deg)
    settled = settle_step(run.theta, wanted, TOLERANCE) if run.end == 'done' else None
    near = f'within {math.degrees(TOLERANCE):.0f}° of {wanted_deg:g}°'
    return Simulated(run, settled, near, wanted)


def _steer(options: argparse.Namespace, config: 'RigConfig') -> Simulated:
    """Carry the object straight ahead at its goal."""
    from tactile_push.control import settle_step
    from tactile_push.simulation.steered_run import NEAR, steered_run

    goal = options.x_goal_mm / 1000.0
    run = steered_run(config, goal, options.steps)
    settled = settle_step(run.x, goal, NEAR) if run.end == 'done' else None
    near = f'within {1000.0 * NEAR:g} mm of x = {options.x_goal_mm:g} mm'
    return Simulated(run, settled, near, math.nan, (_x_row(run),))


def _x_row(run: 'Rollout') -> str:
    return f'x          {1000.0 * run.x[0]:.2f} mm -> {1000.0 * run.x[-1]:.2f} mm'


LAWS = {
    'push': Law(_push, options=tuple(name for name in DEFAULTS if name != AXES)),
    'place': Law(_place, (X_GOAL, THETA_GOAL), (AXES,)),
    'steer': Law(_steer, (X_GOAL,)),
    'settle': Law(_settle, (THETA_GOAL,)),
}
