# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A wrong index is never believed."""

import io
import random
import struct

import pytest
from mcap.writer import Writer

from support.bag_damage import (
    CHUNKS,
    WHOLE,
    WRITTEN,
    changed,
    chunks_of,
    read,
    read_up_to,
    write,
)
from support.bag_files import mcap_bytes
from tactile_push.bags import BagReader


@pytest.mark.slow
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


@pytest.mark.parametrize('length', [0, 8, 9, 2**64 - 1])
def test_index_of_a_chunk_that_cannot_be_so_long_is_made_anew(tmp_path, length):
    whole = mcap_bytes(WRITTEN, enable_crcs=False)
    index = struct.pack('<QQ', *(struct.unpack_from('<QQ', whole, chunks_of(whole)[3][0] + 9)))
    place = whole.rindex(index) + 24  # behind two times and the offset
    data = whole[:place] + struct.pack('<Q', length) + whole[place + 8 :]
    found, warnings = read(write(tmp_path / 'file.mcap', data))
    assert found == WRITTEN
    assert 'outside of the file' in warnings[0] and 'no message is missing' in warnings[0]


def test_closed_bag_with_a_wrong_index_is_read_up_to_the_first_damage(tmp_path):
    start, end, _ = CHUNKS[5]
    data = changed(changed(WHOLE, end - 3), len(WHOLE) - 40)
    assert 'the index has a wrong checksum' in read_up_to(tmp_path / 'file.mcap', data, start)


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
