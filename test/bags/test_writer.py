# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A written bag against the MCAP specification, rosbag2 of Jazzy and two other readers."""

import errno
import os
import random
import signal
import struct
import subprocess
import sys
import time

import pytest
import yaml
from mcap.exceptions import EndOfFile
from mcap.reader import NonSeekingReader, make_reader
from mcap_ros2.decoder import DecoderFactory

from support.waiting import wait_for
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
        writer.flush()  # does not wait for the disk
        path = tmp_path / 'bag' / 'bag_0.mcap'
        (message,) = wait_for(lambda: read_unfinished(path), 'the message')
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


@pytest.mark.slow
@pytest.mark.parametrize('bounds', [(0.0, 0.0), *([(0.2, 3.0)] * 4)])
def test_killed_process_loses_less_than_a_second(tmp_path, bounds):
    lifetime = random.uniform(*bounds)
    process = subprocess.Popen(
        [sys.executable, '-c', WRITE_FOREVER, str(tmp_path / 'bag')],
        stdout=subprocess.PIPE,
        text=True,
    )
    with process:
        written = []
        for line in process.stdout:
            written.append(int(line))
            if written[-1] - written[0] >= lifetime * 1e9:
                break
        process.send_signal(signal.SIGKILL)
        written += [int(line) for line in process.stdout if line.endswith('\n')]
    assert process.returncode == -signal.SIGKILL
    assert not (tmp_path / 'bag' / 'metadata.yaml').exists()

    readable = [message.log_time for message in read_unfinished(tmp_path / 'bag' / 'bag_0.mcap')]
    assert readable == written[: len(readable)]
    # Not a second, even if the process did not get the processor for a while.
    assert written[-1] - (readable or written)[-1] < 1_000_000_000
    assert readable or lifetime < 1.0


def test_what_is_flushed_is_put_onto_the_disk(tmp_path, monkeypatch):
    synced = []
    fdatasync = os.fdatasync

    def note_and_sync(descriptor):
        synced.append(os.fstat(descriptor).st_size)
        fdatasync(descriptor)

    monkeypatch.setattr(os, 'fdatasync', note_and_sync)
    path = tmp_path / 'bag' / 'bag_0.mcap'
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/clock', CLOCK)
        wait_for(lambda: synced, 'the beginning of the file')
        syncs = len(synced)
        writer.write('/clock', clock_message(1, 2), 10, 11)
        writer.flush()
        wait_for(lambda: len(synced) > syncs, 'the message')
        assert len(read_unfinished(path)) == 1
        assert synced[-1] == path.stat().st_size
        writer.flush()  # nothing new
        writer.flush()
    assert len(synced) == syncs + 2  # and at the end
    assert synced[-1] == path.stat().st_size


@pytest.mark.slow
@pytest.mark.parametrize('compression', ['zstd', 'lz4', 'none'])
@pytest.mark.parametrize('split', [{}, {'max_bytes': 8_000}, {'max_duration': 1.0}])
def test_every_compression_and_split_is_read_by_rosbags(tmp_path, compression, split):
    highlevel = pytest.importorskip('rosbags.highlevel')
    directory = tmp_path / 'push'
    readings = [(10**18 + 10_000_000 * i, random.random(), random.random()) for i in range(500)]
    with BagWriter(directory, compression=compression, **split) as writer:
        writer.add_topic('/tactile', JOINT_STATE, qos=[QOS])
        writer.add_topic('/clock', CLOCK, type_hash=CLOCK_HASH)
        for i, (stamp, azimuth, elevation) in enumerate(readings):
            data = joint_state_message(divmod(stamp, 10**9), azimuth, elevation)
            writer.write('/tactile', data, stamp, stamp - 5)
            if i % 100 == 0:
                writer.write('/clock', clock_message(i, 7), stamp + 1, stamp + 1)
            if i % 10 == 0:
                writer.flush()
    files = sorted(path.name for path in directory.glob('*.mcap'))
    assert len(files) == 1 if not split else len(files) > 2
    assert files == sorted(f'push_{i}.mcap' for i in range(len(files)))

    with highlevel.AnyReader([directory]) as reader:
        assert reader.message_count == 505
        assert reader.start_time == readings[0][0]
        assert reader.end_time == readings[-1][0] + 1
        assert {topic.topic: topic.msgcount for topic in reader.connections} == {
            '/tactile': 500,
            '/clock': 5,
        }
        read = [
            (time, reader.deserialize(data, topic.msgtype))
            for topic, time, data in reader.messages()
            if topic.topic == '/tactile'
        ]
    assert [(time, *message.position) for time, message in read] == readings


