# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags written by rosbags."""

import numpy as np
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.typesys import Stores, get_typestore

from support.bag_files import (
    CLOCK,
    SECOND,
    clock_message,
)

TYPES = get_typestore(Stores.ROS2_JAZZY)
JOINT_STATE = 'sensor_msgs/msg/JointState'

QOS = Qos(
    QosHistory.KEEP_LAST,
    7,
    QosReliability.BEST_EFFORT,
    QosDurability.VOLATILE,
    QosTime(1, 2),
    QosTime(3, 4),
    QosLiveliness.AUTOMATIC,
    QosTime(5, 6),
    False,
)


def refuse(line):
    """Stand in for `warn` where nothing may be warned of."""
    raise AssertionError(line)


def joint_state(step):
    """Return a sensor_msgs/JointState in CDR."""
    stamp = TYPES.types['builtin_interfaces/msg/Time'](sec=step, nanosec=500_000_000)
    header = TYPES.types['std_msgs/msg/Header'](stamp=stamp, frame_id='finger_base')
    message = TYPES.types[JOINT_STATE](
        header=header,
        name=['theta', 'phi'],
        position=np.array([0.5 * step, -1.0]),
        velocity=np.array([]),
        effort=np.array([2.0]),
    )
    return bytes(TYPES.serialize_cdr(message, JOINT_STATE))


def write_by_rosbags(path, mode, storage=StoragePlugin.MCAP):
    """Write a bag of two topics; return what was written."""
    writer = RosbagsWriter(path, version=9, storage_plugin=storage)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    writer.set_custom_data('object', 'block')
    written = []
    with writer:
        clock = writer.add_connection('/clock', CLOCK, typestore=TYPES, offered_qos_profiles=[QOS])
        state = writer.add_connection('/state', JOINT_STATE, typestore=TYPES)
        for step in range(50):
            for topic, data in ((clock, clock_message(step * SECOND)), (state, joint_state(step))):
                time = step * SECOND + topic.id
                writer.write(topic, time, data)
                written.append((topic.topic, time, data))
    return written


MODES = [
    CompressionMode.NONE,
    CompressionMode.FILE,
    CompressionMode.MESSAGE,
    CompressionMode.STORAGE,
]
