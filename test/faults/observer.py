# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The observer of nodes that are killed: it asks again, and publishes what no node would."""

import contextlib
import time
from collections.abc import Callable
from typing import Any, TypeVar

from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import GetState
from rcl_interfaces.msg import Parameter, ParameterValue, SetParametersResult
from rcl_interfaces.srv import SetParameters
from rclpy.publisher import Publisher

from tactile_push.testing import Observer

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


class FaultObserver(Observer):
    """Hears topics, calls services, publishes and waits for conditions."""

    def __init__(self, domain: int, name: str = 'fault_table') -> None:
        super().__init__(domain, name)
        self._publishers: dict[str, Publisher] = {}

    def wait_for(self, condition: Callable[[], M], what: str, patience: float = PATIENCE) -> M:
        """Hear until a condition holds, and return it; it is a broken promise if it never does."""
        try:
            return super().wait_for(condition, what, patience)
        except TimeoutError as error:
            raise BrokenPromiseError(str(error)) from None

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
        """Publish a message once all subscribers hear, and return the moment [s]."""
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
        """Return the identities of a topic's publishers, those that died lately included."""
        return {bytes(i.endpoint_gid) for i in self.node.get_publishers_info_by_topic(topic)}

    def lifecycle_state(self, node: str) -> int:
        """Return the id of a managed node's state."""
        answer = self.ask(GetState, f'{node}/get_state', GetState.Request())
        return int(answer.current_state.id)

    def reach_state(self, node: str, goal: int) -> None:
        """Bring a managed node to a primary state, wherever it is."""
        while (state := self.lifecycle_state(node)) != goal:
            if not self.change_state(node, TRANSITIONS[state < goal, state]):
                raise BrokenPromiseError(f'{node} does not leave state {state}')

    def set_parameter(self, node: str, name: str, value: ParameterValue) -> SetParametersResult:
        """Set a parameter of a node and return what it says to that."""
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        return self.ask(SetParameters, f'{node}/set_parameters', request).results[0]
