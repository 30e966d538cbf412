# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push doctor`: what is right, wrong or missing about a running finger."""

import argparse
import json
import sys
import typing
from dataclasses import asdict

from tactile_push.cli.arguments import Commands, Refused, namespace

if typing.TYPE_CHECKING:
    from collections.abc import Sequence

    from tactile_push.doctor import Finding


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
    option(
        '--touches',
        action='store_true',
        help='also ask on the terminal for four touches of the tip, and judge the signs of azimuth '
        'and elevation by them',
    )
    option('--json', action='store_true', help='print one JSON object')
    doctor.set_defaults(run=_doctor, ros=True)


def _doctor(options: argparse.Namespace) -> int:
    from tactile_push.doctor import RIGHT, findings
    from tactile_push.doctor.looking import look
    from tactile_push.doctor.touches import touch_findings
    from tactile_push.interface import TACTILE

    if options.touches and not sys.stdin.isatty():
        raise Refused('--touches: expected a terminal on standard input')
    namespace = options.namespace or ''
    seen = look(namespace)
    found = findings(seen)
    if not options.json:
        _show(found)
    if options.touches:
        publishers = seen.publishers.get(TACTILE, ())
        touched = [*touch_findings(_touches(namespace), publishers[0].node if publishers else '')]
        found += touched
        if not options.json:
            _show(touched)
    if options.json:
        print(json.dumps({'findings': [asdict(finding) for finding in found]}, indent=2))
    return 0 if all(finding.verdict == RIGHT for finding in found) else 1


def _show(found: 'Sequence[Finding]') -> None:
    from tactile_push.streams import one_line

    for finding in found:
        remedy = f'; {finding.remedy}' if finding.remedy else ''
        print(one_line(f'{finding.verdict:8}{finding.subject}: {finding.words}{remedy}'))


def _touches(namespace: str) -> dict[str, list[tuple[float, float]]]:
    """Ask for one touch after the other, and return the readings of each."""
    from tactile_push.doctor.looking import hearing_readings
    from tactile_push.doctor.touches import TOUCHES

    readings = {}
    with hearing_readings(namespace) as hear:
        for name, request in TOUCHES.items():
            print(f'{request}, keep it so for a second, and press Enter: ', end='', file=sys.stderr)
            sys.stderr.flush()
            if not sys.stdin.readline():
                raise Refused('--touches: expected Enter, got the end of the input')
            readings[name] = hear()
    return readings
