# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push simulate`: one object under the control law or open loop."""

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, Refused, number, picture, steps
from tactile_push.paper import (
    BLOCK,
    BLOCK_DEPTH,
    BLOCK_EDGE,
    D_INITIAL,
    DISK,
    DISK_RADIUS,
    KD,
    KP,
    THETA_DESIRED,
    THETA_INITIAL,
    TOLERANCE,
)

if TYPE_CHECKING:
    from tactile_push.mechanics import Support
    from tactile_push.simulation import ObjectFile, RigConfig, Rollout


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
    option('--object', default=BLOCK, metavar='block|disk|FILE', help='what is pushed (FILE: JSON)')
    option(
        '--support',
        default=argparse.SUPPRESS,
        metavar='corners|uniform|circle:RADIUS_M|rim|FILE',
        help='what the object rests on; RADIUS_M in metres, FILE is JSON (default: as the file of '
        'the object says, otherwise uniform)',
    )
    option('--surface', default='ellipsoid', choices=('ellipsoid', 'exact'), help='limit surface')
    mu = number('a coefficient of friction of 0 or more, or inf', 0.0, math.inf)
    option(
        '--mu-c',
        type=mu,
        default=argparse.SUPPRESS,
        metavar='X|inf',
        help='friction at the finger (default: as the file of the object says, otherwise inf)',
    )
    gain = number('a finite gain of 0 or more', 0.0, sys.float_info.max)
    option('--kp', type=gain, default=KP, metavar='X', help='proportional gain [rad/rad]')
    option('--kd', type=gain, default=KD, metavar='X', help='derivative gain [rad/rad]')
    edge = number('degrees between -90 and 90', -90.0, 90.0, closed=False)
    start = math.degrees(THETA_INITIAL)
    option('--theta0-deg', type=edge, default=start, metavar='DEG', help='edge angle at the start')
    length = number('millimetres', -sys.float_info.max, sys.float_info.max)
    option(
        '--d0-mm',
        type=length,
        default=argparse.SUPPRESS,
        metavar='MM',
        help=f'contact along the edge at the start (default: {1e3 * D_INITIAL:g} for the block, '
        'otherwise the contact nearest to d = 0)',
    )
    ahead = number('degrees between 0 and 180', 0.0, 180.0, closed=False)
    option('--phi0-deg', type=ahead, default=90.0, metavar='DEG', help='first push angle')
    angle = number('degrees between -180 and 180', -180.0, 180.0)
    wanted = math.degrees(THETA_DESIRED)
    option('--theta-desired-deg', type=angle, default=wanted, metavar='DEG', help='desired angle')
    option('--steps', type=steps, default=600, metavar='N', help='control periods of 0.1 s')
    option('--open-loop', action='store_true', help='keep the first push angle')
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

    from tactile_push.cli.output import naming, write_json
    from tactile_push.control import settle_step

    json_file, plot = (getattr(options, name, None) for name in ('json', 'plot'))
    try:
        with Console(stderr=True).status('simulating (the first time, compiling)'):
            run, config = _run(options)
        settled = None
        if run.end == 'done':
            settled = settle_step(run.theta, math.radians(options.theta_desired_deg), TOLERANCE)
        if json_file is not None:
            with naming(json_file, '--json'):
                write_json(json_file, _as_json(run, config, settled))
        if plot is not None:
            from tactile_push.figures import plot_history  # which loads matplotlib

            wanted = math.radians(options.theta_desired_deg)
            with naming(plot, '--plot'):
                plot_history({'': (run.theta, run.phi, wanted, TOLERANCE, settled)}, [plot])
    except ValueError as error:
        raise Refused(error) from None
    if json_file != '-':
        _print(run, config, settled, options.theta_desired_deg)
    if run.end != 'done':
        raise Refused(run.end, status=1)
    return 0


