# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push report`: a page about a run."""

import argparse
import json
import re
import sys
from dataclasses import replace
from pathlib import Path

from tactile_push.cli.arguments import Commands

ENDINGS = r'(\.mcap)?(\.zstd)?$'  # of a bag's file


def add(commands: Commands) -> None:
    """Add the command.

    Parameters
    ----------
    commands : argparse subparsers
        Where it belongs.
    """
    report = commands.add_parser(
        'report',
        help='make a page of plots and a view from above of what a bag has recorded',
        description='Writes one HTML file that any browser shows without a network: theta, phi, '
        'v_x, d, the age of the readings, stops and warnings against time, finger and object from '
        'above with a time slider, and the outcome beside the paper.',
    )
    report.add_argument(
        'bag', type=Path, metavar='BAG', help='folder of the bag, or its .mcap file'
    )
    report.add_argument(
        '-o',
        '--out',
        type=_page,
        metavar='FILE',
        help='page to write; replaced if it is there (default: name of the bag with .html, here)',
    )
    report.add_argument('--json', action='store_true', help='print one JSON object instead')
    report.set_defaults(run=_report)


def _page(text: str) -> Path:
    """Read the name of a page, which no bag can have."""
    if Path(text).suffix.lower() not in ('.html', '.htm'):
        raise argparse.ArgumentTypeError(f'expected a file *.html, got {text}')
    return Path(text)


def _report(options: argparse.Namespace) -> int:
    from tactile_push.bags import BagError, BagReader
    from tactile_push.bags.disk import write_whole
    from tactile_push.cli.bags import reading, warner
    from tactile_push.report import messages_shown, read_run, report_html

    warnings: list[str] = []
    try:
        with BagReader(options.bag, warnings.append) as bag, reading(messages_shown(bag)) as told:
            run = read_run(bag, told)
    except BagError as error:
        print(f'tactile_push report: {error}', file=sys.stderr)
        return 2
    run = replace(run, warnings=[*warnings, *run.warnings])
    for line in run.warnings:
        warner('report')(line)
    out = options.out or Path(f'{re.sub(ENDINGS, "", run.name)}.html')
    write_whole(out, report_html(run))
    print(json.dumps({'file': str(out)}) if options.json else out)
    return 0
