# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Messages and bags made by an independent encoder, rosbags."""

import mcap.writer
import numpy as np
from mcap.writer import CompressionType
from rosbags.interfaces import Nodetype
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from tactile_push.bags import BagWriter, schema_text

TYPES = get_typestore(Stores.ROS2_JAZZY)


def of_type(description, value):
    """Return a value in the form that rosbags encodes; what is left out is empty."""
    kind, detail = description
    if kind == Nodetype.NAME:
        given = value or {}
        fields = dict(TYPES.fielddefs[detail][1])
        assert set(given) <= set(fields), f'{detail} has no {set(given) - set(fields)}'
        return TYPES.types[detail](
            **{name: of_type(part, given.get(name)) for name, part in fields.items()}
        )
    if kind == Nodetype.BASE:
        empty = {'string': '', 'bool': False}.get(detail[0], 0)
        return empty if value is None else value
    element, length = detail
    values = [None] * length * (kind == Nodetype.ARRAY) if value is None else value
    values = [of_type(element, entry) for entry in values]
    if element[0] == Nodetype.BASE and element[1][0] != 'string':
        name = element[1][0]
        return np.array(values, dtype={'byte': 'uint8', 'char': 'uint8'}.get(name, name))
    return values


def encode(type_name, stamp=None, **fields):
    """Return a message in CDR; `stamp` [ns] is that of its header."""
    if stamp is not None:
        sec, nanosec = divmod(stamp, 10**9)
        fields['header'] = {'stamp': {'sec': sec, 'nanosec': nanosec}}
    message = of_type((Nodetype.NAME, type_name), fields)
    return bytes(TYPES.serialize_cdr(message, type_name))


def joint_state(stamp, **positions):
    """Return a sensor_msgs/JointState in CDR."""
    return encode(
        'sensor_msgs/msg/JointState',
        stamp,
        name=list(positions),
        position=list(positions.values()),
    )


def write_bag(directory, topics):
    """Write a bag: the topics' types and messages (log time [ns], CDR) by name."""
    with BagWriter(directory) as writer:
        for name, (type_name, _) in topics.items():
            writer.add_topic(name, type_name)
        for time, name, data in _in_order(topics):
            writer.write(name, data, time, time)
    return directory


def write_foreign_bag(directory, topics):
    """Write such a bag with rosbags."""
    with Writer(directory, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            name: writer.add_connection(name, type_name, typestore=TYPES)
            for name, (type_name, _) in topics.items()
        }
        for time, name, data in _in_order(topics):
            writer.write(connections[name], time, data)
    return directory


def write_file(path, topics, notes=(), definitions=(), compression=CompressionType.LZ4):
    """Write such a file with the writer of mcap, with other definitions for some types."""
    with open(path, 'wb') as stream:
        writer = mcap.writer.Writer(stream, compression=compression)
        writer.start(profile='ros2')
        channels = {}
        for name, (type_name, _) in topics.items():
            text = dict(definitions).get(type_name) or schema_text(type_name)
            schema = writer.register_schema(type_name, 'ros2msg', text.encode())
            channels[name] = writer.register_channel(name, 'cdr', schema)
        for time, name, data in _in_order(topics):
            writer.add_message(channels[name], time, data, time)
        writer.add_metadata('tactile_push', dict(notes))
        writer.finish()
    return path


def _in_order(topics):
    rows = [(time, name, data) for name, (_, messages) in topics.items() for time, data in messages]
    return sorted(rows, key=lambda row: row[0])
