# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well objects are placed, and whether goals are told apart in advance.

    python benchmarks/placing.py [--runs N] [--seed S] [--noise-deg X] [--lag X] [--belt M]

Each run places the paper's block, on corners, uniform, rim or a patch of 1 cm, with mu_c 0.1, 0.3,
1 or infinite, from a random start at a random goal, on the exact limit surface. A goal counts as
reachable with reserve if a plan under the true numbers spares some of every limit, and still does
after the object has translated over 30 mm of belt; as reachable at the limits if a plan within all
limits gets there. Of each kind: the shares of runs that end within 0.5, 1 and 2 mm and degrees,
errors, and belt used; with the state told to the law, and with the estimator's.
"""

import argparse
import math
import multiprocessing
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np
from rich.console import Console
from rich.table import Table

from tactile_push import paper
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Bounds, Goal, Situation, follow
from tactile_push.control.placing.reachability import (
    AT_THE_LIMITS,
    OUT_OF_REACH,
    WITH_RESERVE,
    Task,
    reach,
    with_reserve,
)
from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator, edges_of
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import Rig, RigConfig
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.placement import Placement, place, pushed_of
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

VERDICTS = (WITH_RESERVE, AT_THE_LIMITS, OUT_OF_REACH)
FRICTIONS = (0.1, 0.3, 1.0, math.inf)
WIDEST_X, WIDEST_THETA, WIDEST_D = 0.05, 0.5, 0.018  # of starts and goals [m, rad, m]
WORKSPACE = (-0.105, 0.105)  # [m]
THETA_MAX = math.radians(50.0)  # in plans
HELD = 0.03  # belt on which the object translates before a reserve is asked for [m]
L_SHARE = 0.01  # standard deviation of l and r that the estimator is told, as a share
WITHIN = (0.5, 1.0, 2.0)  # [mm] and degrees


@dataclass(frozen=True)
class Conditions:
    """What is alike in all runs."""

    noise: float  #: of a reading of theta [rad]
    lag: float  #: time constant of the finger [s]
    belt: float  #: what there is of it [m]


@dataclass(frozen=True)
class Case:
    """One start and goal."""

    config: RigConfig
    goal: Goal
    verdict: str
    shortest: float  #: belt of the plan under the true numbers [m]


def case(seed: int, conditions: Conditions) -> Case:
    """Draw a start and a goal."""
    rng = np.random.default_rng(seed)
    mu_c = float(rng.choice(FRICTIONS))
    block = Outline.rectangle(paper.BLOCK_EDGE, paper.BLOCK_DEPTH)
    supports = Support.corners, Support.uniform, Support.rim, lambda _: Support.circle(0.01)
    slider = Slider.on(block, supports[rng.integers(4)](block), exact=True)
    theta, d = rng.uniform(-WIDEST_THETA, WIDEST_THETA), rng.uniform(-WIDEST_D, WIDEST_D)
    config = RigConfig(slider, mu_c, theta, d, tip_turns=False)
    x = Rig(config).finger_pose.x
    goal = Goal(
        x + rng.uniform(-WIDEST_X, WIDEST_X), float(rng.uniform(-WIDEST_THETA, WIDEST_THETA))
    )
    steepest = 1.0 / math.tan(paper.PHI_MIN)
    half = paper.BLOCK_EDGE / 2.0
    bounds = Bounds(steepest, 2000.0, *WORKSPACE, -half, half, THETA_MAX)
    pushed = pushed_of(config)._replace(lag=conditions.lag * config.belt_speed)
    task = Task(Situation(x, theta, d, 0.0, 0.0), pushed, bounds, conditions.belt)
    told = reach(task, goal)
    verdict = told.verdict
    if verdict == WITH_RESERVE:
        ahead = -math.tan(theta + math.atan2(d, pushed.l))
        then = follow(task.now, min(max(ahead, -steepest), steepest), HELD, pushed)
        later = with_reserve(Task(then, pushed, bounds, conditions.belt - HELD))
        verdict = WITH_RESERVE if later.arrives(goal) else AT_THE_LIMITS
    return Case(config, goal, verdict, told.plan.length if told.plan else math.nan)


def run(seed: int, conditions: Conditions, told: bool) -> tuple[Case, Placement]:
    """Place one object."""
    one = case(seed, conditions)
    config = one.config
    faults = Faults(servo=Servo(time_constant=conditions.lag), sensor=Sensor(conditions.noise))
    law = PlaceLaw(
        *(one.goal, conditions.belt, config.belt_speed, paper.CONTROL_PERIOD),
        lag=conditions.lag,
        workspace=WORKSPACE,
    )
    sensing = None
    if not told:
        estimator = ObjectEstimator(
            edges_of(paper.BLOCK_CORNERS)[:1],
            conditions.noise,
            l_share=L_SHARE,
            radius=config.radius,
            radius_share=L_SHARE,
        )
        motion = FingerMotion(conditions.lag)
        sensing = ActiveSensing(estimator, motion, config.belt_speed, 0.3, radius=config.radius)
    return one, place(config, law, sensing=sensing, faults=faults, seed=seed)


def rows(name: str, results: list[tuple[Case, Placement]]) -> list[tuple[str, ...]]:
    """Return the cells of a row for each verdict."""
    cells = []
    for verdict in VERDICTS:
        some = [(one, done) for one, done in results if one.verdict == verdict]
        if not some:
            continue
        errors = np.array(
            [(1e3 * abs(p.x_error), math.degrees(abs(p.theta_error))) for _, p in some]
        )
        shares = [f'{100.0 * np.mean((errors <= w).all(axis=1)):.0f} %' for w in WITHIN]
        x, theta = (f'{np.median(e):.2f}, {np.quantile(e, 0.95):.2f}' for e in errors.T)
        belt = 1e3 * np.median([p.belt for _, p in some])
        ratios = [p.belt / one.shortest for one, p in some if one.verdict != OUT_OF_REACH]
        ratio = f'{np.median(ratios):.2f}' if ratios else ''
        cells.append((name, verdict, str(len(some)), *shares, x, theta, f'{belt:.0f}', ratio))
    return cells


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--runs', type=int, default=40, metavar='N', help='of each kind of state')
    parser.add_argument('--seed', type=int, default=0, metavar='S')
    parser.add_argument('--noise-deg', type=float, default=0.3, metavar='X')
    parser.add_argument('--lag', type=float, default=0.1, metavar='S')
    parser.add_argument('--belt', type=float, default=0.3, metavar='M')
    parser.add_argument('--processes', type=int, default=os.cpu_count(), metavar='N')
    options = parser.parse_args()
    conditions = Conditions(math.radians(options.noise_deg), options.lag, options.belt)
    within = (f'within {w:g}' for w in WITHIN)
    columns = 'state', 'goal', 'runs', *within, 'x [mm]', 'theta [°]', 'belt [mm]', 'of shortest'
    table = Table(*columns)
    seeds = range(options.seed, options.seed + options.runs)
    fork = multiprocessing.get_context('fork')
    with ProcessPoolExecutor(options.processes, fork) as pool:
        for name, told in (('told', True), ('estimated', False)):
            tasks = [pool.submit(run, seed, conditions, told) for seed in seeds]
            for cells in rows(name, [task.result() for task in tasks]):
                table.add_row(*cells)
    Console(width=None if sys.stdout.isatty() else 130).print(table)
    return 0


if __name__ == '__main__':
    sys.exit(main())
