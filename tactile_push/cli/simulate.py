# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push simulate`: one object under the control law or open loop."""

import argparse
import json
import math
import sys
from pathlib import Path

from tactile_push.cli.arguments import Commands, number, picture, steps


def add(commands: Commands) -> None:
    """Add the command."""
    simulate = commands.add_parser(
        'simulate',
        help='simulate one object under the control law or open loop',
        description='Simulates a push of one object: mechanics and control law alone, no nodes. '
        'The defaults are the case of figure 8 of the paper.',
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    option = simulate.add_argument
    option(
        '--object', default='block', metavar='block|disk|FILE', help='what is pushed; JSON files'
    )
    option(
        '--support',
        default='uniform',
        metavar='corners|uniform|circle:RADIUS_M|rim|FILE',
        help='what the object rests on; a radius in metres',
    )
    option('--surface', default='ellipsoid', choices=('ellipsoid', 'exact'), help='limit surface')
    friction = number('a coefficient of friction of 0 or more, or inf', 0.0, math.inf)
    option('--mu-c', type=friction, default=math.inf, metavar='X|inf', help='finger on object')
    gain = number('a finite gain of 0 or more', 0.0, sys.float_info.max)
    option('--kp', type=gain, default=0.05, metavar='X', help='proportional gain [rad/rad]')
    option('--kd', type=gain, default=5.0, metavar='X', help='derivative gain [rad/rad]')
    edge = number('degrees between -90 and 90', -90.0, 90.0, closed=False)
    option('--theta0-deg', type=edge, default=20.0, metavar='DEG', help='edge at the start')
    length = number('millimetres', -sys.float_info.max, sys.float_info.max)
    option(
        '--d0-mm',
        type=length,
        default=argparse.SUPPRESS,
        metavar='MM',
        help='contact along the edge at the start (default: -6 for the block, otherwise the '
        'contact nearest to d = 0)',
    )
    ahead = number('degrees between 0 and 180', 0.0, 180.0, closed=False)
    option('--phi0-deg', type=ahead, default=90.0, metavar='DEG', help='first push angle')
    any_angle = number('degrees between -180 and 180', -180.0, 180.0)
    option('--theta-desired-deg', type=any_angle, default=-10.0, metavar='DEG', help='wanted edge')
    option('--steps', type=steps, default=600, metavar='N', help='control periods of 0.1 s')
    option('--open-loop', action='store_true', help='push at the first angle all the time')
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
        help='draw theta and phi - 90 degrees against the step; the ending chooses the format',
    )
    simulate.set_defaults(run=_simulate)


def _simulate(options: argparse.Namespace) -> int:
    from rich.console import Console

    d0, json_file, plot = (getattr(options, name, None) for name in ('d0_mm', 'json', 'plot'))
    try:
        with Console(stderr=True).status('simulating (the first time, compiling)'):
            from tactile_push.simulation import case as simulate

            done = simulate.simulate(
                options.object,
                options.support,
                exact=options.surface == 'exact',
                mu_c=options.mu_c,
                theta=math.radians(options.theta0_deg),
                d=None if d0 is None else d0 / 1000.0,
                phi=math.radians(options.phi0_deg),
                theta_desired=math.radians(options.theta_desired_deg),
                kp=options.kp,
                kd=options.kd,
                steps=options.steps,
                open_loop=options.open_loop,
            )
        if json_file is not None:
            text = json.dumps(done.as_json()) + '\n'
            if json_file == '-':
                sys.stdout.write(text)
            else:
                with simulate.naming('--json', json_file):
                    Path(json_file).write_text(text)
        if plot is not None:
            from tactile_push.figures import plot_history

            run, wanted = done.run, done.theta_desired
            history = run.theta, run.phi, wanted, simulate.BAND, done.settle_step
            with simulate.naming('--plot', plot):
                plot_history({'': history}, [plot])
    except ValueError as error:
        print(f'tactile_push simulate: {error}', file=sys.stderr)
        return 2
    if json_file != '-':
        print(simulate.summary(done))
    if done.run.end != 'done':
        print(f'tactile_push simulate: {done.run.end}', file=sys.stderr)
        return 1
    return 0
