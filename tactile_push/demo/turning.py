# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Both rigs of the paper turn their objects."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from tactile_push.bags import BagReader
from tactile_push.control import PUSHING, STATES
from tactile_push.demo.running import (
    Experiment,
    follow_experiment,
    keep_quiet,
    page_port,
    run_experiment,
)
from tactile_push.figures import plot_history
from tactile_push.interface import (
    CONTROLLER_STATE,
    EXPERIMENT,
    SENSING_STATE,
    SENTENCE,
    SIM_PLANT,
    TRUE_STATE,
)
from tactile_push.paper import (
    BLOCK,
    BLOCK_L,
    DISK,
    DISK_RADIUS,
    FINGER_RADIUS,
    PAPER,
    PaperFigures,
)
from tactile_push.report.columns import Column, read_tables, topics_of
from tactile_push.report.merit import PushFigures, known_step, push_figures

STEPS = 450  # the paper's figures 9 and 10 settle by step 173 and translate from step 400 on
RIGS = {paper.object: paper for paper in PAPER}  # also names of the parameter files
TITLES = {BLOCK: r'block, $\theta_d$ = −10°', DISK: r'disk, $\theta_d$ = 0°'}
DISTANCES = {BLOCK: BLOCK_L, DISK: DISK_RADIUS}  # from edge or tangent to the centre of mass [m]


@dataclass(frozen=True)
class RigResult:
    """What came out for one rig; SI units."""

    push: PushFigures
    theta_final: float  # [rad]
    phi_final: float  # [rad]
    d_final: float  # true contact at the end [m]
    known_step: int | None  # from which active sensing knows d to 2 mm; of a disk the first one
    wall_seconds: float  # from the start of the processes to their end [s]

    def as_json(self) -> dict[str, Any]:
        """Return the result as plain values, SI units."""
        push = self.push
        d_lower, d_upper = push.d_range or (None, None)
        return {
            'settle_step': push.settle_step,
            'theta_final': self.theta_final,
            'phi_final': self.phi_final,
            'd_final': self.d_final,
            'd_lower': d_lower,
            'd_upper': d_upper,
            'known_step': self.known_step,
            'theta_range': push.theta_range,
            'phi_range': push.phi_range,
            'ticks_lost': push.ticks_lost,
            'wall_seconds': self.wall_seconds,
        }


def run_demo(
    out: Path,
    progress: Callable[[str, int], None],
    plant: str = SIM_PLANT,
    sensor: str = SENTENCE,
    show: Callable[[str], None] = keep_quiet,
) -> dict[str, RigResult]:
    """Run both rigs, record them, draw their history and return the results by rig.

    The bags NAME/ and the picture history.png go to the folder `out` and replace those of an
    earlier demonstration. `progress` is told the rig's name and the number of steps done. `plant`
    is the node that simulates, `sensor` one of `SENSOR_KINDS`. `show` is told the address of a page
    that shows the rigs, if there is one: the demonstration needs none. Raises a `DemoError` if a
    process ends early or nothing moves on, and an OSError if the folder cannot be written.
    """
    out.mkdir(parents=True, exist_ok=True)
    results = {}
    panels = {}
    page = page_port()
    for name, paper in RIGS.items():
        follow = partial(follow_experiment, progress=partial(progress, name), show=show)
        what = Experiment(name, {EXPERIMENT: {'steps': STEPS}}, plant, sensor)
        wall_seconds = run_experiment(what, out / name, page, follow)
        show = keep_quiet  # the page of the next rig has the same address
        results[name], theta, phi = _evaluate(paper, out / name, wall_seconds)
        settled = results[name].push.settle_step
        panels[TITLES[name]] = theta, phi, paper.theta_desired, paper.band, settled
    plot_history(panels, [out / 'history.png'])
    return results


def _evaluate(
    paper: PaperFigures, bag: Path, wall_seconds: float
) -> tuple[RigResult, Column, Column]:
    """Return the result of a rig, and theta and phi of its steps [rad].

    Theta is the true one: a sensor with noise feels an object that is settled turn to and fro.
    """
    with BagReader(bag) as reader:
        tables, _ = read_tables(reader, topics_of(reader, ''))
    truth, sensed = tables[TRUE_STATE], tables[SENSING_STATE]
    states = dict(tables[CONTROLLER_STATE])
    latest = np.searchsorted(truth['time'], states['time'], side='right') - 1
    states['theta'] = truth['theta'][np.maximum(latest, 0)]
    pushing = states['state'] == STATES.index(PUSHING)
    theta, phi = states['theta'][pushing], states['phi'][pushing]
    widths = sensed['d_upper'] - sensed['d_lower']
    result = RigResult(
        push=push_figures(
            *(states, paper.band, DISTANCES[paper.object], paper.object, FINGER_RADIUS)
        ),
        theta_final=float(theta[-1]),
        phi_final=float(phi[-1]),
        d_final=float(truth['d'][-1]),
        known_step=known_step(states['time'][pushing], sensed['time'], widths),
        wall_seconds=wall_seconds,
    )
    return result, theta, phi
