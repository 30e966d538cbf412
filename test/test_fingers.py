# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics of a bag are the package's own, and which only look like it."""

import pytest

from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.fingers import FIELDS, definition_trouble, fingers_in, is_own, left_alone
from tactile_push.interface import CONTACT, DIAGNOSTICS, GEOMETRY_STATE, TACTILE, TRUE_POSE

JOINTS, POSE, BOOL = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped', 'a_msgs/msg/B'


@pytest.fixture
def bag(tmp_path):
    """Return a function that writes a bag of such topics: type and number of messages by name."""

    def write(topics):
        with BagWriter(tmp_path / 'bag') as writer:
            for name, (kind, count) in topics.items():
                writer.add_topic(name, kind, definition='bool data')
                for k in range(count):
                    writer.write(name, b'\0\1\0\0', k, k)
        return BagReader(tmp_path / 'bag')

    return write


def test_finger_has_the_topics_of_its_namespace_that_have_messages(bag):
    topics = {
        '/tactile': (JOINTS, 2),
        '/contact': (POSE, 0),
        '/left/tactile': (JOINTS, 1),
        '/left/contact': (POSE, 1),
        '/right/contact': (POSE, 1),
        '/right/tactile': (JOINTS, 0),
    }
    fingers = fingers_in(bag(topics), [TACTILE], [], '')
    assert fingers == {'': {TACTILE}, '/left': {TACTILE, CONTACT}}


def test_what_is_named_like_a_topic_of_a_finger_and_is_of_another_type_is_foreign(bag):
    topics = {
        '/tactile': (JOINTS, 1),
        '/contact': (BOOL, 1),
        '/hand/contact': (JOINTS, 1),
        '/glove/tactile': ('', 1),
        '/camera/markers': (BOOL, 1),
        '/diagnostics': (BOOL, 1),
        '/hand/diagnostics': (BOOL, 1),
        '/my_contact': (BOOL, 1),
    }
    reader = bag(topics)
    assert fingers_in(reader, [TACTILE, CONTACT], [], '') == {'': {TACTILE}}
    assert left_alone(reader, [TACTILE, CONTACT]) == (
        f'left alone: /contact (expected {POSE}, got {BOOL}), '
        f'/glove/tactile (expected {JOINTS}, got no type), '
        f'/hand/contact (expected {POSE}, got {JOINTS})'
    )
    assert left_alone(reader, [DIAGNOSTICS]).count('expected') == 1
    assert left_alone(reader, [TRUE_POSE]) == ''
    own = {name for name in [*topics, '/nothing', '/left/contact'] if is_own(reader, name)}
    assert own == {'/tactile'}


def test_type_name_without_msg_is_the_same_type(bag):
    reader = bag({'/tactile': ('sensor_msgs/JointState', 1)})
    assert fingers_in(reader, [TACTILE], [], '') == {'': {TACTILE}}


def test_fields_that_are_read_are_those_of_the_types(tmp_path):
    with BagWriter(tmp_path / 'types') as writer:
        for number, type_name in enumerate(FIELDS):
            pytest.importorskip(type_name.split('/')[0])
            writer.add_topic(f'/t{number}', type_name)
    with BagReader(tmp_path / 'types') as reader:
        assert {definition_trouble(reader, topic) for topic in reader.topics} == {''}


def test_definition_that_lacks_what_is_read_is_refused_where_it_is_used(bag):
    reader = bag({'/tactile': (JOINTS, 1), '/contact': (POSE, 1)})
    with pytest.raises(BagError, match=f'the definition of {JOINTS} for /tactile lacks header'):
        fingers_in(reader, [TACTILE], [TACTILE, GEOMETRY_STATE], '')
    with pytest.raises(BagError, match='bag: nothing at all'):
        fingers_in(reader, [TRUE_POSE], [TACTILE], 'nothing at all')
