# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in an MCAP file without an index: one that was cut off, or that lost it."""

from pathlib import Path

from mcap.opcode import Opcode
from mcap.records import Metadata

from tactile_push.bags.mcap_contents import LOOSE, NOTES, Contents
from tactile_push.bags.mcap_records import (
    HEADER,
    LARGEST_CHUNK,
    LARGEST_RECORD,
    MAGIC,
    DamageError,
    chunk_content,
    chunk_times,
    parse,
)
from tactile_push.bags.sources import Source

# Opcode and length of the records behind the last message.
_ENDS = ((Opcode.DATA_END, 4), (Opcode.FOOTER, 20))

# Opcodes that MCAP has given to records; those from 128 on are left to whoever writes the file.
_KNOWN = range(Opcode.HEADER, Opcode.DATA_END + 1)

# How many bytes of records without a chunk are read at once; as many as a usual chunk has.
_WINDOW = 1 << 20


def scan(source: Source, path: Path) -> tuple[Contents, str]:
    """Read a file up to where it ends, is cut off or damaged; say what is missing behind that."""
    look = _Scan(source)
    try:
        while look.take_record():
            pass
    except DamageError as error:
        left = '' if source.size is None else f'{source.size - look.offset} '
        return look.contents, (
            f'damaged at byte {look.offset} ({error}): the {left}bytes from there on are not read; '
            f"MCAP's command `mcap recover {path} -o NEW.mcap` saves what is sound in them"
        )
    return look.contents, look.losses


class _Scan:
    """How far a file has been read, and what was in it."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self.offset = len(MAGIC)
        self.contents = Contents()
        self.losses = ''

    def take_record(self) -> bool:
        """Take in the next record, or several without a chunk; return whether there may be more."""
        header = self._source.read(self.offset, HEADER.size)
        if len(header) < HEADER.size:
            return self._end(header)
        opcode, length = HEADER.unpack(header)
        if (opcode, length) in _ENDS:
            return False
        if opcode not in _KNOWN and opcode < 128:
            raise DamageError('no record')
        size = HEADER.size + length
        is_loose = opcode in LOOSE
        if is_loose or opcode in (Opcode.CHUNK, Opcode.METADATA):
            if size > (LARGEST_RECORD if opcode == Opcode.METADATA else LARGEST_CHUNK):
                raise DamageError(f'a record of {size} bytes')
            data = self._source.read(self.offset, max(size, _WINDOW) if is_loose else size)
            if len(data) < size:
                return self._end(data)
            size = self._take(opcode, data)
        elif self._source.size is not None and self.offset + size > self._source.size:
            return self._end(header)
        self.offset += size
        return True

    def _take(self, opcode: int, data: bytes) -> int:
        """Take in what begins some bytes; return how many of them that is."""
        contents = self.contents
        if opcode == Opcode.METADATA:
            record = parse(Metadata, data)
            if record.name in NOTES:
                contents.metadata.append(record)
            return len(data)
        if opcode == Opcode.CHUNK:
            return contents.survey(chunk_content(data), self.offset, len(data), True)
        # Writers make chunks or none: behind a chunk this is the inside of another, whose
        # beginning is damaged and whose checksum does not cover this.
        if any(piece.is_chunk for piece in contents.pieces[-1:]):
            raise DamageError('a message outside of the chunks')
        return contents.survey(data, self.offset, len(data), False)

    def _end(self, head: bytes) -> bool:
        """Say what is lost with a record that the end of the file cuts off; return False.

        `head` is what is left of the record, or its beginning.
        """
        size = self._source.size
        left = len(head) if size is None else size - self.offset
        if size is not None and left and self._source.read(size - len(MAGIC), len(MAGIC)) == MAGIC:
            raise DamageError('a record is longer than the file')
        lost = ''
        if head[:1] == bytes([Opcode.CHUNK]) and (times := chunk_times(head)):
            first, last = times
            seconds = (last - (self.contents.end if self.contents.counts else first)) * 1e-9
            lost = f', about {max(seconds, 0.0):.3f} s'
        self.losses = (
            f'{left} bytes from byte {self.offset} on{lost} at the end cannot be read'
            if left
            else 'what came after the last whole chunk is missing'
        )
        return False
