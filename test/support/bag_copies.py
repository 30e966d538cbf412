# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The recorded bags that tests replay, and copies of bags."""

import shutil
from pathlib import Path

from mcap.writer import Writer

from tactile_push.bags import BagReader, BagWriter
from tactile_push.replay import replay

DATA = Path(__file__).parents[1] / 'data'


def copied(
    bag, out, rename=lambda topic: topic, keep=lambda topic: True, note=True, definitions=()
):
    """Copy a bag, or a part of it, under other names, with other definitions of some topics."""
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            if keep(topic.name):
                definition = dict(definitions).get(topic.name, topic.definition)
                writer.add_topic(rename(topic.name), topic.type_name, definition=definition)
        for message in reader.messages():
            if keep(message.topic):
                writer.write(
                    rename(message.topic), message.data, message.log_time, message.publish_time
                )
        for key, text in reader.notes.items() if note else ():
            writer.note(key, text)
    return out


def with_topics(bag, out, *topics):
    """Copy a bag and add topics, each with a message at each tenth of its first second.

    A topic is its name, its type, the encodings of messages and schema, the schema, a message.
    """
    out.mkdir()
    with BagReader(bag) as reader:
        for file in reader.files:
            shutil.copy(file, out)
        start = reader.start_time
    with open(out / 'more_0.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        for name, type_name, encoding, schema_encoding, schema, data in topics:
            number = writer.register_schema(type_name, schema_encoding, schema) if type_name else 0
            channel = writer.register_channel(name, encoding, number)
            for k in range(10):
                writer.add_message(channel, start + k * 10**8, data, start)
        writer.finish()
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
