# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How often the estimator's intervals have the truth, and how narrow they are.

    python benchmarks/estimation.py [--experiments N] [--seed S] [--json FILE] [--plot FILE]
    python benchmarks/estimation.py --physics mujoco [--starts N] [--straight] [--push-height M]

Each experiment runs the paper's law on a simulated rig whose object, start, sensor and finger are
drawn by chance within its group, and gives the readings at 10 Hz and the finger's measured motion
to the estimator. Of each group: the share of 95 % intervals of d that have the truth, the median
width of the interval, and how often the truth is within the guaranteed bounds, after 10, 20, 60,
173 and 400 steps. Experiments whose noise exceeds the stated bound, or that have outliers, do not
count for the guarantee. Where the estimator does not know which edge is pushed: how often the right
one leads, and from which step on its weight, with that of edges alike, stays above 0.95.

Beside it: for contacts known to stick the bound of Cramer and Rao on the width, 4 sqrt(variance of
d), from the sensitivities of theta to its start, d and c, with the prior as one more reading; for
some groups a bootstrap particle filter of 4,000 particles with Liu and West's kernel; and the
paper's method, (17) over the last 25 steps once theta has stayed within its noise.

With --physics mujoco the nodes' steps run on the rig in MuJoCo, whose mechanics the estimator does
not share: eight cases and N random starts for each of two frictions, 450 control periods each. Of
all control periods with an estimate: the share of 95 % intervals of d that have the truth, of
intervals narrower than 2 mm that do not, and of guaranteed bounds that hold.
"""

import argparse
import json
import multiprocessing
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from estimating.groups import GROUPS, STEPS
from estimating.study import Outcome, figures, make
from rich.console import Console
from rich.progress import track
from rich.table import Table

METHODS = ('estimator', 'guaranteed', 'particles', 'translation (17)')
SHOWN = ('sticks, 0.2°', 'sticks, 0.5°', 'mu_c 0', 'mu_c 0.3', 'exact corners', 'l and r uncertain')
PORTION = 10  # experiments that a process makes at a time


def run(count: int, seed: int) -> dict[str, Any]:
    """Make `count` experiments of every group, on all cores."""
    outcomes: list[list[Outcome]] = [[] for _ in GROUPS]
    fork = multiprocessing.get_context('fork')
    with ProcessPoolExecutor(os.cpu_count(), fork) as pool:
        tasks = [
            pool.submit(make, index, seed, range(first, min(first + PORTION, count)))
            for index in range(len(GROUPS))
            for first in range(0, count, PORTION)
        ]
        shown = Console(stderr=True)
        for task in track(as_completed(tasks), total=len(tasks), console=shown, transient=True):
            index, some = task.result()
            outcomes[index] += some
    return {group.name: figures(group, some) for group, some in zip(GROUPS, outcomes, strict=True)}


def run_on_mujoco(cases: list[Any], seed: int) -> dict[str, Any]:
    """Run cases on MuJoCo, on all cores."""
    from estimating import on_mujoco

    fork = multiprocessing.get_context('fork')
    told: dict[str, list[Any]] = {case.name: [] for case in cases}
    with ProcessPoolExecutor(os.cpu_count(), fork) as pool:
        tasks = [pool.submit(on_mujoco.run, case, seed + i) for i, case in enumerate(cases)]
        shown = Console(stderr=True)
        for _ in track(as_completed(tasks), total=len(tasks), console=shown, transient=True):
            pass
    for case, task in zip(cases, tasks, strict=True):
        told[case.name].append(task.result())
    return {name: on_mujoco.figures(runs) for name, runs in told.items()}


def show(results: dict[str, Any]) -> None:
    """Print a row for every group and method."""
    table = Table('group', 'method', *(f'step {k}' for k in STEPS), 'ms/tick')
    for name, result in results.items():
        for method in METHODS:
            if result[method]:
                cells = [
                    f'{one["width_mm"]:.2f} mm {100.0 * one["coverage"]:.1f} %' if one else ''
                    for one in (result[method].get(str(k)) for k in STEPS)
                ]
                cost = ''
                if method == 'estimator':
                    cost = f'{result["milliseconds_a_tick"]["mean"]:.2f}'
                table.add_row(name if method == 'estimator' else '', method, *cells, cost)
        if result['cramer_rao_mm']:
            widths = [f'{width:.2f} mm' for width in result['cramer_rao_mm'].values()]
            table.add_row('', 'Cramer-Rao', *widths)
        if 'edge' in result:
            edge = result['edge']
            leads = (edge['leads'].get(str(k)) for k in STEPS)
            cells = ['' if one is None else f'leads in {100.0 * one:.0f} %' for one in leads]
            table.add_row('', 'pushed edge', *cells)
            found = f'found in {100.0 * edge["found"]:.0f} %'
            at = '' if edge['found_at_step'] is None else f'by step {edge["found_at_step"]:.0f}'
            table.add_row('', '', found, at, f'misled in {100.0 * edge["misled"]:.1f} %')
        for reason, count in result['contradictions'].items():
            table.add_row('', f'{count} x', reason)
    print_wide(table)


def print_wide(table: Table) -> None:
    """Print a table."""
    Console(width=None if sys.stdout.isatty() else 170).print(table)


def plot(results: dict[str, Any], file: Path) -> None:
    """Draw width against step: the first group by every method, and the first of each kind."""
    from tactile_push.figures.style import TWO_COLUMNS, new_figure

    figure = new_figure(TWO_COLUMNS, 4.0)
    left, right = figure.subplots(1, 2, sharey=True)
    name, result = next(iter(results.items()))
    for method in METHODS:
        draw(left, result[method], label=method)
    if result['cramer_rao_mm']:
        steps = [int(k) for k in result['cramer_rao_mm']]
        left.loglog(steps, list(result['cramer_rao_mm'].values()), 'k:', label='Cramér-Rao')
    left.set(xlabel='step', ylabel='median width for d [mm]', title=name)
    for name in results:
        if name in SHOWN:
            draw(right, results[name]['estimator'], label=name)
    right.set(xlabel='step', title='the estimator')
    for axes in (left, right):  # below the lines, not on them
        axes.legend(loc='upper center', bbox_to_anchor=(0.5, -0.2), ncols=2)
    figure.savefig(file)


def draw(axes: Any, rows: dict[str, Any], **style: Any) -> None:
    """Draw the widths of one method in one group."""
    if rows:
        axes.loglog([int(k) for k in rows], [one['width_mm'] for one in rows.values()], **style)


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--experiments', type=int, default=10000, metavar='N', help='in all')
    parser.add_argument('--seed', type=int, default=0, metavar='S')
    parser.add_argument('--physics', choices=('paper', 'mujoco'), default='paper')
    parser.add_argument('--starts', type=int, default=16, metavar='N', help='on mujoco')
    parser.add_argument('--straight', action='store_true', help='on mujoco, a tip held by a wrist')
    parser.add_argument('--push-height', type=float, default=0.016, metavar='M', help='on mujoco')
    parser.add_argument('--json', type=Path, metavar='FILE')
    parser.add_argument('--plot', type=Path, metavar='FILE')
    arguments = parser.parse_args()
    if arguments.experiments < 1 or arguments.seed < 0:
        parser.error('--experiments: expected 1 or more, --seed: 0 or more')
    if arguments.physics == 'mujoco':
        from estimating import on_mujoco  # which needs the extra

        cases = on_mujoco.cases(
            arguments.starts, arguments.push_height, tip_turns=not arguments.straight
        )
        results = run_on_mujoco(cases, arguments.seed)
        print_wide(on_mujoco.show(results))
    else:
        results = run(max(1, round(arguments.experiments / len(GROUPS))), arguments.seed)
        show(results)
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(results, indent=1) + '\n')
    if arguments.plot is not None and arguments.physics == 'paper':
        plot(results, arguments.plot)


if __name__ == '__main__':
    main()
