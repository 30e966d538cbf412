# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read bags: those of this package and those of `ros2 bag record -s mcap`."""

import logging
import os
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from mcap.records import Channel, Schema
from mcap_ros2.decoder import DecoderFactory

from tactile_push.bags.bag_files import (
    METADATA,
    BagMetadata,
    find_files,
    load_yaml,
    parse_metadata,
    read_metadata,
)
from tactile_push.bags.definitions import full_type_name
from tactile_push.bags.fields import same_fields
from tactile_push.bags.mcap_contents import Piece
from tactile_push.bags.mcap_file import McapFile, Message
from tactile_push.bags.mcap_records import DamageError
from tactile_push.bags.merge import Batch, in_order
from tactile_push.bags.qos import read_profiles
from tactile_push.bags.sources import BagError
from tactile_push.bags.topic import Topic
from tactile_push.streams import one_line

# Longest message of a type without fields: the encapsulation header, a byte, padding [bytes].
EMPTY_MESSAGE = 8

_LOGGER = logging.getLogger('tactile_push.bags')


class BagReader:
    """A bag of this package or of ``ros2 bag record -s mcap``; a context manager.

    A bag that was cut off is read up to there, a damaged one up to the damage; of a damaged bag
    that was closed, only the damaged chunks are left out. A warning says where, how much is
    missing, and how to save what is behind a damage.

    Parameters
    ----------
    path : str or Path
        Folder of the bag, or one of its files.
    warn : callable, optional
        Gets one line for each problem that does not keep the bag from being read; by default the
        lines are logged.

    Raises
    ------
    BagError
        If there is no bag or it cannot be read.
    """

    def __init__(
        self, path: str | os.PathLike[str], warn: Callable[[str], None] = _LOGGER.warning
    ) -> None:
        self.path = Path(path)  #: where the bag is; its folder if its metadata.yaml is given
        self.topics: dict[str, Topic] = {}  #: by name
        #: messages by topic, with those of damaged chunks that nobody has read yet
        self.counts: dict[str, int] = {}
        self.notes: dict[str, str] = {}  #: custom data of the bag
        self._warn = warn
        self._warned: set[str] = set()
        self._sources: dict[str, tuple[Channel, Schema | None]] = {}
        self._decoders: dict[str, Callable[[bytes], Any]] = {}
        try:
            if self.path.name == METADATA and self.path.is_file():
                self.path = self.path.parent
            metadata = self._metadata()
            files = find_files(self.path, metadata, self.warn)
        except OSError as error:
            raise BagError(f'{self.path}: {error.strerror or error}') from None
        self._files = self._open_files(files)
        self.files = [file.path for file in self._files]  #: in their order
        self._topic_names = [self._take_topics(file) for file in self._files]
        filled = [file.contents for file in self._files if file.contents.counts]
        #: first log time [ns], as `end_time` is the last one; both are 0 in an empty bag
        self.start_time = min((contents.start for contents in filled), default=0)
        self.end_time = max((contents.end for contents in filled), default=0)
        self._compressed = [self._take_notes(file, metadata) for file in self._files]
        self.notes.update(metadata.custom_data)
        self._compare(metadata)

    def messages(
        self,
        topics: Collection[str] | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> Iterator[Message]:
        """Read messages in order of their log time, whatever their order in the bag.

        Parameters
        ----------
        topics : collection of str, optional
            Names of the topics; all by default. A topic that the bag lacks has no messages.
        start, end : int, optional
            First log time, and the one before which reading ends [ns].

        Returns
        -------
        iterator of Message
            The messages, read as they are asked for; at equal times in the order of the bag.
            BagError is raised then if a file can no longer be read.
        """
        start = 0 if start is None else start
        end = 2**64 if end is None else end
        batches = []
        unread: Counter[int] = Counter()
        for number, (file, names) in enumerate(zip(self._files, self._topic_names, strict=True)):
            if topics is not None:
                names = {channel: name for channel, name in names.items() if name in topics}
            load = partial(self._load, unread, number, names, start, end)
            for piece in file.contents.pieces:
                # An index without message indexes does not say which channels a chunk has.
                wanted = not piece.channels or not names.keys().isdisjoint(piece.channels)
                if wanted and piece.end >= start and piece.start < end:
                    unread[number] += 1
                    batches.append(Batch(piece.start, partial(load, piece)))
        try:
            yield from in_order(batches)
        finally:
            self._close()

    def warn(self, line: str) -> None:
        """Tell a problem that does not keep the bag from being used.

        Parameters
        ----------
        line : str
            What is wrong and where; a line that was told before is not told again.
        """
        if line not in self._warned:
            self._warned.add(line)
            self._warn(one_line(line))

    def decode(self, message: Message) -> Any:
        """Decode a message by the schema in the bag; BagError if it does not decode.

        Parameters
        ----------
        message : Message
            A message of this bag.

        Returns
        -------
        object
            With the fields of the message as attributes.
        """
        decoder = self._decoders.get(message.topic) or self._make_decoder(message.topic)
        topic = self.topics[message.topic]
        if len(message.data) > EMPTY_MESSAGE and not topic.definition.strip():
            raise BagError(
                f'{self.path}: the definition of {topic.type_name} for {topic.name} is missing'
            )
        try:
            return decoder(message.data)
        except Exception as error:  # mcap_ros2 checks nothing, so any error may come
            seconds = (message.log_time - self.start_time) * 1e-9
            raise BagError(
                f'{self.path}: the message of {topic.name} at {seconds:.6f} s does not decode '
                f'as {topic.type_name}: {_in_words(error)}'
            ) from None

    def __enter__(self) -> 'BagReader':
        return self

    def __exit__(self, *exc_info: object) -> None:
        self._close()

    def _close(self) -> None:
        for file in self._files:
            file.close()

    def _metadata(self) -> BagMetadata:
        if not self.path.is_dir():
            return BagMetadata()
        try:
            return read_metadata(self.path, self.warn)
        except FileNotFoundError:
            return BagMetadata()
        except (OSError, ValueError) as error:
            self.warn(f'{self.path / METADATA}: not used: {_in_words(error)}')
            return BagMetadata()

    def _open_files(self, paths: list[Path]) -> list[McapFile]:
        files = []
        errors = []
        for path in paths:
            try:
                files.append(McapFile(path, self.warn))
            except BagError as error:
                errors.append(error)
        if not files:
            raise errors[0]
        for left_out in errors:
            self.warn(f'{left_out}; left out')
        return files

    def _take_topics(self, file: McapFile) -> dict[int, str]:
        """Add the topics of a file; return their names by its channels."""
        names = {}
        contents = file.contents
        for number, channel in contents.channels.items():
            schema = contents.schemas.get(channel.schema_id)
            name = f'/{channel.topic.removeprefix("/")}'  # not all writers write the slash
            type_name, text, encodings = '', '', (channel.message_encoding, '')
            if schema is not None:
                type_name = full_type_name(schema.name)
                text = schema.data.decode(errors='surrogateescape')  # it may be binary
                encodings = (channel.message_encoding, schema.encoding)
            topic = self.topics.get(name)
            if topic is None:
                self._sources[name] = (channel, schema)
                self.topics[name] = Topic(
                    name,
                    type_name,
                    text,
                    read_profiles(
                        channel.metadata.get('offered_qos_profiles', ''),
                        partial(self._warn_of_quality, name),
                    ),
                    channel.metadata.get('topic_type_hash', ''),
                    encodings,
                )
            elif other := _another_kind(topic, type_name, text, encodings):
                self.warn(
                    f'{file.path}: {contents.counts[number]} messages of {name} are left out: '
                    f'{other}'
                )
                continue
            names[number] = name
            self.counts.setdefault(name, 0)
            self.counts[name] += contents.counts[number]
        return names

    def _warn_of_quality(self, topic: str, line: str) -> None:
        self.warn(f'{self.path}: quality of service of {topic}: {line}')

    def _take_notes(self, file: McapFile, metadata: BagMetadata) -> bool:
        """Add the notes in a file; return whether its messages are compressed one by one."""
        compression = metadata.message_compression
        for record in file.contents.metadata:
            if record.name == 'tactile_push':
                self.notes.update(record.metadata)
                continue
            try:
                text = load_yaml(record.metadata.get('serialized_metadata', ''))
                own = parse_metadata(text, lambda line: self.warn(f'{file.path}: {line}'))
            except ValueError as error:
                self.warn(f'{file.path}: metadata of rosbag2 not used: {error}')
                continue
            self.notes.update(own.custom_data)
            compression = own.message_compression
        if compression not in ('', 'zstd'):
            raise BagError(
                f'{file.path}: expected messages compressed with zstd, got {compression}'
            )
        return compression != ''

    def _compare(self, metadata: BagMetadata) -> None:
        count = sum(self.counts.values())
        if metadata.message_count > count:
            seconds = max(metadata.end - self.end_time, 0) * 1e-9
            self.warn(
                f'{self.path}: {metadata.message_count - count} of the '
                f'{metadata.message_count} messages that metadata.yaml counts are missing, '
                f'{seconds:.3f} s at the end'
            )

    def _load(
        self,
        unread: Counter[int],
        number: int,
        names: Mapping[int, str],
        start: int,
        end: int,
        piece: Piece,
    ) -> list[Message]:
        file = self._files[number]
        try:
            messages = file.messages(piece, names, start, end, self._compressed[number])
        except DamageError as error:
            messages = []
            first, last = ((time - self.start_time) * 1e-9 for time in (piece.start, piece.end))
            self.warn(
                f'{file.path}: damaged at byte {piece.offset} ({error}): {piece.length} bytes '
                f'with the messages from {first:.3f} s to {last:.3f} s are left out'
            )
        # A bag may have more files than a process may have open.
        unread[number] -= 1
        if not unread[number]:
            file.close()
        return messages

    def _make_decoder(self, topic: str) -> Callable[[bytes], Any]:
        if topic not in self.topics:
            raise BagError(f'{self.path}: no topic {topic}')
        if trouble := self.topics[topic].trouble({}):
            raise BagError(f'{self.path}: {trouble}')
        channel, schema = self._sources[topic]
        decoder = DecoderFactory().decoder_for(channel.message_encoding, schema)
        assert decoder is not None  # as it has a definition in ROS's words
        self._decoders[topic] = decoder
        return decoder


def _another_kind(topic: Topic, type_name: str, text: str, encodings: tuple[str, str]) -> str:
    """Return why messages of one topic cannot be taken for messages of another, '' if they can."""
    expected, got = (topic.type_name, *topic.encodings), (type_name, *encodings)
    if expected != got:
        return f'expected {" in ".join(expected)}, got {" in ".join(got)}'
    if topic.decodes and not same_fields(type_name, topic.definition, text):
        return f'{type_name} is defined otherwise'
    return ''


def _in_words(error: Exception) -> str:
    return ' '.join(f'{type(error).__name__}: {error}'.split())
