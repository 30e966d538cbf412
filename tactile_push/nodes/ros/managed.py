# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A lifecycle node that starts itself, survives wrong requests and leaves nothing behind."""

from collections.abc import Callable
from typing import Any

from lifecycle_msgs.srv import ChangeState
from rclpy.lifecycle import (
    LifecycleNode,
    LifecyclePublisher,
    LifecycleState,
    TransitionCallbackReturn,
)
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.ros.qos import PUBLISHED


class ManagedNode(LifecycleNode):
    """A lifecycle node that can start itself and that no request can end.

    When somebody asks rclpy for a transition that is impossible in the present state, it ends the
    process and leaves the asker without an answer.

    A subclass makes its topics in `on_configure` by `make_publisher` and `make_subscription`; they
    are removed when it is cleaned up. Whatever ends its activity calls `_stop` first.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._publishers_made: list[LifecyclePublisher] = []
        self._subscriptions_made: list[Subscription] = []
        for service in self.services:
            if service.srv_type is ChangeState:
                self._change_state = service.callback
                service.callback = self._on_change_state

    def autostart(self) -> None:
        """Configure and activate without a manager; ConfigurationError if that fails."""
        for transition in (self.trigger_configure, self.trigger_activate):
            if transition() != TransitionCallbackReturn.SUCCESS:
                raise ConfigurationError('could not start, see above')

    def make_publisher(self, message_type: type, topic: str) -> LifecyclePublisher:
        """Return a publisher that is removed when the node is cleaned up."""
        publisher = self.create_lifecycle_publisher(message_type, topic, PUBLISHED)
        self._publishers_made.append(publisher)
        return publisher

    def make_subscription(
        self, message_type: type, topic: str, callback: Callable[[Any], None], qos: QoSProfile
    ) -> None:
        """Subscribe to a topic until the node is cleaned up."""
        self._subscriptions_made.append(
            self.create_subscription(message_type, topic, callback, qos)
        )

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop."""
        self._stop()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove the topics."""
        for publisher in self._publishers_made:
            self.destroy_lifecycle_publisher(publisher)
        for subscription in self._subscriptions_made:
            self.destroy_subscription(subscription)
        self._publishers_made, self._subscriptions_made = [], []
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop for good."""
        self._stop()
        return TransitionCallbackReturn.SUCCESS

    def destroy_node(self) -> None:
        """Stop and end."""
        self._stop()
        super().destroy_node()

    def _stop(self) -> None:
        """End what the node does while it is active; nothing unless a subclass does something."""

    def _on_change_state(
        self, request: ChangeState.Request, response: ChangeState.Response
    ) -> ChangeState.Response:
        try:
            return self._change_state(request, response)
        except RuntimeError as error:  # rclpy's RCLError, which is not public
            self.get_logger().warning(f'refused a transition: {error}')
            response.success = False
            return response
