# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Active sensing on the rig in MuJoCo, through the steps that the nodes run."""

import math
import time
from dataclasses import dataclass, field, replace
from itertools import islice
from statistics import median
from typing import Any

import numpy as np
from rich.table import Table

from estimating.groups import BELT_SPEED, BLOCK, PERIOD, RADIUS, rectangle
from tactile_push import paper
from tactile_push.control import PUSHING
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.mechanics.compiled import Array
from tactile_push.parameters import (
    ActiveSensingParameters,
    MujocoPlantParameters,
    PushControllerParameters,
)
from tactile_push.parameters.active_sensing import compile_sensing, make_sensing
from tactile_push.parameters.mujoco_plant import FEET
from tactile_push.parameters.push_controller import make_control
from tactile_push.pipeline import Sensing
from tactile_push.report.merit import KNOWN
from tactile_push.simulation import Faults, RigConfig, Sensor, Servo, control_periods
from tactile_push.simulation.mujoco_model import MujocoPhysics
from tactile_push.simulation.mujoco_rig import MujocoRig

STEPS = 450
LATE = 400  # the step whose widths are shown
SLACK = 2e-5  # of the truth: a tip that is dented, an object that tilts [m]
READINGS = 5  # a control period: 50 Hz
BESIDE = (0.004, -0.002)  # of a mass off centre, from the centroid [m]
NOISE, MORE_NOISE = math.radians(0.2), math.radians(0.5)
RIG = MujocoPlantParameters()
"""Mass, height and friction of the object."""


@dataclass(frozen=True)
class Case:
    """An object, how it is pushed, and what active sensing is told."""

    name: str
    mu_c: float = 0.5
    vertices: tuple[tuple[float, float], ...] = BLOCK  # of a polygon; empty for the paper's disk
    centre: tuple[float, float] = (0.0, 0.0)  # of mass, in the same frame [m]
    corners: bool = False  # whether it rests on its corners, else on its whole area
    noise: float = NOISE
    lag: float = 0.0  # of the finger, which active sensing is told [s]
    theta: float = paper.THETA_INITIAL
    d: float = paper.D_INITIAL
    tip_turns: bool = True
    push_height: float = RIG.push_height
    steps: int = STEPS

    def rig(self) -> MujocoRig:
        """Give the rig."""
        if self.vertices:
            outline = Outline.polygon(self.vertices).about(*self.centre)
            support = Support.corners(outline) if self.corners else balanced(outline)
        else:
            outline = Outline.circle(paper.DISK_RADIUS)
            support = Support.uniform(outline, FEET)
        d = self.d if self.vertices else 0.0
        slider = Slider(outline, support.c)
        config = RigConfig(
            *(slider, self.mu_c, self.theta, d, BELT_SPEED, RADIUS), tip_turns=self.tip_turns
        )
        physics = MujocoPhysics(support, RIG.mu_s, RIG.mass, RIG.object_height, self.push_height)
        faults = Faults(servo=Servo(self.lag), sensor=Sensor(noise=self.noise))
        return MujocoRig(config, physics, faults)

    def told(self) -> ActiveSensingParameters:
        """Give what active sensing is told."""
        p = ActiveSensingParameters(noise=max(self.noise, NOISE), finger_lag=self.lag)
        if not self.vertices:
            return replace(p, vertices=[], disk_radius=paper.DISK_RADIUS)
        about = np.array(self.vertices) - np.array(self.centre)
        return replace(p, vertices=about.ravel().tolist(), edge=0)

    def controller(self) -> PushControllerParameters:
        """Give what the controller is told."""
        p = PushControllerParameters()
        return p if self.vertices else replace(p, theta_desired=0.0)


def balanced(outline: Outline) -> Support:
    """Give feet under the area whose pressure is even, or slanted so as to bear the weight."""
    even = Support.uniform(outline, FEET)
    x, y = even.points.T
    m_x, m_y, m_xx, m_xy, m_yy = even.loads @ np.stack([x, y, x * x, x * y, y * y], axis=1)
    a, b = np.linalg.solve([[m_xx, m_xy], [m_xy, m_yy]], [-m_x, -m_y])
    return Support.at_points(even.points, even.loads * (1.0 + a * x + b * y))


CASES = (
    Case('block'),
    Case('disk', vertices=()),
    Case('mu_c 1.5', mu_c=1.5),
    Case('mu_c 0.1', mu_c=0.1),
    Case('plate 8 x 4 cm', vertices=rectangle(0.08, 0.04)),
    Case('mass off centre', centre=BESIDE),
    Case('lag 0.15 s, noise 0.5°', noise=MORE_NOISE, lag=0.15),
    Case('four corners', corners=True),
)