def test_every_file_of_a_split_bag_is_complete_by_itself(jazzy, tmp_path):
    directory = tmp_path / 'push'
    times = [5_000_000_000 + 400_000_000 * i for i in range(10)]
    with BagWriter(directory, max_duration=1.0) as writer:
        writer.note('tactile_push.version', '1.2.3')
        writer.add_topic('/clock', CLOCK, qos=[QOS], type_hash=CLOCK_HASH)
        for time_ns in times[:5]:
            writer.write('/clock', clock_message(*divmod(time_ns, 10**9)), time_ns, time_ns)
        writer.add_topic('/tactile', JOINT_STATE)
        for time_ns in times[5:]:
            writer.write('/clock', clock_message(*divmod(time_ns, 10**9)), time_ns, time_ns)
    # rosbag2's should_split_bagfile: a message more than max_duration after the file's first one.
    expected = [times[0:3], times[3:6], times[6:9], times[9:]]
    text = (directory / 'metadata.yaml').read_text()
    information = yaml.safe_load(text)['rosbag2_bagfile_information']
    assert information['relative_file_paths'] == [f'push_{i}.mcap' for i in range(4)]
    assert information['files'] == [
        {
            'path': f'push_{i}.mcap',
            'starting_time': {'nanoseconds_since_epoch': span[0]},
            'duration': {'nanoseconds': span[-1] - span[0]},
            'message_count': len(span),
        }
        for i, span in enumerate(expected)
    ]
    assert information['message_count'] == 10
    assert information['starting_time'] == {'nanoseconds_since_epoch': times[0]}
    assert information['duration'] == {'nanoseconds': times[-1] - times[0]}
    for i, span in enumerate(expected):
        with open(directory / f'push_{i}.mcap', 'rb') as stream:
            reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
            assert reader.get_header().profile == 'ros2'
            channels = {
                channel.topic: channel for channel in reader.get_summary().channels.values()
            }
            assert channels['/clock'].metadata['topic_type_hash'] == CLOCK_HASH
            assert ('/tactile' in channels) == (i > 0)
            stamps = [
                decoded.clock.sec * 10**9 + decoded.clock.nanosec
                for *_, decoded in reader.iter_decoded_messages()
            ]
            assert stamps == span
            records = list(reader.iter_metadata())
        (note,) = (record.metadata for record in records if record.name == 'tactile_push')
        assert note == {'tactile_push.version': '1.2.3'}
        first, *_, last = (
            yaml.safe_load(record.metadata['serialized_metadata'])
            for record in records
            if record.name == 'rosbag2'
        )
        assert list(first) == list(last) == list(METADATA)
        assert last['relative_file_paths'] == [f'push_{k}.mcap' for k in range(i + 1)]
        assert last['message_count'] == sum(map(len, expected[: i + 1]))


def test_split_files_are_not_much_larger_than_asked_for(tmp_path):
    directory = tmp_path / 'push'
    with BagWriter(directory, compression='none', max_bytes=100_000) as writer:
        writer.add_topic('/clock', CLOCK)
        for i in range(20_000):
            writer.write('/clock', clock_message(i, 0), i, i)
    sizes = [path.stat().st_size for path in directory.glob('*.mcap')]
    assert len(sizes) >= 20_000 * 43 // 150_000
    assert max(sizes) < 150_000  # what was asked for, a chunk and the index


def test_chunks_are_bounded_at_any_rate_of_messages(tmp_path):
    data = b'\0\1\0\0' + struct.pack('<I', 100_000) + random.randbytes(99_999) + b'\0'
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/text', 'std_msgs/msg/String')
        for i in range(100):
            writer.write('/text', data, i, i)
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        chunks = make_reader(stream).get_summary().chunk_indexes
    assert len(chunks) >= 9
    assert max(chunk.uncompressed_size for chunk in chunks) <= 2**20 + 110_000


def test_notes_are_in_the_metadata_and_in_the_file_at_once(tmp_path):
    directory = tmp_path / 'bag'
    with BagWriter(directory) as writer:
        writer.note('tactile_push.version', '1.2.3')
        writer.note('tactile_push.parameters', '{"sim_plant": {"mu_c": "ä\n"}}')
        writer.note('tactile_push.version', '1.2.4')
        writer.flush()
        wait_for(lambda: b'1.2.4' in (directory / 'bag_0.mcap').read_bytes(), 'the note')
    text = (directory / 'metadata.yaml').read_text()
    assert yaml.safe_load(text)['rosbag2_bagfile_information']['custom_data'] == {
        'tactile_push.version': '1.2.4',
        'tactile_push.parameters': '{"sim_plant": {"mu_c": "ä\n"}}',
    }
    with open(directory / 'bag_0.mcap', 'rb') as stream:
        records = [r for r in make_reader(stream).iter_metadata() if r.name == 'tactile_push']
    assert [key for record in records for key in record.metadata] == [
        'tactile_push.version',
        'tactile_push.parameters',
        'tactile_push.version',
    ]
    with pytest.raises(ValueError, match='closed'):
        writer.note('tactile_push.version', '1.2.5')


