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
from collections import Counter

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from sensor_msgs.msg import JointState

from tactile_push.nodes.diagnostics import OK, WARN, Diagnostics, Health
from tactile_push.nodes.parameters import Parameter, declare
from tactile_push.nodes.process import run
from tactile_push.tactile import (
    PoleHistory,
    Reading,
    ReadingRejectedError,
    contact_of_reading,
    pole_angle,
    quaternion_of_yaw,
)

SENSOR_DATA = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


class ContactGeometry(Node):
    """Node: `tactile` and `joint_states` in, `contact` out."""

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
            read_only=True,
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
    )

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, self.PARAMETERS)
        self._pole = PoleHistory(self._settings.joint_state_timeout)
        self._published = 0
        self._rejected: Counter[str] = Counter()
        self._publisher = self.create_publisher(PoseStamped, 'contact', 10)
        if self._settings.use_joint_states:
            # Before the readings: the executor serves what has arrived in this order.
            self.create_subscription(JointState, 'joint_states', self._on_joint_states, SENSOR_DATA)
        self.create_subscription(JointState, 'tactile', self._on_tactile, SENSOR_DATA)
        self._diagnostics = Diagnostics(self, self._health, self._counts)

    def _on_joint_states(self, message: JointState) -> None:
        angles = dict(zip(message.name, message.position, strict=False))
        try:
            joints = [angles[name] for name in self._settings.joint_names]
        except KeyError:
            return  # joint_states of another mechanism
        self._pole.record(_seconds(message), pole_angle(self._settings.mount_angle, joints))

    def _on_tactile(self, message: JointState) -> None:
        position = dict(zip(message.name, message.position, strict=False))
        force = dict(zip(message.name, message.effort, strict=False))
        nan = float('nan')
        reading = Reading(
            position.get('azimuth', nan),
            position.get('elevation', nan),
            force.get('normal_force', nan),
        )
        try:
            contact = contact_of_reading(
                reading,
                self._psi(_seconds(message)),
                self._settings.finger_radius,
                self._settings.max_out_of_plane,
            )
        except ReadingRejectedError as reason:
            self._rejected[str(reason)] += 1
            return
        pose = PoseStamped()
        pose.header.stamp = message.header.stamp
        pose.header.frame_id = 'finger_disk'
        pose.pose.position.x, pose.pose.position.y = contact.x, contact.y
        orientation = pose.pose.orientation
        orientation.z, orientation.w = quaternion_of_yaw(contact.theta)
        self._publisher.publish(pose)
        self._published += 1

    def _psi(self, stamp: float) -> float:
        if self._settings.use_joint_states:
            return self._pole.at(stamp)
        return self._settings.mount_angle

    def _counts(self) -> dict[str, int]:
        rejected = {f'rejected: {reason}': count for reason, count in self._rejected.items()}
        return {'contacts': self._published, **rejected}

    def _health(self) -> Health:
        rates = self._diagnostics.rates
        if any(rates[f'rejected: {reason}'] for reason in self._rejected):
            return Health(WARN, 'readings without a contact')
        if not rates['contacts']:
            return Health(WARN, 'no readings')
        return Health(OK, 'contact')


def _seconds(message: JointState) -> float:
    return Time.from_msg(message.header.stamp).nanoseconds * 1e-9


def main() -> int:
    """Run the node as a process."""
    return run(ContactGeometry)


if __name__ == '__main__':
    sys.exit(main())
