# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of messages, and which topics of a bag belong to which finger."""

import pytest

from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.interface import CONTACT, TACTILE
from tactile_push.replay.messages import fingers_of, nanoseconds, only

JOINTS, POSE = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped'


def found(folder, topics, having, needed):
    """Return the fingers of a bag of such topics: type and number of messages by name."""
    with BagWriter(folder) as writer:
        for name, (kind, count) in topics.items():
            writer.add_topic(name, kind)
            for k in range(count):
                writer.write(name, b'\0\1\0\0', k, k)
    with BagReader(folder) as bag:
        return fingers_of(bag, having, needed)


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


def test_finger_has_the_topics_of_its_namespace_that_have_messages(tmp_path):
    topics = {
        '/tactile': (JOINTS, 2),
        '/contact': (POSE, 0),
        '/left/tactile': (JOINTS, 1),
        '/left/contact': (POSE, 1),
        '/right/contact': (POSE, 1),
        '/right/tactile': (JOINTS, 0),
    }
    fingers = found(tmp_path / 'bag', topics, [TACTILE], [TACTILE, CONTACT])
    assert set(fingers) == {'', '/left'}
    assert TACTILE in fingers[''] and CONTACT not in fingers['']
    assert {TACTILE, CONTACT} <= fingers['/left']


def test_topic_of_another_type_is_refused_if_it_is_needed(tmp_path):
    topics = {'/left/tactile': (JOINTS, 1), '/left/contact': (JOINTS, 1)}
    assert set(found(tmp_path / 'one', topics, [TACTILE], [TACTILE])) == {'/left'}
    with pytest.raises(BagError, match=f'other: /left/contact: expected {POSE}, got {JOINTS}'):
        found(tmp_path / 'other', topics, [TACTILE], [TACTILE, CONTACT])
