# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push play`: publishes a bag with its timing."""

import argparse
from typing import NoReturn

from tactile_push.cli.arguments import BAG, Commands, number
from tactile_push.cli.become import become
from tactile_push.interface import BAG_PLAYER

CLOCK_RATE = 100.0  # unless another one is asked for [Hz]


def add(commands: Commands) -> None:
    """Add the command."""
    play = commands.add_parser(
        'play',
        help='publish a bag with its timing',
        description='Publishes the messages of a bag with their timing, once the subscribers that '
        'it finds can hear it. Space pauses and resumes; right arrow or s publishes the next '
        'message of a paused play. If nodes are to take the messages as live, play with --clock '
        'and start the nodes with use_sim_time:=true; otherwise they refuse the stamps as old.',
    )
    option = play.add_argument
    option('bag', **BAG | {'type': str})
    rate = number('a factor from 0.001 to 1000', 0.001, 1000.0)
    option('--rate', type=rate, metavar='X', help='speed; 2 is twice as fast (default: 1)')
    seconds = number('seconds from 0 to 1e9', 0.0, 1e9)
    option('--start', type=seconds, metavar='S', help='begin this many seconds into the bag')
    option('--duration', type=seconds, metavar='S', help='play for so long (default: to the end)')
    option('--loop', action='store_true', help='start over at the end, until Ctrl-C')
    option(
        '--clock',
        type=number('a rate from 0.001 to 10000', 0.001, 10000.0),
        nargs='?',
        const=CLOCK_RATE,
        metavar='HZ',
        help="publish /clock with the bag's time, HZ times a second and before each message, in "
        f"place of the bag's own /clock (HZ: {CLOCK_RATE:g} unless given); a loop sets it back",
    )
    option('--topics', nargs='+', metavar='TOPIC', help='play only these topics')
    option('--remap', nargs='+', metavar='OLD:=NEW', help='publish topics under other names')
    option('--start-paused', action='store_true', help='begin paused')
    play.set_defaults(run=_play, ros=True)


def _play(options: argparse.Namespace) -> NoReturn:
    given = {
        name: value
        for name, value in vars(options).items()
        if name != 'run' and value not in (None, False)
    }
    become(BAG_PLAYER, given)
