# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The one process that feeds chains of nodes with numbered readings and hears their last hops."""

import math
import random
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import cycle
from pathlib import Path
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

from tactile_push.testing import NodeProcesses, Observer

PATIENCE = 60.0  # [s]; a bound on hanging, not an expectation
BARE_NODES = Path(__file__).with_name('bare_nodes.py')
# Reading number k says elevation FIRST - k STEP, in degrees and in the last digit of the wire:
# every reading is told from its neighbours, and no filter takes the change for a jump.
FIRST, STEP = 70.0, 1e-4


class Heard(NamedTuple):
    """A message as it came: when by the steady clock, when by the system's clock, and its bytes."""

    at: float
    wall: float
    data: bytes


class Device:
    """A sensor on TCP that sends numbered readings.

    Attributes
    ----------
    sent : list of float
        When each reading was written [s], by its number.
    """

    def __init__(self) -> None:
        self._listener = socket.create_server(('127.0.0.1', 0))
        self._listener.settimeout(PATIENCE)
        self.address = f'127.0.0.1:{self._listener.getsockname()[1]}'
        self.sent: list[float] = []

    def accept(self) -> None:
        """Wait for the driver."""
        self._line, _ = self._listener.accept()
        self._line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def send(self) -> None:
        """Send the next reading and remember when."""
        number = len(self.sent)
        body = f'PTACT,{number % 65536},A,0.0000,{FIRST - STEP * number:.4f},1.500'.encode()
        sum_ = 0
        for byte in body:
            sum_ ^= byte
        line = b'$%s*%02X\r\n' % (body, sum_)
        self.sent.append(time.monotonic())
        self._line.sendall(line)

    def close(self) -> None:
        """Hang up."""
        self._line.close()
        self._listener.close()


class Probe(Observer):
    """An observer that keeps messages as bytes, to be read once nothing is measured any more."""

    def hear(self, message_type: type, topic: str) -> list[Heard]:
        """Subscribe and return the list that grows with the messages."""
        heard: list[Heard] = []

        def take(data: bytes) -> None:
            heard.append(Heard(time.monotonic(), time.time(), data))

        self.node.create_subscription(message_type, topic, take, 1000, raw=True)
        return heard


class Chain:
    """The package's nodes, or the bare ones, in a namespace of their own."""

    def __init__(self, nodes: NodeProcesses, probe: Probe, bare: bool) -> None:
        self.bare = bare
        self.namespace = 'bare' if bare else 'ours'
        self._nodes = nodes
        self._probe = probe
        self._joints = probe.node.create_publisher(
            JointState, f'/{self.namespace}/joint_states', 10
        )

    def start(self, node: str, **parameters: Any) -> None:
        """Start a node; `device` is given as host:port."""
        if self.bare:
            command = [sys.executable, str(BARE_NODES), node, '--ros-args']
            for key, value in {'__ns': f'/{self.namespace}', **parameters}.items():
                command += ['-r' if key == '__ns' else '-p', f'{key}:={value}']
            self._nodes.run(f'bare_{node}', command)
            return
        if 'device' in parameters:
            parameters['device'] = f'socket://{parameters["device"]}'
        self._nodes.start(node, parameters, arguments=('-r', f'__ns:=/{self.namespace}'))

    def pid(self, node: str) -> int:
        """Give the process of a node."""
        return self._nodes.running[f'bare_{node}' if self.bare else node].pid

    def hear(self, message_type: type, topic: str) -> list[Heard]:
        """Subscribe to one of the chain's topics."""
        return self._probe.hear(message_type, f'/{self.namespace}/{topic}')

    def start_on_device(self, **controller: Any) -> None:
        """Start driver, geometry and controller on a device that the probe feeds."""
        self.device = Device()
        self.start('sensor_driver', device=self.device.address)
        self.start('contact_geometry')
        self.start('push_controller', **controller)
        self.device.accept()

    def send_joint_states(self) -> None:
        """Say that the finger points straight ahead."""
        message = JointState(name=['proximal_joint', 'distal_joint'], position=[0.0, 0.0])
        message.header.stamp = self._probe.node.get_clock().now().to_msg()
        self._joints.publish(message)

    def send(self) -> None:
        """Send joint states and the next reading, in the order in which sim_plant does."""
        self.send_joint_states()
        self.device.send()

    def number(self, message: Any) -> int | None:
        """Give the number of the reading that a message tells of, None if it tells of none."""
        if isinstance(message, PoseStamped):
            orientation = message.pose.orientation
            yaw = 2.0 * math.atan2(orientation.z, orientation.w)
            elevation = message.pose.position.x if self.bare else 90.0 - math.degrees(yaw)
        elif 'elevation' in message.name:
            value = message.position[message.name.index('elevation')]
            elevation = value if self.bare else math.degrees(value)
        else:
            value = message.position[message.name.index('theta')]
            elevation = value if self.bare else 90.0 - math.degrees(value)
        return None if math.isnan(elevation) else round((FIRST - elevation) / STEP)

    def interfaces(self) -> set[tuple[str, str, str]]:
        """List what the nodes offer and take: kind, name without namespace, type."""
        node = self._probe.node
        found = set()
        for name, namespace in node.get_node_names_and_namespaces():
            if namespace != f'/{self.namespace}':
                continue
            for kind, ask in (
                ('publisher', node.get_publisher_names_and_types_by_node),
                ('subscription', node.get_subscriber_names_and_types_by_node),
                ('service', node.get_service_names_and_types_by_node),
            ):
                for topic, types in ask(name, namespace):
                    found |= {
                        (name, kind, topic.removeprefix(f'{namespace}/'), type_) for type_ in types
                    }
        return found


@contextmanager
def chains(folder: Path) -> Iterator[tuple[Probe, Chain, Chain]]:
    """Give a probe, the package's chain and the bare one; stop everything in the end."""
    with NodeProcesses(folder) as nodes, Probe(nodes.domain, 'probe') as probe:
        yield probe, Chain(nodes, probe, bare=False), Chain(nodes, probe, bare=True)


@contextmanager
def feed(sends: Sequence[Callable[[], None]], rate: float, jitter: float = 0.0) -> Iterator[None]:
    """Call functions by turns at even distances, from a thread of their own.

    Parameters
    ----------
    sends : sequence of callable
        What to call.
    rate : float
        How often to call each [1/s].
    jitter : float
        How much later a call may come by chance, as a share of the distance of calls.
    """
    stopping = threading.Event()

    def run() -> None:
        chance = random.Random(1)
        distance = 1.0 / rate / len(sends)
        start = time.monotonic()
        for turn, send in enumerate(cycle(sends)):
            due = start + distance * (turn + jitter * chance.random())
            if stopping.wait(max(0.0, due - time.monotonic())):
                return
            send()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield
    finally:
        stopping.set()
        thread.join()
