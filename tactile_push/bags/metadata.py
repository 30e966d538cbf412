# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Rosbag2's metadata of a bag, as ROS 2 Jazzy writes them.

Names, order and version are those of ``YAML::convert`` in
rosbag2_storage/include/rosbag2_storage/yaml.hpp; the values are those that
rosbag2_cpp/src/rosbag2_cpp/writers/sequential_writer.cpp fills in.
"""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import yaml

# What rosbag2 gives as the starting time of a bag without messages [ns].
_NEVER = 2**63 - 1

# Of messages and definitions in ROS 2, in the words of MCAP.
ROS_ENCODINGS = ('cdr', 'ros2msg')


class _Plain:
    """Write equal parts out in full, where YAML would refer from one to the other."""

    def ignore_aliases(self, data: Any) -> bool:
        """Return that nothing is replaced by a reference."""
        return True


class _PlainDumper(_Plain, yaml.SafeDumper):
    pass


class _FastDumper(_Plain, getattr(yaml, 'CSafeDumper', yaml.SafeDumper)):  # type: ignore[misc]
    pass


def to_yaml(value: object) -> str:
    """Write lists and dictionaries of plain values as YAML, in block style without references."""
    style = {'sort_keys': False, 'default_flow_style': False}
    try:
        return yaml.dump(value, Dumper=_FastDumper, **style)
    except UnicodeEncodeError:  # libyaml cannot write the name of a folder that is no text
        return yaml.dump(value, Dumper=_PlainDumper, **style)


@dataclass
class Messages:
    """How many messages there are, and the first and last time at which one was received [ns]."""

    count: int = 0
    start: int = _NEVER
    end: int = 0

    def add(self, time_ns: int) -> None:
        """Count a message that was received at a time [ns]."""
        self.count += 1
        self.start = min(self.start, time_ns)
        self.end = max(self.end, time_ns)

    def times(self) -> dict[str, dict[str, int]]:
        """Return the entries for the times."""
        return {
            'duration': {'nanoseconds': max(self.end - self.start, 0)},
            'starting_time': {'nanoseconds_since_epoch': self.start},
        }


@dataclass
class TopicMetadata:
    """A topic: its publishers' qualities of service, its type's hash ('' if unknown).

    `encodings` are those of its messages and of their definition.
    """

    name: str
    type_name: str
    qos: Sequence[Mapping[str, object]]
    type_hash: str
    count: int = 0
    encodings: tuple[str, str] = ROS_ENCODINGS

    def entry(self) -> dict[str, object]:
        """Return the entry of the topic."""
        return {
            'topic_metadata': {
                'name': self.name,
                'type': self.type_name,
                'serialization_format': self.encodings[0],
                'offered_qos_profiles': [dict(profile) for profile in self.qos],
                'type_description_hash': self.type_hash,
            },
            'message_count': self.count,
        }


@dataclass
class FileMetadata:
    """A file and the messages in it."""

    name: str
    messages: Messages = field(default_factory=Messages)

    def entry(self) -> dict[str, object]:
        """Return the entry of the file."""
        times = self.messages.times()
        return {
            'path': self.name,
            'starting_time': times['starting_time'],
            'duration': times['duration'],
            'message_count': self.messages.count,
        }


def bag_metadata(
    messages: Messages,
    topics: Iterable[TopicMetadata],
    files: Sequence[FileMetadata],
    notes: Mapping[str, str],
) -> dict[str, object]:
    """Return what stands under ``rosbag2_bagfile_information`` in ``metadata.yaml``."""
    return {
        'version': 9,
        'storage_identifier': 'mcap',
        **messages.times(),
        'message_count': messages.count,
        'topics_with_message_count': [topic.entry() for topic in topics],
        # Of whole files or messages, which rosbag2 does itself; chunks are MCAP's own matter.
        'compression_format': '',
        'compression_mode': '',
        'relative_file_paths': [file.name for file in files],
        'files': [file.entry() for file in files],
        # An empty map of yaml-cpp is written as null.
        'custom_data': dict(notes) or None,
        'ros_distro': os.environ.get('ROS_DISTRO', 'jazzy'),
    }
