# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Records of an MCAP file (https://mcap.dev/spec) from bytes that may be damaged.

The `mcap` package parses records. It trusts the lengths that it reads, and takes several
microseconds for a message; here lengths are checked first, and messages are split off quickly.
"""

import contextlib
import struct
import zlib
from collections.abc import Iterator
from io import BytesIO
from typing import TypeVar

import lz4.frame
import zstandard
from mcap.records import Chunk, McapRecord
from mcap.stream_reader import StreamReader

MAGIC = b'\x89MCAP0\r\n'

HEADER = struct.Struct('<BQ')  # opcode, length
_TIMES, _LENGTH, _SIZE = struct.Struct('<QQ'), struct.Struct('<I'), struct.Struct('<Q')
MESSAGE = struct.Struct('<HIQQ')  # channel, sequence, log time, publish time

# Size of a chunk record besides the name of its compression and its content [bytes].
_CHUNK_FIELDS = HEADER.size + 40

# The longest chunk, packed or not, the longest message outside of one, and the longest record of
# any other kind. A longer one is damaged: nobody can tell before its memory is allocated [bytes].
LARGEST_CHUNK = 1 << 28
LARGEST_RECORD = 1 << 26

_ZSTD_MAGIC = b'\x28\xb5\x2f\xfd'

_Record = TypeVar('_Record', bound=McapRecord)


class DamageError(Exception):
    """Bytes that are not what they ought to be."""


def records(data: bytes) -> Iterator[McapRecord]:
    """Parse records that follow one another, chunks unopened."""
    try:
        reader = StreamReader(BytesIO(data), skip_magic=True, emit_chunks=True)
        yield from reader.records
    except Exception as error:  # mcap checks little, so anything may come
        raise DamageError(f'no MCAP record: {error!r}') from None


def parse(kind: type[_Record], data: bytes) -> _Record:
    """Return the record of some kind that begins some bytes."""
    record = next(records(data), None)
    if not isinstance(record, kind):
        raise DamageError(f'expected a {kind.__name__} record, got {type(record).__name__}')
    return record


def split(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Split records that follow one another into opcode, start and end of the body of each."""
    position, end = 0, len(data)
    unpack = HEADER.unpack_from
    while position < end:
        if position + 9 > end:
            raise DamageError('a record is cut off')
        opcode, length = unpack(data, position)
        stop = position + 9 + length
        if stop > end:
            raise DamageError('a record is longer than what it lies in')
        yield opcode, position + 9, stop
        position = stop


def chunk_times(data: bytes) -> tuple[int, int] | None:
    """Return first and last log time of a chunk [ns], None if it is cut off before they end."""
    if len(data) < HEADER.size + 16:
        return None
    with contextlib.suppress(struct.error):  # where it is cut off
        (name_length,) = _LENGTH.unpack_from(data, HEADER.size + 28)
        (size,) = _SIZE.unpack_from(data, HEADER.size + 32 + name_length)
        _check_length(HEADER.unpack_from(data)[1] + HEADER.size, name_length, size)
    start, end = _TIMES.unpack_from(data, HEADER.size)
    return start, end


def chunk_content(data: bytes) -> bytes:
    """Return the records in a chunk record."""
    chunk = parse(Chunk, data)
    _check_length(len(data), len(chunk.compression), len(chunk.data))
    size = chunk.uncompressed_size
    if size > LARGEST_CHUNK:
        raise DamageError(f'expected a chunk of at most {LARGEST_CHUNK} bytes, got {size}')
    if chunk.compression == 'zstd':
        content = _unzstd(chunk.data, size)
    elif chunk.compression == 'lz4':
        content = _unlz4(chunk.data, size)
    elif chunk.compression == '':
        content = chunk.data
    else:
        raise DamageError(f'compression: expected zstd, lz4 or none, got {chunk.compression!r}')
    if len(content) != size:
        raise DamageError(f'expected {size} bytes in the chunk, got {len(content)}')
    if chunk.uncompressed_crc not in (0, zlib.crc32(content)):
        raise DamageError('wrong checksum')
    return content


def _check_length(record: int, name: int, content: int) -> None:
    if record != _CHUNK_FIELDS + name + content:
        raise DamageError('the length of the chunk contradicts that of its content')


def message_content(data: bytes) -> bytes:
    """Return a message that rosbag2 has compressed with zstd."""
    if data[:4] != _ZSTD_MAGIC:
        raise DamageError('a message is not compressed though the metadata say so')
    try:
        size = zstandard.frame_content_size(data)
    except zstandard.ZstdError as error:
        raise DamageError(str(error)) from None
    return _unzstd(data, LARGEST_RECORD if size < 0 else size)


def _unzstd(data: bytes, size: int) -> bytes:
    try:
        # zstd allocates the size that stands in the frame.
        if zstandard.frame_content_size(data) not in (-1, size) or size > LARGEST_CHUNK:
            raise DamageError('the size is not that of the zstd frame')
        return zstandard.ZstdDecompressor().decompress(data, max_output_size=size)
    except (zstandard.ZstdError, MemoryError) as error:
        raise DamageError(f'zstd: {error}') from None


def _unlz4(data: bytes, size: int) -> bytes:
    try:
        return lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=size)
    except (RuntimeError, ValueError, EOFError, MemoryError) as error:
        raise DamageError(f'lz4: {error}') from None
