# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Infers where on the object the finger is, and where its centre of mass lies."""

import sys
import time
from collections import Counter

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

from tactile_push.control import tick_of
from tactile_push.estimation import ObjectEstimate, sensing_values, tells_pose
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.estimate_markers import estimate_markers
from tactile_push.nodes.ros.messages import named_values, object_pose_message
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import ConfigurationError, declare
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.parameters.active_sensing import ActiveSensingParameters, make_sensing

PATIENCE = 1.0  # without a control period for longer it says so [s]


class ActiveSensingNode(Node):
    """Node: `push_controller/state` in, `object_pose` and `active_sensing/state` out.

    The controller's state has the reading, its age and the command of one control period together,
    so that the estimate follows from this topic alone, live and from a bag.

    Its health is an error while the readings contradict the object that the parameters describe; a
    warning as long as there is nothing to tell; well otherwise.
    """

    NAME = 'active_sensing'
    PARAMETERS = ActiveSensingParameters

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS)
        try:
            self._sensing = make_sensing(p)
        except ValueError as error:
            raise ConfigurationError(f'parameter {error}') from None
        compiled = make_sensing(p)  # what is compiled when it is first used shall be so now
        for tick in range(2):
            compiled.tick(0.1 * tick, 0.0, 0.0, 0.0)
        self._time = NodeTime(self)
        self._estimate: ObjectEstimate | None = None
        self._ticked_at = 0.0  # on the steady clock [s]
        self._counted = Counter(ticks=0, readings=0)
        self._pose = self.create_publisher(PoseWithCovarianceStamped, 'object_pose', PUBLISHED)
        self._state = self.create_publisher(JointState, 'active_sensing/state', PUBLISHED)
        self._markers = self.create_publisher(MarkerArray, 'active_sensing/markers', PUBLISHED)
        self.create_subscription(JointState, 'push_controller/state', self._on_tick, PUBLISHED)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)

    def _on_tick(self, message: JointState) -> None:
        stamp, sensing = message.header.stamp, self._sensing
        try:
            tick = tick_of(dict(zip(message.name, message.position, strict=False)))
        except ValueError:
            self._counted['ticks without sense'] += 1
            return
        now = self._time.of(stamp)
        estimate = sensing.tick(now, tick.theta, tick.silence, tick.known_velocity)
        self._estimate, self._ticked_at = estimate, time.monotonic()
        self._counted['ticks'] += 1
        if sensing.forgot:
            self._counted[f'forgot everything: {sensing.forgot}'] += 1
        self._state.publish(named_values(stamp, sensing_values(estimate, sensing)))
        self._counted['readings'] += sensing.took
        if tells_pose(estimate, sensing):
            pose = object_pose_message(estimate.pose, estimate.covariance, stamp, sensing.age)
            self._pose.publish(pose)
        if self._markers.get_subscription_count():
            self._markers.publish(self._drawn(estimate, stamp))
        self._diagnostics.update()

    def _drawn(self, estimate: ObjectEstimate, stamp: Time) -> MarkerArray:
        known = self._sensing.readings > 0 and not estimate.contradiction
        p = self._settings
        outline = None if p.disk_radius > 0.0 else np.reshape(p.vertices, (-1, 2))
        return estimate_markers(
            estimate if known else None, outline, p.disk_radius, p.finger_radius, stamp
        )

    def _health(self) -> Health:
        estimate = self._estimate
        if estimate is None:
            return Health(WARN, 'no control periods yet')
        numbers = sensing_values(estimate, self._sensing)
        values = {name: f'{value:.6g}' for name, value in numbers.items()}
        if time.monotonic() - self._ticked_at > PATIENCE:
            return Health(WARN, 'no control periods', values)
        if not self._sensing.readings:
            return Health(WARN, 'nothing known: no contact', values)
        if estimate.contradiction:
            return Health(ERROR, f'nothing known: {estimate.contradiction}', values)
        return Health(OK, 'estimating', values)


def main() -> int:
    """Run the node as a process."""
    return run(ActiveSensingNode)


if __name__ == '__main__':
    sys.exit(main())
