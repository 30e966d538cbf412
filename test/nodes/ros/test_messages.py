# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps and fields in ROS messages."""

from types import SimpleNamespace

import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from sensor_msgs.msg import JointState

from tactile_push.nodes.ros.messages import filled, publish
from tactile_push.pipeline.messages import (
    command_fields,
    joint_state_fields,
    pose_fields,
)
from tactile_push.pipeline.stamps import stamp_of


def test_fields_within_fields_are_set_and_the_others_stay():
    message = PoseStamped()
    message.pose.position.z = 0.5
    assert filled(message, pose_fields((7, 8), 0.01, -0.02, 0.0)) is message
    assert stamp_of(message) == (7, 8)
    assert message.header.frame_id == 'finger_disk'
    place, turn = message.pose.position, message.pose.orientation
    assert (place.x, place.y, place.z) == (0.01, -0.02, 0.5)
    assert (turn.x, turn.y, turn.z, turn.w) == (0.0, 0.0, 0.0, 1.0)


def test_a_field_that_the_message_lacks_is_refused():
    with pytest.raises(AttributeError, match='positions'):
        filled(JointState(), {'positions': [1.0]})


@pytest.mark.parametrize(
    ('kind', 'fields'),
    [
        (JointState, joint_state_fields((1, 2), {'a': 0.5, 'b': -1.5})),
        (TwistStamped, command_fields((1, 2), -0.004)),
    ],
)
def test_each_message_is_a_new_one_of_the_publishers_type(kind, fields):
    sent = []
    publisher = SimpleNamespace(msg_type=kind, publish=sent.append)
    publish(publisher, fields)
    publish(publisher, {})
    first, second = sent
    assert stamp_of(first) == (1, 2)
    assert second == kind()


def test_joint_states_have_names_and_positions_in_their_order():
    message = filled(JointState(), joint_state_fields((1, 2), {'b': 0.5, 'a': -1.5}))
    assert (message.name, list(message.position)) == (['b', 'a'], [0.5, -1.5])
    assert (len(message.velocity), len(message.effort)) == (0, 0)
