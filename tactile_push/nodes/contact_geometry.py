# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Turns the sensor's angles and the finger's joint angles into the contact."""

import sys
import time
from collections import Counter

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState

from tactile_push.interface import CONTACT, GEOMETRY_STATE, JOINT_STATES, TACTILE
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED, SENSOR_DATA
from tactile_push.parameters.contact_geometry import (
    ContactGeometryParameters,
    make_finder,
    take_values,
)
from tactile_push.pipeline import Geometry
from tactile_push.pipeline.stamps import stamp_of

PATIENCE = 0.5  # without a useful reading before it is an error [s]: the finger has stopped by then
# Counts that are no fault. A finger in the air is none. A message that came twice does no harm; on
# simulated time, which stands still now and then, that is common.
NO_FAULT = {
    'readings',
    'contacts',
    'joint states',
    'joint states of other joints',
    'rejected: no contact',
    'rejected: not newer',
}
FOR_JOINTS = ('no joint state', 'stale joint state')  # refusals


class ContactGeometry(Node):
    """Node: `tactile` and `joint_states` in, `contact` out.

    While somebody subscribes, `contact_geometry/state` says what became of each reading.

    The node reports an error when no reading came for `PATIENCE`, or when it refused all readings
    of that time for a fault. It warns before the first reading, while it refuses some readings for
    a fault, and while joint states are of no use. A finger that touches nothing is well.
    """

    NAME = 'contact_geometry'

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, ContactGeometryParameters, self._take_parameters)
        with refusing():
            self._finder = make_finder(p)
        self._time = NodeTime(self)
        self._geometry = Geometry(self._finder, p.joint_names, self._time.seconds)
        self._counted = Counter(readings=0, contacts=0)
        self._stamp = float('nan')  # of the last reading [s]
        # When the last reading came, and the last useful one, by a clock that cannot be set [s].
        self._heard = self._useful = time.monotonic()
        self._feels = ''  # what the last useful reading said
        self._refusal = ''  # why the last refused reading was refused
        self._contact = self.create_publisher(PoseStamped, CONTACT, PUBLISHED)
        self._state = self.create_publisher(JointState, GEOMETRY_STATE, PUBLISHED)
        if p.use_joint_states:
            # Before the readings: the executor serves what has arrived in this order.
            self.create_subscription(JointState, JOINT_STATES, self._on_joint_states, SENSOR_DATA)
        self.create_subscription(JointState, TACTILE, self._on_tactile, SENSOR_DATA)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)

    def _take_parameters(self, settings: ContactGeometryParameters) -> None:
        self._settings = settings
        take_values(self._finder, settings)

    def _on_joint_states(self, message: JointState) -> None:
        stamp = stamp_of(message)
        self._counted[self._geometry.joint_states(stamp, message.name, message.position)] += 1

    def _on_tactile(self, message: JointState) -> None:
        self._counted['readings'] += 1
        now = time.monotonic()
        if now - self._heard > PATIENCE:
            self._useful = now  # after a silence patience starts over
        self._heard = now
        stamp = stamp_of(message)
        self._stamp = self._time.seconds(*stamp)
        felt = self._geometry.tactile(stamp, message.name, message.position)
        if felt.contact is None:
            self._refuse(felt.refusal)
        else:
            self._useful = now
            self._feels = 'contact'
            self._counted['contacts'] += 1
        for topic, fields in felt.outputs():
            if topic == CONTACT:
                publish(self._contact, fields)
            elif self._state.get_subscription_count():
                publish(self._state, fields)

    def _refuse(self, reason: str) -> None:
        self._counted[f'rejected: {reason}'] += 1
        if reason == 'no contact':
            self._useful = self._heard
            self._feels = reason
        else:
            self._refusal = reason

    def _health(self) -> Health:
        values = {'age of the last reading [s]': f'{self._time.now() - self._stamp:.3f}'}
        if self._finder.pole is not None:
            values['age of the joint state used [s]'] = f'{self._finder.pole.age:.4f}'
        if not self._counted['readings']:
            return Health(WARN, 'no readings yet', values)
        if time.monotonic() - self._heard > PATIENCE:
            return Health(ERROR, 'no readings', values)
        if self._heard - self._useful > PATIENCE:
            trouble = self._geometry.joints.trouble if self._refusal in FOR_JOINTS else ''
            why = f': {trouble}' if trouble else ''
            return Health(ERROR, f'readings refused: {self._refusal}{why}', values)
        if not self._feels:
            return Health(WARN, 'no contact yet', values)
        rates = self._diagnostics.rates
        if any(rates[name] for name in self._counted.keys() - NO_FAULT):
            return Health(WARN, f'{self._feels}, some refused', values)
        return Health(OK, self._feels, values)


def main() -> int:
    """Run the node as a process."""
    return run(ContactGeometry)


if __name__ == '__main__':
    sys.exit(main())
