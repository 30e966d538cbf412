# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Records of an MCAP file out of bytes that may be damaged (https://mcap.dev/spec)."""

import re
import struct
import zlib
from collections.abc import Iterator
from io import BytesIO
from typing import Protocol, TypeVar

import lz4.frame
import zstandard
from mcap.data_stream import ReadDataStream

MAGIC = b'\x89MCAP0\r\n'

HEADER = struct.Struct('<BQ')  # opcode, length
MESSAGE = struct.Struct('<HIQQ')  # channel, sequence, log time, publish time

# What a chunk, or a message outside of one, may take at most; above that a length is taken for
# damaged, for it would be believed blindly [bytes].
LARGEST_CHUNK = 1 << 28

# The same of any other record.
LARGEST_RECORD = 1 << 26

# First and last log time, size and checksum of the content, length of the compression's name.
_CHUNK = struct.Struct('<QQQII')
_SIZE = struct.Struct('<Q')

# Opcode, length and the fields of a chunk up to its content, and how long they are at most. Ahead
# of the place, since one may seem to begin within another.
_CHUNK_HEAD = re.compile(
    rb'\x06(?=(.{8}).{28}(\x04\0\0\0zstd|\x03\0\0\0lz4|\0\0\0\0)(.{8}))', re.DOTALL
)
CHUNK_HEAD_LENGTH = 9 + 28 + 8 + 8

_ZSTD_MAGIC = b'\x28\xb5\x2f\xfd'

_Record = TypeVar('_Record', covariant=True)


class DamageError(Exception):
    """Bytes that are not what they ought to be."""


class _Readable(Protocol[_Record]):
    @staticmethod
    def read(stream: ReadDataStream) -> _Record: ...


def parse(kind: _Readable[_Record], body: bytes) -> _Record:
    """Return a record of mcap's out of its bytes.

    Parameters
    ----------
    kind : type
        Class of `mcap.records`.
    body : bytes
        What follows the record's opcode and length.

    Raises
    ------
    DamageError
        If it is not such a record.
    """
    try:
        return kind.read(ReadDataStream(BytesIO(body)))
    except Exception as error:  # mcap checks nothing, so anything may come
        raise DamageError(f'no {getattr(kind, "__name__", kind)} record: {error!r}') from None


def split(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Go through records that follow one another.

    Parameters
    ----------
    data : bytes
        The records.

    Yields
    ------
    opcode, start, stop : int
        What it is and where its body lies in `data`.

    Raises
    ------
    DamageError
        Where a record does not fit in.
    """
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


def chunk_times(body: bytes) -> tuple[int, int]:
    """Return first and last log time of a chunk by its own account [ns].

    Parameters
    ----------
    body : bytes
        The chunk record behind opcode and length; its beginning is enough.
    """
    if len(body) < 16:
        raise DamageError('the chunk is cut off')
    start, end = struct.unpack_from('<QQ', body)
    return start, end


def find_chunk(data: bytes, *, at_start: bool = False) -> int | None:
    """Return where a chunk record begins, whose length and content's length agree; None if nowhere.

    Parameters
    ----------
    data : bytes
        Part of a file.
    at_start : bool
        Whether only the beginning counts.
    """
    for head in [_CHUNK_HEAD.match(data)] if at_start else _CHUNK_HEAD.finditer(data):
        if head is not None:
            (length,), (content_length,) = _SIZE.unpack(head[1]), _SIZE.unpack(head[3])
            if length == 28 + len(head[2]) + 8 + content_length:
                return head.start()
    return None


def chunk_content(body: bytes) -> bytes:
    """Return the records in a chunk.

    Parameters
    ----------
    body : bytes
        The chunk record behind opcode and length.

    Raises
    ------
    DamageError
        If they are not those that were written.
    """
    try:
        _, _, size, checksum, name_length = _CHUNK.unpack_from(body)
        start = _CHUNK.size + name_length
        compression = body[_CHUNK.size : start]
        (compressed_size,) = _SIZE.unpack_from(body, start)
    except struct.error:
        raise DamageError('the chunk is cut off') from None
    content = body[start + 8 :]
    if len(content) != compressed_size:
        raise DamageError(f'{len(content)} bytes in the chunk, expected {compressed_size}')
    if size > LARGEST_CHUNK:
        raise DamageError(f'a chunk of {size} bytes, expected at most {LARGEST_CHUNK}')
    if compression == b'zstd':
        content = _unzstd(content, size)
    elif compression == b'lz4':
        content = _unlz4(content, size)
    elif compression:
        raise DamageError(f'unknown compression {compression!r}, expected zstd, lz4 or none')
    if len(content) != size:
        raise DamageError(f'{len(content)} bytes in the chunk, expected {size}')
    if checksum not in (0, zlib.crc32(content)):
        raise DamageError('wrong checksum')
    return content


def message_content(data: bytes) -> bytes:
    """Return a message that rosbag2 has compressed.

    Parameters
    ----------
    data : bytes
        A zstd frame.

    Raises
    ------
    DamageError
        If it is none.
    """
    if data[:4] != _ZSTD_MAGIC:
        raise DamageError('a message is not compressed as the metadata says')
    try:
        size = zstandard.frame_content_size(data)
    except zstandard.ZstdError as error:
        raise DamageError(str(error)) from None
    return _unzstd(data, LARGEST_RECORD if size < 0 else size)


def _unzstd(data: bytes, size: int) -> bytes:
    try:
        # The size that the frame tells itself is what would be allocated.
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
