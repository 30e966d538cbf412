# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The `tactile_push` command."""

import argparse
import json
import math
import os
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from tactile_push.demo import RigResult

MOST_STEPS = 10_000_000
PICTURES = ('.png', '.svg', '.pdf')


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : sequence of str, optional
        The words after `tactile_push`; those of the command line by default.

    Returns
    -------
    int
        Exit status: 0 done, 1 the job ran and failed, 2 bad input.
    """
    parser = _Parser(
        prog='tactile_push',
        description='Turn and locate objects by pushing them with one tactile finger.',
    )
    commands = parser.add_subparsers(required=True, metavar='COMMAND')
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
    _add_simulate(commands)
    figures = commands.add_parser(
        'figures',
        help='make figures 2, 3, 6, 7 and 8 of the paper and a map of the gains',
        description='Writes figures 2, 3, 6, 7 and 8 of the paper, made by the library, and a map '
        'of the gains that settle the block with a finger that lags behind its command, as PNG '
        'and SVG.',
    )
    figures.add_argument(
        '-o',
        '--out',
        type=Path,
        default=Path('out/figures'),
        metavar='DIR',
        help='folder for figure_2.png, figure_2.svg, gains.png and so on (default: out/figures)',
    )
    figures.add_argument(
        '--json', action='store_true', help='print the files as one JSON object instead of lines'
    )
    figures.set_defaults(run=_figures)
    options = parser.parse_args(arguments)
    for signum in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(signum) != signal.SIG_IGN:  # as nohup asks
            signal.signal(signum, _terminate)
    try:
        status = options.run(options)
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # whoever reads the output has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


class _Parser(argparse.ArgumentParser):
    """A parser that says in one line what is wrong."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f'{self.prog}: error: {message}; see {self.prog} --help\n')


