# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the managed nodes have in common."""

from lifecycle_msgs.srv import ChangeState
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

from tactile_push.nodes.ros.parameters import ConfigurationError


class ManagedNode(LifecycleNode):
    """A lifecycle node that can start itself and that no request can end.

    rclpy lets a transition that is not possible in the present state end the process, and the
    asker without an answer.

    Parameters
    ----------
    name : str
        Name of the node.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        for service in self.services:
            if service.srv_type is ChangeState:
                self._change_state = service.callback
                service.callback = self._on_change_state

    def autostart(self) -> None:
        """Configure and activate without a lifecycle manager.

        Raises
        ------
        ConfigurationError
            If one of the transitions fails; the node has logged why.
        """
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
