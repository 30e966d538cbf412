# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag with what a real `active_sensing` node would have said meanwhile."""

import json
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import patch

import rclpy
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState

from tactile_push.bags import BagReader, BagWriter
from tactile_push.nodes.active_sensing import ActiveSensingNode
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.stamps import epoch_of, seconds_since

DATA = Path(__file__).parents[1] / 'data'
TICKS, STATE, POSE = '/push_controller/state', '/active_sensing/state', '/object_pose'
KINDS = {
    STATE: 'sensor_msgs/msg/JointState',
    POSE: 'geometry_msgs/msg/PoseWithCovarianceStamped',
}
# The pushed edge is known; the rest is the default, which is the block of both bags.
PARAMETERS = {'edge': 0, 'noise': 0.003, 'use_sim_time': False}
DELAY = 3_000_000  # of the node's messages [ns]


@dataclass
class Said:
    """A message of the node: topic, CDR, log time of the control period [ns]."""

    topic: str
    data: bytes
    log_time: int


def said_by_a_node(bag, from_tick=0):
    """Return what a node says to the control periods of a bag, from one on."""
    with BagReader(bag) as reader:
        ticks = list(reader.messages([TICKS]))[from_tick:]
        epoch = epoch_of(reader.start_time // 10**9)
    arguments = [f'-p {name}:={json.dumps(value)}' for name, value in PARAMETERS.items()]
    rclpy.init(args=['--ros-args', *' '.join(arguments).split()])
    try:
        node = ActiveSensingNode()
        said = []

        def publisher(topic, kind):
            def publish(message):
                said.append(Said(topic, serialize_message(message), tick.log_time))

            return SimpleNamespace(msg_type=kind, publish=publish)

        outputs = {
            topic.removeprefix('/'): publisher(topic, kind)
            for topic, kind in ((STATE, JointState), (POSE, PoseWithCovarianceStamped))
        }
        # The clock of this machine is days away from that of the bag.
        sensing = Sensing(node._sensing.sensing, partial(seconds_since, epoch))
        with (
            patch.object(node, '_outputs', outputs),
            patch.object(node, '_sensing', sensing),
        ):
            for tick in ticks:
                node._on_tick(deserialize_message(tick.data, JointState))
        node.destroy_node()
    finally:
        rclpy.shutdown()
    return said


def with_sensing(bag, said, out, begin=0, pose_first=False, ticks_missed=0):
    """Write a bag with what was said in it, from a time on [ns], without some first ticks."""
    order = {STATE: 1, POSE: 0 if pose_first else 2}
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        for topic, kind in KINDS.items():
            writer.add_topic(topic, kind)
        rows = [(m.log_time, 0, m.topic, m.data) for m in reader.messages()]
        ticks = [row for row in rows if row[2] == TICKS]
        rows = [row for row in rows if row not in ticks[:ticks_missed]]
        rows += [(m.log_time + DELAY, order[m.topic], m.topic, m.data) for m in said]
        for log_time, _, topic, data in sorted(rows, key=lambda row: row[:2]):
            if log_time >= reader.start_time + begin:
                writer.write(topic, data, log_time, log_time)
        notes = json.loads(reader.notes['tactile_push.parameters'])
        notes['active_sensing'] = PARAMETERS
        writer.note('tactile_push.parameters', json.dumps(notes))
    return out
