# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in an MCAP file according to the index at its end."""

import zlib

from mcap.opcode import Opcode
from mcap.records import Channel, ChunkIndex, Footer, Metadata, MetadataIndex, Schema, Statistics

from tactile_push.bags.mcap_contents import NOTES, Contents, Piece
from tactile_push.bags.mcap_records import (
    HEADER,
    LARGEST_RECORD,
    MAGIC,
    DamageError,
    chunk_times,
    parse,
    records,
)
from tactile_push.bags.sources import Source

_FOOTER_LENGTH = HEADER.size + 20


def read_index(source: Source) -> Contents | None:
    """Return what a closed file says it contains; None if its writer left out what is needed."""
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
    footer = parse(Footer, tail)
    begin = footer.summary_start
    if begin == 0:
        return None
    if not len(MAGIC) < begin <= end:
        raise DamageError('the index is not where the footer says')
    data = source.read(begin, source.size - begin)
    # The checksum covers the index and the footer up to the checksum itself.
    checked = len(data) - len(MAGIC) - 4
    if footer.summary_crc not in (0, zlib.crc32(memoryview(data)[:checked])):
        raise DamageError('the index has a wrong checksum')
    contents = Contents()
    statistics = None
    channels_of: dict[frozenset[int], frozenset[int]] = {}  # equal sets are kept once
    for record in records(data):
        if isinstance(record, Schema):
            contents.schemas[record.id] = record
        elif isinstance(record, Channel):
            contents.channels[record.id] = record
        elif isinstance(record, Statistics):
            statistics = record
        elif isinstance(record, ChunkIndex):
            channels = frozenset(record.message_index_offsets)
            piece = Piece(
                record.chunk_start_offset,
                record.chunk_length,
                record.message_start_time,
                record.message_end_time,
                channels_of.setdefault(channels, channels),
                True,
            )
            _check_piece(piece, source, begin, thoroughly=not footer.summary_crc)
            contents.pieces.append(piece)
        elif isinstance(record, MetadataIndex) and record.name in NOTES:
            length = min(record.length, LARGEST_RECORD)
            contents.metadata.append(parse(Metadata, source.read(record.offset, length)))
    contents.pieces.sort(key=lambda piece: piece.offset)
    if statistics is None or not _is_complete(contents, statistics):
        return None
    if statistics.message_count:
        contents.start = statistics.message_start_time
        contents.end = statistics.message_end_time
    contents.counts.update(statistics.channel_message_counts)
    return contents


def _check_piece(piece: Piece, source: Source, end: int, thoroughly: bool) -> None:
    """Check that there is a chunk where the index says; look at it if the index has no checksum."""
    room = end - piece.offset
    if not (len(MAGIC) < piece.offset and HEADER.size < piece.length <= room):
        raise DamageError('the index has a chunk outside of the file')
    if thoroughly:
        head = source.read(piece.offset, HEADER.size + 16)
        length = piece.length - HEADER.size
        if head[: HEADER.size] != HEADER.pack(Opcode.CHUNK, length) or chunk_times(head) != (
            piece.start,
            piece.end,
        ):
            raise DamageError('the index contradicts a chunk')


def _is_complete(contents: Contents, statistics: Statistics) -> bool:
    """Return whether an index has all that is needed: a writer may leave out parts of it."""
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
