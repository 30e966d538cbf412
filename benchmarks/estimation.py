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
"""How often the estimator's intervals have the truth, and how narrow they are.

    python benchmarks/estimation.py [--experiments N] [--seed S] [--json FILE] [--plot FILE]

Each experiment runs the paper's law on a simulated rig whose object, start, sensor and finger are
drawn by chance within its group, and gives the readings at 10 Hz and the finger's measured motion
to the estimator. Of each group: the share of 95 % intervals of d that have the truth, the median
width of the interval, and how often the truth is within the guaranteed bounds, after 10, 20, 60,
173 and 400 steps. Experiments whose noise exceeds the stated bound, or that have outliers, do not
count for the guarantee.

Beside it, for the first groups: the bound of Cramer and Rao on the width for a sticking contact,
4 sqrt(variance of d), from the sensitivities of theta to its start, d and c, with the prior as one
more reading; a bootstrap particle filter of 4,000 particles with Liu and West's kernel; and the
paper's method, (17) over the last 25 steps once theta has stayed within its noise.
"""

import argparse
import json
import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from tactile_push.control import PushLaw, finger_velocity
from tactile_push.estimation import ContactEstimator, Prior
from tactile_push.estimation.hypotheses import advance
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.mechanics.compiled import compiled
from tactile_push.simulation import Faults, Rig, RigConfig, Servo

STEPS = (10, 20, 60, 173, 400)
BELT_SPEED, PERIOD, RADIUS = 0.005, 0.1, 0.0135
C = (0.005, 0.036)
PARTICLES = 4000
SHRINK = 0.98  # of Liu and West
BLOCK = (0.05, 0.0475)


@dataclass(frozen=True)
class Group:
    """Experiments of one kind."""

    name: str
    mu_c: float = math.inf
    noise: float = math.radians(0.2)
    sizes: tuple[float, float] = BLOCK
    c: tuple[float, float] = C
    support: Callable[[Outline], Support] | None = None
    lag: float = 0.0
    outlier: float = 0.0
    sticks: bool = False  # whether the prior knows that the contact sticks
    start: tuple[float, float] | None = None  # theta [rad] and d [m]; by chance without
    rivals: bool = False  # whether the other methods are tried, too


def uniform(outline: Outline) -> Support:
    """Give uniform pressure, by 100 points."""
    return Support.uniform(outline, 100)


def rim(outline: Outline) -> Support:
    """Give all load on the rim, by 100 points."""
    return Support.rim(outline, 100)


FIGURE_8 = (math.radians(20.0), -0.006)
GROUPS = (
    Group('figure 8, sticks, 0.2°', sticks=True, start=FIGURE_8, rivals=True),
    Group('figure 8, sticks, 0.5°', math.inf, math.radians(0.5), sticks=True, start=FIGURE_8),
    Group('sticks, 0.2°', sticks=True, rivals=True),
    Group('sticks, 0.5°', math.inf, math.radians(0.5), sticks=True),
    *(Group(f'mu_c {mu_c:g}', mu_c) for mu_c in (0.0, 0.1, 0.2, 0.3, 0.5, 1.0, math.inf)),
    *(Group(f'noise {a:g}°', math.inf, math.radians(a)) for a in (0.1, 0.5, 1.0)),
    Group('c 0.5 to 1 cm', c=(0.005, 0.01)),
    Group('c 2.5 to 3.6 cm', c=(0.025, 0.036)),
    Group('wide, 8 x 4 cm', 0.5, sizes=(0.08, 0.04)),
    Group('deep, 4 x 6 cm', 0.5, sizes=(0.04, 0.06)),
    Group('exact corners', support=Support.corners),
    Group('exact rim', support=rim),
    Group('exact uniform', support=uniform),
    Group('exact corners, mu_c 0.3', 0.3, support=Support.corners),
    Group('exact uniform, mu_c 0.3', 0.3, support=uniform),
    Group('exact uniform, mu_c 0', 0.0, support=uniform),
    Group('lag 0.1 s', lag=0.1),
    Group('outliers 1 %', outlier=0.01),
)


