# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in an MCAP file: its topics, how many messages they have, and where these lie."""

from collections import Counter
from dataclasses import dataclass, field

from mcap.opcode import Opcode
from mcap.records import Channel, McapRecord, Metadata, Schema

from tactile_push.bags.mcap_records import HEADER, MESSAGE, DamageError, records, split

# Names of the metadata records that are read.
NOTES = ('rosbag2', 'tactile_push')

# Records that chunks consist of. Some writers make no chunks; then they lie loose in the file.
LOOSE = (Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE)


@dataclass(frozen=True, slots=True)
class Piece:
    """Bytes of a file that are read at once: a chunk, or records without a chunk around them."""

    offset: int
    length: int
    start: int  # first log time [ns]
    end: int  # last log time [ns]
    channels: frozenset[int]  # with messages in it; empty if unknown
    is_chunk: bool


@dataclass
class Contents:
    """What is in a file; `end` is before `start` if there are no messages."""

    schemas: dict[int, Schema] = field(default_factory=dict)  # by schema number
    channels: dict[int, Channel] = field(default_factory=dict)  # by channel number
    counts: Counter[int] = field(default_factory=Counter)  # messages by channel number
    start: int = 2**64  # first log time [ns]
    end: int = -1  # last log time [ns]
    pieces: list[Piece] = field(default_factory=list)  # with messages, in the order of the file
    metadata: list[Metadata] = field(default_factory=list)  # of rosbag2 and of this package

    def survey(self, data: bytes, offset: int, length: int, is_chunk: bool) -> int:
        """Take in the records of a piece of the file; return how long it is.

        A chunk is taken in whole or not at all, records without one up to the first that is
        damaged or of another kind.
        """
        found = Contents(dict(self.schemas), dict(self.channels))
        counts = dict.fromkeys(self.channels, 0)
        start, end, sound = found.start, found.end, 0
        unpack = MESSAGE.unpack_from
        try:
            for opcode, first, last in split(data):
                if opcode == Opcode.MESSAGE:
                    if last - first < MESSAGE.size:
                        raise DamageError('a message is cut off')
                    number, _, time, _ = unpack(data, first)
                    if number not in counts:
                        if number not in found.channels:
                            raise DamageError(f'a message of an unknown channel {number}')
                        counts[number] = 0
                    counts[number] += 1
                    start = min(start, time)
                    end = max(end, time)
                elif opcode in LOOSE:
                    found._define(next(records(data[first - HEADER.size : last])))
                elif not is_chunk:
                    break
                sound = last
        except DamageError:
            if is_chunk or not sound:
                raise
        length = length if is_chunk else sound
        self.schemas, self.channels = found.schemas, found.channels
        counts = {number: count for number, count in counts.items() if count}
        if counts:
            self.counts.update(counts)
            self.start, self.end = min(self.start, start), max(self.end, end)
            self.pieces.append(Piece(offset, length, start, end, frozenset(counts), is_chunk))
        return length

    def _define(self, record: McapRecord) -> None:
        if isinstance(record, Schema):
            if self.schemas.setdefault(record.id, record) != record:
                raise DamageError(f'schema {record.id} is defined twice')
        elif isinstance(record, Channel):
            if record.schema_id and record.schema_id not in self.schemas:
                raise DamageError(f'{record.topic} has an unknown schema')
            if self.channels.setdefault(record.id, record) != record:
                raise DamageError(f'channel {record.id} is defined twice')
