# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node in the test's own process: it hears, calls and waits, all in one thread."""

import os
import time
from collections.abc import Callable
from typing import Any, TypeVar

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.srv import SetParameters
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import get_default_context

from tactile_push.testing.processes import loopback

PATIENCE = 60.0  # a bound on hanging, not an expectation [s]
TURN = 0.02  # of the executor, before a condition is looked at again [s]
M = TypeVar('M')


class Heard(list[M]):
    """Messages in the order in which they arrived."""

    def __init__(self) -> None:
        super().__init__()
        self.times: list[float] = []  # when each arrived, by `time.monotonic` [s]

    def append(self, message: M) -> None:
        """Add a message that arrives now."""
        self.times.append(time.monotonic())
        super().append(message)

    def timed(self, first: int = 0) -> list[tuple[float, M]]:
        """Return (time, message) of each from number `first` on, from the end if negative."""
        return list(zip(self.times[first:], self[first:], strict=True))

    def since(self, at: float) -> list[M]:
        """Return the messages that arrived after a moment on the steady clock [s]."""
        return [message for message, time in zip(self, self.times, strict=True) if time > at]


class Observer:
    """Hears topics, calls services and waits for conditions.

    It joins the domain with rclpy's default context if that is free. A node that a test makes
    afterwards in the usual way, without a context, is then in the same domain; `add` lets it run.

    Parameters
    ----------
    domain : int
        ROS domain.
    name : str, optional
        Name of its `node`.
    """

    def __init__(self, domain: int, name: str = 'observer') -> None:
        os.environ.update(loopback())
        self._is_default = not get_default_context().ok()
        self._context = get_default_context() if self._is_default else Context()
        rclpy.init(
            context=self._context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO
        )
        self.node = Node(name, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._added: list[Node] = []
        self._clients: dict[str, Client] = {}

    def __enter__(self) -> 'Observer':
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Destroy the nodes and leave the domain."""
        self._executor.shutdown()
        for node in (*self._added, self.node):
            node.destroy_node()
        rclpy.shutdown(context=None if self._is_default else self._context)

    def add(self, node: Node) -> None:
        """Run another node in this process: its callbacks are called while this observer waits.

        Parameters
        ----------
        node : rclpy.node.Node
            A node in the observer's context; it is destroyed with the observer.
        """
        if node.context is not self._context:
            raise ValueError(
                f'node {node.get_name()}: expected a node made after the observer, in its context'
            )
        self._added.append(node)
        self._executor.add_node(node)

    def hear(self, message_type: type[M], topic: str) -> Heard[M]:
        """Subscribe to a topic.

        Parameters
        ----------
        message_type, topic : type, str
            Type of the messages and name of the topic.

        Returns
        -------
        Heard
            A list to which every message is added as it arrives.
        """
        heard: Heard[M] = Heard()
        self.node.create_subscription(message_type, topic, heard.append, 1000)
        return heard

    def spin_once(self) -> None:
        """Hear what is there, or wait a moment for it."""
        self._executor.spin_once(timeout_sec=TURN)

    def spin(self, seconds: float) -> None:
        """Hear for a while.

        Parameters
        ----------
        seconds : float
            For how long [s of wall time].
        """
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            self._executor.spin_once(timeout_sec=left)

    def wait_for(self, condition: Callable[[], M], what: str, patience: float = PATIENCE) -> M:
        """Hear until a condition holds; TimeoutError if it never does.

        Parameters
        ----------
        condition : callable
            Looked at again after every message.
        what : str
            What is waited for, for the error's message.
        patience : float, optional
            How long to wait at the most [s].

        Returns
        -------
        object
            The first value of the condition that is true.
        """
        deadline = time.monotonic() + patience
        while not (outcome := condition()):
            if time.monotonic() > deadline:
                raise TimeoutError(f'waited {patience:g} s in vain for {what}')
            self.spin_once()
        return outcome

    def call(
        self, service_type: Any, service: str, request: Any, patience: float = PATIENCE
    ) -> Any:
        """Call a service once it is there.

        Parameters
        ----------
        service_type, service, request : type, str, object
            Type and name of the service, and what to ask.
        patience : float, optional
            How long to wait at the most [s].

        Returns
        -------
        object
            The response.
        """
        client = self._client(service_type, service)
        self.wait_for(client.service_is_ready, f'service {service}', patience)
        future = client.call_async(request)
        self.wait_for(future.done, f'an answer of {service}', patience)
        return future.result()

    def change_state(self, node: str, transition: int) -> bool:
        """Ask a managed node for a transition.

        Parameters
        ----------
        node, transition : str, int
            Name of the node, and a constant of lifecycle_msgs/Transition.

        Returns
        -------
        bool
            Whether the node made it.
        """
        request = ChangeState.Request(transition=Transition(id=transition))
        return bool(self.call(ChangeState, f'{node}/change_state', request).success)

    def set_parameters(self, node: str, **values: Any) -> list[Any]:
        """Set parameters of a node.

        Parameters
        ----------
        node : str
            Name of the node.
        **values : object
            New values by name.

        Returns
        -------
        list of SetParametersResult
            The node's answer to each.
        """
        parameters = [Parameter(n, value=v).to_parameter_msg() for n, v in values.items()]
        request = SetParameters.Request(parameters=parameters)
        return list(self.call(SetParameters, f'{node}/set_parameters', request).results)

    def _client(self, service_type: Any, service: str) -> Client:
        if service not in self._clients:
            self._clients[service] = self.node.create_client(service_type, service)
        return self._clients[service]


def field(message: Any, name: str) -> float:
    """Return a position of a JointState by its name; ValueError if it has no such name.

    Parameters
    ----------
    message, name : sensor_msgs.msg.JointState, str
        The message and the name.

    Returns
    -------
    float
        The position.
    """
    return float(message.position[list(message.name).index(name)])


def seconds(message: Any) -> float:
    """Return the stamp of a message as a number.

    Parameters
    ----------
    message : object
        A message with a header.

    Returns
    -------
    float
        Its stamp [s].
    """
    stamp = message.header.stamp
    return float(stamp.sec + stamp.nanosec * 1e-9)
