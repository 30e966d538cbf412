# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Speed of the replay of an hour beside that of mcap's reader on the same messages.

The bag has what a finger says in an hour: readings at 100 Hz, joint states at 50 Hz, what geometry
and law made of them. It is written with the package's own functions, in no time of its own.
"""

import math
import time

import pytest
from builtin_interfaces.msg import Time
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rclpy.serialization import serialize_message

from tactile_push.bags import BagReader, BagWriter
from tactile_push.control import tick_values
from tactile_push.nodes.ros.messages import (
    ContactMessage,
    named_values,
    velocity_command,
)
from tactile_push.parameters import contact_geometry, push_controller
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.pipeline.stamps import epoch_of, seconds_since
from tactile_push.replay import replay
from tactile_push.tactile import reading_of_contact, reading_values

HOUR = 3600  # [s]
READINGS, JOINT_STATES, TICKS = 100, 50, 10  # [Hz]
BEGIN = 1_795_000_000  # [s]
GOAL = 0.5  # of the reader's rate
JOINT_STATE = 'sensor_msgs/msg/JointState'
TOPICS = {
    '/tactile': JOINT_STATE,
    '/joint_states': JOINT_STATE,
    '/contact': 'geometry_msgs/msg/PoseStamped',
    '/contact_geometry/state': JOINT_STATE,
    '/push_controller/state': JOINT_STATE,
    '/finger/cmd_vel': 'geometry_msgs/msg/TwistStamped',
}


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """Write an hour."""
    folder = tmp_path_factory.mktemp('bags') / 'hour'
    finder = contact_geometry.make_finder(contact_geometry.ContactGeometryParameters())
    control = push_controller.make_control(push_controller.PushControllerParameters())
    epoch = epoch_of(BEGIN)
    message = ContactMessage()
    with BagWriter(folder) as writer:
        for topic, type_name in TOPICS.items():
            writer.add_topic(topic, type_name)
        control.activate(seconds_since(epoch, BEGIN, 0))
        elapsed = math.nan
        for k in range(HOUR * READINGS):
            at = BEGIN * 10**9 + k * 10**9 // READINGS
            sec, nanosec = divmod(at, 10**9)
            stamp, now = Time(sec=sec, nanosec=nanosec), seconds_since(epoch, sec, nanosec)

            def write(topic, content, at=at):
                writer.write(topic, serialize_message(content), at, at)

            turned = 0.1 * math.sin(now)
            if k % (READINGS // JOINT_STATES) == 0:
                joints = {'proximal_joint': turned, 'distal_joint': 0.0}
                write('/joint_states', named_values(stamp, joints))
                finder.joints(now, joints.values())
            reading = reading_of_contact(0.2 * math.sin(0.3 * now), math.pi / 2.0 + turned)
            angles = {'azimuth': reading.azimuth, 'elevation': reading.elevation}
            write('/tactile', named_values(stamp, angles))
            contact = finder.contact(reading, now)
            pose = message.of(contact, stamp)
            write('/contact', pose)
            rotation = pose.pose.orientation
            theta = yaw_of_quaternion(rotation.x, rotation.y, rotation.z, rotation.w)
            values = reading_values(reading, finder.joint_angle, contact.theta, '')
            write('/contact_geometry/state', named_values(stamp, values))
            control.feel(theta, now)
            if k % (READINGS // TICKS) == 0:
                tick = control.tick(now, elapsed)
                elapsed = 1.0 / TICKS
                write('/finger/cmd_vel', velocity_command(tick.v_x, stamp))
                write('/push_controller/state', named_values(stamp, tick_values(tick, control.law)))
    return folder


def test_replay_of_an_hour(bag):
    """Replay it, and read and decode the same messages with mcap's reader alone."""
    (file,) = bag.glob('*.mcap')
    began = time.process_time()
    with file.open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        read = sum(1 for _ in reader.iter_decoded_messages(topics=list(TOPICS)))
    reading = time.process_time() - began
    began = time.process_time()
    with BagReader(bag) as opened:
        (comparison,) = replay(opened)
    replaying = time.process_time() - began
    print(
        f'\n    {read:,} messages: read in {reading:.1f} s, replayed in {replaying:.1f} s; '
        f'{reading / replaying:.2f} of the rate, goal {GOAL}'
    )
    assert comparison.readings == HOUR * READINGS
    assert not comparison.different()
    assert reading / replaying >= GOAL
