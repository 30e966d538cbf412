# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Rosbag2's metadata as written and read back; `test_writer.py` compares whole bags."""

import yaml

from support.bag_by_rosbags import refuse
from tactile_push.bags.bag_files import BagMetadata, parse_metadata
from tactile_push.bags.metadata import FileMetadata, Messages, TopicMetadata, bag_metadata, to_yaml


def test_written_metadata_are_read():
    messages = Messages()
    for time in (7, 5, 11):
        messages.add(time)
    file = FileMetadata('bag_0.mcap', messages)
    topic = TopicMetadata('/clock', 'rosgraph_msgs/msg/Clock', [{'depth': 3}], 'RIHS01_0', 3)
    text = to_yaml(bag_metadata(messages, [topic], [file], {'operator': 'ann'}))
    assert parse_metadata(yaml.safe_load(text), refuse) == BagMetadata(
        ('bag_0.mcap',), 3, 11, '', {'operator': 'ann'}
    )


def test_bag_without_messages_begins_never_and_lasts_no_time():
    information = bag_metadata(Messages(), [], [], {})
    assert information['starting_time'] == {'nanoseconds_since_epoch': 2**63 - 1}
    assert information['duration'] == {'nanoseconds': 0}
    assert information['custom_data'] is None


def test_equal_parts_are_written_out():
    part = {'sec': 1}
    assert to_yaml([part, part]) == '- sec: 1\n- sec: 1\n'
