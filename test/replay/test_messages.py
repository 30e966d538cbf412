# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of messages, their numbers, and the names of topics to be made."""

import pytest

from tactile_push.bags import BagReader, BagWriter
from tactile_push.replay.messages import nanoseconds, only, still_free

JOINTS, POSE = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped'


@pytest.mark.parametrize(
    ('stamp', 'time'),
    [((0, 0), 0), ((1_795_000_000, 5), 1_795_000_000_000_000_005), ((-1, 3), 3 - 10**9)],
)
def test_stamp_is_a_time_to_the_nanosecond(stamp, time):
    assert nanoseconds(stamp) == time


def test_numbers_of_other_names_are_left_out():
    fields = {'header': {'frame_id': 'a'}, 'name': ['x', 'y', 'z'], 'position': [1.0, 2.0, 3.0]}
    assert only({'z', 'x', 'w'}, fields) == {
        **{'header': {'frame_id': 'a'}, 'name': ['x', 'z'], 'position': [1.0, 3.0]}
    }


def test_names_that_something_foreign_has_are_not_made(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/contact', JOINTS)
        writer.add_topic('/object_pose', POSE)
        writer.add_topic('/tactile', JOINTS)
    made = {'/contact': POSE, '/left/contact': POSE, '/tactile': JOINTS}
    with BagReader(tmp_path / 'bag') as bag:
        assert still_free(bag, made) == {'/left/contact': POSE, '/tactile': JOINTS}