@dataclass
class Rows:
    """What one method gave in a group, a list each after every one of the steps."""

    widths: dict[int, list[float]] = field(default_factory=lambda: {k: [] for k in STEPS})
    hits: dict[int, list[bool]] = field(default_factory=lambda: {k: [] for k in STEPS})

    def add(self, step: int, lower: float, upper: float, truth: float) -> None:
        """Note an interval."""
        self.widths[step].append(upper - lower)
        self.hits[step].append(lower <= truth <= upper)

    def figures(self) -> dict[str, dict[str, float | int]]:
        """Give coverage, median width [mm] and number after every step that was reached."""
        return {
            str(step): {
                'coverage': float(np.mean(self.hits[step])),
                'width_mm': 1e3 * float(np.median(self.widths[step])),
                'experiments': len(self.hits[step]),
            }
            for step in STEPS
            if self.hits[step]
        }


def experiment(group: Group, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Run the rig: readings, measured and true values at every control period."""
    outline = Outline.rectangle(*group.sizes)
    c = rng.uniform(*group.c)
    slider = Slider(outline, c)
    if group.support is not None:
        slider = Slider.on(outline, group.support(outline), exact=True)
    half = group.sizes[0] / 2.0
    theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.8, 0.8) * half
    if group.start is not None:
        theta, d = group.start
    rig = Rig(RigConfig(slider, group.mu_c, theta, d), Faults(servo=Servo(group.lag)))
    law = PushLaw(0.05, 5.0, math.radians(-10.0))
    rows, x = [], 0.0
    for _ in range(STEPS[-1] + 1):
        noise = group.noise * rng.standard_normal()
        reading = rig.theta + noise
        if rng.random() < group.outlier:
            reading = rng.uniform(-math.pi / 2.0, math.pi / 2.0)
        v_x = (rig.finger_x - x) / PERIOD
        rows.append((reading, v_x, rig.theta, rig.d, law.phi, abs(reading - rig.theta)))
        x = rig.finger_x
        if not rig.touching or abs(rig.d) > half:
            break
        rig.step(finger_velocity(law.update(reading), BELT_SPEED), PERIOD)
    names = ('reading', 'v_x', 'theta', 'd', 'phi', 'error')
    return dict(zip(names, np.array(rows).T, strict=True)) | {'c': np.array([slider.c])}


@compiled
def advance_all(particles: np.ndarray, l: float, v_x: float) -> None:
    """Push every particle for a control period."""
    for row in particles:
        row[0], row[1] = advance(row[0], row[1], row[2], row[3], l, v_x, BELT_SPEED, PERIOD, RADIUS)


def particle_filter(group: Group, run: dict[str, np.ndarray], rng: np.random.Generator) -> Rows:
    """Follow theta, d, c^2 and alpha by particles, their kernels shrunk as by Liu and West."""
    rows, count, half = Rows(), PARTICLES, group.sizes[0] / 2.0
    alpha = np.full(count, math.pi / 2.0)
    if not group.sticks:
        alpha = rng.choice(3, count, p=(0.25, 0.5, 0.25)) * math.pi / 4.0
        some = alpha == math.pi / 4.0
        alpha[some] = rng.uniform(0.0, math.pi / 2.0, some.sum())
    theta = run['reading'][0] + group.noise * rng.standard_normal(count)
    particles = np.stack(
        [theta, rng.uniform(-half, half, count), rng.uniform(*C, count) ** 2, alpha], axis=1
    )
    for k in range(1, len(run['reading'])):
        advance_all(particles, group.sizes[1] / 2.0, run['v_x'][k])
        log_weights = -0.5 * ((run['reading'][k] - particles[:, 0]) / group.noise) ** 2
        weights = np.exp(log_weights - log_weights.max())
        weights /= weights.sum()
        chosen = np.searchsorted(
            np.cumsum(weights), (np.arange(count) + rng.random()) / count
        ).clip(max=count - 1)
        particles = particles[chosen]
        # Liu and West: towards the mean and apart again, so that mean and covariance stay.
        moving = particles[:, :3]
        mean = moving.mean(axis=0)
        deviations = moving.std(axis=0)
        spread = np.cov((moving / np.maximum(deviations, 1e-12)).T) * (1.0 - SHRINK**2)
        noise = rng.multivariate_normal(np.zeros(3), spread, count, check_valid='ignore')
        particles[:, :3] = mean + SHRINK * (moving - mean) + deviations * noise
        particles[:, 2] = particles[:, 2].clip(C[0] ** 2, C[1] ** 2)
        if k in STEPS:
            rows.add(k, *np.quantile(particles[:, 1], (0.025, 0.975)), run['d'][k])
    return rows


def trajectory(
    theta: float, d: float, c: float, l: float, v_x: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Push a sticking contact along measured velocities: theta and d at every control period."""
    out = [(theta, d)]
    for v in v_x[1:]:
        out.append(advance(*out[-1], c * c, math.pi / 2.0, l, v, BELT_SPEED, PERIOD, RADIUS))
    thetas, ds = np.array(out).T
    return thetas, ds


def cramer_rao(group: Group, run: dict[str, np.ndarray]) -> dict[int, float]:
    """Give the width that no unbiased estimate of a sticking contact's d falls below [m]."""
    truth = np.array([run['theta'][0], run['d'][0], run['c'][0]])
    rows = []
    for i, step in enumerate((1e-6, 1e-7, 1e-7)):
        ends = []
        for sign in (step, -step):
            moved = truth.copy()
            moved[i] += sign
            ends.append(trajectory(*moved, group.sizes[1] / 2.0, run['v_x']))
        rows.append([(a - b) / (2.0 * step) for a, b in zip(*ends, strict=True)])
    of_theta, of_d = (np.array([row[j] for row in rows]).T for j in (0, 1))
    prior = np.diag([0.0, 12.0 / group.sizes[0] ** 2, 12.0 / (C[1] - C[0]) ** 2])
    widths = {}
    for k in STEPS:
        if k < len(of_theta):
            seen = of_theta[: k + 1] / group.noise
            variance = of_d[k] @ np.linalg.solve(seen.T @ seen + prior, of_d[k])
            widths[k] = 2.0 * 1.96 * math.sqrt(variance)
    return widths


def by_translation(group: Group, run: dict[str, np.ndarray]) -> Rows:
    """Read off (17) over the last 25 steps, as the paper does; the edge while theta changes."""
    rows, half, l = Rows(), group.sizes[0] / 2.0, group.sizes[1] / 2.0
    for k in STEPS:
        if k >= len(run['reading']):
            continue
        last = slice(max(0, k - 24), k + 1)
        theta, beta = run['reading'][last], run['phi'][last] - run['reading'][last]
        still = k >= 25 and np.ptp(theta) <= 6.0 * group.noise
        d = -l / np.tan(beta)
        lower, upper = (d.min(), d.max()) if still else (-half, half)
        rows.add(k, max(lower, -half), min(upper, half), run['d'][k])
    return rows


def study(group: Group, count: int, seed: int) -> dict[str, Any]:
    """Make the experiments of a group."""
    ours, safe, cost, ticks = Rows(), Rows(), 0.0, 0
    others = {'particles': Rows(), 'translation (17)': Rows()}
    bounds: dict[int, list[float]] = {k: [] for k in STEPS}
    half = group.sizes[0] / 2.0
    mu_c = (math.inf, math.inf) if group.sticks else (0.0, math.inf)
    prior = Prior((-half, half), group.sizes[1] / 2.0, mu_c=mu_c, c=C)
    for number in range(count):
        rng = np.random.default_rng((seed, number))
        run = experiment(group, rng)
        estimator = ContactEstimator(prior, group.noise, outlier=max(group.outlier, 1e-3))
        within = run['error'].max() <= estimator.bounds.noise
        for k, (reading, v_x) in enumerate(zip(run['reading'], run['v_x'], strict=True)):
            start = time.process_time()
            estimate = estimator.push(reading, v_x, BELT_SPEED, PERIOD if k else 0.0)
            cost, ticks = cost + time.process_time() - start, ticks + 1
            if k in STEPS:
                ours.add(k, estimate.d.lower, estimate.d.upper, run['d'][k])
                if within:
                    safe.add(k, estimate.d.least, estimate.d.most, run['d'][k])
        pairs = [('translation (17)', by_translation(group, run))]
        if group.rivals:
            pairs.append(('particles', particle_filter(group, run, rng)))
            for k, width in cramer_rao(group, run).items():
                bounds[k].append(width)
        for name, rows in pairs:
            for k in STEPS:
                others[name].widths[k] += rows.widths[k]
                others[name].hits[k] += rows.hits[k]
    return {
        'estimator': ours.figures(),
        'guaranteed': safe.figures(),
        **{name: rows.figures() for name, rows in others.items()},
        'cramer_rao_mm': {
            str(k): 1e3 * float(np.median(width)) for k, width in bounds.items() if width
        },
        'milliseconds_a_tick': 1e3 * cost / ticks,
    }


def show(results: dict[str, Any]) -> None:
    """Print a row for every group and method."""
    table = Table('group', 'method', *(f'step {k}' for k in STEPS), 'ms/tick')
    for name, result in results.items():
        for method in ('estimator', 'guaranteed', 'particles', 'translation (17)'):
            if result[method]:
                cells = [
                    f'{one["width_mm"]:.2f} mm {100.0 * one["coverage"]:.0f} %'
                    for one in (result[method].get(str(k)) for k in STEPS)
                    if one
                ]
                cost = f'{result["milliseconds_a_tick"]:.2f}' if method == 'estimator' else ''
                row = [*cells, *[''] * (len(STEPS) - len(cells)), cost]
                table.add_row(name if method == 'estimator' else '', method, *row)
        if result['cramer_rao_mm']:
            widths = [f'{width:.2f} mm' for width in result['cramer_rao_mm'].values()]
            table.add_row('', 'Cramer-Rao', *widths)
    Console(width=None if sys.stdout.isatty() else 150).print(table)


def plot(results: dict[str, Any], file: Path) -> None:
    """Draw width against step of the first groups, the paper's method as a line."""
    from tactile_push.plots.style import TWO_COLUMNS, new_figure

    figure = new_figure(TWO_COLUMNS, 3.0)
    axes = figure.subplots()
    name, result = next(iter(results.items()))
    for method in ('estimator', 'guaranteed', 'particles', 'translation (17)'):
        if result[method]:
            steps = [int(k) for k in result[method]]
            axes.loglog(steps, [one['width_mm'] for one in result[method].values()], label=method)
    if result['cramer_rao_mm']:
        steps = [int(k) for k in result['cramer_rao_mm']]
        axes.loglog(steps, list(result['cramer_rao_mm'].values()), 'k:', label='Cramér-Rao')
    axes.set(xlabel='step', ylabel='median width for d [mm]', title=name)
    axes.legend()
    figure.savefig(file)


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--experiments', type=int, default=10000, metavar='N', help='in all')
    parser.add_argument('--seed', type=int, default=0, metavar='S')
    parser.add_argument('--json', type=Path, metavar='FILE')
    parser.add_argument('--plot', type=Path, metavar='FILE')
    arguments = parser.parse_args()
    if arguments.experiments < 1 or arguments.seed < 0:
        parser.error('--experiments: expected 1 or more, --seed: 0 or more')
    count = max(1, round(arguments.experiments / len(GROUPS)))
    results = {
        group.name: study(group, count, arguments.seed)
        for group in track(GROUPS, console=Console(stderr=True), transient=True)
    }
    show(results)
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(results, indent=1) + '\n')
    if arguments.plot is not None:
        plot(results, arguments.plot)


if __name__ == '__main__':
    main()