def test_definition_from_elsewhere_is_taken_as_it_is(tmp_path):
    old, new = 'uint8 x\n', 'uint16 x\n'
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/a', 'nowhere_msgs/msg/Thing', definition=old)
        writer.add_topic('/b', 'nowhere_msgs/msg/Thing', definition=new)
        writer.add_topic('/c', 'nowhere_msgs/msg/Thing', definition=old)
        writer.write('/a', b'\0\1\0\0\5', 1, 1)
        writer.write('/b', b'\0\1\0\0\5\0', 2, 2)
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        summary = reader.get_summary()
        assert [decoded.x for *_, decoded in reader.iter_decoded_messages()] == [5, 5]
    channels = {channel.topic: channel.schema_id for channel in summary.channels.values()}
    assert channels['/a'] == channels['/c'] != channels['/b']
    assert summary.schemas[channels['/b']].data.decode() == new


@pytest.mark.parametrize('compression', ['', 'ZSTD', 'gzip'])
def test_unknown_compression_is_refused_before_anything_is_made(tmp_path, compression):
    with pytest.raises(ValueError, match='compression: expected one of zstd, lz4, none'):
        BagWriter(tmp_path / 'bag', compression=compression)
    assert list(tmp_path.iterdir()) == []


def write_until_it_fails(writer):
    """Write until the disk is full; return the times of what was written, and the error."""
    writer.add_topic('/clock', CLOCK)
    written = []
    with pytest.raises(OSError) as failure:
        for i in range(1_000_000):
            writer.write('/clock', struct.pack('<4sQ', b'\0\1\0\0', random.getrandbits(64)), i, i)
            written.append(i)
            if i % 100 == 0:
                writer.flush()
    return written, failure.value


@pytest.fixture
def small_disk(tmp_path):
    """Return the directory of a file system with room for 200 kB."""
    directory = tmp_path / 'small'
    directory.mkdir()
    mount = ['mount', '-t', 'tmpfs', '-o', 'size=200k', 'tmpfs', str(directory)]
    if subprocess.run(mount, capture_output=True).returncode != 0:
        pytest.skip('no file system can be mounted here')
    yield directory
    subprocess.run(['umount', str(directory)], check=True)


def test_full_disk_ends_the_bag_with_its_last_whole_chunk(small_disk):
    writer = BagWriter(small_disk / 'bag')
    written, error = write_until_it_fails(writer)
    assert error.errno == errno.ENOSPC
    assert error.filename == str(small_disk / 'bag' / 'bag_0.mcap')
    writer.close()
    assert [path.name for path in (small_disk / 'bag').iterdir()] == ['bag_0.mcap']
    # No record is cut, so a reader that wants nothing but records comes to the very end.
    readable = [message.log_time for message in read_unfinished(small_disk / 'bag' / 'bag_0.mcap')]
    assert readable == written[: len(readable)]
    assert len(readable) > 1000
    with pytest.raises(ValueError, match='closed'):
        writer.write('/clock', clock_message(1, 2), 1, 1)


def test_error_in_the_last_moment_is_told_by_close(tmp_path, monkeypatch):
    writer = BagWriter(tmp_path / 'bag')
    writer.add_topic('/clock', CLOCK)
    writer.write('/clock', clock_message(1, 2), 1, 1)
    writer.flush()
    wait_for(lambda: read_unfinished(tmp_path / 'bag' / 'bag_0.mcap'), 'the message')

    def fail(descriptor, data):
        raise OSError(errno.EIO, 'Input/output error')

    monkeypatch.setattr(os, 'write', fail)
    with pytest.raises(OSError, match='Input/output error'):
        writer.close()
    writer.close()
    assert [path.name for path in (tmp_path / 'bag').iterdir()] == ['bag_0.mcap']
    assert len(read_unfinished(tmp_path / 'bag' / 'bag_0.mcap')) == 1


def test_error_in_the_block_of_a_failed_bag_is_the_disks(tmp_path, monkeypatch):
    def fail(descriptor, data):
        raise OSError(errno.EIO, 'Input/output error')

    with pytest.raises(OSError, match='Input/output error'), BagWriter(tmp_path / 'bag') as writer:
        monkeypatch.setattr(os, 'write', fail)
        write_until = time.monotonic() + 60
        writer.add_topic('/clock', CLOCK)
        while time.monotonic() < write_until:
            writer.write('/clock', clock_message(1, 2), 1, 1)
            writer.flush()
