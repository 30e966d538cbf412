# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration: both rigs of the paper, as real nodes against the simulated plant."""

import math
import os
import shutil
import tempfile
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import numpy as np

from tactile_push.bags.states import read_states
from tactile_push.control import PUSHING, STATES, settle_step
from tactile_push.estimation import contact_of_translation
from tactile_push.figures import plot_history
from tactile_push.parameters import config_file
from tactile_push.report.known import known_step
from tactile_push.testing.processes import NodeProcesses

STEPS = 450
TRANSLATING = 400  # the step from which the paper reads off its ranges
REAL_TIME_FACTOR = 20.0
SENSOR_RATE = 20.0  # two readings a control period [Hz]
STALL_TIMEOUT = 30.0  # without a step for so long the demonstration has failed [s]


@dataclass(frozen=True)
class RigCase:
    """One of the paper's two rigs.

    Parameters
    ----------
    name : str
        Name of the rig and of its parameter file.
    title : str
        Name for people.
    theta_desired : float
        Desired angle of the edge [rad].
    band : float
        How near to it counts as settled [rad].
    l : float
        Distance from the edge or tangent to the centre of mass [m].
    paper : dict of str to str
        The paper's figures, for the table.
    """

    name: str
    title: str
    theta_desired: float
    band: float
    l: float
    paper: dict[str, str]


CASES = (
    RigCase(
        'block',
        r'block, $\theta_d$ = −10°',
        math.radians(-10.0),
        math.radians(3.0),
        0.02375,
        {
            'settled': '173',
            'theta': '-10.4 to -8.9',
            'phi': '80.2 to 85.8',
            'd': '0.3 to 2.1',
            'known': '400',
        },
    ),
    RigCase(
        'disk',
        r'disk, $\theta_d$ = 0°',
        0.0,
        math.radians(1.0),
        0.0285,
        {'settled': '110', 'theta': '', 'phi': '', 'd': ''},
    ),
)


@dataclass(frozen=True)
class RigResult:
    """What came out for one rig; SI units.

    Parameters
    ----------
    settle_step : int or None
        Step after which |theta - theta_d| stays within the rig's band.
    theta_final, phi_final : float
        Last angles [rad].
    d_final : float
        True contact at the end [m].
    d_lower, d_upper : float
        Bounds on d by (17), from all steps from `TRANSLATING` on [m].
    known_step : int or None
        Step from which on active sensing knows d to 2 mm; of the disk, d of which is 0 by its
        roundness, the first one that it heard of.
    theta_range, phi_range : tuple of float
        Least and greatest angle from step `TRANSLATING` on [rad].
    ticks_lost : int
        Control periods without a tick.
    wall_seconds : float
        Duration of the run, processes started and stopped [s].
    """

    settle_step: int | None
    theta_final: float
    phi_final: float
    d_final: float
    d_lower: float
    d_upper: float
    known_step: int | None
    theta_range: tuple[float, float]
    phi_range: tuple[float, float]
    ticks_lost: int
    wall_seconds: float


class DemoError(Exception):
    """The demonstration could not be run; the message says why."""


def run_demo(out: Path, progress: Callable[[str, int], None]) -> dict[str, RigResult]:
    """Run both rigs, record them and draw their history.

    Parameters
    ----------
    out : path
        Folder for the bags NAME/ and the picture history.png; what an earlier demonstration left
        there is replaced.
    progress : callable
        Told the rig's name and the number of steps done.

    Returns
    -------
    dict of str to RigResult
        The results by rig.

    Raises
    ------
    DemoError
        If a process ends early or nothing moves on.
    OSError
        If the folder cannot be written.
    """
    out.mkdir(parents=True, exist_ok=True)
    results = {}
    panels = {}
    for case in CASES:
        wall_seconds = _run_rig(case, out / case.name, partial(progress, case.name))
        steps, ticks_lost = _law_history(out / case.name)
        result = _evaluate(case, out / case.name, steps, ticks_lost, wall_seconds)
        results[case.name] = result
        history = steps['theta'], steps['phi'], case.theta_desired, case.band, result.settle_step
        panels[case.title] = history
    plot_history(panels, [out / 'history.png'])
    return results


