# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push doctor`: what is right, wrong or missing about a running finger."""

import argparse
import json
from dataclasses import asdict

from tactile_push.cli.arguments import Commands, namespace


def add(commands: Commands) -> None:
    """Add the command."""
    doctor = commands.add_parser(
        'doctor',
        help='say what is right, wrong or missing about a running finger',
        description='Looks at the nodes and topics of a running finger for 5 s and says, line by '
        'line, what is right, wrong or missing and what to do about it, in the order in which to '
        'mend it. It publishes nothing and moves nothing.',
    )
    option = doctor.add_argument
    option(
        '--namespace',
        type=namespace,
        metavar='NAME',
        help='namespace of the finger, such as left',
    )
    option('--json', action='store_true', help='print one JSON object')
    doctor.set_defaults(run=_doctor, ros=True)


def _doctor(options: argparse.Namespace) -> int:
    from tactile_push.doctor import RIGHT, findings
    from tactile_push.doctor.looking import look
    from tactile_push.streams import one_line

    found = findings(look(options.namespace or ''))
    if options.json:
        print(json.dumps({'findings': [asdict(finding) for finding in found]}, indent=2))
    else:
        for finding in found:
            remedy = f'; {finding.remedy}' if finding.remedy else ''
            print(one_line(f'{finding.verdict:8}{finding.subject}: {finding.words}{remedy}'))
    return 0 if all(finding.verdict == RIGHT for finding in found) else 1
