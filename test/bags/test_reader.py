# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags of rosbags' writer, mcap's writer and our own, read beside mcap's and rosbags' readers."""

import logging
import os
import random
import subprocess
import sys

import numpy as np
import pytest
import yaml
import zstandard
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import CompressionType, IndexType, Writer
from mcap_ros2.decoder import DecoderFactory
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Reader as RosbagsReader
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.typesys import Stores, get_typestore

from support.bag_files import (
    CLOCK,
    CLOCK_DEFINITION,
    SECOND,
    as_tuples,
    clock_message,
    mcap_bytes,
    some_messages,
)
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.bags.states import read_states

TYPES = get_typestore(Stores.ROS2_JAZZY)
JOINT_STATE = 'sensor_msgs/msg/JointState'

QOS = Qos(
    QosHistory.KEEP_LAST,
    7,
    QosReliability.BEST_EFFORT,
    QosDurability.VOLATILE,
    QosTime(1, 2),
    QosTime(3, 4),
    QosLiveliness.AUTOMATIC,
    QosTime(5, 6),
    False,
)


def refuse(line):
    """Stand in for `warn` where nothing may be warned of."""
    raise AssertionError(line)


def joint_state(step):
    """Return a sensor_msgs/JointState in CDR."""
    stamp = TYPES.types['builtin_interfaces/msg/Time'](sec=step, nanosec=500_000_000)
    header = TYPES.types['std_msgs/msg/Header'](stamp=stamp, frame_id='finger_base')
    message = TYPES.types[JOINT_STATE](
        header=header,
        name=['theta', 'phi'],
        position=np.array([0.5 * step, -1.0]),
        velocity=np.array([]),
        effort=np.array([2.0]),
    )
    return bytes(TYPES.serialize_cdr(message, JOINT_STATE))


def write_by_rosbags(path, mode, storage=StoragePlugin.MCAP):
    """Write a bag of two topics; return what was written."""
    writer = RosbagsWriter(path, version=9, storage_plugin=storage)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    writer.set_custom_data('object', 'block')
    written = []
    with writer:
        clock = writer.add_connection('/clock', CLOCK, typestore=TYPES, offered_qos_profiles=[QOS])
        state = writer.add_connection('/state', JOINT_STATE, typestore=TYPES)
        for step in range(50):
            for topic, data in ((clock, clock_message(step * SECOND)), (state, joint_state(step))):
                time = step * SECOND + topic.id
                writer.write(topic, time, data)
                written.append((topic.topic, time, data))
    return written


MODES = [
    CompressionMode.NONE,
    CompressionMode.FILE,
    CompressionMode.MESSAGE,
    CompressionMode.STORAGE,
]


@pytest.mark.parametrize('has_metadata', [True, False])
@pytest.mark.parametrize('mode', MODES)
def test_bag_of_rosbags(tmp_path, mode, has_metadata):
    written = write_by_rosbags(tmp_path / 'bag', mode)
    with RosbagsReader(tmp_path / 'bag') as expected:
        types = {each.topic: each.msgtype for each in expected.connections}
        assert written == [
            (connection.topic, time, bytes(data)) for connection, time, data in expected.messages()
        ]
    if not has_metadata:
        (tmp_path / 'bag' / 'metadata.yaml').unlink()
    with BagReader(tmp_path / 'bag', refuse) as reader:
        assert [(each.topic, each.log_time, each.data) for each in reader.messages()] == written
        assert {name: topic.type_name for name, topic in reader.topics.items()} == types
        assert reader.counts == {'/clock': 50, '/state': 50}
        assert (reader.start_time, reader.end_time) == (1, 49 * SECOND + 2)
        assert reader.notes == {'object': 'block'}
        assert reader.topics['/state'].qos == ()
        (qos,) = reader.topics['/clock'].qos
        assert (qos['history'], qos['depth'], qos['reliability']) == ('keep_last', 7, 'best_effort')
        assert qos['deadline'] == {'sec': 1, 'nsec': 2}
        for message in reader.messages(['/state']):
            theirs = TYPES.deserialize_cdr(message.data, JOINT_STATE)
            ours = reader.decode(message)
            assert (ours.header.stamp.sec, ours.header.frame_id) == (
                theirs.header.stamp.sec,
                theirs.header.frame_id,
            )
            assert list(ours.name) == theirs.name
            assert list(ours.position) == theirs.position.tolist()
            assert (list(ours.velocity), list(ours.effort)) == ([], [2.0])


