# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push record`: topics of the running nodes into a bag."""

import argparse
import os
from pathlib import Path
from typing import NoReturn

from tactile_push.cli.arguments import Commands, Refused, number
from tactile_push.cli.become import become
from tactile_push.interface import BAG_RECORDER


def add(commands: Commands) -> None:
    """Add the command."""
    record = commands.add_parser(
        'record',
        help='record topics of the running nodes into a bag',
        description='Records topics into an MCAP bag that ros2 bag, Foxglove, PlotJuggler and '
        'rosbags open, until Ctrl-C. A topic is recorded as soon as somebody publishes it.',
    )
    option = record.add_argument
    option('topics', nargs='*', metavar='TOPIC', help="topics to record (default: the package's)")
    option(
        '-o',
        '--out',
        type=Path,
        metavar='DIR',
        help='folder of the bag, which must not exist yet (default: tactile_push_ and the date)',
    )
    option('--all', action='store_true', help='record all topics that are not hidden')
    option(
        '--compression',
        choices=('zstd', 'lz4', 'none'),
        default='zstd',
        help="compression of the file's chunks (default: zstd)",
    )
    option(
        '--max-size',
        type=number('megabytes, more than 0', 0.0, 1e9, closed=False),
        metavar='MB',
        help='start another file once one has this many megabytes (default: one file)',
    )
    option(
        '--max-duration',
        type=number('seconds, more than 0', 0.0, 1e9, closed=False),
        metavar='S',
        help='start another file once one is this long (default: one file)',
    )
    option(
        '--use-sim-time',
        action='store_true',
        help='take the time from /clock; nothing is recorded until it runs',
    )
    record.set_defaults(run=_record, ros=True)


def _record(options: argparse.Namespace) -> NoReturn:
    from tactile_push.bags.writer import IS_THERE

    if options.all and options.topics:
        raise Refused('--all: expected no topics beside it')
    if options.out is not None and os.path.lexists(options.out):
        raise Refused(f'--out: {options.out}: {IS_THERE}')
    given: dict[str, object] = {
        'compression': options.compression,
        'topics': options.topics,
        'all': options.all,
        'output': None if options.out is None else str(options.out),
        'max_size': options.max_size and max(round(options.max_size * 1e6), 1),
        'max_duration': options.max_duration,
        'use_sim_time': options.use_sim_time,
    }
    become(BAG_RECORDER, {name: value for name, value in given.items() if value})
