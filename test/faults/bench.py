# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What one or more rows need: fingers with their nodes, an observer, a clock, and watches."""

import os
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rclpy.clock import Clock as NodeClock
from rclpy.clock_type import ClockType
from rosgraph_msgs.msg import Clock

from tactile_push.nodes.ros.diagnostics import ERROR
from tactile_push.testing import NodeProcesses

from .checks import Watch
from .finger import Finger
from .observer import FaultObserver
from .promise import BrokenPromiseError, Setup

TICK = 0.01  # of the tool's own clock [s]
SETTLE = 0.1  # what was published at the same time is heard within it [s]


class OwnClock:
    """Publishes /clock, which goes like the steady one until it is told to jump.

    Parameters
    ----------
    observer : FaultObserver
        Its node does it.
    """

    def __init__(self, observer: FaultObserver) -> None:
        self._offset = 1000.0 - time.monotonic()
        self._publisher = observer.node.create_publisher(Clock, '/clock', 10)
        observer.node.create_timer(
            TICK, self._publish, clock=NodeClock(clock_type=ClockType.STEADY_TIME)
        )

    def jump(self, seconds: float) -> float:
        """Put the clock ahead or back and give the moment on the steady clock [s]."""
        self._offset += seconds
        at = time.monotonic()
        self._publish()
        return at

    def _publish(self) -> None:
        now = round((self._offset + time.monotonic()) * 1e9)
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(now, 1_000_000_000)
        self._publisher.publish(message)


class Bench:
    """Nodes, alone in their ROS domain, and what is measured with them.

    Parameters
    ----------
    setup : Setup
        What is to run.

    Attributes
    ----------
    nodes : NodeProcesses
        The processes.
    observer : FaultObserver
        The tool's own node.
    fingers : list of Finger
        The fingers that the setup asks for, running and with an active controller.
    clock : OwnClock or None
        The clock, if the setup asks for it.
    reaction : float or None
        What the present row has measured: from the fault to v_x = 0 [s].
    """

    def __init__(self, setup: Setup) -> None:
        self.setup = setup
        self.reaction: float | None = None
        self._folder = tempfile.TemporaryDirectory(prefix='tactile_push_faults_')
        self.nodes = NodeProcesses(Path(self._folder.name))
        self.observer = FaultObserver(self.nodes.domain)
        self.clock = OwnClock(self.observer) if setup.own_clock else None
        self.fingers = [
            Finger(namespace, setup, self.nodes, self.observer) for namespace in setup.fingers
        ]
        self._watches = [Watch(finger, aged=not setup.own_clock) for finger in self.fingers]

    @property
    def finger(self) -> Finger:
        """The only finger, or the one that gets the fault."""
        return self.fingers[0]

    def start(self) -> None:
        """Start all nodes and the belt."""
        for finger in self.fingers:
            for node in finger.chain:
                finger.begin(node)
        for finger in self.fingers:
            finger.activate()

    def is_in_the_middle(self) -> bool:
        """Return whether all objects lie so that the fingers can go on for long."""
        return all(finger.is_in_the_middle() for finger in self.fingers)

    def stopped(self, since: float, patience: float = 3.0, **how: Any) -> None:
        """Measure how long it takes until the finger stands, see `Finger.stopped`."""
        self.reaction = self.finger.stopped(since, patience, **how)

    def complaints(self) -> list[str]:
        """Return what was heard since the last time and must not be, whatever the fault."""
        self.observer.spin(SETTLE)
        found = [complaint for watch in self._watches for complaint in watch.complaints()]
        found += self._tracebacks()
        for name, process in self.nodes.running.items():
            if process.poll() is not None:
                found.append(f'{name} ended with status {process.returncode}')
        return found

    def close(self) -> list[str]:
        """End everything and give what was wrong with the end."""
        for finger in self.fingers:
            finger.close()
        for process in self.nodes.running.values():
            process.send_signal(signal.SIGCONT)
        self.nodes.stop()
        self.observer.close()
        found = [
            f'{name}: exit status {process.returncode}'
            for name, process in self.nodes.running.items()
            if process.returncode != 0
        ]
        found += self._tracebacks()
        self._folder.cleanup()
        return found

    def _tracebacks(self) -> list[str]:
        """Return what each log with a traceback ends with, and empty it."""
        found = []
        for log in sorted(Path(self._folder.name).glob('*.log')):
            said = log.read_text(errors='replace')
            if 'Traceback' in said:
                place, what = [*said.split('\n  File ')[-1].splitlines()[:1], said.splitlines()[-1]]
                found.append(f'traceback in {log.name}: {place}: {what}')
                os.truncate(log, 0)
        return found


def expect(condition: bool, otherwise: str) -> None:
    """Raise `BrokenPromiseError` unless something is true."""
    if not condition:
        raise BrokenPromiseError(otherwise)


def spoiled_until_stopped(
    bench: Bench, sensor: str, words: str, alter: Callable[[Any], Any]
) -> None:
    """Spoil what a sensor measures until the finger has stopped and its node said why; mend it."""
    finger = bench.finger
    finger.relay.alter = alter
    bench.stopped(time.monotonic())
    finger.expect_reason('contact silent')
    finger.expect_level(sensor, ERROR)
    said = finger.status(sensor).message
    expect(words in said, said)
    finger.relay.mend()
    finger.wait_until_moving(10.0)
