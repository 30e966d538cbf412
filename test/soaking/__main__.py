# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Run the real nodes for hours of simulated time through random faults and watch their memory.

    PYTHONPATH=test python -m soaking [--hours H] [--seed S] [--json FILE]

Every episode asks for another angle and lets the simulated plant misbehave for a while. Memory has
to stay flat, no tick may be lost outside faults, and after every fault the object settles again or
the controller has stopped and says why.
"""

import argparse
import json
import sys
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from faults.interrupt import interrupt_once
from soaking.run import Soak

DEFAULT_HOURS = 0.2


def main() -> int:
    """Run the soak."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--hours',
        type=float,
        default=DEFAULT_HOURS,
        metavar='H',
        help=f'simulated time [h], default: {DEFAULT_HOURS}',
    )
    parser.add_argument('--seed', type=int, default=1, metavar='S', help='default: 1')
    parser.add_argument('--json', type=Path, metavar='FILE', help='write the report there too')
    options = parser.parse_args()
    if not 0.0 < options.hours <= 1000.0:
        return _refuse(f'--hours: expected more than 0 and at most 1000, got {options.hours}')
    if options.json and not options.json.parent.is_dir():
        return _refuse(f'--json: expected a file in a folder that is there, got {options.json}')
    interrupt_once()
    try:
        with Progress(console=Console(stderr=True)) as progress:
            task = progress.add_task('simulated time', total=options.hours)
            report = Soak(
                options.hours,
                options.seed,
                lambda hours: progress.update(task, completed=hours),
            ).run()
    except KeyboardInterrupt:
        return 130
    complaints = report.complaints()
    print('\n'.join([*report.lines(), *(f'BROKEN            {c}' for c in complaints)]))
    if options.json:
        options.json.write_text(json.dumps(report.as_json(), indent=2) + '\n')
    return 1 if complaints else 0


def _refuse(reason: str) -> int:
    print(f'soak: {reason}', file=sys.stderr)
    return 2


if __name__ == '__main__':
    sys.exit(main())
