# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Chunks with a wrong checksum, and chunks that would fill the memory."""

import struct
import tracemalloc

import lz4.frame
import pytest
import zstandard

from support.bag_damage import CHUNKS, WHOLE, WRITTEN, changed, read, read_up_to, write


def test_wrong_checksum_of_a_chunk(tmp_path):
    start, _, lost = CHUNKS[4]
    # Opcode, length, times and size come before it.
    place = start + 9 + 24
    (checksum,) = struct.unpack_from('<I', WHOLE, place)
    assert checksum != 0
    found, warnings = read(write(tmp_path / 'file.mcap', changed(WHOLE, place)))
    assert found == [message for message in WRITTEN if message not in lost]
    assert 'checksum' in warnings[0]


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
