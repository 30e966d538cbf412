# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One experiment with real nodes on simulated time, from their start to the end of the bag."""

import contextlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTACT_GEOMETRY,
    EXPERIMENT,
    FINGER_SERVO,
    JOINT_VELOCITIES,
    LIVE_PAGE,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SENTENCE,
    SIM_PLANT,
)
from tactile_push.parameters import LivePageParameters, config_file
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS
from tactile_push.testing.processes import NodeProcesses
from tactile_push.watching.listening import listen

REAL_TIME_FACTOR = 20.0  # picked; nodes that cannot keep up make the run slower, not different
SENSOR_RATE = 20.0  # two readings a control period [Hz]
START_TIMEOUT = 180.0  # longest time to the first step [s]: at their first start the nodes compile
STALL_TIMEOUT = 30.0  # longest time between two steps [s]; one takes milliseconds


class DemoError(Exception):
    """The demonstration could not be run; the message says why."""


def keep_quiet(address: str) -> None:
    """Tell nobody of a page."""


@dataclass(frozen=True)
class Experiment:
    """What nodes run with."""

    config: str  # name of the parameter file that describes the object
    more: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)  # parameters by node
    plant: str = SIM_PLANT  # the node that simulates
    sensor: str = SENTENCE  # one of `SENSOR_KINDS`


def page_port() -> int | None:
    """Return a port for the page that shows the rigs, None if there can be no page."""
    settings = LivePageParameters()
    if find_spec('aiohttp') is not None:
        for port in (settings.port, 0):
            with contextlib.suppress(OSError), listen(settings.host, port) as free:
                return int(free.getsockname()[1])
    return None


def run_experiment(
    what: Experiment, bag: Path, page: int | None, follow: Callable[[NodeProcesses], None]
) -> float:
    """Run the nodes into a bag, which replaces an earlier one, and return the time it took [s].

    `follow` waits for the end, `page` is the port of a page that shows the run.
    """
    start = time.monotonic()
    shutil.rmtree(bag, ignore_errors=True)
    config, kind = config_file(f'{what.config}.yaml'), SENSOR_KINDS[what.sensor]

    def more(node: str) -> Mapping[str, Any]:
        return what.more.get(node, {})

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
            nodes.start(what.plant, {**settings, **more(what.plant)}, config=config)
            read_from = {'device': device} if kind.node == SENSOR_DRIVER else {}
            nodes.start(kind.node, {**read_from, **kind.parameters, **simulated})
            nodes.start(CONTACT_GEOMETRY, simulated, config=config)
            waiting = {'autostart': False, **simulated, **more(PUSH_CONTROLLER)}
            nodes.start(PUSH_CONTROLLER, waiting, config=config)
            nodes.start(FINGER_SERVO, simulated, config=config)
            sensing = {**kind.sensing, **simulated, **more(ACTIVE_SENSING)}
            nodes.start(ACTIVE_SENSING, sensing, config=config)
            nodes.start(EXPERIMENT, {'bag': str(bag), **simulated, **more(EXPERIMENT)})
            if page is not None:
                nodes.start(LIVE_PAGE, {'port': page})
            follow(nodes)
    return time.monotonic() - start


def follow_experiment(
    nodes: NodeProcesses,
    progress: Callable[[int], None],
    show: Callable[[str], None] = keep_quiet,
) -> None:
    """Wait for the end of the experiment.

    `progress` is told the number of steps done, `show` the address of a page that shows the run.
    Raises a `DemoError` if a process ends early or nothing moves on.
    """
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
