# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the real nodes on simulated time through one episode after the other."""

import math
import os
import random
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from faults.observer import FaultObserver
from faults.parameter_rows import value_of
from faults.promise import BrokenPromiseError
from tactile_push.control import HELD, PUSHING, STATES, STOP_REASONS, STOPPED
from tactile_push.testing import NodeProcesses, field, seconds

from .episodes import DESIRED, Episode, episodes, next_desired
from .report import Report

CONFIG = Path(__file__).resolve().parents[2] / 'config' / 'block.yaml'
PLANT = {
    # One reading a control period: every reading costs the time of its way through three nodes.
    'sensor_rate': 10.0,
    'publish_clock': True,
    'real_time_factor': 100.0,
    'mu_c': 0.5,
    # For so long time waits for a node of which the machine has no time to think.
    'command_timeout': 5.0,
}
STALLED = 30.0  # without a tick for so long the run is over [s of wall time]
COMPILED = 300.0  # the same before the first tick: the nodes may compile first
LOOK = 36.0  # between looks at the memory [s of simulated time]
BAND = math.radians(3.0)
AFTERMATH = 1.0  # after a fault, before what follows is no longer put down to it [s]
SETTLED = 20  # ticks within it
PATIENCE = 120.0  # for the object to settle after a fault [s of simulated time]


