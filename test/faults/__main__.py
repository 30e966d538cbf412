# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Inject every fault into real nodes and print what was promised and what happened.

    PYTHONPATH=test python -m faults [--only NAME …] [--json FILE] [--list]

Starts the nodes as processes, in real time, in a ROS domain of their own on this machine, and
measures the time from the fault to v_x = 0 at the simulated finger on the steady clock of this
process. A row is BROKEN too if, whatever the fault, a command was not finite or a kick, an old or
wrong reading was published, a log shows a traceback or a node did not end with status 0.
"""

import argparse
import sys
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from faults import FAULTS
from faults.interrupt import interrupt_once
from faults.table import Runner, show, write

WIDTH = 180  # of the table where it is not shown on a terminal: a line a row


def main() -> int:
    """Run the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--only', nargs='+', metavar='NAME', help='the rows whose name contains one of these words'
    )
    parser.add_argument('--json', type=Path, metavar='FILE', help='write the rows there too')
    parser.add_argument('--list', action='store_true', help='print the rows and do nothing')
    options = parser.parse_args()
    chosen = [f for f in FAULTS if not options.only or any(o in f.name for o in options.only)]
    for word in options.only or []:
        if not any(word in fault.name for fault in FAULTS):
            return _refuse(f'--only: expected part of a name that --list shows, got {word!r}')
    if options.list:
        for fault in chosen:
            print(f'{fault.name}: {fault.promise}')
        return 0
    if options.json and not options.json.parent.is_dir():
        return _refuse(f'--json: expected a file in a folder that is there, got {options.json}')
    interrupt_once()
    console = Console(stderr=True)
    try:
        with Runner() as runner, Progress(console=console) as progress:
            task = progress.add_task('', total=len(chosen))
            for fault in chosen:
                progress.update(task, description=fault.name)
                outcome = runner.run(fault)
                words = '; '.join([fault.name, *outcome.broken])
                progress.console.print(f'{outcome.verdict:6}  {words}', highlight=False)
                progress.advance(task)
            runner.finish()
    except KeyboardInterrupt:
        return 130
    show(runner.outcomes, Console(width=None if sys.stdout.isatty() else WIDTH))
    if options.json:
        write(runner.outcomes, options.json)
    return 0 if all(outcome.held for outcome in runner.outcomes) else 1


def _refuse(reason: str) -> int:
    print(f'faults: {reason}', file=sys.stderr)
    return 2


if __name__ == '__main__':
    sys.exit(main())
