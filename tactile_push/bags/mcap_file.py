# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One MCAP file, whole, cut off or damaged."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path

from mcap.opcode import Opcode

from tactile_push.bags.mcap_contents import Contents, Piece
from tactile_push.bags.mcap_index import read_index
from tactile_push.bags.mcap_records import (
    LARGEST_CHUNK,
    MAGIC,
    MESSAGE,
    DamageError,
    chunk_content,
    message_content,
    split,
)
from tactile_push.bags.mcap_scan import scan
from tactile_push.bags.sources import BagError, open_source

_BY_LOG_TIME = attrgetter('log_time')


@dataclass(frozen=True, slots=True)
class Message:
    """A message as it lies in a bag."""

    topic: str  #: full name of the topic
    log_time: int  #: when it was received [ns]
    publish_time: int  #: when it was published [ns]
    data: bytes  #: the message in CDR, with its four bytes of encapsulation header


class McapFile:
    """An MCAP file, whole, cut off or damaged; `warn` gets a line about what cannot be read."""

    def __init__(self, path: Path, warn: Callable[[str], None]) -> None:
        self.path = path
        self.contents = Contents()
        self._source = open_source(path)
        try:
            self._look(warn)
        finally:
            self.close()

    def messages(
        self, piece: Piece, topics: Mapping[int, str], start: int, end: int, compressed: bool
    ) -> list[Message]:
        """Read the messages of a piece from `start` until before `end`, by log time.

        `topics` has the topics that are asked for by their channels; `compressed` says whether
        rosbag2 has compressed each message. DamageError says that they are not what was written.
        """
        if piece.length > LARGEST_CHUNK:
            raise DamageError(f'expected at most {LARGEST_CHUNK} bytes, got {piece.length}')
        data = self._source.read(piece.offset, piece.length)
        if len(data) < piece.length:
            raise DamageError('the file ends')
        if piece.is_chunk:
            data = chunk_content(data)
        known = self.contents.channels
        found = []
        unpack, size = MESSAGE.unpack_from, MESSAGE.size
        for opcode, first, last in split(data):
            if opcode != Opcode.MESSAGE:
                continue
            if last - first < size:
                raise DamageError('a message is cut off')
            number, _, log_time, publish_time = unpack(data, first)
            topic = topics.get(number)
            if topic is None:
                if number not in known:
                    raise DamageError(f'a message of an unknown channel {number}')
            elif start <= log_time < end:
                content = data[first + size : last]
                if compressed:
                    content = message_content(content)
                found.append(Message(topic, log_time, publish_time, content))
        found.sort(key=_BY_LOG_TIME)
        return found

    def close(self) -> None:
        """Close the file; the next reading opens it again."""
        self._source.close()

    def _look(self, warn: Callable[[str], None]) -> None:
        start = self._source.read(0, len(MAGIC))
        if not MAGIC.startswith(start):
            raise BagError(f'{self.path}: expected an MCAP file, which begins with {MAGIC!r}')
        if len(start) < len(MAGIC):
            warn(f'{self.path}: nothing was recorded: the file has {len(start)} bytes')
            return
        contents, trouble = None, ''
        try:
            contents = read_index(self._source)
        except DamageError as error:
            trouble = str(error)
        if contents is None:
            contents, losses = scan(self._source, self.path)
            if trouble or losses:
                warn(f'{self.path}: {trouble or "damaged"}: {losses or "no message is missing"}')
        self.contents = contents