class Soak:
    """One run.

    Parameters
    ----------
    hours : float
        Simulated time [h].
    seed : int
        Of the faults.
    progress : callable, optional
        Told the simulated time that has passed [h].
    """

    def __init__(
        self, hours: float, seed: int, progress: Callable[[float], None] = lambda hours: None
    ) -> None:
        self.report = Report(seed)
        self._end = 3600.0 * hours
        self._draw = random.Random(seed)
        self._progress = progress
        self._desired = -DESIRED
        self._state: JointState | None = None
        self._start = math.nan
        self._before = 0.0  # simulated time of the plants before this one [s]
        self._plants = 0
        self._heard_at = time.monotonic()
        self._faulty_until = -math.inf
        self._settled = 0
        self._next_look = 0.0

    def run(self) -> Report:
        """Run the nodes until the time is over or something breaks.

        Returns
        -------
        Report
            What was measured, up to there.
        """
        with (
            tempfile.TemporaryDirectory(prefix='tactile_push_soak_') as folder,
            NodeProcesses(Path(folder)) as self._nodes,
        ):
            self._observer = FaultObserver(self._nodes.domain, 'soak')
            try:
                self._start_nodes(f'{folder}/sensor')
                begin = time.monotonic()
                for episode in episodes(self._draw):
                    if self._now >= self._end:
                        break
                    self.report.outcomes.append((episode.fault, self._outcome(episode)))
                self.report.hours = self._now / 3600.0
                self.report.real_time_factor = self._now / (time.monotonic() - begin)
            except BrokenPromiseError as error:
                self.report.broken.append(str(error))
            finally:
                self._observer.close()
        return self.report

    @property
    def _now(self) -> float:
        """Simulated time since the first tick, of all plants together [s]."""
        if self._state is None:
            return self._before
        return self._before + seconds(self._state) - self._start

    def _start_nodes(self, device: str) -> None:
        simulated = {'use_sim_time': True}
        self._observer.node.create_subscription(
            JointState, '/push_controller/state', self._on_state, 100
        )
        self._device = device
        self._start_plant()
        self._nodes.start('sensor_driver', {'device': device, **simulated})
        self._nodes.start('contact_geometry', simulated, config=CONFIG)
        self._nodes.start('push_controller', simulated, config=CONFIG)
        self._wait(lambda: self._state is not None)

    def _start_plant(self) -> None:
        self._plants += 1
        parameters = {'device': self._device, **PLANT}
        self._nodes.start('sim_plant', parameters, config=CONFIG)

    def _on_state(self, state: JointState) -> None:
        """Count what a tick tells."""
        report, before = self.report, self._state
        self._heard_at = time.monotonic()
        stamp = seconds(state)
        if before is None:
            self._start = stamp
        elif stamp < seconds(before):  # the time of another plant
            self._before = self._now
            self._start = stamp
        self._state = state
        if before is None:
            return
        lost = round(field(state, 'ticks_lost') - field(before, 'ticks_lost'))
        if self._now <= self._faulty_until:
            report.ticks_lost_in_faults += lost
        else:
            report.ticks_lost += lost
        report.ticks += 1
        pushing = STATES[int(field(state, 'state'))] == PUSHING
        near = abs(field(state, 'theta') - self._desired) < BAND
        self._settled = self._settled + 1 if pushing and near else 0
        if self._now >= self._next_look:
            self._next_look += LOOK
            self._look_at_memory()

    def _look_at_memory(self) -> None:
        for name, process in self._nodes.running.items():
            memory = resident_megabytes(process.pid)
            key = f'{name} {self._plants}' if name == 'sim_plant' else name
            self.report.memory.setdefault(key, []).append((self._now / 3600.0, memory))
        self._progress(self._now / 3600.0)

    def _outcome(self, episode: Episode) -> str:
        """Go through an episode and say what became of the object."""
        assert self._state is not None
        self._turn(next_desired(self._desired, field(self._state, 'finger_x')))
        self._wait_until(self._now + episode.before)
        self._faulty_until = math.inf
        self._set('sim_plant', episode.fault, episode.value)
        self._wait_until(self._now + episode.duration)
        self._set('sim_plant', episode.fault, episode.default)
        self._faulty_until = self._now + AFTERMATH
        self._settled = 0
        deadline = self._now + PATIENCE
        self._wait(lambda: self._settled >= SETTLED or self._rests or self._now > deadline)
        if self._settled >= SETTLED:
            return 'settled'
        if not self._rests:
            return f'not settled, theta = {math.degrees(field(self._state, "theta")):.1f} degrees'
        reason = self._reason
        self._go_on(reason)
        return f'stopped: {reason}'

    @property
    def _rests(self) -> bool:
        """Whether the controller has rested for longer than a fault goes on to be felt."""
        assert self._state is not None
        rests = STATES[int(field(self._state, 'state'))] == STOPPED
        return rests and self._now > self._faulty_until

    def _go_on(self, reason: str) -> None:
        """Do what a person would do about a stop."""
        if reason not in HELD:  # the object is lost, or the finger at its end: put both back
            plant = self._nodes.running['sim_plant']
            plant.send_signal(signal.SIGINT)
            plant.wait()
            self._start_plant()
            self._wait(lambda: self._reason in HELD)  # the new plant's time begins anew
        self._observer.call(Trigger, '/push_controller/resume', Trigger.Request())
        self._wait(lambda: not self._reason)
        self._faulty_until = self._now + AFTERMATH

    @property
    def _reason(self) -> str:
        """Why the controller has stopped, if it has."""
        assert self._state is not None
        return STOP_REASONS[int(field(self._state, 'stop_reason'))]

    def _turn(self, desired: float) -> None:
        self._desired = desired
        self._set('push_controller', 'theta_desired', desired)

    def _set(self, node: str, name: str, value: float | bool) -> None:
        answer = self._observer.set_parameter(f'/{node}', name, value_of(value))
        if not answer.successful:
            raise BrokenPromiseError(f'{node}: {name} = {value} was refused: {answer.reason}')

    def _wait_until(self, moment: float) -> None:
        self._wait(lambda: self._now >= moment)

    def _wait(self, condition: Callable[[], bool]) -> None:
        while not condition():
            self._observer.spin_once()
            for name, process in self._nodes.running.items():
                if process.poll() is not None:
                    raise BrokenPromiseError(f'{name} ended with status {process.returncode}')
            patience = COMPILED if self._state is None else STALLED
            if time.monotonic() - self._heard_at > patience:
                raise BrokenPromiseError(f'no tick for {patience:g} s after {self._now:.1f} s')


def resident_megabytes(pid: int) -> float:
    """Return the memory that a process holds.

    Parameters
    ----------
    pid : int
        The process.

    Returns
    -------
    float
        Resident set size [MB].
    """
    pages = int(Path(f'/proc/{pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE') / 1e6
