# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What others read in the bytes, and that they are those that ROS sends."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap_ros2._dynamic import generate_dynamic
from rosbags.typesys import Stores, get_typestore

from tactile_push.bags import schema_text
from tactile_push.pipeline.cdr import (
    encode_joint_state,
    encode_pose,
    encode_twist,
    encode_unsure_pose,
)

CHECKED = settings(derandomize=True, deadline=None, max_examples=100)
STAMPS = st.tuples(st.integers(-(2**31), 2**31 - 1), st.integers(0, 10**9 - 1))
NUMBER = st.floats(width=64)
NAMES = st.text(st.characters(min_codepoint=32, max_codepoint=0x2FF), max_size=12)
STORE = get_typestore(Stores.ROS2_JAZZY)


def by_mcap(data, type_name):
    return generate_dynamic(type_name, schema_text(type_name))[type_name](data)


def by_rosbags(data, type_name):
    return STORE.deserialize_cdr(data, type_name)


def same(ours, theirs):
    return list(map(repr, map(float, ours))) == list(map(repr, map(float, theirs)))


@CHECKED
@given(stamp=STAMPS, values=st.dictionaries(NAMES, NUMBER, max_size=20))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_joint_state_is_read_by_others_as_it_was_written(read, stamp, values):
    message = read(encode_joint_state(stamp, values), 'sensor_msgs/msg/JointState')
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == ''
    assert list(message.name) == list(values)
    assert same(message.position, values.values())
    assert len(message.velocity) == len(message.effort) == 0


@CHECKED
@given(stamp=STAMPS, frame=NAMES, numbers=st.lists(NUMBER, min_size=7, max_size=7))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_pose_is_read_by_others_as_it_was_written(read, stamp, frame, numbers):
    data = encode_pose(stamp, frame, numbers[:3], numbers[3:])
    message = read(data, 'geometry_msgs/msg/PoseStamped')
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    place, turn = message.pose.position, message.pose.orientation
    assert same([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w], numbers)


@CHECKED
@given(stamp=STAMPS, frame=NAMES, numbers=st.lists(NUMBER, min_size=43, max_size=43))
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_unsure_pose_is_read_by_others_as_it_was_written(read, stamp, frame, numbers):
    data = encode_unsure_pose(stamp, frame, numbers[:3], numbers[3:7], numbers[7:])
    message = read(data, 'geometry_msgs/msg/PoseWithCovarianceStamped')
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    assert same([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w], numbers[:7])
    assert same(message.pose.covariance, numbers[7:])


@CHECKED
@given(stamp=STAMPS, frame=NAMES, v_x=NUMBER)
@pytest.mark.parametrize('read', [by_mcap, by_rosbags])
def test_twist_is_read_by_others_as_it_was_written(read, stamp, frame, v_x):
    message = read(encode_twist(stamp, frame, v_x), 'geometry_msgs/msg/TwistStamped')
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == stamp
    assert message.header.frame_id == frame
    linear, angular = message.twist.linear, message.twist.angular
    assert same([linear.x], [v_x])
    assert same([linear.y, linear.z, angular.x, angular.y, angular.z], [0.0] * 5)


def test_bytes_are_those_of_the_specification():
    # By hand: sec, nanosec, '' with its length, one name, one position, two empty sequences.
    assert encode_joint_state((1, 2), {'d': 0.5}) == bytes.fromhex(
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

    data = encode_joint_state((7, 8), {'theta': 0.25, 'v_x': math.inf})
    message = deserialize_message(data, JointState)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (7, 8)
    assert message.name == ['theta', 'v_x']
    assert list(message.position) == [0.25, math.inf]


def test_unsure_pose_is_written_as_ros_writes_it():
    pytest.importorskip('rclpy')
    from geometry_msgs.msg import PoseWithCovarianceStamped
    from rclpy.serialization import deserialize_message, serialize_message

    covariance = [float(k) / 7.0 for k in range(36)]
    data = encode_unsure_pose((7, 8), 'finger_disk', (0.1, -0.2, 0.0), (0, 0, 0.6, 0.8), covariance)
    message = PoseWithCovarianceStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = 7, 8
    message.header.frame_id = 'finger_disk'
    message.pose.pose.position.x, message.pose.pose.position.y = 0.1, -0.2
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = 0.6, 0.8
    message.pose.covariance = covariance
    assert deserialize_message(data, PoseWithCovarianceStamped) == message
    # With this frame the numbers follow without a gap, in which ROS leaves what it finds.
    assert data == serialize_message(message)
