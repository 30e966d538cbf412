# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push record`: topics of the running nodes into a bag."""

import argparse
import os
import sys
from pathlib import Path

from tactile_push.cli.arguments import Commands, number
from tactile_push.cli.become import become


def add(commands: Commands) -> None:
    """Add the command."""
    record = commands.add_parser(
        'record',
        help='record topics of the running nodes into a bag',
        description='Records topics into an MCAP bag that ros2 bag, Foxglove, PlotJuggler and '
        'rosbags open, until Ctrl-C. A topic is recorded as soon as somebody publishes it.',
    )
    option = record.add_argument
    option('topics', nargs='*', metavar='TOPIC', help="topics (default: the package's)")
    option(
        '-o',
        '--out',
        type=Path,
        metavar='DIR',
        help='folder that the bag makes, not there yet (default: tactile_push_ and the date)',
    )
    option('--all', action='store_true', help='all topics that are not hidden')
    option(
        '--compression',
        choices=('zstd', 'lz4', 'none'),
        default='zstd',
        help='of the chunks of the file (default: zstd)',
    )
    option(
        '--max-size',
        type=number('megabytes, more than 0', 0.0, 1e9, closed=False),
        metavar='MB',
        help='begin another file when one has so many megabytes (default: one file)',
    )
    option(
        '--max-duration',
        type=number('seconds, more than 0', 0.0, 1e9, closed=False),
        metavar='S',
        help='begin another file after so many seconds (default: one file)',
    )
    option(
        '--use-sim-time',
        action='store_true',
        help='take the time from /clock; nothing is recorded until it runs',
    )
    record.set_defaults(run=_record, ros=True)


def _record(options: argparse.Namespace) -> int:
    if options.all and options.topics:
        return _refuse('--all: expected no topics beside it')
    if options.out is not None and os.path.lexists(options.out):
        return _refuse(f'--out: {options.out}: is there already, expected a new folder')
    parameters: dict[str, object] = {'compression': options.compression}
    if options.topics:
        parameters['topics'] = options.topics
    if options.all:
        parameters['all'] = True
    if options.out is not None:
        parameters['output'] = str(options.out)
    if options.max_size is not None:
        parameters['max_size'] = max(round(options.max_size * 1e6), 1)
    if options.max_duration is not None:
        parameters['max_duration'] = options.max_duration
    if options.use_sim_time:
        parameters['use_sim_time'] = True
    become('bag_recorder', parameters)


def _refuse(reason: str) -> int:
    print(f'tactile_push record: {reason}', file=sys.stderr)
    return 2
