# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push figures`: the paper's figures."""

import argparse
import json
from pathlib import Path

from tactile_push.cli.arguments import Commands


def add(commands: Commands) -> None:
    """Add the command."""
    figures = commands.add_parser(
        'figures',
        help='make figures 2, 3, 6, 7 and 8 of the paper, a map of gains, the drift, and a turn',
        description='Writes figures 2, 3, 6, 7 and 8 of the paper, made by the library, a map of '
        'the gains that settle the block with a finger that lags behind its command, the drift '
        'of the block while the finger tip turns, and how soon theta is at its angle by all that '
        'is known, as PNG and SVG.',
    )
    figures.add_argument(
        '-o',
        '--out',
        type=Path,
        default=Path('out/figures'),
        metavar='DIR',
        help='folder for figure_2.png, figure_2.svg, gains.png and so on (default: out/figures)',
    )
    figures.add_argument(
        '--json', action='store_true', help='print the files as one JSON object instead of lines'
    )
    figures.set_defaults(run=_figures)


def _figures(options: argparse.Namespace) -> int:
    from rich.console import Console

    from tactile_push.cli.output import naming
    from tactile_push.figures import save_figures

    with naming(options.out), Console(stderr=True).status('figures') as status:
        files = save_figures(options.out, lambda name: status.update(name))
    if options.json:
        print(json.dumps({'files': [str(file) for file in files]}))
    else:
        print(*files, sep='\n')
    return 0
