# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""`tactile_push figures`: the paper's figures."""

import argparse
import json
import sys
from pathlib import Path

from tactile_push.cli.arguments import Commands


def add(commands: Commands) -> None:
    """Add the command.

    Parameters
    ----------
    commands : argparse subparsers
        Where it belongs.
    """
    figures = commands.add_parser(
        'figures',
        help='make figures 2, 3, 6, 7 and 8 of the paper and a map of the gains',
        description='Writes figures 2, 3, 6, 7 and 8 of the paper, made by the library, and a map '
        'of the gains that settle the block with a finger that lags behind its command, as PNG '
        'and SVG.',
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

    from tactile_push.plots import save_figures

    with Console(stderr=True).status('figures') as status:
        try:
            files = save_figures(options.out, lambda name: status.update(name))
        except OSError as error:
            where = error.filename or options.out
            print(f'tactile_push figures: {where}: {error.strerror}', file=sys.stderr)
            return 2
    if options.json:
        print(json.dumps({'files': [str(file) for file in files]}))
    else:
        print(*files, sep='\n')
    return 0
