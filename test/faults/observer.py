# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The tool's own node: it hears, calls, publishes and waits, all in one thread."""

import contextlib
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import rclpy
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import Parameter, ParameterValue, SetParametersResult
from rcl_interfaces.srv import SetParameters
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher

from tactile_push.testing.processes import loopback

from .promise import BrokenPromiseError

PATIENCE = 15.0  # a bound on hanging, not an expectation [s]
ASK_AGAIN = 1.0  # [s]
TRANSITIONS = {  # by whether to go up and the state
    (True, State.PRIMARY_STATE_UNCONFIGURED): Transition.TRANSITION_CONFIGURE,
    (True, State.PRIMARY_STATE_INACTIVE): Transition.TRANSITION_ACTIVATE,
    (False, State.PRIMARY_STATE_ACTIVE): Transition.TRANSITION_DEACTIVATE,
    (False, State.PRIMARY_STATE_INACTIVE): Transition.TRANSITION_CLEANUP,
}
M = TypeVar('M')


@dataclass(frozen=True)
class Heard(Generic[M]):
    """A message and when it arrived on the tool's steady clock [s]."""

    at: float
    message: M


class Observer:
    """Hears topics, calls services and waits for conditions.

    Parameters
    ----------
    domain : int
        ROS domain.
    name : str, optional
        Name of its node.
    """

    def __init__(self, domain: int, name: str = 'fault_table') -> None:
        os.environ.update(loopback())
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self.node = Node(name, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._clients: dict[str, Client] = {}
        self._publishers: dict[str, Publisher] = {}

    def close(self) -> None:
        """Leave the domain."""
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def hear(self, message_type: type[M], topic: str) -> list[Heard[M]]:
        """Subscribe and give the list to which the messages will be added."""
        heard: list[Heard[M]] = []
        self.node.create_subscription(
            message_type, topic, lambda m: heard.append(Heard(time.monotonic(), m)), 1000
        )
        return heard

    def spin_once(self) -> None:
        """Hear what is there, or wait a moment for it."""
        self._executor.spin_once(timeout_sec=0.02)

    def spin(self, seconds: float) -> None:
        """Hear for a while."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            self._executor.spin_once(timeout_sec=left)

    def wait_for(self, condition: Callable[[], M], what: str, patience: float = PATIENCE) -> M:
        """Hear until something is true, and give it; it is a broken promise if it never is."""
        deadline = time.monotonic() + patience
        while not (outcome := condition()):
            if time.monotonic() > deadline:
                raise BrokenPromiseError(f'waited {patience:g} s in vain for {what}')
            self.spin_once()
        return outcome

    def call(
        self, service_type: Any, service: str, request: Any, patience: float = PATIENCE
    ) -> Any:
        """Call a service and give its answer."""
        client = self._client(service_type, service)
        self.wait_for(client.service_is_ready, f'service {service}', patience)
        future = client.call_async(request)
        self.wait_for(future.done, f'an answer of {service}', patience)
        return future.result()

    def ask(self, service_type: Any, service: str, request: Any) -> Any:
        """Call a service that may be called twice, and ask again if nobody answers.

        A killed node stays in the graph for a while, so a question may go to nobody.
        """
        client = self._client(service_type, service)
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            future = client.call_async(request)
            with contextlib.suppress(BrokenPromiseError):
                self.wait_for(future.done, '', ASK_AGAIN)
                return future.result()
        raise BrokenPromiseError(f'waited {PATIENCE:g} s in vain for an answer of {service}')

    def publish(self, topic: str, message: Any) -> float:
        """Publish a message and give the moment [s]."""
        if topic not in self._publishers:
            publisher = self.node.create_publisher(type(message), topic, 10)
            self._publishers[topic] = publisher
            self.wait_for(
                lambda: publisher.get_subscription_count() == self.node.count_subscribers(topic),
                f'the subscribers of {topic}',
            )
        at = time.monotonic()
        self._publishers[topic].publish(message)
        return at

    def publishers(self, topic: str) -> set[bytes]:
        """Give the identities of a topic's publishers, those that died lately included."""
        return {bytes(i.endpoint_gid) for i in self.node.get_publishers_info_by_topic(topic)}

    def change_state(self, node: str, transition: int) -> bool:
        """Ask a managed node for a transition and say whether it was made."""
        request = ChangeState.Request(transition=Transition(id=transition))
        return bool(self.call(ChangeState, f'{node}/change_state', request).success)

    def lifecycle_state(self, node: str) -> int:
        """Give the id of a managed node's state."""
        answer = self.ask(GetState, f'{node}/get_state', GetState.Request())
        return int(answer.current_state.id)

    def reach_state(self, node: str, goal: int) -> None:
        """Bring a managed node to a primary state, wherever it is."""
        while (state := self.lifecycle_state(node)) != goal:
            if not self.change_state(node, TRANSITIONS[state < goal, state]):
                raise BrokenPromiseError(f'{node} does not leave state {state}')

    def set_parameter(self, node: str, name: str, value: ParameterValue) -> SetParametersResult:
        """Set a parameter of a node and give what it says to that."""
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        return self.ask(SetParameters, f'{node}/set_parameters', request).results[0]

    def _client(self, service_type: Any, service: str) -> Client:
        if service not in self._clients:
            self._clients[service] = self.node.create_client(service_type, service)
        return self._clients[service]
