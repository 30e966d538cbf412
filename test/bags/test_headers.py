# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of headers against messages that rosbags encoded."""

import pytest
from rosbags.interfaces import Nodetype

from support.bag_making import TYPES, encode, of_type, write_bag
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.bags.headers import HeaderStamps
from tactile_push.bags.reader import Message

STAMP = 1_732_540_000_123_456_789


@pytest.fixture
def stamps(tmp_path):
    """Return the stamps of a bag with topics of several types and no messages."""
    types = {
        '/joints': 'sensor_msgs/msg/JointState',
        '/marker': 'visualization_msgs/msg/Marker',  # constants and comments come first
        '/markers': 'visualization_msgs/msg/MarkerArray',  # the header is in its parts
        '/clock': 'rosgraph_msgs/msg/Clock',
        '/header': 'std_msgs/msg/Header',
        '/empty': 'std_msgs/msg/Empty',
    }
    bag = write_bag(tmp_path / 'bag', {name: (kind, []) for name, kind in types.items()})
    with BagReader(bag) as reader:
        yield HeaderStamps(reader)


def test_header_is_found_where_it_is_the_first_field(stamps):
    assert '/joints' in stamps
    assert '/marker' in stamps
    for without in ('/markers', '/clock', '/header', '/empty', '/nowhere'):
        assert without not in stamps


OTHER_HEADERS = [
    'int32 data\n',
    'float64 sec\nfloat64 nanosec\n',
    'builtin_interfaces/Time stamp\n',
    'string frame_id\nbuiltin_interfaces/Time stamp\n',
]


@pytest.mark.parametrize('header', ['', *OTHER_HEADERS])
def test_header_of_another_shape_is_none(tmp_path, header):
    text = f'std_msgs/Header header\n{"=" * 80}\nMSG: std_msgs/Header\n{header}' if header else ''
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/a', 'a_msgs/msg/A', definition=text or 'std_msgs/Header header')
    with BagReader(tmp_path / 'bag') as reader:
        assert '/a' not in HeaderStamps(reader)


@pytest.mark.parametrize('stamp', [0, 1, STAMP, -1, -(2**31) * 10**9, 2**31 * 10**9 - 1])
@pytest.mark.parametrize('kind', ['sensor_msgs/msg/JointState', 'visualization_msgs/msg/Marker'])
def test_stamp_of_message(stamps, kind, stamp):
    assert stamps.of(Message('/joints', 0, 0, encode(kind, stamp))) == stamp


def test_stamp_of_big_endian_message(stamps):
    header = {'stamp': {'sec': 12, 'nanosec': 34}}
    message = of_type((Nodetype.NAME, 'sensor_msgs/msg/JointState'), {'header': header})
    data = TYPES.serialize_cdr(message, 'sensor_msgs/msg/JointState', little_endian=False)
    assert stamps.of(Message('/joints', 0, 0, bytes(data))) == 12_000_000_034


@pytest.mark.parametrize('length', range(12))
def test_message_without_room_for_a_stamp_is_refused(stamps, length):
    data = encode('sensor_msgs/msg/JointState', STAMP)[:length]
    with pytest.raises(BagError, match=f'/joints at 7.500000 s, got {length} bytes'):
        stamps.of(Message('/joints', 7_500_000_000, 0, data))
