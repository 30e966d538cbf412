# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Write a bag as `ros2 bag record -s mcap` of ROS 2 Jazzy does.

A bag is a directory with one MCAP file and a ``metadata.yaml``. The formats are
https://mcap.dev/spec, https://mcap.dev/spec/registry (profile ``ros2``) and version 9 of
``rosbag2_storage::BagMetadata``.
"""

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import yaml
from mcap.writer import LIBRARY_IDENTIFIER, CompressionType, Writer

from tactile_push.bags.definitions import schema_text

# Longest time for which a message stays in memory while others follow it [s].
FLUSH_PERIOD = 1.0

# What rosbag2 gives as the starting time of a bag without messages [ns].
_NEVER = 2**63 - 1


class _PlainDumper(yaml.SafeDumper):
    """Write equal parts out in full, where YAML would refer from one to the other."""

    def ignore_aliases(self, data: Any) -> bool:
        """Tell that nothing is to be replaced by a reference."""
        return True


def _to_yaml(value: object) -> str:
    return yaml.dump(value, Dumper=_PlainDumper, sort_keys=False, default_flow_style=False)


@dataclass
class _Topic:
    """A topic of the bag: its channel in the MCAP file and its entry in the metadata."""

    channel_id: int
    metadata: dict[str, object]
    message_count: int = 0


class BagWriter:
    """A bag that is being written.

    What was written is handed to the operating system at the latest one second later, as long as
    messages keep coming or `flush` is called, so that little is lost if the process dies. A bag
    that was not closed has no index and no ``metadata.yaml`` (``ros2 bag reindex`` makes one), but
    can be read up to its last whole chunk.

    Parameters
    ----------
    directory : str or path
        Directory of the bag, made here with its parents. The MCAP file in it gets its name.

    Raises
    ------
    FileExistsError
        If `directory` exists: a bag is never overwritten.

    Examples
    --------
    >>> import tempfile
    >>> directory = Path(tempfile.mkdtemp(), 'push')
    >>> with BagWriter(directory) as bag:
    ...     pass
    >>> sorted(path.name for path in directory.iterdir())
    ['metadata.yaml', 'push_0.mcap']
    """

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self._directory = Path(directory)
        self._directory.mkdir(parents=True)
        self._file_name = f'{self._directory.name}_0.mcap'
        self._topics: dict[str, _Topic] = {}
        self._schema_ids: dict[str, int] = {}
        self._start, self._end = _NEVER, 0
        self._stream = open(self._directory / self._file_name, 'wb')  # noqa: SIM115, see close
        self._mcap = Writer(self._stream, compression=CompressionType.ZSTD, enable_crcs=True)
        self._mcap.start(profile='ros2', library=f'tactile_push {LIBRARY_IDENTIFIER}')
        self._add_metadata_record()
        self.flush()

    def add_topic(
        self,
        name: str,
        type_name: str,
        *,
        qos: Sequence[Mapping[str, object]] = (),
        type_hash: str = '',
    ) -> None:
        """Add a topic, which must be done once before messages are written to it.

        Parameters
        ----------
        name : str
            Full name of the topic, such as ``'/tactile'``.
        type_name : str
            Message type, such as ``'sensor_msgs/msg/JointState'``.
        qos : sequence of mappings, optional
            One quality of service for each publisher of the topic, with the keys and words of
            rosbag2 (``history: keep_last``, …). A player takes its own default where there is
            none.
        type_hash : str, optional
            Hash of the message type after REP-2011 (``RIHS01_…``); empty if it is not known.

        Raises
        ------
        LookupError
            If the message type is not installed.
        ValueError
            If the bag has the topic already.
        """
        if name in self._topics:
            raise ValueError(f'the bag has the topic {name} already')
        if type_name not in self._schema_ids:
            self._schema_ids[type_name] = self._mcap.register_schema(
                type_name, 'ros2msg', schema_text(type_name).encode()
            )
        profiles = [dict(profile) for profile in qos]
        channel_id = self._mcap.register_channel(
            name,
            'cdr',
            self._schema_ids[type_name],
            {
                'offered_qos_profiles': _to_yaml(profiles).rstrip(),
                'topic_type_hash': type_hash,
            },
        )
        self._topics[name] = _Topic(
            channel_id,
            {
                'name': name,
                'type': type_name,
                'serialization_format': 'cdr',
                'offered_qos_profiles': profiles,
                'type_description_hash': type_hash,
            },
        )

    def write(self, topic: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> None:
        """Add a message.

        Parameters
        ----------
        topic : str
            Name of a topic of the bag; KeyError if it was not added.
        data : bytes
            The message in CDR, with its four bytes of encapsulation header.
        log_time_ns, publish_time_ns : int
            When it was received and published, in nanoseconds since the epoch of the clock.
        """
        if self._stream.closed:
            raise ValueError('the bag is closed')
        entry = self._topics[topic]
        self._mcap.add_message(entry.channel_id, log_time_ns, data, publish_time_ns)
        entry.message_count += 1
        self._start = min(self._start, log_time_ns)
        self._end = max(self._end, log_time_ns)
        if time.monotonic() - self._flushed >= FLUSH_PERIOD:
            self.flush()

    def flush(self) -> None:
        """Finish the chunk and hand all that was written to the operating system."""
        self._mcap.flush()
        self._flushed = time.monotonic()

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``; further calls do nothing."""
        if self._stream.closed:
            return
        with self._stream:
            self.flush()
            self._add_metadata_record()
            self._mcap.finish()
        text = _to_yaml({'rosbag2_bagfile_information': self._metadata()})
        Path(self._directory, 'metadata.yaml').write_text(text, encoding='utf-8')

    def __enter__(self) -> 'BagWriter':
        """Return the bag, which is closed at the end of the block."""
        return self

    def __exit__(
        self,
        error_type: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Close the bag; what was written before an error is kept."""
        self.close()

    def _add_metadata_record(self) -> None:
        # Like rosbag2, once when the bag is opened and once when it is closed; the last one counts.
        text = _to_yaml(self._metadata()).rstrip()
        self._mcap.add_metadata('rosbag2', {'serialized_metadata': text})

    def _metadata(self) -> dict[str, object]:
        duration = {'nanoseconds': max(self._end - self._start, 0)}
        starting_time = {'nanoseconds_since_epoch': self._start}
        message_count = sum(topic.message_count for topic in self._topics.values())
        return {
            'version': 9,
            'storage_identifier': 'mcap',
            'duration': duration,
            'starting_time': starting_time,
            'message_count': message_count,
            'topics_with_message_count': [
                {'topic_metadata': topic.metadata, 'message_count': topic.message_count}
                for topic in self._topics.values()
            ],
            # Of whole files or messages, which rosbag2 does itself; chunks are MCAP's own matter.
            'compression_format': '',
            'compression_mode': '',
            'relative_file_paths': [self._file_name],
            'files': [
                {
                    'path': self._file_name,
                    'starting_time': starting_time,
                    'duration': duration,
                    'message_count': message_count,
                }
            ],
            'custom_data': None,
            'ros_distro': os.environ.get('ROS_DISTRO', 'jazzy'),
        }