def _number(
    what: str, lower: float, upper: float, *, closed: bool = True
) -> Callable[[str], float]:
    """Give a reader of numbers between bounds, for argparse."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (lower <= value <= upper if closed else lower < value < upper):
            raise argparse.ArgumentTypeError(f'expected {what}, got {text}')
        return value

    return read


def _steps(text: str) -> int:
    whole = text.isascii() and text.isdigit() and len(text) <= len(str(MOST_STEPS))
    if not (whole and int(text) <= MOST_STEPS):
        raise argparse.ArgumentTypeError(f'expected a whole number, 0 to {MOST_STEPS}, got {text}')
    return int(text)


def _picture(text: str) -> Path:
    if Path(text).suffix.lower() not in PICTURES:
        raise argparse.ArgumentTypeError(f'expected a file *{", *".join(PICTURES)}, got {text}')
    return Path(text)


def _add_simulate(commands: 'argparse._SubParsersAction[_Parser]') -> None:
    simulate = commands.add_parser(
        'simulate',
        help='simulate one object under the control law or open loop',
        description='Simulates a push of one object: mechanics and control law alone, no nodes. '
        'The defaults are the case of figure 8 of the paper.',
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    add = simulate.add_argument
    add('--object', default='block', metavar='block|disk|FILE', help='what is pushed; JSON files')
    add(
        '--support',
        default='uniform',
        metavar='corners|uniform|circle:RADIUS_M|rim|FILE',
        help='what the object rests on; a radius in metres',
    )
    add('--surface', default='ellipsoid', choices=('ellipsoid', 'exact'), help='limit surface')
    friction = _number('a coefficient of friction of 0 or more, or inf', 0.0, math.inf)
    add('--mu-c', type=friction, default=math.inf, metavar='X|inf', help='finger on object')
    gain = _number('a finite gain of 0 or more', 0.0, sys.float_info.max)
    add('--kp', type=gain, default=0.05, metavar='X', help='proportional gain [rad/rad]')
    add('--kd', type=gain, default=5.0, metavar='X', help='derivative gain [rad/rad]')
    edge = _number('degrees between -90 and 90', -90.0, 90.0, closed=False)
    add('--theta0-deg', type=edge, default=20.0, metavar='DEG', help='edge at the start')
    length = _number('millimetres', -sys.float_info.max, sys.float_info.max)
    add(
        '--d0-mm',
        type=length,
        default=argparse.SUPPRESS,
        metavar='MM',
        help='contact along the edge at the start (default: -6 for the block, otherwise the '
        'contact nearest to d = 0)',
    )
    ahead = _number('degrees between 0 and 180', 0.0, 180.0, closed=False)
    add('--phi0-deg', type=ahead, default=90.0, metavar='DEG', help='first push angle')
    any_angle = _number('degrees between -180 and 180', -180.0, 180.0)
    add('--theta-desired-deg', type=any_angle, default=-10.0, metavar='DEG', help='wanted edge')
    add('--steps', type=_steps, default=600, metavar='N', help='control periods of 0.1 s')
    add('--open-loop', action='store_true', help='push at the first angle all the time')
    add(
        '--json',
        metavar='FILE|-',
        default=argparse.SUPPRESS,
        help='write the run as one JSON object in SI units; - prints it instead of the summary',
    )
    add(
        '--plot',
        type=_picture,
        metavar='FILE',
        default=argparse.SUPPRESS,
        help='draw theta and phi - 90 degrees against the step; the ending chooses the format',
    )
    simulate.set_defaults(run=_simulate)


def _simulate(options: argparse.Namespace) -> int:
    from rich.console import Console

    d0, json_file, plot = (getattr(options, name, None) for name in ('d0_mm', 'json', 'plot'))
    try:
        with Console(stderr=True).status('simulating (the first time, compiling)'):
            from tactile_push import simulate

            done = simulate.simulate(
                options.object,
                options.support,
                exact=options.surface == 'exact',
                mu_c=options.mu_c,
                theta=math.radians(options.theta0_deg),
                d=None if d0 is None else d0 / 1000.0,
                phi=math.radians(options.phi0_deg),
                theta_desired=math.radians(options.theta_desired_deg),
                kp=options.kp,
                kd=options.kd,
                steps=options.steps,
                open_loop=options.open_loop,
            )
        if json_file is not None:
            text = json.dumps(done.as_json()) + '\n'
            if json_file == '-':
                sys.stdout.write(text)
            else:
                with simulate.naming('--json', json_file):
                    Path(json_file).write_text(text)
        if plot is not None:
            with simulate.naming('--plot', plot):
                simulate.plot(done, plot)
    except ValueError as error:
        print(f'tactile_push simulate: {error}', file=sys.stderr)
        return 2
    if json_file != '-':
        print(simulate.summary(done))
    if done.run.end != 'done':
        print(f'tactile_push simulate: {done.run.end}', file=sys.stderr)
        return 1
    return 0


def _figures(options: argparse.Namespace) -> int:
    from rich.console import Console

    from tactile_push.plots import save_figures

    with Console(stderr=True).status('figures') as status:
        try:
            files = save_figures(options.out, lambda name: status.update(name))
        except OSError as error:
            print(f'tactile_push figures: --out: {error}', file=sys.stderr)
            return 2
    if options.json:
        print(json.dumps({'files': [str(file) for file in files]}))
    else:
        print(*files, sep='\n')
    return 0


def _terminate(signum: int, frame: FrameType | None) -> NoReturn:
    """End as after an exception, so that what was started is stopped."""
    sys.exit(128 + signum)


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
        print(f'tactile_push demo: --out: {error}', file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(demo.as_json(results), indent=2))
    else:
        _print_demo(results, options.out)
    return 0 if all(result.settle_step is not None for result in results.values()) else 1


def _print_demo(results: 'dict[str, RigResult]', out: Path) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from tactile_push.demo import CASES, TRANSLATING

    table = Table()
    table.add_column('')
    for case in CASES:
        table.add_column(case.name, justify='right')
        table.add_column('paper', justify='right', style='dim')

    def degrees(bounds: tuple[float, float]) -> str:
        return f'{math.degrees(bounds[0]):.1f} to {math.degrees(bounds[1]):.1f}'

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
        ['never' if run.settle_step is None else str(run.settle_step) for run in runs],
    )
    row(f'θ from step {TRANSLATING} on [°]', 'theta', [degrees(run.theta_range) for run in runs])
    row(f'φ from step {TRANSLATING} on [°]', 'phi', [degrees(run.phi_range) for run in runs])
    row(
        'so d by (17) [mm]',
        'd',
        [f'{1e3 * run.d_lower:.2f} to {1e3 * run.d_upper:.2f}' for run in runs],
    )
    row('true d at the end [mm]', '', [f'{1e3 * run.d_final:.2f}' for run in runs])
    row('control ticks lost', '', [str(run.ticks_lost) for run in runs])
    row('wall time [s]', '', [f'{run.wall_seconds:.1f}' for run in runs])
    console = Console()
    console.print(table)
    console.print(f'{out}/history.png, {out}/block/, {out}/disk/')


if __name__ == '__main__':
    sys.exit(main())
