# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""A written bag against the MCAP specification, rosbag2 of Jazzy and two other readers."""

import signal
import struct
import subprocess
import sys

import pytest
import yaml
from mcap.exceptions import EndOfFile
from mcap.reader import NonSeekingReader, make_reader
from mcap_ros2.decoder import DecoderFactory

from tactile_push.bags import BagWriter, schema_text

JOINT_STATE = 'sensor_msgs/msg/JointState'
CLOCK = 'rosgraph_msgs/msg/Clock'
CLOCK_HASH = 'RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564'

# The words of rmw's qos_string_conversions.h, and RMW_DURATION_INFINITE.
FOREVER = {'sec': 9223372036, 'nsec': 854775807}
QOS = {
    'history': 'keep_last',
    'depth': 5,
    'reliability': 'reliable',
    'durability': 'volatile',
    'deadline': FOREVER,
    'lifespan': FOREVER,
    'liveliness': 'automatic',
    'liveliness_lease_duration': FOREVER,
    'avoid_ros_namespace_conventions': False,
}

pytest.importorskip('sensor_msgs')


def clock_message(sec, nanosec):
    """Return a rosgraph_msgs/Clock in little-endian CDR."""
    return struct.pack('<4xiI', sec, nanosec).replace(bytes(4), b'\0\1\0\0', 1)


def joint_state_message(stamp, azimuth, elevation):
    """Return a sensor_msgs/JointState in little-endian CDR, laid out by hand."""
    sec, nanosec = stamp
    return b'\0\1\0\0' + struct.pack(
        '<iI I1s3x I I8s I10s2x I4x 2d I I',
        *(sec, nanosec),
        *(1, b''),
        *(2, 8, b'azimuth', 10, b'elevation'),
        *(2, azimuth, elevation),
        *(0, 0),
    )


@pytest.fixture
def bag(tmp_path):
    """Return the directory of a closed bag with two topics and three messages."""
    directory = tmp_path / 'push'
    with BagWriter(directory) as writer:
        writer.add_topic('/clock', CLOCK, qos=[QOS, QOS], type_hash=CLOCK_HASH)
        writer.add_topic('/tactile', JOINT_STATE)
        writer.write('/tactile', joint_state_message((7, 8), 0.25, -0.5), 1_500, 1_400)
        writer.write('/clock', clock_message(3, 4), 1_000, 900)
        writer.write('/clock', clock_message(5, 6), 3_000, 2_900)
    return directory


@pytest.fixture
def reader(bag):
    """Return an MCAP reader of the bag."""
    with open(bag / 'push_0.mcap', 'rb') as stream:
        yield make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])


def test_rclpy_is_not_needed():
    program = "import sys; sys.modules['rclpy'] = None; import tactile_push.bags"
    subprocess.run([sys.executable, '-c', program], check=True)


def test_directory_holds_file_and_metadata(bag):
    assert sorted(path.name for path in bag.iterdir()) == ['metadata.yaml', 'push_0.mcap']


def test_existing_directory_is_refused_and_left_alone(bag):
    before = {path: path.read_bytes() for path in bag.iterdir()}
    with pytest.raises(FileExistsError, match='push'):
        BagWriter(bag)
    assert {path: path.read_bytes() for path in bag.iterdir()} == before


def test_header(reader):
    header = reader.get_header()
    assert header.profile == 'ros2'
    assert header.library.startswith('tactile_push ')


def test_schemas_and_channels(reader):
    summary = reader.get_summary()
    channels = {channel.topic: channel for channel in summary.channels.values()}
    assert set(channels) == {'/clock', '/tactile'}
    for topic, type_name in {'/clock': CLOCK, '/tactile': JOINT_STATE}.items():
        channel = channels[topic]
        schema = summary.schemas[channel.schema_id]
        assert channel.message_encoding == 'cdr'
        assert (schema.name, schema.encoding) == (type_name, 'ros2msg')
        assert schema.data.decode() == schema_text(type_name)
        assert set(channel.metadata) == {'offered_qos_profiles', 'topic_type_hash'}
    assert channels['/clock'].metadata['topic_type_hash'] == CLOCK_HASH
    assert channels['/tactile'].metadata['topic_type_hash'] == ''


def test_offered_qos_is_yaml_in_block_style_without_references(reader):
    channels = {channel.topic: channel for channel in reader.get_summary().channels.values()}
    text = channels['/clock'].metadata['offered_qos_profiles']
    assert yaml.safe_load(text) == [QOS, QOS]
    assert text.splitlines()[:6] == [
        '- history: keep_last',
        '  depth: 5',
        '  reliability: reliable',
        '  durability: volatile',
        '  deadline:',
        '    sec: 9223372036',
    ]
    assert '&' not in text and '*' not in text
    assert yaml.safe_load(channels['/tactile'].metadata['offered_qos_profiles']) == []


