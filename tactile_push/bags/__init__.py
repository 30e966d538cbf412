# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags: MCAP files that `ros2 bag`, Foxglove, PlotJuggler and rosbags open.

Nothing here needs ROS but `tactile_push.recording.recorder`, which is therefore not imported here.
"""

from tactile_push.bags.definitions import schema_text
from tactile_push.bags.reader import BagError, BagReader, Message
from tactile_push.bags.topic import Topic
from tactile_push.bags.writer import BagWriter

__all__ = ['BagError', 'BagReader', 'BagWriter', 'Message', 'Topic', 'schema_text']
