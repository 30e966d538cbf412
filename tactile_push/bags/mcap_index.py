# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The index at the end of an MCAP file that was closed."""

import zlib
from collections.abc import Iterator
from typing import Any

from mcap.opcode import Opcode
from mcap.records import (
    Channel,
    ChunkIndex,
    Footer,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
)

from tactile_push.bags.mcap_contents import NOTES, Contents, Piece
from tactile_push.bags.mcap_records import (
    HEADER,
    LARGEST_RECORD,
    MAGIC,
    DamageError,
    chunk_times,
    parse,
)
from tactile_push.bags.mcap_sources import Source

_FOOTER_LENGTH = HEADER.size + 20

# How much is read at once for the checksum [bytes].
_STEP = 1 << 20

_KINDS: dict[int, Any] = {
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
    Opcode.STATISTICS: Statistics,
    Opcode.CHUNK_INDEX: ChunkIndex,
    Opcode.METADATA_INDEX: MetadataIndex,
}


def read_index(source: Source) -> Contents | None:
    """Return what a file contains by its own account.

    Parameters
    ----------
    source : Source
        The file.

    Returns
    -------
    Contents or None
        None if the writer has left out a part of the index that is needed.

    Raises
    ------
    DamageError
        If there ought to be an index and is none that can be believed.
    """
    if source.size is None:
        return None
    end = source.size - _FOOTER_LENGTH - len(MAGIC)
    tail = source.read(max(end, 0), _FOOTER_LENGTH + len(MAGIC))
    if (
        end < len(MAGIC)
        or not tail.endswith(MAGIC)
        or HEADER.unpack_from(tail) != (Opcode.FOOTER, 20)
    ):
        raise DamageError('not closed or cut off')
    footer = parse(Footer, tail[HEADER.size : _FOOTER_LENGTH])
    start = footer.summary_start
    if start == 0:
        return None
    if not len(MAGIC) < start <= end:
        raise DamageError('the index is not where the footer says')
    # It covers the footer but for itself.
    if footer.summary_crc not in (0, _checksum(source, start, end, tail[: _FOOTER_LENGTH - 4])):
        raise DamageError('the index has a wrong checksum')
    return _Index(source, start, bool(footer.summary_crc)).read(end)


def _checksum(source: Source, start: int, end: int, tail: bytes) -> int:
    checksum = 0
    for place in range(start, end, _STEP):
        checksum = zlib.crc32(source.read(place, min(_STEP, end - place)), checksum)
    return zlib.crc32(tail, checksum)


class _Index:
    """An index that is being read, with a checksum or without one."""

    def __init__(self, source: Source, start: int, has_checksum: bool) -> None:
        self._source = source
        self._start = start
        self._has_checksum = has_checksum
        self._contents = Contents()
        self._statistics: Statistics | None = None
        # A long bag has many chunks and few sets of topics in them.
        self._sets: dict[frozenset[int], frozenset[int]] = {}

    def read(self, end: int) -> Contents | None:
        """Return what the records up to `end` tell, None if that is not enough."""
        contents = self._contents
        for record in self._records(end):
            if isinstance(record, Schema):
                contents.schemas[record.id] = record
            elif isinstance(record, Channel):
                contents.channels[record.id] = record
            elif isinstance(record, Statistics):
                self._statistics = record
            elif isinstance(record, ChunkIndex):
                contents.pieces.append(self._piece(record))
            elif isinstance(record, MetadataIndex) and record.name in NOTES:
                contents.metadata.append(self._metadata(record))
        contents.pieces.sort(key=lambda piece: piece.offset)
        statistics = self._statistics
        if statistics is None or not self._is_complete(statistics):
            return None
        if statistics.message_count:
            contents.start = statistics.message_start_time
            contents.end = statistics.message_end_time
        contents.counts.update(statistics.channel_message_counts)
        return contents

    def _records(self, end: int) -> Iterator[object]:
        place = self._start
        while place < end:
            header = self._source.read(place, HEADER.size)
            place += HEADER.size
            if place > end:
                raise DamageError('the index breaks off')
            opcode, length = HEADER.unpack(header)
            if length > min(end - place, LARGEST_RECORD):
                raise DamageError('the index breaks off')
            if opcode in _KINDS:
                yield parse(_KINDS[opcode], self._source.read(place, length))
            place += length

    def _piece(self, index: ChunkIndex) -> Piece:
        channels = frozenset(index.message_index_offsets)
        piece = Piece(
            index.chunk_start_offset,
            index.chunk_length,
            index.message_start_time,
            index.message_end_time,
            self._sets.setdefault(channels, channels),
            True,
        )
        if not len(MAGIC) < piece.offset < piece.offset + piece.length <= self._start:
            raise DamageError('the index has a chunk outside of the file')
        if not self._has_checksum:
            head = self._source.read(piece.offset, HEADER.size + 16)
            if HEADER.unpack_from(head) != (
                Opcode.CHUNK,
                piece.length - HEADER.size,
            ) or chunk_times(head[HEADER.size :]) != (piece.start, piece.end):
                raise DamageError('the index contradicts a chunk')
        return piece

    def _metadata(self, index: MetadataIndex) -> Metadata:
        length = index.length - HEADER.size
        if not 0 < length <= LARGEST_RECORD:
            raise DamageError('the index has metadata where none are')
        data = self._source.read(index.offset, index.length)
        if data[: HEADER.size] != HEADER.pack(Opcode.METADATA, length):
            raise DamageError('the index has metadata where none are')
        return parse(Metadata, data[HEADER.size :])

    def _is_complete(self, statistics: Statistics) -> bool:
        """Tell whether it has all that is needed: a writer may leave out parts of it."""
        contents = self._contents
        return (
            statistics.chunk_count == len(contents.pieces) >= min(statistics.message_count, 1)
            and statistics.channel_count == len(contents.channels)
            and statistics.message_count == sum(statistics.channel_message_counts.values())
            and statistics.channel_message_counts.keys() <= contents.channels.keys()
            and all(piece.channels <= contents.channels.keys() for piece in contents.pieces)
            and all(
                channel.schema_id == 0 or channel.schema_id in contents.schemas
                for channel in contents.channels.values()
            )
        )
