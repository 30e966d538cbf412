# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Write a bag as `ros2 bag record -s mcap` of ROS 2 Jazzy does.

A bag is a directory with one MCAP file or more and a ``metadata.yaml``. The formats are
https://mcap.dev/spec, https://mcap.dev/spec/registry (profile ``ros2``) and version 9 of
``rosbag2_storage::BagMetadata``; what goes into the MCAP file is as in
rosbag2_storage_mcap/src/mcap_storage.cpp.
"""

import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from mcap.writer import LIBRARY_IDENTIFIER, CompressionType, Writer

from tactile_push.bags.definitions import schema_text
from tactile_push.bags.disk import Disk, DiskFile, sync_directory, write_whole
from tactile_push.bags.metadata import (
    ROS_ENCODINGS,
    FileMetadata,
    Messages,
    TopicMetadata,
    bag_metadata,
    to_yaml,
)

# Longest time for which a message stays in memory while others follow it [s]. With the time that
# the disk then takes, a power cut loses no more than a second.
FLUSH_PERIOD = 0.5

COMPRESSIONS = {
    'zstd': CompressionType.ZSTD,
    'lz4': CompressionType.LZ4,
    'none': CompressionType.NONE,
}

_NO_SCHEMA = 0  # its number in MCAP
IS_THERE = 'expected a new folder, got a path that exists'
# Size at which a chunk is closed, before compression [B]; as in mcap itself.
_CHUNK_BYTES = 1 << 20


class BagWriter:
    """A bag that is being written.

    As long as messages keep coming or `flush` is called, each message is on the disk at most a
    second later, so that little is lost if the process dies or the power fails. A bag that was not
    closed has no ``metadata.yaml``, which ``ros2 bag reindex`` makes, and its last file has no
    index; it can be read up to its last whole chunk.

    When the disk is full or fails, the next call raises OSError. The bag then ends, like one that
    was not closed, with the last chunk that reached the disk whole.

    In memory are one chunk, at most 64 that wait for the disk, and the index of the file, a
    kilobyte a chunk.

    Parameters
    ----------
    directory : str or Path
        Directory of the bag, made here with its parents. The MCAP files in it get its name.
    compression : {'zstd', 'lz4', 'none'}, optional
        How chunks are compressed.
    max_bytes : int, optional
        The next message begins a new file once one has so many bytes; 0 for one file.
    max_duration : float, optional
        So does a message that was received so long after the first one of the file [s].

    Raises
    ------
    FileExistsError
        If `directory` exists: a bag is never overwritten.
    OSError
        If it cannot be made.

    Examples
    --------
    >>> import tempfile
    >>> directory = Path(tempfile.mkdtemp(), 'push')
    >>> with BagWriter(directory) as bag:
    ...     pass
    >>> sorted(path.name for path in directory.iterdir())
    ['metadata.yaml', 'push_0.mcap']
    """

    def __init__(
        self,
        directory: str | os.PathLike[str],
        *,
        compression: str = 'zstd',
        max_bytes: int = 0,
        max_duration: float = 0.0,
    ) -> None:
        if compression not in COMPRESSIONS:
            raise ValueError(
                f'compression: expected one of {", ".join(COMPRESSIONS)}, got {compression!r}'
            )
        self._directory = Path(os.path.abspath(directory))  # of '.', too, files get the name
        self._compression = COMPRESSIONS[compression]
        self._max_bytes = max_bytes
        self._max_duration = round(max_duration * 1e9)
        try:
            self._directory.mkdir(parents=True)
        except FileExistsError as error:
            raise FileExistsError(error.errno, IS_THERE, os.fspath(directory)) from None
        self._topics: dict[str, TopicMetadata] = {}
        self._definitions: dict[str, str] = {}
        self._notes: dict[str, str] = {}
        self._messages = Messages()
        self._files: list[FileMetadata] = []
        self._closed = False
        self._disk = Disk()
        self._begin_file()
        self._disk.do(lambda: sync_directory(self._directory.parent))

    @property
    def message_count(self) -> int:
        """Number of messages written; some of the last are missing in the bag if it `failed`."""
        return self._messages.count

    @property
    def failed(self) -> bool:
        """Whether an error of the disk has been raised; the bag has ended then."""
        return self._disk.failed

    @property
    def file_count(self) -> int:
        """Number of files begun."""
        return len(self._files)

    @property
    def byte_count(self) -> int:
        """Size of all files so far, without what waits in a chunk [B]."""
        return self._finished_bytes + self._stream.tell()

    def add_topic(
        self,
        name: str,
        type_name: str,
        *,
        qos: Sequence[Mapping[str, object]] = (),
        type_hash: str = '',
        definition: str | None = None,
        encodings: tuple[str, str] = ROS_ENCODINGS,
    ) -> None:
        """Add a topic, which must be done once before messages are written to it.

        Parameters
        ----------
        name, type_name : str
            Full name, such as ``'/tactile'``, and type, such as ``'sensor_msgs/msg/JointState'``.
        qos : sequence of mappings, optional
            One quality of service for each publisher of the topic, with the keys and words of
            rosbag2 (``history: keep_last``, …). A player takes its own default where there is
            none.
        type_hash : str, optional
            Hash of the message type after REP-2011 (``RIHS01_…``); empty if it is not known.
        definition : str, optional
            Definition of the message type with those of all its parts, for example from another
            bag; by default that of the installed type.
        encodings : tuple of two str, optional
            Encodings of the messages and of the definition in the words of MCAP, for messages of
            another bag that are not ROS 2's; the second is empty if there is no definition.

        Raises
        ------
        LookupError
            If the message type is not installed and no definition is given.
        ValueError
            If the bag has the topic already.
        """
        if name in self._topics:
            raise ValueError(f'the bag has the topic {name} already')
        self._definitions[name] = schema_text(type_name) if definition is None else definition
        self._topics[name] = TopicMetadata(name, type_name, qos, type_hash, encodings=encodings)
        self._register(self._topics[name])

    def write(self, topic: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> None:
        """Add a message.

        Parameters
        ----------
        topic : str
            Name of a topic of the bag; KeyError if it was not added.
        data : bytes
            The message in its topic's encoding: CDR with its four bytes of encapsulation header.
        log_time_ns, publish_time_ns : int
            When it was received and published, in nanoseconds since the epoch of the clock.
        """
        if self._closed:
            raise ValueError('the bag is closed')
        entry = self._topics[topic]
        self._disk.check()
        if self._is_full(log_time_ns):
            self._finish_file()
            self._begin_file()
        self._mcap.add_message(self._channel_ids[topic], log_time_ns, data, publish_time_ns)
        entry.count += 1
        self._messages.add(log_time_ns)
        self._files[-1].messages.add(log_time_ns)
        if time.monotonic() - self._flushed >= FLUSH_PERIOD:
            self.flush()

    def note(self, key: str, text: str) -> None:
        """Put a text into the bag: into ``custom_data`` of its metadata, and into every file.

        Parameters
        ----------
        key, text : str
            What it is about, and the text; a later note of the same key replaces this one.
        """
        if self._closed:
            raise ValueError('the bag is closed')
        self._notes[key] = text
        self._mcap.add_metadata('tactile_push', {key: text})

    def flush(self) -> None:
        """Finish the chunk and have all that was written put onto the disk; do not wait for it."""
        self._disk.check()
        self._mcap.flush()
        self._flushed = time.monotonic()

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``; further calls do nothing."""
        if self._closed:
            return
        self._closed = True
        failed = self.failed
        try:
            if not failed:
                self._finish_file()
        finally:
            self._disk.close()
        if not failed:
            self._disk.check()
            text = to_yaml({'rosbag2_bagfile_information': self._metadata()})
            write_whole(self._directory / 'metadata.yaml', text)

    def __enter__(self) -> 'BagWriter':
        return self

    def __exit__(self, *exc_info: object) -> None:
        """Close the bag; what was written before an error is kept."""
        self.close()

    def _is_full(self, log_time_ns: int) -> bool:
        """Return whether a message begins a new file, as in rosbag2's should_split_bagfile."""
        messages = self._files[-1].messages
        if not messages.count:
            return False
        if self._max_bytes and self._stream.tell() >= self._max_bytes:
            return True
        return bool(self._max_duration) and log_time_ns - messages.start > self._max_duration

    def _begin_file(self) -> None:
        """Begin a file that can be read without the others."""
        self._finished_bytes = self.byte_count if self._files else 0
        name = f'{self._directory.name}_{len(self._files)}.mcap'
        self._stream = DiskFile(self._disk, self._directory / name)
        self._files.append(FileMetadata(name))
        self._mcap = Writer(
            self._stream,  # type: ignore[arg-type]  # has what is needed of a stream
            # Small chunks keep a file close to the size that was asked for.
            chunk_size=min(_CHUNK_BYTES, self._max_bytes // 16 or _CHUNK_BYTES),
            compression=self._compression,
            enable_crcs=True,
        )
        self._mcap.start(profile='ros2', library=f'tactile_push {LIBRARY_IDENTIFIER}')
        self._schema_ids: dict[tuple[str, str, str], int] = {}
        self._channel_ids: dict[str, int] = {}
        self._add_metadata_record()
        for key, text in self._notes.items():
            self._mcap.add_metadata('tactile_push', {key: text})
        for topic in self._topics.values():
            self._register(topic)
        self.flush()

    def _finish_file(self) -> None:
        self._mcap.flush()
        self._add_metadata_record()
        self._mcap.finish()
        self._stream.close()

    def _register(self, topic: TopicMetadata) -> None:
        message_encoding, schema_encoding = topic.encodings
        schema = topic.type_name, schema_encoding, self._definitions[topic.name]
        if schema not in self._schema_ids:
            data = schema[-1].encode(errors='surrogateescape')  # as `BagReader` decodes it
            self._schema_ids[schema] = (
                self._mcap.register_schema(*schema[:2], data) if schema_encoding else _NO_SCHEMA
            )
        self._channel_ids[topic.name] = self._mcap.register_channel(
            topic.name,
            message_encoding,
            self._schema_ids[schema],
            {
                'offered_qos_profiles': to_yaml([dict(entry) for entry in topic.qos]).rstrip(),
                'topic_type_hash': topic.type_hash,
            },
        )

    def _add_metadata_record(self) -> None:
        # Like rosbag2, when a file is opened and when it is closed; the last record counts.
        text = to_yaml(self._metadata()).rstrip()
        self._mcap.add_metadata('rosbag2', {'serialized_metadata': text})

    def _metadata(self) -> dict[str, object]:
        return bag_metadata(self._messages, self._topics.values(), self._files, self._notes)
