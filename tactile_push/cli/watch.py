# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push watch`: what the nodes say, live, on a page for browsers."""

import argparse

from tactile_push.cli.arguments import Commands, namespace, number, port
from tactile_push.cli.become import become
from tactile_push.interface import LIVE_PAGE
from tactile_push.needs_aiohttp import aiohttp_is_missing

OPTIONS = ('host', 'port', 'history')  # which are parameters of the node


def add(commands: Commands) -> None:
    """Add the command."""
    watch = commands.add_parser(
        'watch',
        help='show what the nodes say on a page, live',
        description='Serves a page that shows theta, phi, v_x and d against time, the finger and '
        'the object from above, and stops and warnings as they happen, until Ctrl-C.',
    )
    option = watch.add_argument
    option(
        '--host',
        metavar='ADDRESS',
        help='address of this machine to listen on, 0.0.0.0 for all; anybody who can reach it can '
        'look (default: 127.0.0.1, for this machine alone)',
    )
    option(
        '--port',
        type=port,
        metavar='N',
        help='port to listen on, 0 for any that is free (default: 8765)',
    )
    option(
        '--history',
        type=number('seconds from 1 to 600', 1.0, 600.0),
        metavar='S',
        help='how far back the page shows (default: 60)',
    )
    option(
        '--namespace',
        type=namespace,
        metavar='NAME',
        help='namespace of the finger, such as left',
    )
    watch.set_defaults(run=_watch, ros=True)


def _watch(options: argparse.Namespace) -> int:
    if aiohttp_is_missing('tactile_push watch'):
        return 2
    given = {name: getattr(options, name) for name in OPTIONS}
    place = [] if options.namespace is None else ['-r', f'__ns:={options.namespace}']
    become(LIVE_PAGE, {name: value for name, value in given.items() if value is not None}, place)
