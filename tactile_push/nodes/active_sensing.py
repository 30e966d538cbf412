# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Infers where on the object the finger is, and where its centre of mass lies."""

import sys
import time
from collections import Counter

from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

from tactile_push.interface import CONTROLLER_STATE, OBJECT_POSE, SENSING_MARKERS, SENSING_STATE
from tactile_push.nodes.ros.compiling import compiling
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.markers import estimate_markers
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.parameters.active_sensing import (
    ActiveSensingParameters,
    compile_sensing,
    make_sensing,
)
from tactile_push.pipeline import Sensed, Sensing
from tactile_push.pipeline.stamps import stamp_of

PATIENCE = 1.0  # without a control period for longer the node warns [s]: ten of the paper's


class ActiveSensingNode(Node):
    """Node: `push_controller/state` in, `object_pose` and `active_sensing/state` out.

    The controller's state has the reading, its age and the command of one control period together,
    so that the estimate follows from this topic alone, live and from a bag.

    The node reports an error while the readings contradict the object that the parameters describe.
    It warns as long as nothing is known.
    """

    NAME = 'active_sensing'

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, ActiveSensingParameters)
        self._counted = Counter(ticks=0, readings=0)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)
        with refusing():
            sensing = make_sensing(p)
        with compiling(self, self._diagnostics):
            compile_sensing(p)
        self._sensing = Sensing(sensing, NodeTime(self).seconds)
        self._sensed: Sensed | None = None
        self._ticked_at = 0.0  # by a clock that cannot be set [s]
        self._outputs = {
            SENSING_STATE: self.create_publisher(JointState, SENSING_STATE, PUBLISHED),
            OBJECT_POSE: self.create_publisher(PoseWithCovarianceStamped, OBJECT_POSE, PUBLISHED),
        }
        self._markers = self.create_publisher(MarkerArray, SENSING_MARKERS, PUBLISHED)
        self.create_subscription(JointState, CONTROLLER_STATE, self._on_tick, PUBLISHED)

    def _on_tick(self, message: JointState) -> None:
        try:
            sensed = self._sensing.state(stamp_of(message), message.name, message.position)
        except ValueError:
            self._counted['ticks without sense'] += 1
            return
        self._sensed, self._ticked_at = sensed, time.monotonic()
        self._counted['ticks'] += 1
        if sensed.forgot:
            self._counted[f'forgot everything: {sensed.forgot}'] += 1
        self._counted['readings'] += sensed.took
        for topic, fields in sensed.outputs():
            publish(self._outputs[topic], fields)
        if self._markers.get_subscription_count():
            estimate = sensed.estimate if sensed.known else None
            self._markers.publish(estimate_markers(estimate, self._settings, message.header.stamp))
        self._diagnostics.update()

    def _health(self) -> Health:
        sensed = self._sensed
        if sensed is None:
            return Health(WARN, 'no control periods yet')
        values = {name: f'{value:.6g}' for name, value in sensed.values.items()}
        if time.monotonic() - self._ticked_at > PATIENCE:
            return Health(WARN, 'no control periods', values)
        if sensed.estimate.contradiction:
            return Health(ERROR, f'nothing known: {sensed.estimate.contradiction}', values)
        if not sensed.values['readings']:
            return Health(WARN, 'nothing known: no contact', values)
        if sensed.blind:
            return Health(WARN, f'hardly estimating: {sensed.blind}', values)
        return Health(OK, 'estimating', values)


def main() -> int:
    """Run the node as a process."""
    return run(ActiveSensingNode)


if __name__ == '__main__':
    sys.exit(main())