@pytest.mark.parametrize('mode', MODES)
def test_single_file_of_a_bag(tmp_path, mode):
    written = write_by_rosbags(tmp_path / 'bag', mode)
    (file,) = (path for path in (tmp_path / 'bag').iterdir() if '.mcap' in path.name)
    with BagReader(file, refuse) as reader:
        assert [(each.topic, each.log_time, each.data) for each in reader.messages()] == written
        assert reader.files == [file]


OPTIONS = {
    'zstd': {},
    'lz4': {'compression': CompressionType.LZ4},
    'none': {'compression': CompressionType.NONE},
    'without chunks': {'use_chunking': False},
    'one chunk': {'chunk_size': 10**9},
    'without checksums': {'enable_crcs': False},
    'with a checksum of all': {'enable_data_crcs': True},
    'without statistics': {'use_statistics': False},
    'without index': {'index_types': IndexType.NONE},
    'without message index': {'index_types': IndexType.CHUNK | IndexType.METADATA},
    'without repeated channels': {'repeat_channels': False},
    'without repeated schemas': {'repeat_schemas': False},
    'without summary': {
        'repeat_channels': False,
        'repeat_schemas': False,
        'index_types': IndexType.NONE,
        'use_statistics': False,
        'use_summary_offsets': False,
    },
}


@pytest.mark.parametrize('suffix', ['.mcap', '.mcap.zstd'])
@pytest.mark.parametrize('options', OPTIONS.values(), ids=OPTIONS)
def test_file_of_mcap(tmp_path, options, suffix):
    written = some_messages(100)
    data = mcap_bytes(written, **options)
    path = tmp_path / f'file{suffix}'
    path.write_bytes(zstandard.compress(data) if suffix == '.mcap.zstd' else data)
    with BagReader(path, refuse) as reader:
        assert as_tuples(reader.messages()) == written
        assert as_tuples(reader.messages()) == written
        topics = {topic for topic, *_ in written}
        assert set(reader.topics) == topics
        assert reader.topics['/clock1'].type_name == CLOCK
        assert reader.topics['/clock1'].definition == CLOCK_DEFINITION
        assert reader.counts == {
            topic: sum(each[0] == topic for each in written) for topic in topics
        }
        assert (reader.start_time, reader.end_time) == (written[0][1], written[-1][1])


