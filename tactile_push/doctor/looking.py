# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Looks at a running graph: what is there, what it says for a while, and what it answers."""

import math
import os
import time
from array import array
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from typing import Any, TypeVar

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import GetState
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from tactile_push.doctor.snapshot import Endpoint, Heard, Snapshot
from tactile_push.interface import (
    CLOCK,
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    DIAGNOSTICS,
    JOINT_STATES,
    NODES,
    OBJECT_POSE,
    SERVO_STATE,
    TACTILE,
    TOPICS,
)
from tactile_push.pipeline.named import by_name
from tactile_push.recording.parameter_notes import ParameterNotes

LISTENED = (TACTILE, JOINT_STATES, CONTACT, COMMAND, CONTROLLER_STATE, SERVO_STATE, OBJECT_POSE)
DISCOVERY = 2.0  # in which nodes find each other, usually within 1 s [s]
LISTENING = 3.0  # for so long the doctor listens [s]; each node reports its health once a second
PATIENCE = 3.0  # for answers that did not come meanwhile [s]
STALE = 0.3  # in which readings from before a touch are heard and forgotten [s]
TOUCHED = 1.0  # for so long the doctor listens to a touch [s]
TURN = 0.05  # between looks at who has answered [s]
ASK_AGAIN = 1.0  # after which a missing answer is lost [s]
ANYTHING = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
NAME = 'doctor'
T = TypeVar('T')


def look(namespace: str = '') -> Snapshot:
    """Look at a finger's part of the running graph for 5 s, 8 s if a node does not answer.

    Parameters
    ----------
    namespace : str, optional
        Namespace of the finger, '' for the root.

    Returns
    -------
    Snapshot
        What was seen.
    """
    with _joined(namespace) as (node, executor):
        return _Look(node, executor).snapshot()


@contextmanager
def hearing_readings(
    namespace: str = '',
) -> Iterator[Callable[[], list[tuple[float, float]]]]:
    """Listen to a sensor whenever somebody has touched it.

    Parameters
    ----------
    namespace : str, optional
        Namespace of the finger, '' for the root.

    Yields
    ------
    callable
        Listens for a second, and returns azimuth and elevation of each reading in it [rad].
    """
    with _joined(namespace) as (node, executor):
        azimuth, elevation = TOPICS[TACTILE].field_names[:2]
        listener = _Listener(node, TACTILE, _Time(node).now)

        def spin(seconds: float) -> None:
            end = time.monotonic() + seconds
            while time.monotonic() < end:
                executor.spin_once(timeout_sec=TURN)

        def hear() -> list[tuple[float, float]]:
            spin(STALE)
            listener.begin()
            spin(TOUCHED)
            heard = listener.heard(TOUCHED)
            return [(v.get(azimuth, math.nan), v.get(elevation, math.nan)) for v in heard.values]

        spin(DISCOVERY)
        yield hear


@contextmanager
def _joined(namespace: str) -> Iterator[tuple[Node, SingleThreadedExecutor]]:
    """Take part in the graph by a node that publishes nothing."""
    context = Context()
    rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
    node = Node(
        f'{NAME}_{os.getpid()}',
        context=context,
        namespace=namespace,
        enable_rosout=False,
        start_parameter_services=False,
    )
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield node, executor
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.shutdown(context=context)


