# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration on every plant with every sensor: one row for each object.

    python benchmarks/closed_loops.py [--plants NODE …] [--sensors NAME …]

Real nodes push the paper's block and disk at the paper's gains, and `finger_servo` moves the
joints. Each row has the step from which on theta stays near theta_d, the step from which on d is
known to 2 mm, and the shares of the control periods in which the 95 % interval and the guaranteed
bounds hold the true d. Needs the extras ros, mujoco and camera.
"""

import argparse
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from tactile_push.bags import BagReader
from tactile_push.demo.turning import run_demo
from tactile_push.interface import PLANTS, SENSORS
from tactile_push.replay import estimate
from tactile_push.report.outcome import step_words

COLUMNS = ('plant', 'sensor', 'object', 'settled', 'd known', 'in the 95 %', 'in the bounds')


def main() -> int:
    """Run the demonstrations and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--plants', nargs='+', choices=PLANTS, default=PLANTS, metavar='NODE')
    parser.add_argument('--sensors', nargs='+', choices=SENSORS, default=SENSORS, metavar='NAME')
    options = parser.parse_args()
    table, console = Table(*COLUMNS), Console(stderr=True)
    with tempfile.TemporaryDirectory(prefix='tactile_push_') as folder:
        for plant in options.plants:
            for sensor in options.sensors:
                out = Path(folder) / plant / sensor
                with console.status('') as status:
                    tell = partial(_tell, status.update, f'{plant} {sensor}')
                    results = run_demo(out, tell, plant, sensor)
                for name, result in results.items():
                    figures = _figures(out / name, result.push.settle_step)
                    table.add_row(plant, sensor, name, *figures)
    Console().print(table)
    return 0


def _tell(show: Callable[[str], None], what: str, name: str, step: int) -> None:
    show(f'{what} {name} step {step}')


def _figures(bag: Path, settled: int | None) -> tuple[str, ...]:
    """Return the cells of a recorded run."""
    with BagReader(bag) as reader:
        (known,) = estimate(reader)
    inside = known.inside, known.inside_guaranteed
    shares = ('' if one is None else f'{one:.1%}' for one in inside)
    return step_words(settled), step_words(known.known_step), *shares


if __name__ == '__main__':
    sys.exit(main())