def test_own_bag_beside_the_reader_of_mcap(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/clock', CLOCK, qos=[{'depth': 3}, {'depth': 4}], type_hash='RIHS01_0')
        writer.add_topic('/state', JOINT_STATE)
        for step in range(200):
            writer.write('/clock', clock_message(step), step, step - 7 + 7)
            writer.write('/state', joint_state(step), step, 3)
            if step % 50 == 0:
                writer.flush()
    with open(tmp_path / 'bag' / 'bag_0.mcap', 'rb') as stream:
        expected = list(
            make_reader(stream, decoder_factories=[DecoderFactory()]).iter_decoded_messages()
        )
    with BagReader(tmp_path / 'bag', refuse) as reader:
        read = list(reader.messages())
        assert as_tuples(read) == [
            (channel.topic, message.log_time, message.publish_time, message.data)
            for _, channel, message, _ in expected
        ]
        # The dynamic classes differ, so their texts are compared.
        assert [repr(reader.decode(message)) for message in read] == [
            repr(decoded) for *_, decoded in expected
        ]
        assert reader.topics['/clock'].qos == ({'depth': 3}, {'depth': 4})
        assert reader.topics['/clock'].type_hash == 'RIHS01_0'


def test_topics_and_times_are_selected(tmp_path):
    written = some_messages(300)
    (tmp_path / 'file.mcap').write_bytes(mcap_bytes(written))
    times = [each[1] for each in written]
    with BagReader(tmp_path / 'file.mcap', refuse) as reader:
        for topics in (None, [], ['/clock0'], {'/clock2', '/clock1'}, ['/nothing', '/clock1']):
            for start, end in ((None, None), (times[7], times[203]), (None, 3), (times[-1], None)):
                assert as_tuples(reader.messages(topics, start, end)) == [
                    each
                    for each in written
                    if (topics is None or each[0] in topics)
                    and (start is None or each[1] >= start)
                    and (end is None or each[1] < end)
                ]


@given(st.lists(st.lists(st.integers(0, 30), max_size=30), min_size=1, max_size=3))
def test_messages_come_in_order_of_log_time_from_any_files(tmp_path_factory, files):
    folder = tmp_path_factory.mktemp('bag')
    number = 0
    written = []
    for index, times in enumerate(files):
        messages = []
        for time in times:
            messages.append((f'/clock{number % 3}', time, number, clock_message(number)))
            number += 1
        written += messages
        (folder / f'bag_{index}.mcap').write_bytes(mcap_bytes(messages, chunk_size=100))
    with BagReader(folder, refuse) as reader:
        read = as_tuples(reader.messages())
    # Python's sort is stable, so those of one time stay in the order of the bag.
    assert read == sorted(written, key=lambda each: each[1])


def metadata_of(*files, count=0, **more):
    """Return the text of a metadata.yaml."""
    information = {
        'version': 9,
        'storage_identifier': 'mcap',
        'relative_file_paths': list(files),
        'message_count': count,
        'starting_time': {'nanoseconds_since_epoch': 5 * SECOND},
        'duration': {'nanoseconds': 3 * SECOND},
    }
    return yaml.safe_dump({'rosbag2_bagfile_information': {**information, **more}})


def test_files_come_in_the_order_of_their_numbers_or_of_the_metadata(tmp_path):
    written = some_messages(12)
    for number, message in enumerate(written):
        (tmp_path / f'bag_{number}.mcap').write_bytes(mcap_bytes([message]))
    names = [f'bag_{number}.mcap' for number in range(12)]
    with BagReader(tmp_path, refuse) as reader:
        assert [file.name for file in reader.files] == names
        assert as_tuples(reader.messages()) == written
        assert sum(reader.counts.values()) == 12
    (tmp_path / 'metadata.yaml').write_text(metadata_of(*names[3::-1]))
    with BagReader(tmp_path, refuse) as reader:
        assert [file.name for file in reader.files] == names[3::-1]
        assert as_tuples(reader.messages()) == written[:4]


def test_notes_of_metadata_records_and_of_the_metadata_file(tmp_path):
    with open(tmp_path / 'bag_0.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        writer.add_metadata('tactile_push', {'tactile_push.version': '1', 'a': 'b'})
        writer.add_metadata('tactile_push', {'tactile_push.version': '2'})
        writer.add_metadata('other', {'c': 'd'})
        writer.finish()
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', custom_data={'operator': 'ann', 'run': 3})
    )
    with BagReader(tmp_path, refuse) as reader:
        assert reader.notes == {
            'tactile_push.version': '2',
            'a': 'b',
            'operator': 'ann',
            'run': '3',
        }


def test_empty_bag(tmp_path):
    (tmp_path / 'file.mcap').write_bytes(mcap_bytes([]))
    with BagReader(tmp_path / 'file.mcap', refuse) as reader:
        assert list(reader.messages()) == []
        assert (reader.topics, reader.counts, reader.notes) == ({}, {}, {})
        assert (reader.start_time, reader.end_time) == (0, 0)


def test_readings_of_one_bag_do_not_disturb_one_another(tmp_path):
    written = some_messages(200)
    for number in range(4):
        part = written[number * 50 : (number + 1) * 50]
        (tmp_path / f'bag_{number}.mcap').write_bytes(mcap_bytes(part))
    reader = BagReader(tmp_path, refuse)
    first, second = reader.messages(), reader.messages()
    ahead = [next(first) for _ in range(120)]
    behind = []
    for message in first:
        ahead.append(message)
        behind.append(next(second))
    with reader:
        pass
    behind += second
    assert as_tuples(ahead) == as_tuples(behind) == written


def test_topic_of_two_types_keeps_the_first(tmp_path):
    with open(tmp_path / 'file.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        for number, type_name in enumerate((CLOCK, 'std_msgs/msg/String', CLOCK)):
            schema = writer.register_schema(type_name, 'ros2msg', CLOCK_DEFINITION.encode())
            channel = writer.register_channel('/clock', 'cdr', schema)
            writer.add_message(channel, number, clock_message(number), number)
        writer.finish()
    warnings = []
    with BagReader(tmp_path / 'file.mcap', warnings.append) as reader:
        assert [each.log_time for each in reader.messages()] == [0, 2]
        assert reader.counts == {'/clock': 2}
    (line,) = warnings
    assert '1 messages of /clock' in line and 'std_msgs/msg/String' in line and CLOCK in line


ENCODINGS = [('json', 'jsonschema'), ('cdr', 'ros2idl'), ('cdr', 'omgidl'), ('protobuf', 'ros2msg')]


@pytest.mark.parametrize(('encoding', 'schema_encoding'), ENCODINGS)
def test_unknown_encoding_is_read_and_not_decoded(tmp_path, encoding, schema_encoding):
    with open(tmp_path / 'file.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('')
        schema = writer.register_schema('Thing', schema_encoding, b'\xff{}')
        writer.add_message(writer.register_channel('/thing', encoding, schema), 1, b'abc', 1)
        writer.add_message(writer.register_channel('/bare', encoding, 0), 2, b'def', 2)
        writer.finish()
    with BagReader(tmp_path / 'file.mcap', refuse) as reader:
        thing, bare = reader.messages()
        assert (thing.data, bare.data) == (b'abc', b'def')
        assert reader.topics['/bare'].type_name == ''
        for message, encodings in ((thing, schema_encoding), (bare, '')):
            with pytest.raises(BagError) as error:
                reader.decode(message)
            assert f'{message.topic} cannot be decoded: expected ' in str(error.value)
            assert f"got message encoding '{encoding}'" in str(error.value)
            assert f"schema encoding '{encodings}'" in str(error.value)


def one_message(path, data, definition=CLOCK_DEFINITION):
    with open(path, 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        schema = writer.register_schema(CLOCK, 'ros2msg', definition.encode())
        channel = writer.register_channel('/clock', 'cdr', schema)
        writer.add_message(channel, 5 * SECOND, clock_message(1), 0)
        writer.add_message(channel, 5 * SECOND + 250_000_000, data, 0)
        writer.finish()
    return path


@pytest.mark.parametrize('data', [b'', b'\0\1', b'\0\1\0\0', clock_message(1)[:-1]])
def test_message_that_does_not_decode(tmp_path, data):
    with BagReader(one_message(tmp_path / 'file.mcap', data), refuse) as reader:
        first, second = reader.messages()
        assert reader.decode(first).clock.nanosec == 1
        assert second.data == data
        with pytest.raises(BagError) as error:
            reader.decode(second)
    text = str(error.value)
    assert text.startswith(str(tmp_path / 'file.mcap'))
    assert '/clock at 0.250000 s' in text and CLOCK in text and '\n' not in text


DEFINITIONS = ['unknown_msgs/Thing thing\n', 'int32[', f'{CLOCK} again\n', '\0']


@pytest.mark.parametrize('definition', DEFINITIONS)
def test_definition_that_makes_no_sense(tmp_path, capfd, definition):
    path = one_message(tmp_path / 'file.mcap', b'\0\1\0\0', definition)
    with BagReader(path, refuse) as reader:
        message = next(reader.messages())
        with pytest.raises(BagError, match='/clock') as error:
            reader.decode(message)
    assert '\n' not in str(error.value)
    assert capfd.readouterr() == ('', '')


@pytest.mark.parametrize('make', ['nothing', 'folder', 'folder named so', 'text', 'sqlite', 'pipe'])
def test_what_is_no_bag(tmp_path, make):
    path = tmp_path / 'bag.mcap'
    if make.startswith('folder'):
        path.mkdir()
    if make == 'folder named so':
        path = path / 'x.mcap'
        path.mkdir()
    elif make == 'text':
        path.write_text('topics: none\n')
    elif make == 'sqlite':
        path.write_bytes(b'SQLite format 3\0' + bytes(100))
    elif make == 'pipe':
        os.mkfifo(path)
    with pytest.raises(BagError) as error:
        BagReader(path, refuse)
    assert str(path) in str(error.value) and '\n' not in str(error.value)


def test_folder_in_place_of_a_file(tmp_path):
    (tmp_path / 'bag_0.mcap').mkdir()
    with pytest.raises(BagError, match='bag_0.mcap'):
        BagReader(tmp_path, refuse)


@pytest.mark.parametrize('has_metadata', [True, False])
def test_sqlite_bag_is_refused_with_what_to_do(tmp_path, has_metadata):
    write_by_rosbags(tmp_path / 'bag', CompressionMode.NONE, StoragePlugin.SQLITE3)
    if not has_metadata:
        (tmp_path / 'bag' / 'metadata.yaml').unlink()
    for path in (tmp_path / 'bag', tmp_path / 'bag' / 'bag.db3'):
        with pytest.raises(
            BagError, match=r'expected a bag stored as mcap, got sqlite3: `ros2 bag convert`'
        ):
            BagReader(path, refuse)


BAD_METADATA = {
    'no YAML': b'rosbag2_bagfile_information: [',
    'no text': bytes(range(256)),
    'empty': b'',
    'a list': b'- 1',
    'something else': b'rosbag2_bagfile_information: 3',
    'half': b'rosbag2_bagfile_information:\n  version: 9\n',
    'deep': b'[' * 200_000,
    'words for numbers': metadata_of('bag_0.mcap', count='many').encode(),
    'a folder': None,
}


@pytest.mark.parametrize('text', BAD_METADATA.values(), ids=BAD_METADATA)
def test_bad_metadata_file_is_not_used(tmp_path, text):
    written = some_messages(20)
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(written))
    if text is None:
        (tmp_path / 'metadata.yaml').mkdir()
    else:
        (tmp_path / 'metadata.yaml').write_bytes(text)
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written
    (line,) = warnings
    assert line.startswith(f'{tmp_path}/metadata.yaml: not used: ') and '\n' not in line


def test_missing_files_are_named_and_counted(tmp_path):
    written = some_messages(300)
    (tmp_path / 'bag_1.mcap').write_bytes(mcap_bytes(written[:100]))
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', 'bag_1.mcap', 'bag_2.mcap', count=300)
    )
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written[:100]
    first, last, summary = warnings
    assert 'bag_0.mcap: missing' in first
    assert 'bag_2.mcap: missing' in last
    # The metadata tell of 3 s, of which 0.99 s are there.
    assert '200 of the 300 messages' in summary and '2.010 s' in summary


def test_renamed_files_are_read(tmp_path):
    written = some_messages(20)
    (tmp_path / 'renamed.mcap').write_bytes(mcap_bytes(written))
    (tmp_path / 'metadata.yaml').write_text(metadata_of('bag_0.mcap'))
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written
    assert len(warnings) == 1


def test_bad_file_of_a_split_bag_is_left_out(tmp_path):
    written = some_messages(60)
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(written[:20]))
    (tmp_path / 'bag_1.mcap').write_bytes(b'something else')
    (tmp_path / 'bag_2.mcap').write_bytes(mcap_bytes(written[40:]))
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written[:20] + written[40:]
    (line,) = warnings
    assert 'bag_1.mcap' in line and 'left out' in line


def test_unknown_message_compression_is_refused(tmp_path):
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(some_messages(3)))
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', compression_mode='MESSAGE', compression_format='fancy')
    )
    with pytest.raises(BagError, match='expected messages compressed with zstd, got fancy'):
        BagReader(tmp_path, refuse)


