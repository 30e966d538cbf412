# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags cut off anywhere, with wrong bytes anywhere: read up to there, with a warning.

What is sound is known from mcap's own reader of the file before it was damaged.
"""

import io
import os
import random
import re
import struct
import tracemalloc

import lz4.frame
import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.records import Chunk, Message
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import CompressionType, Writer

from support.bag_files import SECOND, as_tuples, mcap_bytes, some_messages
from tactile_push.bags import BagError, BagReader

WRITTEN = some_messages(120)
WHOLE = mcap_bytes(WRITTEN)


def chunks_of(data):
    """Return first byte, end and messages of each chunk of a sound file."""
    summary = make_reader(io.BytesIO(data)).get_summary()
    topics = {number: channel.topic for number, channel in summary.channels.items()}
    chunks = []
    records = StreamReader(io.BytesIO(data), emit_chunks=True).records
    contents = [breakup_chunk(record) for record in records if isinstance(record, Chunk)]
    for index, content in zip(summary.chunk_indexes, contents, strict=True):
        messages = [
            (topics[each.channel_id], each.log_time, each.publish_time, each.data)
            for each in content
            if isinstance(each, Message)
        ]
        start = index.chunk_start_offset
        chunks.append((start, start + index.chunk_length, messages))
    return chunks


CHUNKS = chunks_of(WHOLE)


def read(path):
    """Return the messages of a bag and the warnings."""
    warnings = []
    with BagReader(path, warnings.append) as reader:
        messages = list(reader.messages())
        for message in messages:
            reader.decode(message)
    for line in warnings:
        assert line.startswith(str(path)) and '\n' not in line
    return as_tuples(messages), warnings


def write(path, data):
    path.write_bytes(data)
    return path


def sound_before(cut):
    """Return the messages of all chunks that end before a place in `WHOLE`."""
    return [message for _, end, messages in CHUNKS if end <= cut for message in messages]


def test_the_bag_has_what_the_tests_are_about():
    assert len(CHUNKS) > 10
    assert [message for *_, messages in CHUNKS for message in messages] == WRITTEN


def test_bag_cut_off_at_every_byte_of_its_last_chunk(tmp_path):
    start, end, messages = CHUNKS[-1]
    before = sound_before(start)
    for cut in range(start, end):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == before
        (line,) = warnings
        assert 'cut off' in line
        if cut > start:
            assert f' {cut - start} bytes' in line
    # Once the beginning of the chunk is there, it is known how long it was.
    seconds = (messages[-1][1] - before[-1][1]) / SECOND
    assert f'about {seconds:.3f} s at the end cannot be read' in line


def test_bag_cut_off_behind_its_last_chunk_lacks_nothing(tmp_path):
    for cut in (*range(CHUNKS[-1][1], len(WHOLE), 10), len(WHOLE) - 1):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == WRITTEN
        assert len(warnings) == 1
    assert 'no message is missing' in warnings[0]


def test_bag_cut_off_at_a_thousand_random_places(tmp_path):
    places = random.Random(1)
    for cut in (places.randrange(len(WHOLE)) for _ in range(1000)):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == sound_before(cut)
        assert len(warnings) == 1


@pytest.mark.parametrize('compression', [CompressionType.NONE, CompressionType.LZ4])
def test_bag_of_another_compression_cut_off(tmp_path, compression):
    whole = mcap_bytes(WRITTEN, compression=compression)
    chunks = chunks_of(whole)
    for cut in random.Random(2).sample(range(len(whole)), 200):
        found, warnings = read(write(tmp_path / 'file.mcap', whole[:cut]))
        assert found == [
            message for _, end, messages in chunks if end <= cut for message in messages
        ]
        assert len(warnings) == 1


def test_bag_without_chunks_is_read_up_to_its_last_whole_message(tmp_path):
    whole = mcap_bytes(WRITTEN, use_chunking=False)
    ends = [whole.index(data) + len(data) for *_, data in WRITTEN]
    for cut in random.Random(3).sample(range(len(whole)), 300):
        found, warnings = read(write(tmp_path / 'file.mcap', whole[:cut]))
        assert len(found) == sum(end <= cut for end in ends)
        assert found == WRITTEN[: len(found)]
        assert len(warnings) == 1


def test_compressed_file_cut_off(tmp_path):
    written = some_messages(10_000)
    mcap = mcap_bytes(written, chunk_size=2_000, compression=CompressionType.NONE)
    whole = zstandard.compress(mcap)
    lengths = set()
    for cut in random.Random(4).sample(range(20, len(whole)), 30):
        found, warnings = read(write(tmp_path / 'file.mcap.zstd', whole[:cut]))
        assert found == written[: len(found)]
        # zstd's last block has the index.
        assert len(found) == len(written) or len(warnings) == 1
        lengths.add(len(found))
    assert len(lengths) > 2


def changed(data, place, value=None):
    """Return bytes of which one is another."""
    value = data[place] ^ 0x10 if value is None else value
    return data[:place] + bytes([value]) + data[place + 1 :]


@pytest.mark.parametrize('number', [0, 5, len(CHUNKS) - 1])
def test_chunk_with_a_wrong_byte_is_left_out_of_a_closed_bag(tmp_path, number):
    start, end, lost = CHUNKS[number]
    found, warnings = read(write(tmp_path / 'file.mcap', changed(WHOLE, end - 3)))
    assert found == [message for message in WRITTEN if message not in lost]
    (line,) = warnings
    assert f'at byte {start}' in line and f'{end - start} bytes' in line


def read_up_to(path, data, place):
    """Read a bag with a damage; return the warning, which says where and how to save the rest."""
    found, warnings = read(write(path, data))
    assert found == sound_before(place)
    (line,) = warnings
    assert f'damaged at byte {place} (' in line
    assert f'the {len(data) - place} bytes from there on are not read' in line
    assert f'`mcap recover {path} -o NEW.mcap`' in line
    return line


@pytest.mark.parametrize('number', [0, 5, len(CHUNKS) - 1])
def test_unclosed_bag_is_read_up_to_a_chunk_with_a_wrong_byte(tmp_path, number):
    start, end, _ = CHUNKS[number]
    data = changed(WHOLE, end - 3)[: CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)


def test_closed_bag_with_a_wrong_index_is_read_up_to_the_first_damage(tmp_path):
    start, end, _ = CHUNKS[5]
    data = changed(changed(WHOLE, end - 3), len(WHOLE) - 40)
    assert 'the index has a wrong checksum' in read_up_to(tmp_path / 'file.mcap', data, start)


def test_bag_without_chunks_is_read_up_to_the_first_damage(tmp_path):
    whole = mcap_bytes(WRITTEN, use_chunking=False)
    # The channel of a message stands behind its opcode and length.
    place = whole.index(WRITTEN[70][-1]) - 22 - 9
    data = changed(whole, place + 9, 77)
    found, (line,) = read(write(tmp_path / 'file.mcap', data))
    assert found == WRITTEN[:70]
    assert f'damaged at byte {place} (a message of an unknown channel 77)' in line


def test_what_is_left_out_is_told_of_once(tmp_path):
    _, end, lost = CHUNKS[4]
    path = write(tmp_path / 'file.mcap', changed(WHOLE, end - 3))
    warnings = []
    with BagReader(path, warnings.append) as reader:
        assert warnings == []
        assert sum(reader.counts.values()) == len(WRITTEN)
        assert len(list(reader.messages())) == len(list(reader.messages()))
    (line,) = warnings
    times = [(message[1] - WRITTEN[0][1]) / SECOND for message in (lost[0], lost[-1])]
    assert f'from {times[0]:.3f} s to {times[1]:.3f} s' in line


def test_wrong_checksum_of_a_chunk(tmp_path):
    start, _, lost = CHUNKS[4]
    # Opcode, length, times and size come before it.
    place = start + 9 + 24
    (checksum,) = struct.unpack_from('<I', WHOLE, place)
    assert checksum != 0
    found, warnings = read(write(tmp_path / 'file.mcap', changed(WHOLE, place)))
    assert found == [message for message in WRITTEN if message not in lost]
    assert 'checksum' in warnings[0]


def test_wrong_index_is_made_anew(tmp_path):
    (summary_start,) = struct.unpack_from('<Q', WHOLE, len(WHOLE) - 8 - 20)
    for place in random.Random(5).sample(range(summary_start, len(WHOLE)), 200):
        found, warnings = read(write(tmp_path / 'file.mcap', changed(WHOLE, place)))
        assert found == WRITTEN
        # The checksum does not cover what says that there is none.
        assert len(warnings) == 1 and 'no message is missing' in warnings[0]


def test_wrong_index_without_a_checksum_is_made_anew(tmp_path):
    whole = mcap_bytes(WRITTEN, enable_crcs=False)
    index = struct.pack('<QQ', *(struct.unpack_from('<QQ', whole, chunks_of(whole)[3][0] + 9)))
    # The times of the chunk stand in the chunk first and in the index last.
    place = whole.rindex(index)
    found, warnings = read(write(tmp_path / 'file.mcap', changed(whole, place)))
    assert found == WRITTEN
    assert 'contradicts' in warnings[0] and 'no message is missing' in warnings[0]


def test_unclosed_bag_is_read_up_to_a_hole(tmp_path):
    start, end = CHUNKS[3][1], CHUNKS[5][1] - 7
    data = WHOLE[:start] + bytes(end - start) + WHOLE[end : CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)


@pytest.mark.parametrize('place', range(9))
def test_unclosed_bag_is_read_up_to_a_wrong_opcode_or_length(tmp_path, place):
    start = CHUNKS[3][0]
    data = changed(WHOLE, start + place)[: CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)


def test_wrong_attachment_does_not_matter(tmp_path):
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start('ros2')
    writer.add_attachment(1, 1, 'picture', 'image/png', b'attached')
    channel = writer.register_channel('/x', 'cdr', 0)
    writer.add_message(channel, 1, b'x', 1)
    writer.finish()
    data = stream.getvalue().replace(b'attached', b'attacked')
    warnings = []
    with BagReader(write(tmp_path / 'file.mcap', data), warnings.append) as reader:
        assert [message.data for message in reader.messages()] == [b'x']
    assert warnings == []


@pytest.mark.parametrize('size', [0, 1, 7])
def test_file_of_less_than_its_first_bytes_is_an_empty_bag(tmp_path, size):
    found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:size]))
    assert found == []
    assert f'{size} bytes' in warnings[0]


def test_a_damaged_bag_stays_as_it_is(tmp_path):
    path = write(tmp_path / 'file.mcap', changed(WHOLE, CHUNKS[3][1] - 3)[:-20])
    os.chmod(path, 0o444)
    before = path.stat()
    read(path)
    assert path.read_bytes() == changed(WHOLE, CHUNKS[3][1] - 3)[:-20]
    after = path.stat()
    assert (after.st_mtime_ns, after.st_mode) == (before.st_mtime_ns, before.st_mode)
    assert list(tmp_path.iterdir()) == [path]


def try_to_read(path):
    """Return what `read` returns, and None if it refuses the bag in a line."""
    try:
        return read(path)
    except BagError as error:
        assert re.fullmatch('[^\n]+', str(error)) and str(path) in str(error)
        return None


def test_one_wrong_byte_anywhere_is_never_silent_and_never_believed(tmp_path):
    for place in (*range(8), *random.Random(6).sample(range(8, len(WHOLE)), 1000)):
        result = try_to_read(write(tmp_path / 'file.mcap', changed(WHOLE, place)))
        if result is None:
            assert place < 8  # the file does not begin as MCAP files do
            continue
        found, warnings = result
        assert set(found) <= set(WRITTEN)
        assert found == sorted(found, key=lambda message: message[1])
        assert found == WRITTEN or warnings


KINDS = {
    'zstd': WHOLE,
    'lz4': mcap_bytes(WRITTEN, compression=CompressionType.LZ4),
    'none': mcap_bytes(WRITTEN, compression=CompressionType.NONE),
    'no checksums': mcap_bytes(WRITTEN, compression=CompressionType.NONE, enable_crcs=False),
    'no chunks': mcap_bytes(WRITTEN, use_chunking=False, enable_crcs=False),
    'file': zstandard.compress(WHOLE),
}

DAMAGE = st.tuples(
    st.sampled_from(['put', 'insert', 'delete', 'cut', 'copy']),
    st.floats(0, 1, exclude_max=True),
    st.binary(min_size=1, max_size=9) | st.sampled_from([b'\xff' * 8, bytes(8), b'\xff' * 4]),
    st.integers(1, 300),
)


def damaged(data, damages):
    """Return bytes after what has happened to them."""
    for what, where, new, size in damages:
        place = int(where * len(data))
        if what == 'put':
            data = data[:place] + new + data[place + len(new) :]
        elif what == 'insert':
            data = data[:place] + new + data[place:]
        elif what == 'delete':
            data = data[:place] + data[place + size :]
        elif what == 'cut':
            data = data[: max(place, 8)]
        else:
            data = data[:place] + data[place // 2 : place // 2 + size] + data[place:]
    return data


@pytest.mark.parametrize('kind', KINDS)
@settings(deadline=None)
@given(st.lists(DAMAGE, min_size=1, max_size=4))
def test_any_damage_ends_in_messages_or_in_one_line(tmp_path_factory, kind, damages):
    folder = tmp_path_factory.getbasetemp()
    path = folder / ('fuzz.mcap.zstd' if kind == 'file' else 'fuzz.mcap')
    write(path, damaged(KINDS[kind], damages))
    tracemalloc.start()
    try:
        result = try_to_read(path)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2e7
    if result is not None and kind in ('zstd', 'lz4', 'none', 'file'):
        assert set(result[0]) <= set(WRITTEN)


def chunk_record(compression, content, size):
    """Return a chunk record as it stands in a file."""
    body = struct.pack('<QQQI', 0, 1, size, 0)
    body += struct.pack('<I', len(compression)) + compression
    body += struct.pack('<Q', len(content)) + content
    return struct.pack('<BQ', 6, len(body)) + body


def zeros(size, *, told):
    """Return very many zeros in zstd, which tells their number or not."""
    packer = zstandard.ZstdCompressor(write_content_size=told).compressobj(size=size)
    piece = bytes(10**6)
    return b''.join(packer.compress(piece) for _ in range(size // len(piece))) + packer.flush()


BOMBS = {
    'zstd, told': (b'zstd', zeros(3 * 10**8, told=True), 3 * 10**8),
    'zstd, not told': (b'zstd', zeros(3 * 10**8, told=True), 100),
    'zstd, of no size': (b'zstd', zeros(3 * 10**8, told=False), 100),
    'lz4, not told': (b'lz4', lz4.frame.compress(bytes(3 * 10**7)), 100),
    'a huge size': (b'zstd', zstandard.compress(b''), 2**63),
    'a huge size of lz4': (b'lz4', lz4.frame.compress(b''), 2**63),
}


@pytest.mark.parametrize('bomb', BOMBS.values(), ids=BOMBS)
def test_what_would_fill_the_memory_is_not_read(tmp_path, bomb):
    record = chunk_record(*bomb)
    data = WHOLE[: CHUNKS[2][1]] + record + WHOLE[CHUNKS[3][0] : CHUNKS[-1][1]]
    tracemalloc.start()
    try:
        read_up_to(tmp_path / 'file.mcap', data, CHUNKS[2][1])
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2e7
