# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One MCAP file, whole or damaged."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path

from mcap.opcode import Opcode

from tactile_push.bags.mcap_contents import Contents, Piece
from tactile_push.bags.mcap_index import read_index
from tactile_push.bags.mcap_records import (
    HEADER,
    LARGEST_CHUNK,
    MAGIC,
    MESSAGE,
    DamageError,
    chunk_content,
    message_content,
    split,
)
from tactile_push.bags.mcap_scan import Scan
from tactile_push.bags.mcap_sources import BagError, open_source

_BY_LOG_TIME = attrgetter('log_time')


@dataclass(frozen=True, slots=True)
class Message:
    """A message as it lies in a bag.

    Parameters
    ----------
    topic : str
        Full name of the topic.
    log_time, publish_time : int
        When it was received and published [ns].
    data : bytes
        The message in CDR, with its four bytes of encapsulation header.
    """

    topic: str
    log_time: int
    publish_time: int
    data: bytes


class McapFile:
    """An MCAP file. What is known to be wrong in it is never given out.

    Parameters
    ----------
    path : Path
        The file.
    warn : callable
        Gets a line that says what cannot be read.

    Attributes
    ----------
    path : Path
        The file.
    contents : Contents
        What is in it.

    Raises
    ------
    BagError
        If it is no MCAP file or must not be read.
    """

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
        """Read the messages of a piece, in order of their log time.

        Parameters
        ----------
        piece : Piece
            A part of this file.
        topics : mapping of int to str
            Topics by the numbers of the channels that are asked for.
        start, end : int
            First log time, and the one before which reading ends [ns].
        compressed : bool
            Whether rosbag2 has compressed each message.

        Returns
        -------
        list of Message
            The messages.

        Raises
        ------
        DamageError
            If they are not those that were written.
        """
        if piece.length > LARGEST_CHUNK:
            raise DamageError(f'{piece.length} bytes, expected at most {LARGEST_CHUNK}')
        data = self._source.read(piece.offset, piece.length)
        if len(data) < piece.length:
            raise DamageError('the file ends')
        if piece.is_chunk:
            if HEADER.unpack_from(data) != (Opcode.CHUNK, piece.length - HEADER.size):
                raise DamageError('no chunk where the index has one')
            data = chunk_content(data[HEADER.size :])
        known = self.contents.channels
        found = []
        unpack, size = MESSAGE.unpack_from, MESSAGE.size
        for opcode, first, last in split(data):
            if opcode != Opcode.MESSAGE:
                continue
            if last - first < size:
                if piece.is_chunk:
                    raise DamageError('a message is cut off')
                continue
            number, _, log_time, publish_time = unpack(data, first)
            topic = topics.get(number)
            if topic is None:
                if piece.is_chunk and number not in known:
                    raise DamageError(f'a message of an unknown channel {number}')
            elif start <= log_time < end:
                content = data[first + size : last]
                if compressed:
                    content = message_content(content)
                found.append(Message(topic, log_time, publish_time, content))
        found.sort(key=_BY_LOG_TIME)
        return found

    def close(self) -> None:
        """Close the file; it is opened again when it is read."""
        self._source.close()

    def _look(self, warn: Callable[[str], None]) -> None:
        start = self._source.read(0, len(MAGIC))
        if not MAGIC.startswith(start):
            raise BagError(f'{self.path}: no MCAP file, which would begin with {MAGIC!r}')
        if len(start) < len(MAGIC):
            warn(f'{self.path}: nothing was recorded: {len(start)} bytes, an empty bag has more')
            return
        trouble = ''
        try:
            contents = read_index(self._source)
        except DamageError as error:
            contents = None
            trouble = str(error)
        if contents is None:
            scan = Scan(self._source)
            contents = scan.contents
            if trouble or scan.losses:
                losses = scan.losses or 'no message is missing'
                warn(f'{self.path}: {trouble or "damaged"}: {losses}')
        self.contents = contents
