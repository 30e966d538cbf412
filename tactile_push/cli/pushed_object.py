# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The options that say what is pushed, on what it rests and where the push starts."""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import number
from tactile_push.paper import (
    BLOCK,
    BLOCK_DEPTH,
    BLOCK_EDGE,
    D_INITIAL,
    DISK,
    DISK_RADIUS,
    THETA_INITIAL,
)

if TYPE_CHECKING:
    from tactile_push.mechanics import Support
    from tactile_push.simulation import ObjectFile, RigConfig

FACING = number('degrees between -90 and 90', -90.0, 90.0, closed=False)
LENGTH = number('millimetres', -sys.float_info.max, sys.float_info.max)


def add_object(option: Callable[..., Any]) -> None:
    """Add the options of the object, by a parser's `add_argument`."""
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


def add_start(option: Callable[..., Any]) -> None:
    """Add the options of the start."""
    start = math.degrees(THETA_INITIAL)
    option(
        '--theta0-deg', type=FACING, default=start, metavar='DEG', help='edge angle at the start'
    )
    option(
        '--d0-mm',
        type=LENGTH,
        default=argparse.SUPPRESS,
        metavar='MM',
        help=f'contact along the edge at the start (default: {1e3 * D_INITIAL:g} for the block, '
        'otherwise the contact nearest to d = 0)',
    )


def config_of(options: argparse.Namespace) -> 'RigConfig':
    """Return the rig that the options ask for, with a tip that does not turn.

    Raises
    ------
    Refused
        If a file cannot be read.
    ValueError
        If a file or a number is wrong, or the start is no contact that pushes.
    """
    from tactile_push.mechanics import Slider
    from tactile_push.simulation import RigConfig

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
    mu_c = getattr(options, 'mu_c', mu_c)
    return RigConfig(slider, mu_c, theta, d, tip_turns=False)  # as in the equations


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
