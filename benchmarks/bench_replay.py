# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Speed of the replay of an hour beside that of mcap's reader on the same messages.

The bag holds an hour of one finger: readings at 100 Hz, joint states at 50 Hz, and what geometry
and law made of them. The steps of `tactile_push.pipeline` write it without waiting.
"""

import math
import time

import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from tactile_push.bags import BagReader, BagWriter
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    GEOMETRY_STATE,
    JOINT_STATES,
    TACTILE,
    TOPICS,
)
from tactile_push.nodes.ros.messages import filled
from tactile_push.parameters import ContactGeometryParameters, PushControllerParameters
from tactile_push.parameters.contact_geometry import make_finder
from tactile_push.parameters.push_controller import make_control, make_finger
from tactile_push.pipeline import Control, Geometry, edge_angle
from tactile_push.pipeline.messages import joint_state_fields
from tactile_push.pipeline.stamps import epoch_of, seconds_since
from tactile_push.replay import replay
from tactile_push.tactile import reading_of_contact

HOUR = 3600  # [s]
READINGS, TURNS, TICKS = 100, 50, 10  # [Hz]
BEGIN = 1_795_000_000  # [s]
GOAL = 0.5  # of the reader's rate
MESSAGES = {
    TACTILE: JointState,
    JOINT_STATES: JointState,
    CONTACT: PoseStamped,
    GEOMETRY_STATE: JointState,
    CONTROLLER_STATE: JointState,
    COMMAND: TwistStamped,
}


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """Write an hour."""
    folder = tmp_path_factory.mktemp('bags') / 'hour'
    epoch = epoch_of(BEGIN)

    def seconds(sec, nanosec):
        return seconds_since(epoch, sec, nanosec)

    g, p = ContactGeometryParameters(), PushControllerParameters()
    geometry = Geometry(make_finder(g), g.joint_names, seconds)
    push = make_control(p)
    control = Control(push, make_finger(p), p.joint_names, seconds)
    with BagWriter(folder) as writer:
        for topic in MESSAGES:
            writer.add_topic(f'/{topic}', TOPICS[topic].type_name)
        push.activate(seconds(BEGIN, 0))
        elapsed = math.nan
        for k in range(HOUR * READINGS):
            at = BEGIN * 10**9 + k * 10**9 // READINGS
            stamp = divmod(at, 10**9)

            def write(topic, fields, at=at):
                data = serialize_message(filled(MESSAGES[topic](), fields))
                writer.write(f'/{topic}', data, at, at)

            now = seconds(*stamp)
            turned = 0.1 * math.sin(now)
            if k % (READINGS // TURNS) == 0:
                joints = dict(zip(p.joint_names, (turned, 0.0), strict=True))
                write(JOINT_STATES, joint_state_fields(stamp, joints))
                geometry.joint_states(stamp, list(joints), list(joints.values()))
            reading = reading_of_contact(0.2 * math.sin(0.3 * now), math.pi / 2.0 + turned)
            angles = {'azimuth': reading.azimuth, 'elevation': reading.elevation}
            write(TACTILE, joint_state_fields(stamp, angles))
            felt = geometry.tactile(stamp, list(angles), list(angles.values()))
            for topic, fields in felt.outputs():
                write(topic, fields)
                if topic == CONTACT:
                    turn = fields['pose']['orientation']
                    control.contact(stamp, edge_angle('', 0.0, 0.0, turn['z'], turn['w']))
            if k % (READINGS // TICKS) == 0:
                tick = control.tick(stamp, elapsed)
                elapsed = 1.0 / TICKS
                for topic, fields in control.outputs(stamp, tick):
                    write(topic, fields)
    return folder


def test_replay_of_an_hour(bag):
    """Replay it, and read and decode the same messages with mcap's reader alone."""
    (file,) = bag.glob('*.mcap')
    began = time.process_time()
    with file.open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        read = sum(
            1 for _ in reader.iter_decoded_messages(topics=[f'/{topic}' for topic in MESSAGES])
        )
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
