# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Turns the sensor's angles and the finger's joint angles into the contact."""

import sys
import time
from collections import Counter

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from tactile_push.nodes.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.node_time import NodeTime
from tactile_push.nodes.parameters import ConfigurationError, Parameter, declare
from tactile_push.nodes.process import run
from tactile_push.tactile import (
    JUMP_TOLERANCE,
    MAX_THETA_RATE,
    ContactFinder,
    Reading,
    ReadingRejectedError,
    quaternion_of_yaw,
)

SENSOR_DATA = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
PATIENCE = 0.5  # without a reading, or without one that is of use, before it is an error [s]
NO_CONTACT = 'no contact'
# What is counted and no reason to worry. A finger in the air is no fault. What came twice did no
# harm; on simulated time, which stands still now and then, it is common.
NO_FAULT = {
    'readings',
    'contacts',
    'joint states',
    'joint states of other joints',
    f'rejected: {NO_CONTACT}',
    'rejected: not newer',
}


class ContactGeometry(Node):
    """Node: `tactile` and `joint_states` in, `contact` out.

    Its health is an error when no more readings come for `PATIENCE`, or when all that came in that
    time were refused for a fault; a warning before the first one, while some are refused for a
    fault, or joint states are of no use; well otherwise, a finger that touches nothing included.
    """

    NAME = 'contact_geometry'
    PARAMETERS = (
        Parameter('finger_radius', 0.0135, 'm', "effective radius of the finger's disk", 1e-4, 1.0),
        Parameter(
            'use_joint_states',
            True,
            '',
            'take the direction of the finger tip from joint_states; otherwise it is mount_angle',
            read_only=True,
        ),
        Parameter(
            'mount_angle',
            1.5707963267948966,
            'rad',
            'angle of the finger tip in finger_base at joint angles zero',
            -6.3,
            6.3,
        ),
        Parameter(
            'joint_names',
            ['proximal_joint', 'distal_joint'],
            '',
            'the moving joints in joint_states whose angles add up to the direction of the tip',
            read_only=True,
        ),
        Parameter(
            'joint_state_timeout',
            0.1,
            's',
            'largest time between a reading and the joint state used for it',
            0.001,
            10.0,
        ),
        Parameter(
            'max_out_of_plane',
            0.2,
            '',
            'largest size of cos(elevation) sin(azimuth), by which the direction of a contact '
            'sticks out of the plane of motion',
            0.001,
            1.0,
        ),
        Parameter(
            'detectable_range',
            1.5707963267948966,
            'rad',
            'largest angle between the pole and a contact that the sensor detects properly; pi/2 '
            'is the whole hemisphere',
            0.01,
            1.6,
        ),
        Parameter(
            'max_theta_rate',
            MAX_THETA_RATE,
            'rad/s',
            'how fast theta can turn; it grows with the speed of the belt',
            0.01,
            1000.0,
        ),
        Parameter(
            'jump_tolerance',
            JUMP_TOLERANCE,
            'rad',
            'how far two readings of the same theta may differ; pi refuses no jump',
            0.001,
            3.2,
        ),
    )

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS, self._take_parameters)
        if p.use_joint_states and not p.joint_names:
            raise ConfigurationError('parameter joint_names: expected the name of a joint, got []')
        self._finder = ContactFinder(
            p.finger_radius,
            joint_state_timeout=p.joint_state_timeout if p.use_joint_states else None,
        )
        self._take_parameters()
        self._time = NodeTime(self)
        self._counted = Counter(readings=0, contacts=0)
        self._stamp = float('nan')  # of the last reading [s]
        self._heard = self._useful = time.monotonic()  # when the last reading, the last useful came
        self._feels = ''  # what the last useful reading said
        self._refusal = ''  # why the last refused one was refused
        self._pose = PoseStamped()
        self._pose.header.frame_id = 'finger_disk'
        self._publisher = self.create_publisher(PoseStamped, 'contact', 10)
        if p.use_joint_states:
            # Before the readings: the executor serves what has arrived in this order.
            self.create_subscription(JointState, 'joint_states', self._on_joint_states, SENSOR_DATA)
        self.create_subscription(JointState, 'tactile', self._on_tactile, SENSOR_DATA)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)

    def _take_parameters(self) -> None:
        p, finder = self._settings, self._finder
        finder.radius = p.finger_radius
        finder.max_out_of_plane = p.max_out_of_plane
        finder.detectable_range = p.detectable_range
        finder.mount_angle = p.mount_angle
        finder.jumps.max_rate = p.max_theta_rate
        finder.jumps.tolerance = p.jump_tolerance
        if finder.pole is not None:
            finder.pole.timeout = p.joint_state_timeout

    def _on_joint_states(self, message: JointState) -> None:
        names, position = message.name, message.position
        try:
            angles = [position[names.index(name)] for name in self._settings.joint_names]
        except (ValueError, IndexError):
            self._counted['joint states of other joints'] += 1
            return
        if self._finder.joints(self._time.of(message.header.stamp), angles):
            self._counted['joint states'] += 1
        else:
            self._counted['joint states refused'] += 1

    def _on_tactile(self, message: JointState) -> None:
        self._counted['readings'] += 1
        now = time.monotonic()
        if now - self._heard > PATIENCE:
            self._useful = now  # after a silence patience starts over
        self._heard = now
        self._stamp = self._time.of(message.header.stamp)
        try:
            contact = self._finder.contact(_reading(message), self._stamp)
        except ReadingRejectedError as reason:
            self._refuse(str(reason))
            return
        self._useful = now
        self._feels = 'contact'
        self._counted['contacts'] += 1
        pose = self._pose  # one for all: publishing copies it
        pose.header.stamp = message.header.stamp
        pose.pose.position.x, pose.pose.position.y = contact.x, contact.y
        orientation = pose.pose.orientation
        orientation.z, orientation.w = quaternion_of_yaw(contact.theta)
        self._publisher.publish(pose)

    def _refuse(self, reason: str) -> None:
        self._counted[f'rejected: {reason}'] += 1
        if reason == NO_CONTACT:
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
            return Health(ERROR, f'readings refused: {self._refusal}', values)
        if not self._feels:
            return Health(WARN, 'no contact yet', values)
        rates = self._diagnostics.rates
        if any(rates[name] for name in self._counted.keys() - NO_FAULT):
            return Health(WARN, f'{self._feels}, some refused', values)
        return Health(OK, self._feels, values)


def _reading(message: JointState) -> Reading:
    names, position = message.name, message.position
    try:
        reading = Reading(position[names.index('azimuth')], position[names.index('elevation')])
    except (ValueError, IndexError):
        raise ReadingRejectedError('no azimuth and elevation') from None
    if message.header.stamp.sec < 0:
        raise ReadingRejectedError('negative stamp')  # the contact would have it, too
    return reading


def main() -> int:
    """Run the node as a process."""
    return run(ContactGeometry)


if __name__ == '__main__':
    sys.exit(main())
