# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What there is in an MCAP file without an index: one that was cut off, or that lost it."""

from dataclasses import dataclass

from mcap.opcode import Opcode
from mcap.records import Metadata

from tactile_push.bags.mcap_contents import NOTES, Contents
from tactile_push.bags.mcap_records import (
    CHUNK_HEAD_LENGTH,
    HEADER,
    LARGEST_CHUNK,
    LARGEST_RECORD,
    MAGIC,
    DamageError,
    chunk_content,
    chunk_times,
    find_chunk,
    parse,
)
from tactile_push.bags.mcap_sources import Source

# Records with messages, or what belongs to them, without a chunk around them.
_LOOSE = frozenset([Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE])

# How the data section ends: opcode and length.
_ENDS = frozenset([(Opcode.DATA_END, 4), (Opcode.FOOTER, 20)])

# How much is read at once where there are no chunks, and in search of one [bytes].
_WINDOW = 1 << 20


@dataclass
class _Losses:
    """What cannot be read.

    Parameters
    ----------
    places : int
        How often something was damaged.
    first : str
        Where and how it was damaged for the first time.
    size : int
        How much [bytes].
    duration : int
        Time that the lost messages cover, as far as it is known [ns].
    """

    places: int = 0
    first: str = ''
    size: int = 0
    duration: int = 0

    def add(self, offset: int, reason: str, size: int, duration: int = 0) -> None:
        self.first = self.first or f'at byte {offset} ({reason})'
        self.places += 1
        self.size += size
        self.duration += duration

    def __str__(self) -> str:
        seconds = f', about {self.duration * 1e-9:.3f} s' if self.duration else ''
        return f'{self.size} bytes{seconds}'


class Scan:
    """A look through a file from its beginning to where it ends or breaks off.

    Parameters
    ----------
    source : Source
        The file.

    Attributes
    ----------
    contents : Contents
        What is there and sound.
    is_closed : bool
        Whether the messages end as in a file that was closed.
    """

    def __init__(self, source: Source) -> None:
        self._source = source
        self._offset = len(MAGIC)
        # Before here nothing need be searched for what was missed.
        self._settled = self._offset
        self._damage = _Losses()
        self._rest = _Losses()
        self.contents = Contents()
        self.is_closed = False
        while self._take_record():
            pass

    @property
    def losses(self) -> str:
        """What is missing, in words; empty if nothing is known to be."""
        words = []
        if self._damage.places:
            words.append(
                f'{self._damage.places} damaged places, the first {self._damage.first}: '
                f'{self._damage} are left out'
            )
        if self._rest.places:
            words.append(f'{self._rest} at the end cannot be read')
        elif not self.is_closed:
            words.append('what came after the last whole chunk is missing')
        return '; '.join(words)

    def _take_record(self) -> bool:
        """Take in the next record; return whether there may be more."""
        size = self._source.size
        header = self._source.read(self._offset, HEADER.size)
        if len(header) < HEADER.size:
            if header:
                self._rest.add(self._offset, 'the file ends', len(header))
            return False
        opcode, length = HEADER.unpack(header)
        if (opcode, length) in _ENDS:
            self.is_closed = True
            return False
        end = self._offset + HEADER.size + length
        if opcode == Opcode.CHUNK:
            return self._take_chunk(length)
        if opcode == 0 or (size is not None and end > size):
            return self._search('no record')
        if opcode in _LOOSE:
            return self._take_loose(length)
        if opcode == Opcode.METADATA and length <= LARGEST_RECORD:
            self._take_metadata(length)
        self._offset = end
        return True

    def _take_chunk(self, length: int) -> bool:
        start, size = self._offset, HEADER.size + length
        head = self._source.read(start, CHUNK_HEAD_LENGTH)
        if find_chunk(head, at_start=True) is None:
            return self._search('no chunk')
        self._offset = self._settled = start + size
        first, last = chunk_times(head[HEADER.size :])
        if size > LARGEST_CHUNK:
            self._damage.add(start, f'a chunk of {length} bytes', size, last - first)
            return True
        body = self._source.read(start + HEADER.size, length)
        if len(body) < length:
            missing = max(last - (self.contents.end if self.contents.counts else first), 0)
            self._rest.add(start, 'the file ends', HEADER.size + len(body), missing)
            return False
        try:
            self.contents.survey(chunk_content(body), start, size, True)
        except DamageError as error:
            self._damage.add(start, str(error), size, max(last - first, 0))
        return True

    def _take_loose(self, length: int) -> bool:
        """Take in records without a chunk around them, as many as come in one go."""
        # Writers make chunks or none. In a file with chunks these are the inside of one, reached
        # by a wrong length and under no checksum.
        if length > LARGEST_CHUNK or self._settled > len(MAGIC):
            return self._search('no record')
        start = self._offset
        data = self._source.read(start, max(_WINDOW, HEADER.size + length))
        end = _loose_end(data)
        if end == 0:
            return self._search('no record')
        bad = self.contents.survey(data[:end], start, end, False)
        if bad:
            self._damage.add(start, f'{bad} records of unknown channels', 0)
        self._offset += end
        return True

    def _take_metadata(self, length: int) -> None:
        body = self._source.read(self._offset + HEADER.size, length)
        try:
            record = parse(Metadata, body)
        except DamageError as error:
            self._damage.add(self._offset, str(error), HEADER.size + length)
        else:
            if record.name in NOTES:
                self.contents.metadata.append(record)

    def _search(self, reason: str) -> bool:
        """Go to the next chunk that looks whole, from where something makes no sense."""
        size = self._source.size
        lost = self._offset
        place = self._settled
        while size is not None and place < size:
            # A chunk's beginning may lie on the boundary of two windows.
            found = find_chunk(self._source.read(place, _WINDOW + CHUNK_HEAD_LENGTH))
            if found is not None and found < _WINDOW:
                self._offset = place + found
                self._damage.add(lost, reason, max(self._offset - lost, 0))
                return True
            place += _WINDOW
        self._rest.add(lost, reason, 0 if size is None else size - lost)
        return False


def _loose_end(data: bytes) -> int:
    """Return where the whole records at the beginning of some bytes end."""
    place = 0
    while place + HEADER.size <= len(data):
        opcode, length = HEADER.unpack_from(data, place)
        end = place + HEADER.size + length
        if opcode not in _LOOSE or end > len(data):
            break
        place = end
    return place
