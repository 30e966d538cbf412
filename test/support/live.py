# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Real nodes as processes, and an observer in the test's own process."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import JointState

from tactile_push.testing.processes import NodeProcesses

CONFIG = Path(__file__).resolve().parents[2] / 'config'
PATIENCE = 60.0  # [s]; a bound on hanging, not an expectation


class Observer:
    """Subscribes, calls services and waits for conditions."""

    def __init__(self, domain: int) -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self.node = Node('observer', context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)

    def close(self) -> None:
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def collect(self, message_type: type, topic: str) -> list[Any]:
        """Subscribe and give the list that the messages will be appended to."""
        messages: list[Any] = []
        self.node.create_subscription(message_type, topic, messages.append, 1000)
        return messages

    def wait_for(self, condition: Callable[[], Any], what: str, patience: float = PATIENCE) -> Any:
        deadline = time.monotonic() + patience
        while not (outcome := condition()):
            assert time.monotonic() < deadline, f'waited {patience} s in vain: {what}'
            self._executor.spin_once(timeout_sec=0.05)
        return outcome

    def call(self, service_type: type, service: str, request: Any) -> Any:
        client = self.node.create_client(service_type, service)
        self.wait_for(client.service_is_ready, f'service {service}')
        future = client.call_async(request)
        self.wait_for(future.done, f'answer of {service}')
        self.node.destroy_client(client)
        return future.result()

    def change_state(self, node: str, transition: int) -> bool:
        request = ChangeState.Request(transition=Transition(id=transition))
        return self.call(ChangeState, f'{node}/change_state', request).success


class Rig:
    """The whole loop on simulated time, and what it says."""

    def __init__(self, nodes: NodeProcesses, observer: Observer, device: str) -> None:
        self.nodes = nodes
        self.observer = observer
        self._device = device
        self.contacts = observer.collect(PoseStamped, 'contact')
        self.commands = observer.collect(TwistStamped, 'finger/cmd_vel')
        self.states = observer.collect(JointState, 'push_controller/state')
        self.truth = observer.collect(JointState, 'ground_truth/state')

    def start(self, config: str = 'block', **plant: Any) -> None:
        """Start all nodes; the law begins with the first push of the finger."""
        file = CONFIG / f'{config}.yaml'
        simulated = {'use_sim_time': True}
        timing = {'sensor_rate': 20.0, 'publish_clock': True, 'real_time_factor': 10.0}
        self.nodes.start('sim_plant', {'device': self._device, **timing, **plant}, config=file)
        self.start_driver()
        self.nodes.start('contact_geometry', simulated, config=file)
        self.nodes.start('push_controller', {'autostart': False, **simulated}, config=file)
        observer = self.observer
        assert observer.change_state('push_controller', Transition.TRANSITION_CONFIGURE)
        hearing = {'contact': 3, 'finger/cmd_vel': 4, 'push_controller/state': 1}
        observer.wait_for(
            lambda: (
                self.contacts
                and self.truth
                and all(observer.node.count_subscribers(t) >= n for t, n in hearing.items())
            ),
            'all nodes to hear each other',
        )
        assert observer.change_state('push_controller', Transition.TRANSITION_ACTIVATE)

    def start_driver(self) -> None:
        self.nodes.start('sensor_driver', {'device': self._device, 'use_sim_time': True})

    def wait_until_moving(self) -> None:
        """Wait until the finger has moved for a while."""
        seen = len(self.truth)
        self.observer.wait_for(
            lambda: sum(abs(field(m, 'v_x')) > 1e-4 for m in self.truth[seen:]) > 10,
            'the finger to move',
        )

    def wait_until_resting(self) -> None:
        """Wait until the plant's finger has no velocity."""
        seen = len(self.truth)
        self.observer.wait_for(
            lambda: self.truth[seen:] and field(self.truth[-1], 'v_x') == 0.0,
            'the finger to stop',
        )


def field(message: JointState, name: str) -> float:
    return message.position[list(message.name).index(name)]


def seconds(message: Any) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