def as_json(results: dict[str, RigResult]) -> dict[str, dict[str, dict[str, object]]]:
    """Give the results as one object of plain values, SI units."""
    return {'rigs': {name: asdict(result) for name, result in results.items()}}


def _run_rig(case: RigCase, bag: Path, progress: Callable[[int], None]) -> float:
    """Run one rig into a bag and give the time that it took [s]."""
    start = time.monotonic()
    shutil.rmtree(bag, ignore_errors=True)
    config = config_file(f'{case.name}.yaml')
    with tempfile.TemporaryDirectory(prefix='tactile_push_') as folder:
        device = os.path.join(folder, 'sensor')
        plant = {
            'device': device,
            'sensor_rate': SENSOR_RATE,
            'publish_clock': True,
            'real_time_factor': REAL_TIME_FACTOR,
        }
        simulated = {'use_sim_time': True}
        with NodeProcesses(Path(folder)) as nodes:
            nodes.start('sim_plant', plant, config=config)
            nodes.start('sensor_driver', {'device': device, **simulated})
            nodes.start('contact_geometry', simulated, config=config)
            nodes.start('push_controller', {'autostart': False, **simulated}, config=config)
            nodes.start('active_sensing', simulated, config=config)
            nodes.start('experiment', {'bag': str(bag), 'steps': STEPS, **simulated})
            _follow(nodes, progress)
    return time.monotonic() - start


def _follow(nodes: NodeProcesses, progress: Callable[[int], None]) -> None:
    """Wait for the end of the experiment."""
    experiment = nodes.running['experiment']
    steps = 0
    moved = time.monotonic()
    while experiment.poll() is None:
        time.sleep(0.05)
        numbers = [line for line in nodes.log('experiment').read_text().split() if line.isdigit()]
        if numbers and int(numbers[-1]) != steps:
            steps = int(numbers[-1])
            moved = time.monotonic()
            progress(steps)
        for name, process in nodes.running.items():
            if process.poll() not in (None, 0):
                last_words = nodes.log(name).read_text().strip().splitlines()[-1:]
                raise DemoError(f'{name} ended: {"".join(last_words) or "without a word"}')
        if time.monotonic() - moved > STALL_TIMEOUT:
            raise DemoError(f'no progress for {STALL_TIMEOUT:.0f} s after step {steps}')


def _law_history(bag: Path) -> tuple[dict[str, np.ndarray], int]:
    state = read_states(bag, '/push_controller/state')
    pushing = state['state'] == STATES.index(PUSHING)
    steps = {name: values[pushing] for name, values in state.items()}
    return steps, int(state['ticks_lost'][-1])


def _evaluate(
    case: RigCase,
    bag: Path,
    steps: dict[str, np.ndarray],
    ticks_lost: int,
    wall_seconds: float,
) -> RigResult:
    theta, phi = steps['theta'], steps['phi']
    sensed = read_states(bag, '/active_sensing/state')
    bounds = [
        contact_of_translation(theta_k, phi_k, case.l)
        for theta_k, phi_k in zip(theta[TRANSLATING:], phi[TRANSLATING:], strict=True)
    ]
    return RigResult(
        settle_step=settle_step(theta, case.theta_desired, case.band),
        theta_final=float(theta[-1]),
        phi_final=float(phi[-1]),
        d_final=float(read_states(bag, '/ground_truth/state')['d'][-1]),
        d_lower=min(bounds),
        d_upper=max(bounds),
        known_step=known_step(
            steps['stamp'], sensed['stamp'], sensed['d_upper'] - sensed['d_lower']
        ),
        theta_range=(float(theta[TRANSLATING:].min()), float(theta[TRANSLATING:].max())),
        phi_range=(float(phi[TRANSLATING:].min()), float(phi[TRANSLATING:].max())),
        ticks_lost=ticks_lost,
        wall_seconds=wall_seconds,
    )
