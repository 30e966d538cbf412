# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags of rosbags' writer, mcap's writer and our own, read beside mcap's and rosbags' readers."""

import logging
import random
import subprocess
import sys

import pytest
import zstandard
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import CompressionType, IndexType, Writer
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag2 import Reader as RosbagsReader

from support.bag_by_rosbags import JOINT_STATE, MODES, TYPES, joint_state, refuse, write_by_rosbags
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


NAMES = [['/clock'], ['clock'], ['clock', '/clock'], ['left/clock'], ['a/b/clock', 'clock']]


@pytest.mark.parametrize('names', NAMES, ids=' and '.join)
@pytest.mark.parametrize('finish', [True, False])
def test_topic_has_a_leading_slash_whether_the_bag_writes_it_or_not(tmp_path, names, finish):
    written = [(name, time, time, clock_message(time)) for time in range(4) for name in names]
    (tmp_path / 'file.mcap').write_bytes(mcap_bytes(written, finish=finish, chunk_size=1))
    warnings = []
    with BagReader(tmp_path / 'file.mcap', warnings.append) as reader:
        full = {f'/{name.lstrip("/")}' for name in names}
        assert set(reader.topics) == {topic.name for topic in reader.topics.values()} == full
        assert reader.counts == {name: 4 * len(names) // len(full) for name in full}
        read = list(reader.messages(full))
        assert [(f'/{n.lstrip("/")}', *rest) for n, *rest in written] == as_tuples(read)
        assert [reader.decode(message).clock.nanosec for message in read] == [
            time for _, time, *_ in written
        ]
    assert len(warnings) == (not finish)


@pytest.mark.parametrize('second', ['int32 data', '', 'builtin_interfaces/Time[] clock', 'int32['])
def test_messages_that_the_bag_defines_otherwise_than_the_first_are_left_out(tmp_path, second):
    with open(tmp_path / 'file.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        for number, text in enumerate((CLOCK_DEFINITION, second, f'# new\n{CLOCK_DEFINITION}')):
            schema = writer.register_schema(CLOCK, 'ros2msg', text.encode())
            channel = writer.register_channel('/clock', 'cdr', schema, {'number': str(number)})
            writer.add_message(channel, number, clock_message(number), number)
        writer.finish()
    warnings = []
    with BagReader(tmp_path / 'file.mcap', warnings.append) as reader:
        assert [reader.decode(each).clock.nanosec for each in reader.messages()] == [0, 2]
    (line,) = warnings
    assert line.endswith(f'1 messages of /clock are left out: {CLOCK} is defined otherwise')


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


def test_warnings_are_logged_unless_somebody_takes_them(tmp_path, caplog):
    (tmp_path / 'file.mcap').write_bytes(mcap_bytes(some_messages(20))[:-1])
    with caplog.at_level(logging.WARNING), BagReader(tmp_path / 'file.mcap'):
        pass
    assert str(tmp_path / 'file.mcap') in caplog.text


READ_ALL = """
import sys
from tactile_push.bags import BagReader
with BagReader(sys.argv[1], print) as reader:
    count = sum(len(message.data) for message in reader.messages())
with open('/proc/self/status') as status:  # getrusage counts the parent's memory too
    peak = next(line.split()[1] for line in status if line.startswith('VmHWM'))
print(count, peak)
"""


@pytest.mark.slow
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