def test_topics_of_one_type_share_the_schema(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/left/tactile', JOINT_STATE)
        writer.add_topic('/right/tactile', JOINT_STATE)
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        summary = make_reader(stream).get_summary()
    assert len(summary.schemas) == 1
    assert len(summary.channels) == 2


def test_chunks_are_compressed_indexed_and_have_a_crc(bag):
    with open(bag / 'push_0.mcap', 'rb') as stream:
        (chunk_index,) = make_reader(stream).get_summary().chunk_indexes
        stream.seek(chunk_index.chunk_start_offset)
        chunk = stream.read(chunk_index.chunk_length)
    assert chunk_index.compression == 'zstd'
    assert set(chunk_index.message_index_offsets) == {1, 2}
    # Opcode, record length, start and end time, uncompressed size, then the checksum.
    opcode, _, start, end, _, crc = struct.unpack_from('<BQQQQI', chunk)
    assert (opcode, start, end) == (6, 1_000, 3_000)
    assert crc != 0


def test_messages_read_by_mcap(reader):
    messages = list(reader.iter_decoded_messages())
    assert [
        (channel.topic, message.log_time, message.publish_time, message.sequence)
        for _, channel, message, _ in messages
    ] == [('/clock', 1_000, 900, 0), ('/tactile', 1_500, 1_400, 0), ('/clock', 3_000, 2_900, 0)]
    first, tactile, last = (decoded for *_, decoded in messages)
    assert (first.clock.sec, first.clock.nanosec) == (3, 4)
    assert (last.clock.sec, last.clock.nanosec) == (5, 6)
    assert (tactile.header.stamp.sec, tactile.header.stamp.nanosec) == (7, 8)
    assert tactile.header.frame_id == ''
    assert tactile.name == ['azimuth', 'elevation']
    assert list(tactile.position) == [0.25, -0.5]
    assert list(tactile.velocity) == list(tactile.effort) == []


def test_messages_read_by_rosbags(bag):
    rosbag2 = pytest.importorskip('rosbags.rosbag2')
    typesys = pytest.importorskip('rosbags.typesys')
    types = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    with rosbag2.Reader(bag) as reader:
        # Its end is the first nanosecond after the last message.
        assert (reader.message_count, reader.start_time, reader.end_time) == (3, 1_000, 3_001)
        assert {
            topic.topic: (topic.msgtype, topic.msgcount, topic.digest)
            for topic in reader.connections
        } == {'/clock': (CLOCK, 2, CLOCK_HASH), '/tactile': (JOINT_STATE, 1, '')}
        qos = {topic.topic: topic.ext.offered_qos_profiles for topic in reader.connections}
        assert [(entry.depth, entry.reliability.name) for entry in qos['/clock']] == [
            (5, 'RELIABLE'),
            (5, 'RELIABLE'),
        ]
        assert qos['/tactile'] == []
        messages = [
            (time, types.deserialize_cdr(data, topic.msgtype))
            for topic, time, data in reader.messages()
        ]
    assert [time for time, _ in messages] == [1_000, 1_500, 3_000]
    first, tactile, last = (message for _, message in messages)
    assert (first.clock.sec, first.clock.nanosec) == (3, 4)
    assert (last.clock.sec, last.clock.nanosec) == (5, 6)
    assert (tactile.header.stamp.sec, tactile.header.stamp.nanosec) == (7, 8)
    assert tactile.header.frame_id == ''
    assert tactile.name == ['azimuth', 'elevation']
    assert tactile.position.tolist() == [0.25, -0.5]
    assert tactile.velocity.size == tactile.effort.size == 0


# rosbag2_storage/yaml.hpp of Jazzy, every field in its order.
METADATA = {
    'version': 9,
    'storage_identifier': 'mcap',
    'duration': {'nanoseconds': 2_000},
    'starting_time': {'nanoseconds_since_epoch': 1_000},
    'message_count': 3,
    'topics_with_message_count': [
        {
            'topic_metadata': {
                'name': '/clock',
                'type': CLOCK,
                'serialization_format': 'cdr',
                'offered_qos_profiles': [QOS, QOS],
                'type_description_hash': CLOCK_HASH,
            },
            'message_count': 2,
        },
        {
            'topic_metadata': {
                'name': '/tactile',
                'type': JOINT_STATE,
                'serialization_format': 'cdr',
                'offered_qos_profiles': [],
                'type_description_hash': '',
            },
            'message_count': 1,
        },
    ],
    'compression_format': '',
    'compression_mode': '',
    'relative_file_paths': ['push_0.mcap'],
    'files': [
        {
            'path': 'push_0.mcap',
            'starting_time': {'nanoseconds_since_epoch': 1_000},
            'duration': {'nanoseconds': 2_000},
            'message_count': 3,
        }
    ],
    'custom_data': None,
    'ros_distro': 'jazzy',
}


@pytest.fixture
def jazzy(monkeypatch):
    """Tell the writer that it runs under ROS 2 Jazzy."""
    monkeypatch.setenv('ROS_DISTRO', 'jazzy')


def test_metadata_file(jazzy, bag):
    text = (bag / 'metadata.yaml').read_text()
    assert yaml.safe_load(text) == {'rosbag2_bagfile_information': METADATA}
    assert '&' not in text and '*' not in text


def test_metadata_records_of_opening_and_closing(jazzy, reader):
    opened, closed = (
        yaml.safe_load(record.metadata['serialized_metadata'])
        for record in reader.iter_metadata()
        if record.name == 'rosbag2'
    )
    # What rosbag2 knows when it opens a bag; its "never" is the largest 64-bit time.
    never = {'nanoseconds_since_epoch': 9223372036854775807}
    assert opened['message_count'] == 0
    assert opened['starting_time'] == never
    assert opened['duration'] == {'nanoseconds': 0}
    assert opened['topics_with_message_count'] == []
    assert closed == METADATA
    assert list(closed) == list(METADATA)


def test_empty_bag(jazzy, tmp_path):
    with BagWriter(tmp_path / 'deep' / 'empty') as writer:
        writer.add_topic('/clock', CLOCK)
    text = (tmp_path / 'deep' / 'empty' / 'metadata.yaml').read_text()
    information = yaml.safe_load(text)['rosbag2_bagfile_information']
    assert information['message_count'] == 0
    assert information['duration'] == {'nanoseconds': 0}
    assert information['starting_time'] == {'nanoseconds_since_epoch': 9223372036854775807}
    with open(tmp_path / 'deep' / 'empty' / 'empty_0.mcap', 'rb') as stream:
        assert list(make_reader(stream).iter_messages()) == []


def test_unknown_type_is_refused_and_the_bag_goes_on(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        with pytest.raises(LookupError, match='nowhere_msgs/msg/Thing'):
            writer.add_topic('/thing', 'nowhere_msgs/msg/Thing')
        writer.add_topic('/clock', CLOCK)
        writer.write('/clock', clock_message(1, 2), 1, 1)
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        reader = make_reader(stream)
        assert [channel.topic for channel in reader.get_summary().channels.values()] == ['/clock']
        assert len(list(reader.iter_messages())) == 1


def test_misuse_is_refused(tmp_path):
    writer = BagWriter(tmp_path / 'bag')
    writer.add_topic('/clock', CLOCK)
    with pytest.raises(ValueError, match='/clock'):
        writer.add_topic('/clock', CLOCK)
    with pytest.raises(KeyError, match='/tactile'):
        writer.write('/tactile', b'', 0, 0)
    writer.close()
    writer.close()
    with pytest.raises(ValueError, match='closed'):
        writer.write('/clock', clock_message(1, 2), 1, 1)


def test_error_in_the_block_keeps_what_was_written(tmp_path):
    with pytest.raises(ZeroDivisionError), BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/clock', CLOCK)
        writer.write('/clock', clock_message(1, 2), 1, 1)
        raise ZeroDivisionError
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        assert len(list(make_reader(stream).iter_messages())) == 1


def read_unfinished(path):
    """Return the messages of an MCAP file up to where it breaks off."""
    messages = []
    with open(path, 'rb') as stream, pytest.raises(EndOfFile):
        unfinished = NonSeekingReader(stream, validate_crcs=True)
        for _, _, message in unfinished.iter_messages(log_time_order=False):
            messages.append(message)
    return messages


def test_flush_makes_messages_readable_before_the_bag_is_closed(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/clock', CLOCK)
        writer.write('/clock', clock_message(1, 2), 10, 11)
        writer.flush()
        (message,) = read_unfinished(tmp_path / 'bag' / 'bag_0.mcap')
    assert message.data == clock_message(1, 2)
    assert (message.log_time, message.publish_time) == (10, 11)


WRITE_FOREVER = """
import sys, time
from tactile_push.bags import BagWriter
writer = BagWriter(sys.argv[1])
writer.add_topic('/clock', 'rosgraph_msgs/msg/Clock')
while True:
    now = time.monotonic_ns()
    writer.write('/clock', bytes.fromhex('000100000100000002000000'), now, now)
    print(now, flush=True)
    time.sleep(0.005)
"""


def test_killed_process_loses_about_a_second(tmp_path):
    process = subprocess.Popen(
        [sys.executable, '-c', WRITE_FOREVER, str(tmp_path / 'bag')],
        stdout=subprocess.PIPE,
        text=True,
    )
    with process:
        written = []
        for line in process.stdout:
            written.append(int(line))
            if written[-1] - written[0] > 3_500_000_000:
                break
        process.send_signal(signal.SIGKILL)
        written += [int(line) for line in process.stdout if line.endswith('\n')]
    assert process.returncode == -signal.SIGKILL
    assert not (tmp_path / 'bag' / 'metadata.yaml').exists()

    readable = [message.log_time for message in read_unfinished(tmp_path / 'bag' / 'bag_0.mcap')]
    assert readable == written[: len(readable)]
    # One second, and half of one for a process that did not get the processor in between.
    assert written[-1] - readable[-1] < 1_500_000_000
