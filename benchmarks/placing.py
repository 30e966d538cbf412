# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well objects are placed, and whether goals are told apart in advance.

    python benchmarks/placing.py [--runs N] [--seed S] [--groups NAME …] [--json FILE]
    python benchmarks/placing.py --physics mujoco [--runs N] [--seed S] [--json FILE]

Each run places an object on corners, its area, its rim or a patch of 1 cm, with mu_c 0.1, 0.3, 1 or
infinite, from a random start at a random goal, on the exact limit surface. Within its group all
runs have the object, the conditions and the law in common: the paper's block, 300 mm of belt, noise
of 0.3 degrees, a lag of 0.1 s, and the law that plans, unless the name says otherwise. Rivals are
law (18), whose theta_d is the goal's, and a cascade that sets theta_d by the error of x.

Goals count that a plan under the true numbers reaches while it spares some of every limit, and
still does after the object has translated over 30 mm of belt. Of these: the shares of runs that let
go within 0.5, 1 and 2 mm and degrees; median and 95 % quantile of the errors; of the runs within
0.5 the belt in the median, the part of it for learning, and the ratio to the shortest belt that a
long search finds under the true numbers.

Of all goals of the block: how often one is refused that an oracle reaches, and how often one is
promised that cannot be reached. The oracle is the law with the true state told, or the long search.
What it cannot do is what the law does not do with the true state told.
"""

import argparse
import json
import multiprocessing
import os
import sys
from collections.abc import Iterable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from deliveries.cases import BESIDE, PLATE, TRIANGLE, Group
from deliveries.runs import Outcome, judged, row, run
from rich.console import Console
from rich.table import Table

GROUPS = (
    Group('block'),
    Group('state told', state_told=True),
    Group('law (18), state told', state_told=True, law='law (18)'),
    Group('cascade, state told', state_told=True, law='cascade'),
    Group('law (18)', law='law (18)'),
    Group('cascade', law='cascade'),
    Group('plate 8 x 4 cm', corners=PLATE),
    Group('triangle', corners=TRIANGLE),
    Group('mass off centre', centre=BESIDE),
    Group('noise 0.2°', noise=0.2),
    Group('noise 0.5°', noise=0.5),
    Group('no lag', lag=0.0),
    Group('lag 0.2 s', lag=0.2),
    Group('belt 150 mm', belt=0.15),
    Group('belt 200 mm', belt=0.2),
    Group('belt 400 mm', belt=0.4),
    Group('l wrong by 5 %, called so', l_error=0.05, l_share=0.05),
    Group('1 % outliers', outlier=0.01),
    Group('tip turns', tip_turns=True),
)
ESTIMATED, TOLD = GROUPS[:2]  # every goal of these is tried
WITHIN = (0.5, 1.0, 2.0)  # [mm] and degrees
COLUMNS = (
    *('group', 'runs', *(f'within {w:g}' for w in WITHIN)),
    *('x [mm]', 'theta [°]', 'belt [mm]', 'learning', 'of shortest'),
)
JUDGED = ('goals', 'judged', 'oracle does', 'of these refused', 'promised', 'of these not done')


def workers(count: int) -> Executor:
    """Return so many processes, or this one alone."""
    if count == 1:
        return ThreadPoolExecutor(1)
    return ProcessPoolExecutor(count, multiprocessing.get_context('fork'))


def outcomes_of(pool: Executor, groups: Iterable[Group], seeds: range) -> dict[str, list[Outcome]]:
    """Run groups on all processes."""
    tasks = {
        group.name: [pool.submit(run, seed, group, group in (ESTIMATED, TOLD)) for seed in seeds]
        for group in groups
    }
    return {name: [task.result() for task in some] for name, some in tasks.items()}


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--runs', type=int, metavar='N', help='in all: 2,000 by default, 100 on mujoco'
    )
    parser.add_argument('--seed', type=int, default=0, metavar='S')
    parser.add_argument('--groups', nargs='+', metavar='NAME', help='all by default')
    parser.add_argument('--physics', choices=('paper', 'mujoco'), default='paper')
    parser.add_argument('--processes', type=int, default=os.cpu_count(), metavar='N')
    parser.add_argument('--json', type=Path, metavar='FILE')
    options = parser.parse_args()
    names = [group.name for group in GROUPS]
    unknown = set(options.groups or ()) - set(names)
    if unknown:
        parser.error(f'--groups: expected some of {names}, got {sorted(unknown)}')
    with workers(options.processes) as pool:
        if options.physics == 'mujoco':
            from deliveries import on_mujoco  # which needs the extra

            seeds = range(options.seed, options.seed + (options.runs or 100))
            groups = (on_mujoco.GROUP,)
            found = {on_mujoco.GROUP.name: list(pool.map(on_mujoco.run, seeds))}
        else:
            groups = tuple(g for g in GROUPS if g.name in (options.groups or names))
            count = max(1, round((options.runs or 2000) / len(groups)))
            found = outcomes_of(pool, groups, range(options.seed, options.seed + count))
    show(groups, found)
    if options.json is not None:
        results = {name: [asdict(one) for one in some] for name, some in found.items()}
        options.json.write_text(json.dumps(results, indent=1) + '\n')
    return 0


def show(groups: Iterable[Group], found: dict[str, list[Outcome]]) -> None:
    """Print the tables."""
    console = Console(width=None if sys.stdout.isatty() else 150)
    table = Table(*COLUMNS)
    for group in groups:
        table.add_row(*row(group.name, found[group.name], WITHIN))
    console.print(table)
    if ESTIMATED.name in found and TOLD.name in found:
        table = Table(*JUDGED)
        for cells in judged(found[TOLD.name], found[ESTIMATED.name]):
            table.add_row(*cells)
        console.print(table)


if __name__ == '__main__':
    sys.exit(main())
