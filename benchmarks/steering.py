# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether objects are carried straight ahead at a goal for as long as one likes.

    python benchmarks/steering.py [--minutes M] [--starts N] [--noise-deg X] [--lag X]

Each run steers the paper's block, on a patch of 1 cm, uniform, rim or corners, with mu_c from 0.1
to infinite, with the usual finger, whose tip turns. Starts and goals are random: the edge within 20
degrees, d within 3 mm of where the object would be carried straight ahead, the goal within 15 mm of
where the centre of mass starts. A goal can be held if the leaf on which the contact starts has an
angle of up to 35 degrees and a contact within the friction cone there; other goals are drawn again.
A run holds its goal if the centre of mass is within 2 mm of it from two minutes on. The table has
the share of runs that do, when they get there, the largest error after two minutes, and why the
others do not.
"""

import argparse
import math
import multiprocessing
import os
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np
from rich.console import Console
from rich.table import Table

from tactile_push import paper
from tactile_push.control import settle_step
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import RigConfig
from tactile_push.simulation.steered_run import NEAR, steered_run

SUPPORTS = ('patch', 'uniform', 'rim', 'corners')
FRICTIONS = (0.1, 0.3, 0.5, 1.0, math.inf)
WIDEST_THETA, WIDEST_E, WIDEST_X = math.radians(20.0), 0.003, 0.015
STEEPEST = math.radians(35.0)
LATEST = 120.0  # [s]


@dataclass(frozen=True)
class Task:
    """One run."""

    support: str
    mu_c: float
    seed: int
    minutes: float
    noise: float
    lag: float


def case(task: Task) -> tuple[RigConfig, float]:
    """Draw a start, and a goal [m] from where the finger starts that can be held."""
    rng = np.random.default_rng(task.seed)
    block = Outline.rectangle(paper.BLOCK_EDGE, paper.BLOCK_DEPTH)
    patch = Support.circle(0.01)
    support = patch if task.support == 'patch' else getattr(Support, task.support)(block)
    slider = Slider.on(block, support, exact=True)
    while True:
        theta = rng.uniform(-WIDEST_THETA, WIDEST_THETA)
        d = rng.uniform(-WIDEST_E, WIDEST_E) - paper.BLOCK_L * math.tan(theta)
        config = RigConfig(slider, task.mu_c, theta, d)
        reach = paper.BLOCK_L + config.radius
        start = -d * math.cos(theta) - reach * math.sin(theta)
        goal = start + rng.uniform(-WIDEST_X, WIDEST_X)
        held = _held(config, theta, d, goal)
        contact = paper.BLOCK_L * math.tan(abs(held))
        if abs(held) <= STEEPEST and contact <= paper.BLOCK_L * task.mu_c:
            return config, goal


def _held(config: RigConfig, theta: float, d: float, goal: float) -> float:
    """Return the angle at which the object is carried straight ahead at a goal, on its leaf."""
    links, tip, r = config.finger, config.tip, config.radius

    def psi(x: float) -> float:
        return sum(links.inverse(tip.x + x, tip.y))

    low, high = -math.pi / 3.0, math.pi / 3.0
    for _ in range(50):
        held = (low + high) / 2.0
        rolled = r * (psi(goal + r * math.sin(held)) - psi(0.0) + theta - held)
        if d + rolled + paper.BLOCK_L * math.tan(held) < 0.0:
            low = held
        else:
            high = held
    return (low + high) / 2.0


def run(task: Task) -> tuple[float, float, str]:
    """Return when the object arrives [s], the largest error later on [m], and how it ends."""
    config, goal = case(task)
    steps = round(60.0 * task.minutes / paper.CONTROL_PERIOD)
    done = steered_run(config, goal, steps, noise=task.noise, lag=task.lag, seed=task.seed)
    if done.end != 'done':
        return math.nan, math.nan, done.end
    first = settle_step(done.x, goal, NEAR)
    late = round(LATEST / paper.CONTROL_PERIOD)
    most = float(np.abs(done.x[late:] - goal).max())
    if first is None or first > late:
        return math.nan, most, f'{1e3 * most:.1f} mm'
    return first * paper.CONTROL_PERIOD, most, ''


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=float, default=10.0, metavar='M')
    parser.add_argument('--starts', type=int, default=4, metavar='N', help='of each kind')
    parser.add_argument('--noise-deg', type=float, default=0.3, metavar='X')
    parser.add_argument('--lag', type=float, default=0.1, metavar='S')
    parser.add_argument('--processes', type=int, default=os.cpu_count(), metavar='N')
    options = parser.parse_args()
    columns = 'support', 'mu_c', 'held', 'there after [s]', 'largest error [mm]', 'the others'
    table = Table(*columns)
    rest = options.minutes, math.radians(options.noise_deg), options.lag
    fork = multiprocessing.get_context('fork')
    with ProcessPoolExecutor(options.processes, fork) as pool:
        kinds = [(support, mu_c) for support in SUPPORTS for mu_c in FRICTIONS]
        runs = {
            kind: [pool.submit(run, Task(*kind, seed, *rest)) for seed in range(options.starts)]
            for kind in kinds
        }
        for (support, mu_c), tasks in runs.items():
            results = [task.result() for task in tasks]
            held = [(when, most) for when, most, end in results if not end]
            ends = Counter(end for _, _, end in results if end)
            when = f'{np.median([one for one, _ in held]):.0f}' if held else ''
            most = f'{1e3 * max(one for _, one in held):.2f}' if held else ''
            others = ', '.join(f'{count} {end}' for end, count in ends.items())
            share = f'{len(held)} of {len(results)}'
            table.add_row(support, f'{mu_c:g}', share, when, most, others)
    Console(width=None if sys.stdout.isatty() else 130).print(table)
    return 0


if __name__ == '__main__':
    sys.exit(main())