def random_starts(count: int, mu_c: float) -> list[Case]:
    """Give the block from starts that are drawn by chance."""
    rng = np.random.default_rng(15)
    half = paper.BLOCK_EDGE / 2.0
    return [
        Case(
            f'starts, mu_c {mu_c:g}',
            mu_c=mu_c,
            theta=float(rng.uniform(-0.4, 0.4)),
            d=float(rng.uniform(-0.6, 0.6)) * half,
        )
        for _ in range(count)
    ]


@dataclass
class Told:
    """What active sensing told in one run."""

    name: str
    # Of each control period in which it knew d: step, true d, 95 % interval, guaranteed bounds [m].
    rows: list[tuple[float, ...]] = field(default_factory=list)
    periods: int = 0
    silent: int = 0  # control periods in which it contradicted
    contradictions: set[str] = field(default_factory=set)
    cost: float = 0.0  # CPU time [s]
    rig_cost: float = 0.0  # of the rig and the controller [s]


def run(case: Case, seed: int) -> Told:
    """Push an object and listen to active sensing."""
    rig, told, p = case.rig(), Told(case.name), case.told()
    compile_sensing(p)
    sensing = Sensing(make_sensing(p), lambda k, _: k * PERIOD)
    push = make_control(case.controller())
    begun = time.process_time()
    for k, tick in enumerate(islice(control_periods(rig, push, READINGS, seed), case.steps)):
        if tick.state != PUSHING:
            break
        start = time.process_time()
        sensed = sensing.tick((k, 0), tick)
        told.cost += time.process_time() - start
        told.periods += 1
        if sensed.estimate.contradiction:
            told.silent += 1
            told.contradictions.add(sensed.estimate.contradiction)
        if sensed.known and rig.touching:
            d = sensed.estimate.d
            told.rows.append((k, rig.d, d.lower, d.upper, d.least, d.most))
    told.rig_cost = time.process_time() - begun - told.cost
    return told


def cases(starts: int, push_height: float, tip_turns: bool) -> list[Case]:
    """Give all cases, with so many random starts for each friction."""
    drawn = [case for mu_c in (0.5, 0.1) for case in random_starts(starts, mu_c)]
    changed = {'push_height': push_height, 'tip_turns': tip_turns}
    return [replace(case, **changed) for case in (*CASES, *drawn)]


def figures(runs: list[Told]) -> dict[str, Any]:
    """Give the figures of the runs of one name together."""
    rows: Array = np.array([row for one in runs for row in one.rows])
    _, d, lower, upper, least, most = rows.T
    inside = (lower - SLACK <= d) & (d <= upper + SLACK)
    wrong = (upper - lower <= KNOWN) & ~inside
    late = [row for one in runs for row in one.rows if row[0] == LATE]
    periods = sum(one.periods for one in runs)
    return {
        'runs': len(runs),
        'periods': periods,
        'coverage': float(inside.mean()),
        'width_mm': 1e3 * median(row[3] - row[2] for row in late) if late else None,
        'd_mm': 1e3 * median(row[1] for row in late) if late else None,
        'known_while_wrong': float(wrong.mean()),
        'guaranteed': float(((least - SLACK <= d) & (d <= most + SLACK)).mean()),
        'runs_with_contradiction': sum(one.silent > 0 for one in runs),
        'silent': sum(one.silent for one in runs) / periods,
        'contradictions': sorted(set().union(*(one.contradictions for one in runs))),
        'milliseconds_a_tick': 1e3 * sum(one.cost for one in runs) / periods,
        'rig_share_of_a_core': sum(one.rig_cost for one in runs) / (periods * PERIOD),
    }


def show(results: dict[str, Any]) -> Table:
    """Give a row for each name of a case."""
    heads = ('coverage', 'width at 400', 'known while wrong', 'bounds held', 'contradicted in')
    table = Table('case', 'd at 400', *heads, 'ms/tick', 'core of the rig')
    for name, one in results.items():
        width, d = (
            '' if one[key] is None else f'{one[key]:.2f} mm' for key in ('width_mm', 'd_mm')
        )
        shares = (one[key] for key in ('coverage', 'known_while_wrong', 'guaranteed'))
        coverage, wrong, held = (f'{100.0 * share:.1f} %' for share in shares)
        contradicted = f'{one["runs_with_contradiction"]} of {one["runs"]}'
        costs = f'{one["milliseconds_a_tick"]:.2f}', f'{100.0 * one["rig_share_of_a_core"]:.0f} %'
        table.add_row(name, d, coverage, width, wrong, held, contradicted, *costs)
    return table
