# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The recorded bags that tests replay, and copies of bags."""

from pathlib import Path

from tactile_push.bags import BagReader, BagWriter
from tactile_push.replay import replay

DATA = Path(__file__).parents[1] / 'data'


def copied(bag, out, rename=lambda topic: topic, keep=lambda topic: True, note=True):
    """Copy a bag, or a part of it, under other names."""
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            if keep(topic.name):
                writer.add_topic(rename(topic.name), topic.type_name, definition=topic.definition)
        for message in reader.messages():
            if keep(message.topic):
                writer.write(
                    rename(message.topic), message.data, message.log_time, message.publish_time
                )
        for key, text in reader.notes.items() if note else ():
            writer.note(key, text)
    return out


def contents(bag, topics=None):
    """Return messages by topic and stamp as text: every digit, and NaN as NaN."""
    with BagReader(bag) as reader:
        return sorted(
            (message.topic, str(reader.decode(message))) for message in reader.messages(topics)
        )


def replayed(bag, **how):
    """Replay a bag and return the comparison of each finger."""
    with BagReader(bag) as reader:
        return replay(reader, **how)


def without(bag, out, *topics):
    """Copy a bag without the messages of some topics and without its notes."""
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        for message in reader.messages():
            if message.topic not in topics:
                writer.write(message.topic, message.data, message.log_time, message.publish_time)
    return out
