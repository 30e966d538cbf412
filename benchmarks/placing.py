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

With regrasp the finger has two axes, and those goals count that are out of reach from the first
contact under the true numbers, whatever plan is looked for, and within reach from another one on
the same edge. The belt for such a goal is compared with the shortest way over one of these.

Of all goals of the block: how often one is refused that an oracle reaches, and how often one is
promised with reserve that cannot be reached. The oracle is the law, with the true state told or by
touch alone, or the long search. What cannot be reached is what the law misses both ways.

A file gets a line for each run as it ends. Runs that it has already are not made again.
"""

import argparse
import json
import multiprocessing
import os
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from deliveries.cases import BESIDE, PLATE, TRIANGLE, Group
from deliveries.runs import Outcome, judged, row, run
from rich.console import Console
from rich.table import Table

from tactile_push.simulation.placement import Placement

Run = Callable[[int, Group, bool], Outcome]

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
    Group('with regrasp', axes=2),
)
ESTIMATED, TOLD = GROUPS[:2]  # every goal of these is tried
WITHIN = (0.5, 1.0, 2.0)  # [mm] and degrees
COLUMNS = (
    *('group', 'runs', *(f'within {w:g}' for w in WITHIN)),
    *('x [mm]', 'theta [°]', 'belt [mm]', 'learning', 'of shortest'),
)
JUDGED = (
    'goals',
    'judged',
    'oracle does',
    'of these refused',
    'promised',
    'missed by touch',
    'missed if told',
    'by both',
)


def workers(count: int) -> Executor:
    """Return so many processes, or this one alone."""
    if count == 1:
        return ThreadPoolExecutor(1)
    return ProcessPoolExecutor(count, multiprocessing.get_context('fork'))


def outcomes_of(
    pool: Executor, groups: Iterable[Group], seeds: range, one_run: Run, file: Path | None
) -> dict[str, list[Outcome]]:
    """Run groups on all processes, seed after seed, as far as a file does not have them."""
    known = read(file) if file is not None and file.exists() else {}
    tasks: dict[tuple[str, int], Future[Outcome]] = {}
    for seed in seeds:
        for group in groups:
            if (group.name, seed) not in known:
                every = group in (ESTIMATED, TOLD)
                tasks[group.name, seed] = pool.submit(one_run, seed, group, every)
    for (name, seed), task in tasks.items():
        known[name, seed] = task.result()
        if file is not None:
            with file.open('a') as lines:
                lines.write(json.dumps({'group': name, **asdict(known[name, seed])}) + '\n')
    return {group.name: [known[group.name, seed] for seed in seeds] for group in groups}


def read(file: Path) -> dict[tuple[str, int], Outcome]:
    """Return the runs of a file, by group and seed."""
    found = {}
    for line in file.read_text().splitlines():
        numbers = json.loads(line)
        name, placement = numbers.pop('group'), numbers.pop('placement')
        placed = None if placement is None else Placement(**placement)
        found[name, numbers['seed']] = Outcome(**numbers, placement=placed)
    return found


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
    groups, one_run, runs = (
        tuple(g for g in GROUPS if g.name in (options.groups or names)),
        run,
        2000,
    )
    if options.physics == 'mujoco':
        from deliveries import on_mujoco  # which needs the extra

        groups, one_run, runs = (on_mujoco.GROUP,), on_mujoco.run, 100
    count = max(1, round((options.runs or runs) / len(groups)))
    seeds = range(options.seed, options.seed + count)
    with workers(options.processes) as pool:
        found = outcomes_of(pool, groups, seeds, one_run, options.json)
    show(groups, found)
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
