# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration: both rigs of the paper, as real nodes against a simulated plant."""

import contextlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from tactile_push.bags import BagReader
from tactile_push.control import PUSHING, STATES
from tactile_push.figures import plot_history
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    EXPERIMENT,
    FINGER_SERVO,
    JOINT_VELOCITIES,
    LIVE_PAGE,
    PUSH_CONTROLLER,
    SENSING_STATE,
    SENSOR_DRIVER,
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
from tactile_push.parameters import LivePageParameters, config_file
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS
from tactile_push.report.columns import Column, read_tables, topics_of
from tactile_push.report.merit import PushFigures, known_step, push_figures
from tactile_push.testing.processes import NodeProcesses
from tactile_push.watching.listening import listen

STEPS = 450  # the paper's figures 9 and 10 settle by step 173 and translate from step 400 on
REAL_TIME_FACTOR = 20.0  # picked; nodes that cannot keep up make the run slower, not different
SENSOR_RATE = 20.0  # two readings a control period [Hz]
START_TIMEOUT = 180.0  # longest time to the first step [s]: at their first start the nodes compile
STALL_TIMEOUT = 30.0  # longest time between two steps [s]; one takes milliseconds
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


class DemoError(Exception):
    """The demonstration could not be run; the message says why."""


def _keep_quiet(address: str) -> None:
    pass


def run_demo(
    out: Path,
    progress: Callable[[str, int], None],
    plant: str = SIM_PLANT,
    sensor: str = SENTENCE,
    show: Callable[[str], None] = _keep_quiet,
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
    page = _page_port()
    for name, paper in RIGS.items():
        follow = partial(_follow, progress=partial(progress, name), show=show)
        wall_seconds = _run_rig(plant, sensor, name, out / name, page, follow)
        show = _keep_quiet  # the page of the next rig has the same address
        results[name], theta, phi = _evaluate(paper, out / name, wall_seconds)
        settled = results[name].push.settle_step
        panels[TITLES[name]] = theta, phi, paper.theta_desired, paper.band, settled
    plot_history(panels, [out / 'history.png'])
    return results


def _page_port() -> int | None:
    """Return a port for the page that shows the rigs, None if there can be no page."""
    settings = LivePageParameters()
    if find_spec('aiohttp') is not None:
        for port in (settings.port, 0):
            with contextlib.suppress(OSError), listen(settings.host, port) as free:
                return int(free.getsockname()[1])
    return None


def _run_rig(
    plant: str,
    sensor: str,
    name: str,
    bag: Path,
    page: int | None,
    follow: Callable[[NodeProcesses], None],
) -> float:
    """Run one rig into a bag and return the time that it took [s]."""
    start = time.monotonic()
    shutil.rmtree(bag, ignore_errors=True)
    config, kind = config_file(f'{name}.yaml'), SENSOR_KINDS[sensor]
    with tempfile.TemporaryDirectory(prefix='tactile_push_') as folder:
        device = os.path.join(folder, 'sensor')
        settings = {
            'device': device,
            'sensor_rate': SENSOR_RATE,
            'publish_clock': True,
            'real_time_factor': REAL_TIME_FACTOR,
            'commands': JOINT_VELOCITIES,
            **kind.plant,
        }
        simulated = {'use_sim_time': True}
        with NodeProcesses(Path(folder)) as nodes:
            nodes.start(plant, settings, config=config)
            read_from = {'device': device} if kind.node == SENSOR_DRIVER else {}
            nodes.start(kind.node, {**read_from, **kind.parameters, **simulated})
            nodes.start(CONTACT_GEOMETRY, simulated, config=config)
            nodes.start(PUSH_CONTROLLER, {'autostart': False, **simulated}, config=config)
            nodes.start(FINGER_SERVO, simulated, config=config)
            nodes.start(ACTIVE_SENSING, {**kind.sensing, **simulated}, config=config)
            nodes.start(EXPERIMENT, {'bag': str(bag), 'steps': STEPS, **simulated})
            if page is not None:
                nodes.start(LIVE_PAGE, {'port': page})
            follow(nodes)
    return time.monotonic() - start


def _follow(
    nodes: NodeProcesses,
    progress: Callable[[int], None],
    show: Callable[[str], None] = _keep_quiet,
) -> None:
    """Wait for the end of the experiment."""
    experiment = nodes.running[EXPERIMENT]
    address = ''
    steps = 0
    moved = time.monotonic()
    while experiment.poll() is None:
        time.sleep(0.05)
        numbers = [line for line in nodes.log(EXPERIMENT).read_text().split() if line.isdigit()]
        if numbers and int(numbers[-1]) != steps:
            steps = int(numbers[-1])
            moved = time.monotonic()
            progress(steps)
        if LIVE_PAGE in nodes.running and not address:
            said = nodes.log(LIVE_PAGE).read_text().split()
            address = next((word for word in said if word.startswith('http:')), '')
            if address:
                show(address)
        for name, process in nodes.running.items():
            if name != LIVE_PAGE and process.poll() not in (None, 0):
                last_words = nodes.log(name).read_text().strip().splitlines()[-1:]
                raise DemoError(f'{name} ended: {"".join(last_words) or "without a word"}')
        waited = time.monotonic() - moved
        if not steps and waited > START_TIMEOUT:
            raise DemoError(f'no step within {START_TIMEOUT:g} s, in which the nodes also compile')
        if steps and waited > STALL_TIMEOUT:
            raise DemoError(f'no progress for {STALL_TIMEOUT:g} s after step {steps}')


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