def _run(options: argparse.Namespace) -> 'tuple[Rollout, RigConfig]':
    """Simulate the run that the options ask for."""
    from tactile_push.control import PushLaw
    from tactile_push.mechanics import Slider
    from tactile_push.simulation import RigConfig, rollout

    thing = _object(options.object)
    support, mu_c = thing.support, math.inf if thing.mu_c is None else thing.mu_c
    if hasattr(options, 'support') or support is None:
        support = _support(getattr(options, 'support', 'uniform'), thing)
    slider = Slider.on(
        thing.outline,
        support,
        exact=options.surface == 'exact',
        centre_of_mass=thing.centre_of_mass,
    )
    d = D_INITIAL if options.object == BLOCK else None
    if hasattr(options, 'd0_mm'):
        d = options.d0_mm / 1000.0
    theta = math.radians(options.theta0_deg)
    config = RigConfig(
        slider, getattr(options, 'mu_c', mu_c), theta, d, tip_turns=False
    )  # as in the equations
    phi = math.radians(options.phi0_deg)
    law = PushLaw(options.kp, options.kd, math.radians(options.theta_desired_deg))
    if not options.open_loop and not law.phi_min <= phi <= law.phi_max:
        raise ValueError(
            f'phi: expected {law.phi_min} to {law.phi_max} rad, the bounds of the law, got {phi}'
        )
    law.reset(phi)
    return rollout(config, phi if options.open_loop else law, options.steps), config


def _as_json(run: 'Rollout', config: 'RigConfig', settled: int | None) -> dict[str, Any]:
    """Return arrays with a value for the start of every step, and what is true of the run."""
    from tactile_push.mechanics import MODES

    return {
        **{name: getattr(run, name).tolist() for name in ('theta', 'phi', 'd', 'x', 'y')},
        'mode': [MODES[mode] for mode in run.mode],
        'c': config.slider.c,
        'settle_step': settled,
        'end': run.end,
    }


def _print(run: 'Rollout', config: 'RigConfig', settled: int | None, wanted_deg: float) -> None:
    from tactile_push.mechanics import MODES

    steps = len(run.theta) - 1
    counts = {name: int((run.mode[:steps] == mode).sum()) for mode, name in enumerate(MODES)}
    modes = ', '.join(f'{name} {count}' for name, count in counts.items() if count)
    within = f'within {math.degrees(TOLERANCE):.0f}° of {wanted_deg:g}°'
    print(
        f'c          {1000.0 * config.slider.c:.2f} mm',
        f'steps      {steps} ({modes})' if modes else f'steps      {steps}',
        f'settled    {"never" if settled is None else f"step {settled}"}, {within}',
        f'theta      {math.degrees(run.theta[0]):.2f}° -> {math.degrees(run.theta[-1]):.2f}°',
        f'phi        {math.degrees(run.phi[0]):.2f}° -> {math.degrees(run.phi[-1]):.2f}°',
        f'd          {1000.0 * run.d[0]:.3f} mm -> {1000.0 * run.d[-1]:.3f} mm',
        sep='\n',
    )


def _object(thing: str) -> 'ObjectFile':
    """Return what is known of an object."""
    from tactile_push.cli.output import naming
    from tactile_push.mechanics import Outline
    from tactile_push.simulation import ObjectFile, read_object

    if thing == BLOCK:
        return ObjectFile(Outline.rectangle(BLOCK_EDGE, BLOCK_DEPTH))
    if thing == DISK:
        return ObjectFile(Outline.circle(DISK_RADIUS))
    with naming(thing, '--object'):
        return read_object(Path(thing))


def _support(name: str, thing: 'ObjectFile') -> 'Support':
    """Return what the object rests on."""
    from tactile_push.cli.output import naming
    from tactile_push.mechanics import Outline, Support
    from tactile_push.simulation import read_support

    outline, centre_of_mass = thing.outline, thing.centre_of_mass
    if name in ('corners', 'uniform', 'rim'):
        support = getattr(Support, name)(outline)
        return support if centre_of_mass is None else support.carrying(centre_of_mass)
    if name.startswith('circle:'):
        try:
            radius = float(name.removeprefix('circle:'))
        except ValueError:
            raise ValueError(f'support: expected circle:RADIUS_M, got {name}') from None
        centre = centre_of_mass or Support.uniform(outline).centre
        support = Support.circle(radius, *centre)
        rim = Outline.circle(radius).points(radius / 16.0) + centre
        if not outline.contains(rim, 1e-9 * outline.length).all():
            raise ValueError(f'support: expected a circle under the object, got {name}')
        return support
    with naming(name, '--support'):
        return read_support(Path(name), centre_of_mass)
