# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push demo`: both rigs of the paper, or three placed objects, with real nodes."""

import argparse
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from tactile_push.cli.arguments import Commands, Refused
from tactile_push.interface import CAMERA, MUJOCO_PLANT, SENSORS, SENTENCE, SIM_PLANT
from tactile_push.needs_mujoco import mujoco_is_missing
from tactile_push.needs_opencv import opencv_is_missing
from tactile_push.paper import DISK

if TYPE_CHECKING:
    from rich.progress import Progress

    from tactile_push.demo.turning import RigResult

PHYSICS = {'paper': SIM_PLANT, 'mujoco': MUJOCO_PLANT}


def add(commands: Commands) -> None:
    """Add the command."""
    demo = commands.add_parser(
        'demo',
        help='turn the block and the disk of the paper with real nodes on a simulated rig, or '
        'place three objects',
        description='Runs the rigs of figures 9 and 10 of the paper as ROS 2 nodes in separate '
        'processes against the simulated plant, faster than real time, and compares the outcome '
        'with the paper; or places three objects, and compares where they were let go with the '
        'goals. Needs a minute or two.',
    )
    demo.add_argument(
        '--place',
        action='store_true',
        help='place three objects one after the other by touch alone; the exit status is 1 if one '
        'was not let go',
    )
    demo.add_argument(
        '-o',
        '--out',
        type=Path,
        default=Path('out'),
        metavar='DIR',
        help='folder for history.png and the bags block/ and disk/, with --place for placed.png '
        'and the bag placed/ (default: out)',
    )
    demo.add_argument(
        '--physics',
        choices=tuple(PHYSICS),
        default='paper',
        help="who simulates: the paper's mechanics, or MuJoCo with a finger of joints and a push "
        'above the belt (default: paper)',
    )
    demo.add_argument(
        '--sensor',
        choices=SENSORS,
        default=SENTENCE,
        help='what the finger feels with: a sensor that sends sentences, a force/torque sensor '
        'or a camera with its noise (default: sentence)',
    )
    demo.add_argument('--json', action='store_true', help='print one JSON object, SI units')
    demo.set_defaults(run=_demo, ros=True)


def _demo(options: argparse.Namespace) -> int:
    if PHYSICS[options.physics] == MUJOCO_PLANT and mujoco_is_missing('tactile_push demo'):
        return 2
    if options.sensor == CAMERA and opencv_is_missing('tactile_push demo', 'cv2'):
        return 2
    return _place(options) if options.place else _turn(options)


def _turn(options: argparse.Namespace) -> int:
    from tactile_push.demo.turning import RIGS, STEPS, run_demo

    with _running(options) as bar:
        tasks = {name: bar.add_task(name, total=STEPS) for name in RIGS}
        results = run_demo(
            options.out,
            lambda name, steps: bar.update(tasks[name], completed=min(steps, STEPS)),
            PHYSICS[options.physics],
            options.sensor,
            lambda address: bar.console.print(f'to watch: {address}', soft_wrap=True),
        )
    if options.json:
        rigs = {name: result.as_json() for name, result in results.items()}
        print(json.dumps({'rigs': rigs}, indent=2))
    else:
        _print(results, options.out)
    settled = all(result.push.settle_step is not None for result in results.values())
    return 0 if settled else 1


def _place(options: argparse.Namespace) -> int:
    from tactile_push.cli.output import wide_console
    from tactile_push.demo.placing import PLACING_STEPS, run_placing
    from tactile_push.report.outcome import goal_table

    with _running(options) as bar:
        task = bar.add_task('placing', total=PLACING_STEPS)
        result = run_placing(
            options.out,
            lambda steps: bar.update(task, completed=min(steps, PLACING_STEPS)),
            PHYSICS[options.physics],
            options.sensor,
            lambda address: bar.console.print(f'to watch: {address}', soft_wrap=True),
        )
        bar.update(task, completed=PLACING_STEPS)  # what no goal has taken is left over
    if options.json:
        print(json.dumps(result.as_json(), indent=2))
    else:
        console = wide_console()
        console.print(goal_table(result.goals))
        console.print(f'{options.out}/placed.png, {options.out}/placed/')
    return 0 if result.all_released else 1


@contextmanager
def _running(options: argparse.Namespace) -> 'Iterator[Progress]':
    """Show the progress of a demonstration; refuse what cannot be written or run."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from tactile_push.cli.output import naming
    from tactile_push.demo.running import DemoError

    bar = Progress(
        TextColumn('{task.description:8}'),
        BarColumn(),
        TextColumn('step {task.completed} of {task.total}'),
        TimeElapsedColumn(),
        console=Console(stderr=True),
    )
    try:
        with naming(options.out):
            options.out.mkdir(parents=True, exist_ok=True)  # before a bar is shown in vain
            with bar:
                yield bar
    except DemoError as error:
        raise Refused(error, status=1) from None


def _print(results: 'dict[str, RigResult]', out: Path) -> None:
    from tactile_push.cli.output import wide_console
    from tactile_push.report.outcome import Row, fixed, outcome_table, push_rows, step_words

    runs = {}
    for name, result in results.items():
        known = None if name == DISK else step_words(result.known_step)  # a disk's d is 0
        rows = push_rows(result.push, known)
        rows.append(Row('true d at the end [mm]', fixed(1e3 * result.d_final, 2)))
        rows.append(Row('wall time [s]', f'{result.wall_seconds:.1f}'))
        runs[name] = rows, result.push.paper
    console = wide_console()
    console.print(outcome_table(runs))
    console.print(f'{out}/history.png, {out}/block/, {out}/disk/')
