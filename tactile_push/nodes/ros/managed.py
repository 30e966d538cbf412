# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A lifecycle node that starts itself and survives wrong requests."""

from lifecycle_msgs.srv import ChangeState
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

from tactile_push.nodes.ros.parameters import ConfigurationError


class ManagedNode(LifecycleNode):
    """A lifecycle node that can start itself and that no request can end.

    When somebody asks rclpy for a transition that is impossible in the present state, it ends the
    process and leaves the asker without an answer.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        for service in self.services:
            if service.srv_type is ChangeState:
                self._change_state = service.callback
                service.callback = self._on_change_state

    def autostart(self) -> None:
        """Configure and activate without a manager; ConfigurationError if that fails."""
        for transition in (self.trigger_configure, self.trigger_activate):
            if transition() != TransitionCallbackReturn.SUCCESS:
                raise ConfigurationError('could not start, see above')

    def _on_change_state(
        self, request: ChangeState.Request, response: ChangeState.Response
    ) -> ChangeState.Response:
        try:
            return self._change_state(request, response)
        except RuntimeError as error:  # rclpy's RCLError, which is not public
            self.get_logger().warning(f'refused a transition: {error}')
            response.success = False
            return response
