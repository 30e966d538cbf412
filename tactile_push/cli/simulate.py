# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push simulate`: one object under a control law or open loop."""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, Refused, number, picture, steps
from tactile_push.cli.pushed_object import FACING, LENGTH, add_object, add_start, config_of
from tactile_push.cli.simulated_laws import DEFAULTS, LAWS, Simulated, check_law
from tactile_push.paper import TOLERANCE

if TYPE_CHECKING:
    from tactile_push.simulation import RigConfig


def add(commands: Commands) -> None:
    """Add the command."""
    simulate = commands.add_parser(
        'simulate',
        help='simulate one object under a control law or open loop',
        description='Simulates a push of one object, no nodes: with law push, the law (18), '
        'mechanics and law alone; with another law by touch alone, with a sensor that errs by 0.3° '
        'and a finger that lags by 0.1 s. The defaults are the case of figure 8 of the paper.',
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    option = simulate.add_argument
    add_object(option)
    option(
        '--law',
        default='push',
        choices=tuple(LAWS),
        help='push brings theta to its desired angle by the law (18); place brings the object to a '
        'place across the belt and an angle, and lets it go there; steer carries the object '
        'straight ahead at a place across the belt; settle brings theta to an angle by all that is '
        'known',
    )
    gain = number('a finite gain of 0 or more', 0.0, sys.float_info.max)
    _optional(option, '--kp', type=gain, metavar='X', help='proportional gain [rad/rad]')
    _optional(option, '--kd', type=gain, metavar='X', help='derivative gain [rad/rad]')
    add_start(option)
    ahead = number('degrees between 0 and 180', 0.0, 180.0, closed=False)
    _optional(option, '--phi0-deg', type=ahead, metavar='DEG', help='first push angle')
    angle = number('degrees between -180 and 180', -180.0, 180.0)
    _optional(option, '--theta-desired-deg', type=angle, metavar='DEG', help='desired angle')
    option(
        '--x-goal-mm',
        type=LENGTH,
        default=argparse.SUPPRESS,
        metavar='MM',
        help='where the centre of mass shall be across the belt, from where the finger starts, for '
        'the laws place and steer',
    )
    option(
        '--theta-goal-deg',
        type=FACING,
        default=argparse.SUPPRESS,
        metavar='DEG',
        help='angle that the edge shall have, for the laws place and settle',
    )
    _optional(
        option,
        '--axes',
        type=int,
        choices=(1, 2),
        help='how many ways the finger can move, for the law place; with 2 it touches the object '
        'elsewhere where no push from the first contact leads to the goal',
    )
    option('--steps', type=steps, default=600, metavar='N', help='control periods of 0.1 s')
    option(
        '--open-loop',
        action='store_true',
        default=argparse.SUPPRESS,
        help='keep the first push angle',
    )
    option(
        '--json',
        metavar='FILE|-',
        default=argparse.SUPPRESS,
        help='write the run as one JSON object in SI units; - prints it instead of the summary',
    )
    option(
        '--plot',
        type=picture,
        metavar='FILE',
        default=argparse.SUPPRESS,
        help='draw theta and phi - 90 degrees against the step, or with law place the ways of '
        'finger and object from above; the ending chooses the format',
    )
    simulate.set_defaults(run=_simulate)


def _optional(option: Callable[..., Any], name: str, *, help: str, **how: Any) -> None:
    """Add an option of some laws, of which it has to be known whether it was given."""
    default = DEFAULTS[name.removeprefix('--').replace('-', '_')]
    option(name, default=argparse.SUPPRESS, help=f'{help} (default: {default})', **how)


def _simulate(options: argparse.Namespace) -> int:
    from rich.console import Console

    from tactile_push.cli.output import naming, write_json

    check_law(options)
    json_file, plot = (getattr(options, name, None) for name in ('json', 'plot'))
    try:
        with Console(stderr=True).status('simulating (the first time, compiling)'):
            config = config_of(options)
            done = LAWS[options.law].run(options, config)
        run = done.run
        if json_file is not None:
            with naming(json_file, '--json'):
                write_json(json_file, _as_json(done, config))
        if plot is not None:
            with naming(plot, '--plot'):
                _draw(done, plot)
    except ValueError as error:
        raise Refused(error) from None
    if json_file != '-':
        _print(done, config)
    if run.end != 'done':
        raise Refused(run.end, status=1)
    return 0


def _draw(done: Simulated, file: Path) -> None:
    """Draw a run as its law has it, or else theta and phi against the step."""
    if done.draw is not None:
        done.draw(file)
        return
    from tactile_push.figures import plot_history  # which loads matplotlib

    run = done.run
    plot_history({'': (run.theta, run.phi, done.theta_wanted, TOLERANCE, done.settled)}, [file])


def _as_json(done: Simulated, config: 'RigConfig') -> dict[str, Any]:
    """Return arrays with a value for the start of every step, and what is true of the run."""
    from tactile_push.mechanics import MODES

    run = done.run
    return {
        **{name: getattr(run, name).tolist() for name in ('theta', 'phi', 'd', 'x', 'y')},
        'mode': [MODES[mode] for mode in run.mode],
        'c': config.slider.c,
        'settle_step': done.settled,
        'end': run.end,
        **done.told,
    }


def _print(done: Simulated, config: 'RigConfig') -> None:
    from tactile_push.mechanics import MODES

    run, settled = done.run, done.settled
    steps = len(run.theta) - 1
    counts = {name: int((run.mode[:steps] == mode).sum()) for mode, name in enumerate(MODES)}
    modes = ', '.join(f'{name} {count}' for name, count in counts.items() if count)
    print(
        f'c          {1000.0 * config.slider.c:.2f} mm',
        f'steps      {steps} ({modes})' if modes else f'steps      {steps}',
        f'settled    {"never" if settled is None else f"step {settled}"}, {done.near}',
        f'theta      {math.degrees(run.theta[0]):.2f}° -> {math.degrees(run.theta[-1]):.2f}°',
        f'phi        {math.degrees(run.phi[0]):.2f}° -> {math.degrees(run.phi[-1]):.2f}°',
        f'd          {1000.0 * run.d[0]:.3f} mm -> {1000.0 * run.d[-1]:.3f} mm',
        *done.rows,
        sep='\n',
    )
