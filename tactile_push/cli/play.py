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
        description='Publishes the messages of a bag as they were recorded, once the subscribers '
        'that are there can hear. Space pauses and goes on; right arrow or s publishes the next '
        'message of a paused play. Nodes that shall take the messages for live ones need --clock '
        'and use_sim_time:=true: by any other clock the stamps are old.',
    )
    option = play.add_argument
    option('bag', **BAG | {'type': str})
    rate = number('a factor from 0.001 to 1000', 0.001, 1000.0)
    option('--rate', type=rate, metavar='X', help="how fast the bag's time goes by (default: 1)")
    seconds = number('seconds from 0 to 1e9', 0.0, 1e9)
    option(
        '--start', type=seconds, metavar='S', help='begin so long after the beginning of the bag'
    )
    option('--duration', type=seconds, metavar='S', help='play so much of it (default: the rest)')
    option('--loop', action='store_true', help='start over at the end, until Ctrl-C')
    option(
        '--clock',
        type=number('a rate from 0.001 to 10000', 0.001, 10000.0),
        nargs='?',
        const=CLOCK_RATE,
        metavar='HZ',
        help="publish /clock so often by the bag's time, and before each message, in place of "
        f'that of the bag (HZ: {CLOCK_RATE:g} unless given); at the start of a loop it jumps back',
    )
    option('--topics', nargs='+', metavar='TOPIC', help='play only these')
    option('--remap', nargs='+', metavar='OLD:=NEW', help='publish topics under other names')
    option('--start-paused', action='store_true', help='begin with a pause')
    play.set_defaults(run=_play, ros=True)


def _play(options: argparse.Namespace) -> NoReturn:
    given = {
        name: value
        for name, value in vars(options).items()
        if name != 'run' and value not in (None, False)
    }
    become(BAG_PLAYER, given)
