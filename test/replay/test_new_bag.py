# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What others read in the bytes, and that they are those that ROS sends."""

import importlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap_ros2._dynamic import generate_dynamic
from rosbags.typesys import Stores, get_typestore

from tactile_push.bags import schema_text
from tactile_push.pipeline.messages import (
    command_fields,
    joint_state_fields,
    object_pose_fields,
    pose_fields,
)
from tactile_push.replay.new_bag import encoder

JOINT_STATE = 'sensor_msgs/msg/JointState'
POSE = 'geometry_msgs/msg/PoseStamped'
UNCERTAIN_POSE = 'geometry_msgs/msg/PoseWithCovarianceStamped'
TWIST = 'geometry_msgs/msg/TwistStamped'
CHECKED = settings(derandomize=True, deadline=None, max_examples=100)
STAMPS = st.tuples(st.integers(-(2**31), 2**31 - 1), st.integers(0, 10**9 - 1))
NUMBER = st.floats(width=64)
NAMES = st.text(st.characters(min_codepoint=32, max_codepoint=0x2FF), max_size=12)
STORE = get_typestore(Stores.ROS2_JAZZY)


def by_mcap(data, type_name):
    return generate_dynamic(type_name, schema_text(type_name))[type_name](data)


def by_rosbags(data, type_name):
    return STORE.deserialize_cdr(data, type_name)


def encode(type_name, fields):
    return encoder(type_name, schema_text(type_name))(fields)


def header(stamp, frame):
    return {'stamp': {'sec': stamp[0], 'nanosec': stamp[1]}, 'frame_id': frame}


def pose(numbers):
    return {
        'position': dict(zip('xyz', numbers[:3], strict=True)),
        'orientation': dict(zip('xyzw', numbers[3:], strict=True)),
    }


def same(ours, theirs):
    return list(map(repr, map(float, ours))) == list(map(repr, map(float, theirs)))


@CHECKED
@given(stamp=STAMPS, values=st.dictionaries(NAMES, NUMBER, max_size=20))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_joint_state_is_read_by_others_as_it_was_written(read, stamp, values):
    message = read(encode(JOINT_STATE, joint_state_fields(stamp, values)), JOINT_STATE)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == ''
    assert list(message.name) == list(values)
    assert same(message.position, values.values())
    assert len(message.velocity) == len(message.effort) == 0


@CHECKED
@given(stamp=STAMPS, frame=NAMES, numbers=st.lists(NUMBER, min_size=7, max_size=7))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_pose_is_read_by_others_as_it_was_written(read, stamp, frame, numbers):
    data = encode(POSE, {'header': header(stamp, frame), 'pose': pose(numbers)})
    message = read(data, POSE)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    place, turn = message.pose.position, message.pose.orientation
    assert same([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w], numbers)


@pytest.mark.slow
@CHECKED
@given(stamp=STAMPS, frame=NAMES, numbers=st.lists(NUMBER, min_size=43, max_size=43))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_uncertain_pose_is_read_by_others_as_it_was_written(read, stamp, frame, numbers):
    content = {'pose': pose(numbers[:7]), 'covariance': numbers[7:]}
    data = encode(UNCERTAIN_POSE, {'header': header(stamp, frame), 'pose': content})
    message = read(data, UNCERTAIN_POSE)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    assert same([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w], numbers[:7])
    assert same(message.pose.covariance, numbers[7:])


@CHECKED
@given(stamp=STAMPS, frame=NAMES, v_x=NUMBER)
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_twist_is_read_by_others_as_it_was_written(read, stamp, frame, v_x):
    fields = {'header': header(stamp, frame), 'twist': {'linear': {'x': v_x}}}
    message = read(encode(TWIST, fields), TWIST)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    linear, angular = message.twist.linear, message.twist.angular
    assert same([linear.x], [v_x])
    assert same([linear.y, linear.z, angular.x, angular.y, angular.z], [0.0] * 5)


def test_bytes_are_those_of_the_specification():
    # By hand: sec, nanosec, '' with its length, one name, one position, two empty sequences.
    assert encode(JOINT_STATE, joint_state_fields((1, 2), {'d': 0.5})) == bytes.fromhex(
        '00010000'
        '01000000 02000000 01000000 00 000000'
        '01000000 02000000 6400 0000'
        '01000000 000000000000e03f'
        '00000000 00000000'
    )


def test_ros_reads_what_was_written():
    pytest.importorskip('rclpy')
    from rclpy.serialization import deserialize_message
    from sensor_msgs.msg import JointState

    values = {'theta': 0.25, 'v_x': math.inf}
    data = encode(JOINT_STATE, joint_state_fields((7, 8), values))
    message = deserialize_message(data, JointState)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (7, 8)
    assert message.name == ['theta', 'v_x']
    assert list(message.position) == [0.25, math.inf]


def test_uncertain_pose_is_written_as_ros_writes_it():
    pytest.importorskip('rclpy')
    from geometry_msgs.msg import PoseWithCovarianceStamped
    from rclpy.serialization import deserialize_message, serialize_message

    angle = 2.0 * math.atan2(0.6, 0.8)
    covariance = np.arange(9.0).reshape(3, 3) / 7.0
    fields = object_pose_fields((7, 8), np.array([0.1, -0.2, angle]), covariance)
    data = encode(UNCERTAIN_POSE, fields)
    message = PoseWithCovarianceStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = 7, 8
    message.header.frame_id = 'finger_disk'
    message.pose.pose.position.x, message.pose.pose.position.y = 0.1, -0.2
    message.pose.pose.orientation.z = math.sin(angle / 2.0)
    message.pose.pose.orientation.w = math.cos(angle / 2.0)
    for row, row_in_space in enumerate((0, 1, 5)):
        for column, column_in_space in enumerate((0, 1, 5)):
            message.pose.covariance[6 * row_in_space + column_in_space] = covariance[row, column]
    assert deserialize_message(data, PoseWithCovarianceStamped) == message
    # With this frame the numbers follow without a gap, in which ROS leaves what it finds.
    assert data == serialize_message(message)


@pytest.mark.parametrize(
    ('type_name', 'fields'),
    [
        (JOINT_STATE, joint_state_fields((-7, 8), {'theta': 0.25, 'ä': math.nan, '': math.inf})),
        (POSE, pose_fields((7, 8), 0.1, -0.2, 0.3)),
        (TWIST, command_fields((7, 8), 0.002)),
        (UNCERTAIN_POSE, object_pose_fields((7, 8), np.array([0.1, 0.2, 3.0]), np.eye(3))),
    ],
)
def test_bag_and_node_put_the_same_into_a_message(type_name, fields):
    pytest.importorskip('rclpy')
    from rclpy.serialization import deserialize_message, serialize_message

    from tactile_push.nodes.ros.messages import filled

    package, _, name = type_name.split('/')
    kind = getattr(importlib.import_module(f'{package}.msg'), name)
    sent = serialize_message(filled(kind(), fields))
    written = encode(type_name, fields)
    assert repr(deserialize_message(written, kind)) == repr(deserialize_message(sent, kind))
