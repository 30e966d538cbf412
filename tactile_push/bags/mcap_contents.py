# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What there is in an MCAP file."""

from collections import Counter
from dataclasses import dataclass, field

from mcap.opcode import Opcode
from mcap.records import Channel, Metadata, Schema

from tactile_push.bags.mcap_records import MESSAGE, DamageError, parse, split

# Metadata records that somebody asks for.
NOTES = frozenset(['rosbag2', 'tactile_push'])


@dataclass(frozen=True, slots=True)
class Piece:
    """Part of a file that is read at once.

    Parameters
    ----------
    offset, length : int
        Where it lies in the file.
    start, end : int
        First and last log time [ns].
    channels : frozenset of int
        Channels with messages in it; empty if that is not known.
    is_chunk : bool
        Whether it is a chunk, and not records without one around them.
    """

    offset: int
    length: int
    start: int
    end: int
    channels: frozenset[int]
    is_chunk: bool


@dataclass
class Contents:
    """What there is in a file or in part of one.

    Parameters
    ----------
    schemas : dict of int to Schema
        By schema number.
    channels : dict of int to Channel
        By channel number.
    counts : Counter of int
        Messages by channel number.
    start, end : int
        First and last log time [ns]; end is before start if there are no messages.
    pieces : list of Piece
        Parts with messages, in the order of the file.
    metadata : list of Metadata
        Metadata records of rosbag2 and of this package.
    """

    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    counts: Counter[int] = field(default_factory=Counter)
    start: int = 2**64
    end: int = -1
    pieces: list[Piece] = field(default_factory=list)
    metadata: list[Metadata] = field(default_factory=list)

    def survey(self, data: bytes, offset: int, length: int, is_chunk: bool) -> int:
        """Take in what there is in further records.

        Parameters
        ----------
        data : bytes
            Schemas, channels and messages.
        offset, length : int
            Where they lie in the file, packed if it is a chunk.
        is_chunk : bool
            Whether they are the content of a chunk.

        Returns
        -------
        int
            How many of them make no sense, which only loose ones may.

        Raises
        ------
        DamageError
            If records of a chunk make no sense: then nothing of it is taken in.
        """
        found = Contents(dict(self.schemas), dict(self.channels))
        counts = dict.fromkeys(self.channels, 0)
        start, end, bad = found.start, found.end, 0
        unpack = MESSAGE.unpack_from
        for opcode, first, last in split(data):
            try:
                if opcode != Opcode.MESSAGE:
                    found._define(opcode, data[first:last])
                    continue
                if last - first < MESSAGE.size:
                    raise DamageError('a message is cut off')
                number, _, time, _ = unpack(data, first)
                if number not in counts:
                    if number not in found.channels:
                        raise DamageError(f'a message of an unknown channel {number}')
                    counts[number] = 0
            except DamageError:
                if is_chunk:
                    raise
                bad += 1
                continue
            counts[number] += 1
            start = min(start, time)
            end = max(end, time)
        self.schemas, self.channels = found.schemas, found.channels
        counts = {number: count for number, count in counts.items() if count}
        if counts:
            self.counts.update(counts)
            self.start, self.end = min(self.start, start), max(self.end, end)
            self.pieces.append(Piece(offset, length, start, end, frozenset(counts), is_chunk))
        return bad

    def _define(self, opcode: int, body: bytes) -> None:
        if opcode == Opcode.CHANNEL:
            channel = parse(Channel, body)
            if channel.schema_id and channel.schema_id not in self.schemas:
                raise DamageError(f'{channel.topic} has an unknown schema')
            if self.channels.setdefault(channel.id, channel) != channel:
                raise DamageError(f'channel {channel.id} is not what it was')
        elif opcode == Opcode.SCHEMA:
            schema = parse(Schema, body)
            if self.schemas.setdefault(schema.id, schema) != schema:
                raise DamageError(f'schema {schema.id} is not what it was')