class _Time:
    """The time of the nodes: the simulated one if somebody publishes it.

    The node's own clock would begin to listen to it when the doctor already has to know it.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._simulated = 0
        node.create_subscription(Clock, CLOCK, self._on_clock, ANYTHING)

    def now(self) -> int:
        """Return the time [ns]."""
        simulated = self._simulated or self._node.count_publishers(CLOCK)
        return self._simulated if simulated else time.time_ns()

    def _on_clock(self, message: Clock) -> None:
        self._simulated = message.clock.sec * 10**9 + message.clock.nanosec


class _Listener:
    """What is heard of one topic."""

    def __init__(self, node: Node, topic: str, now: Callable[[], int]) -> None:
        self._now = now
        self.begin()
        package, _, name = TOPICS[topic].type_name.split('/')
        kind = getattr(import_module(f'{package}.msg'), name)
        node.create_subscription(kind, topic, self._hear, ANYTHING)

    def begin(self) -> None:
        """Forget what was heard so far."""
        self._count = 0
        self._ages: list[float] = []
        self._frames: set[str] = set()
        self._values: list[dict[str, float]] = []

    def _hear(self, message: Any) -> None:
        stamp = message.header.stamp
        self._count += 1
        self._ages.append(1e-9 * (self._now() - stamp.sec * 10**9 - stamp.nanosec))
        self._frames.add(message.header.frame_id)
        if isinstance(message, JointState):
            self._values.append(by_name(message.name, message.position))

    def heard(self, seconds: float) -> Heard:
        """Return what was heard, which took so long."""
        ages, frames, values = tuple(self._ages), frozenset(self._frames), tuple(self._values)
        return Heard(self._count, seconds, ages, frames, values)


class _Look:
    """One look at the graph, through a node in the finger's namespace."""

    def __init__(self, node: Node, executor: SingleThreadedExecutor) -> None:
        self._node = node
        self._executor = executor
        self._own = node.get_namespace()
        self._health: dict[str, tuple[int, str]] = {}
        self._parameters: dict[str, dict[str, Any]] = {}
        self._states: dict[str, str] = {}
        self._asked: dict[str, tuple[Client, float]] = {}

    def snapshot(self) -> Snapshot:
        """Look and listen."""
        node = self._node
        node.create_subscription(DiagnosticArray, DIAGNOSTICS, self._on_health, ANYTHING)
        now = _Time(node).now
        listeners = {topic: _Listener(node, topic, now) for topic in LISTENED}
        ParameterNotes(node, self._on_parameters)
        self._spin(DISCOVERY)
        for listener in listeners.values():
            listener.begin()
        begin = now()
        self._spin(LISTENING)
        seconds = 1e-9 * (now() - begin)
        heard = {topic: listener.heard(seconds) for topic, listener in listeners.items()}
        self._spin(PATIENCE, self._all_have_answered)
        return Snapshot(
            nodes=tuple(self._nodes()),
            states=_in_order(self._states),
            publishers=self._endpoints(node.get_publishers_info_by_topic),
            subscriptions=self._endpoints(node.get_subscriptions_info_by_topic),
            heard=heard,
            parameters=_in_order(self._parameters),
            health=_in_order(self._health),
        )

    def _spin(self, seconds: float, until: Callable[[], bool] = lambda: False) -> None:
        """Hear for so long, or until something holds, and ask nodes for their states meanwhile."""
        end = asked = time.monotonic()
        end += seconds
        while (now := time.monotonic()) < end and not until():
            if now >= asked:
                self._ask_for_states()
                asked = now + TURN
            # With another timeout each time the executor would begin anew with what comes first
            # and never get to the answers.
            self._executor.spin_once(timeout_sec=TURN)

    def _ask_for_states(self) -> None:
        """Ask each managed node that has not answered, again if its answer was lost."""
        for name in self._nodes():
            if not NODES[name].managed or name in self._states:
                continue
            if name not in self._asked:
                client = self._node.create_client(GetState, f'{name}/get_state')
                self._asked[name] = client, -math.inf
            client, at = self._asked[name]
            if client.service_is_ready() and time.monotonic() - at > ASK_AGAIN:
                future = client.call_async(GetState.Request())
                future.add_done_callback(partial(self._on_state, name))
                self._asked[name] = client, time.monotonic()

    def _all_have_answered(self) -> bool:
        return all(
            node in self._parameters and (node in self._states or not NODES[node].managed)
            for node in self._nodes()
        )

    def _on_state(self, node: str, future: Future) -> None:
        self._states[node] = future.result().current_state.label

    def _on_parameters(self, parameters: dict[str, dict[str, Any]]) -> None:
        for full_name, values in parameters.items():
            own, _, name = f'/{full_name}'.rpartition('/')
            if (own or '/') == self._own:
                self._parameters[name] = {
                    key: list(value) if isinstance(value, array) else value
                    for key, value in values.items()
                }

    def _on_health(self, message: DiagnosticArray) -> None:
        for status in message.status:
            own, _, name = status.name.rpartition('/')
            if name in NODES and f'/{own}' == self._own:
                level = int.from_bytes(status.level, 'little')
                found = [value.key for value in status.values if level and value.value == 'True']
                self._health[name] = level, ', '.join([status.message, *found])

    def _nodes(self) -> Iterator[str]:
        for name, namespace in self._node.get_node_names_and_namespaces():
            if namespace == self._own and name in NODES:
                yield name

    def _endpoints(
        self, infos: Callable[[str], list[TopicEndpointInfo]]
    ) -> dict[str, tuple[Endpoint, ...]]:
        found = {}
        for topic in TOPICS:
            ends = map(self._endpoint, infos(self._node.resolve_topic_name(topic)))
            found[topic] = tuple(end for end in ends if not _is_hidden(end.node))
        return {topic: ends for topic, ends in found.items() if ends}

    def _endpoint(self, info: TopicEndpointInfo) -> Endpoint:
        qos, namespace = info.qos_profile, info.node_namespace
        place = '' if namespace == self._own else f'{namespace.rstrip("/")}/'
        return Endpoint(
            place + info.node_name,
            info.topic_type,
            qos.reliability != ReliabilityPolicy.BEST_EFFORT,
            qos.durability == DurabilityPolicy.TRANSIENT_LOCAL,
        )


def _in_order(by_node: Mapping[str, T]) -> dict[str, T]:
    """Return what nodes answered in an order that does not depend on who was first."""
    return {node: by_node[node] for node in NODES if node in by_node}


def _is_hidden(node: str) -> bool:
    """Return whether it is a doctor, or a node that tools such as `ros2 topic` hide."""
    return node.rpartition('/')[2].startswith((f'{NAME}_', '_'))