def test_warnings_are_logged_unless_somebody_takes_them(tmp_path, caplog):
    (tmp_path / 'file.mcap').write_bytes(mcap_bytes(some_messages(20))[:-1])
    with caplog.at_level(logging.WARNING), BagReader(tmp_path / 'file.mcap'):
        pass
    assert str(tmp_path / 'file.mcap') in caplog.text


def test_states_of_a_topic(tmp_path):
    write_by_rosbags(tmp_path / 'bag', CompressionMode.NONE)
    states = read_states(tmp_path / 'bag', '/state')
    assert list(states) == ['stamp', 'theta', 'phi']
    assert states['stamp'].tolist() == [step + 0.5 for step in range(50)]
    assert states['theta'].tolist() == [0.5 * step for step in range(50)]
    assert states['phi'].tolist() == [-1.0] * 50
    assert list(read_states(tmp_path / 'bag', '/nothing')) == ['stamp']
    with pytest.raises(BagError, match=f'{CLOCK}, expected {JOINT_STATE}'):
        read_states(tmp_path / 'bag', '/clock')


READ_ALL = """
import sys
from tactile_push.bags import BagReader
with BagReader(sys.argv[1], print) as reader:
    count = sum(len(message.data) for message in reader.messages())
with open('/proc/self/status') as status:  # getrusage counts the parent's memory too
    peak = next(line.split()[1] for line in status if line.startswith('VmHWM'))
print(count, peak)
"""


