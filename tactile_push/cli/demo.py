# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push demo`: both rigs of the paper with real nodes."""

import argparse
import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from tactile_push.cli.arguments import Commands

if TYPE_CHECKING:
    from tactile_push.demo import RigResult


def add(commands: Commands) -> None:
    """Add the command.

    Parameters
    ----------
    commands : argparse subparsers
        Where it belongs.
    """
    demo = commands.add_parser(
        'demo',
        help='turn the block and the disk of the paper with real nodes on a simulated rig',
        description='Runs the rigs of figures 9 and 10 of the paper as ROS 2 nodes in separate '
        'processes against the simulated plant, faster than real time, and compares the outcome '
        'with the paper. Needs a minute at most.',
    )
    demo.add_argument(
        '-o',
        '--out',
        type=Path,
        default=Path('out'),
        metavar='DIR',
        help='folder for history.png and the bags block/ and disk/ (default: out)',
    )
    demo.add_argument('--json', action='store_true', help='print one JSON object, SI units')
    demo.set_defaults(run=_demo)


def _demo(options: argparse.Namespace) -> int:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from tactile_push import demo

    bar = Progress(
        TextColumn('{task.description:8}'),
        BarColumn(),
        TextColumn('step {task.completed} of {task.total}'),
        TimeElapsedColumn(),
        console=Console(stderr=True),
    )
    tasks = {case.name: bar.add_task(case.name, total=demo.STEPS) for case in demo.CASES}
    try:
        with bar:
            results = demo.run_demo(
                options.out,
                lambda name, steps: bar.update(tasks[name], completed=min(steps, demo.STEPS)),
            )
    except demo.DemoError as error:
        print(f'tactile_push demo: {error}', file=sys.stderr)
        return 1
    except OSError as error:
        where = error.filename or options.out
        print(f'tactile_push demo: {where}: {error.strerror}', file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(demo.as_json(results), indent=2))
    else:
        _print_demo(results, options.out)
    return 0 if all(result.settle_step is not None for result in results.values()) else 1


def _print_demo(results: 'dict[str, RigResult]', out: Path) -> None:
    from rich.markup import escape
    from rich.table import Table

    from tactile_push.cli.bags import wide_console
    from tactile_push.demo import CASES, TRANSLATING

    table = Table()
    table.add_column('')
    for case in CASES:
        table.add_column(case.name, justify='right')
        table.add_column('paper', justify='right', style='dim')

    def degrees(bounds: tuple[float, float]) -> str:
        return f'{math.degrees(bounds[0]):.1f} to {math.degrees(bounds[1]):.1f}'

    def step(found: int | None) -> str:
        return 'never' if found is None else str(found)

    def row(label: str, key: str, values: list[str]) -> None:
        papers = [case.paper.get(key, '') for case in CASES]
        table.add_row(
            escape(label), *[cell for pair in zip(values, papers, strict=True) for cell in pair]
        )

    runs = [results[case.name] for case in CASES]
    bands = ', '.join(f'{math.degrees(case.band):.0f}°' for case in CASES)
    row(
        f'within {bands} of θ_d from step',
        'settled',
        [step(run.settle_step) for run in runs],
    )
    row(f'θ from step {TRANSLATING} on [°]', 'theta', [degrees(run.theta_range) for run in runs])
    row(f'φ from step {TRANSLATING} on [°]', 'phi', [degrees(run.phi_range) for run in runs])
    row(
        'so d by (17) [mm]',
        'd',
        [f'{1e3 * run.d_lower:.2f} to {1e3 * run.d_upper:.2f}' for run in runs],
    )
    row(
        'd known to 2 mm from step',
        'known',
        [
            # Of the disk d is 0 by its roundness.
            step(run.known_step) if 'known' in case.paper else ''
            for case, run in zip(CASES, runs, strict=True)
        ],
    )
    row('true d at the end [mm]', '', [f'{1e3 * run.d_final:.2f}' for run in runs])
    row('control ticks lost', '', [str(run.ticks_lost) for run in runs])
    row('wall time [s]', '', [f'{run.wall_seconds:.1f}' for run in runs])
    console = wide_console()
    console.print(table)
    console.print(f'{out}/history.png, {out}/block/, {out}/disk/')
