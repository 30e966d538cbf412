# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag to be cut off or damaged, and what is sound in it by the account of mcap's own reader."""

import io

from mcap.reader import make_reader
from mcap.records import Chunk, Message
from mcap.stream_reader import StreamReader, breakup_chunk

from support.bag_files import as_tuples, mcap_bytes, some_messages
from tactile_push.bags import BagReader

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


def changed(data, place, value=None):
    """Return bytes of which one is another."""
    value = data[place] ^ 0x10 if value is None else value
    return data[:place] + bytes([value]) + data[place + 1 :]


def read_up_to(path, data, place):
    """Read a bag with a damage; return the warning, which says where and how to save the rest."""
    found, warnings = read(write(path, data))
    assert found == sound_before(place)
    (line,) = warnings
    assert f'damaged at byte {place} (' in line
    assert f'the {len(data) - place} bytes from there on are not read' in line
    assert f'`mcap recover {path} -o NEW.mcap`' in line
    return line