@pytest.mark.parametrize('kind', ['whole', 'cut off', 'without chunks', 'compressed'])
def test_memory_does_not_grow_with_the_bag(tmp_path, kind):
    noise = random.Random(0).randbytes(4_000_000)
    path = tmp_path / ('file.mcap.zstd' if kind == 'compressed' else 'file.mcap')
    with open(path, 'wb') as raw:
        stream = zstandard.ZstdCompressor(level=1).stream_writer(raw, closefd=False)
        target = stream if kind == 'compressed' else raw
        writer = Writer(target, use_chunking=kind != 'without chunks')
        writer.start('ros2')
        schema = writer.register_schema(CLOCK, 'ros2msg', CLOCK_DEFINITION.encode())
        channel = writer.register_channel('/clock', 'cdr', schema)
        for number in range(15_000):
            start = number * 200
            writer.add_message(channel, number, noise[start : start + 20_000], number)
        if kind != 'cut off':
            writer.finish()
        if kind == 'compressed':
            stream.close()
    done = subprocess.run(
        [sys.executable, '-c', READ_ALL, path], capture_output=True, text=True, timeout=300
    )
    *warnings, numbers = done.stdout.splitlines()
    assert len(warnings) == (kind == 'cut off'), done
    size, memory = map(int, numbers.split())
    assert size > 298_000_000
    assert memory < 200_000  # kB
