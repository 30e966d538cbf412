# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push report`: a page about a run."""

import argparse
import json
import re
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from tactile_push.cli.arguments import BAG, Commands, Refused, page

ENDINGS = r'(\.mcap)?(\.zstd)?$'  # of a bag's file


def add(commands: Commands) -> None:
    """Add the command."""
    report = commands.add_parser(
        'report',
        help='make a page of plots and a view from above of what a bag has recorded',
        description='Writes one HTML file that any browser shows without a network: theta, phi, '
        'v_x, d, the age of the readings, stops and warnings against time, finger and object from '
        'above with a time slider, and the outcome beside the paper.',
    )
    report.add_argument('bag', **BAG)
    report.add_argument(
        '-o',
        '--out',
        type=page,
        metavar='FILE',
        help='page to write, in place of an older one (default: the name of the bag with .html)',
    )
    report.add_argument('--json', action='store_true', help='print the file as one JSON object')
    report.set_defaults(run=_report)


def _report(options: argparse.Namespace) -> int:
    from tactile_push.bags.disk import write_whole
    from tactile_push.cli.output import opened, reading, warner
    from tactile_push.report import messages_shown, read_run, report_html

    if find_spec('plotly') is None:  # for which rosdep has no key
        raise Refused('needs plotly: pip install plotly')
    warnings: list[str] = []
    with opened(options.bag, warnings.append) as bag, reading(messages_shown(bag)) as progress:
        run = read_run(bag, progress)
    run = replace(run, warnings=[*warnings, *run.warnings])
    for line in run.warnings:
        warner('report')(line)
    out = options.out or Path(f'{re.sub(ENDINGS, "", run.name)}.html')
    write_whole(out, report_html(run))
    print(json.dumps({'file': str(out)}) if options.json else out)
    return 0
