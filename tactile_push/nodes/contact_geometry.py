# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Turns the sensor's angles and the finger's joint angles into the contact."""

import math
import sys
import time
from collections import Counter

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState

from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.messages import ContactMessage, named_values
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import ConfigurationError, declare
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED, SENSOR_DATA
from tactile_push.parameters.contact_geometry import (
    ContactGeometryParameters,
    make_finder,
    take_values,
)
from tactile_push.tactile import NO_CONTACT, Reading, ReadingRejectedError, reading_values

PATIENCE = 0.5  # without a reading, or without one that is of use, before it is an error [s]
# What is counted and no reason to worry. A finger in the air is no fault. What came twice did no
# harm; on simulated time, which stands still now and then, it is common.
NO_FAULT = {
    'readings',
    'contacts',
    'joint states',
    'joint states of other joints',
    'rejected: no contact',
    'rejected: not newer',
}


class ContactGeometry(Node):
    """Node: `tactile` and `joint_states` in, `contact` out.

    What it used and gave for each reading goes to `contact_geometry/state`, if anybody listens.

    Its health is an error when no more readings come for `PATIENCE`, or when all that came in that
    time were refused for a fault; a warning before the first one, while some are refused for a
    fault, or joint states are of no use; well otherwise, a finger that touches nothing included.
    """

    NAME = 'contact_geometry'
    PARAMETERS = ContactGeometryParameters

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS, self._take_parameters)
        try:
            self._finder = make_finder(p)
        except ValueError as error:
            raise ConfigurationError(f'parameter {error}') from None
        self._time = NodeTime(self)
        self._counted = Counter(readings=0, contacts=0)
        self._stamp = float('nan')  # of the last reading [s]
        self._heard = self._useful = time.monotonic()  # when the last reading, the last useful came
        self._feels = ''  # what the last useful reading said
        self._refusal = ''  # why the last refused one was refused
        self._message = ContactMessage()
        self._publisher = self.create_publisher(PoseStamped, 'contact', PUBLISHED)
        self._state = self.create_publisher(JointState, 'contact_geometry/state', PUBLISHED)
        if p.use_joint_states:
            # Before the readings: the executor serves what has arrived in this order.
            self.create_subscription(JointState, 'joint_states', self._on_joint_states, SENSOR_DATA)
        self.create_subscription(JointState, 'tactile', self._on_tactile, SENSOR_DATA)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)

    def _take_parameters(self, settings: ContactGeometryParameters) -> None:
        self._settings = settings
        take_values(self._finder, settings)

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
        reading, theta, refusal = NO_CONTACT, math.nan, ''
        try:
            reading = _reading(message)
            contact = self._finder.contact(reading, self._stamp)
        except ReadingRejectedError as reason:
            refusal = str(reason)
            self._refuse(refusal)
        else:
            theta = contact.theta
            self._useful = now
            self._feels = 'contact'
            self._counted['contacts'] += 1
            self._publisher.publish(self._message.of(contact, message.header.stamp))
        if self._state.get_subscription_count():
            angle = math.nan if reading is NO_CONTACT else self._finder.joint_angle
            values = reading_values(reading, angle, theta, refusal)
            self._state.publish(named_values(message.header.stamp, values))

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
