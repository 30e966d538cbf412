# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag like another one, in which some topics are made anew."""

import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from mcap_ros2._dynamic import EncoderFunction, serialize_dynamic

from tactile_push.bags import BagReader, BagWriter, Message, schema_text
from tactile_push.pipeline import Fields


class NewBag:
    """Copies messages of a bag and writes new ones from their fields."""

    def __init__(self, writer: BagWriter, encoders: Mapping[str, EncoderFunction]) -> None:
        self._writer = writer
        self._encoders = encoders

    def copy(self, message: Message) -> None:
        """Write a message as it lies in the other bag."""
        self._writer.write(message.topic, message.data, message.log_time, message.publish_time)

    def write(self, topic: str, fields: Fields, log_time: int) -> None:
        """Write a message, at a log time [ns], of a topic that is made anew; leave out others."""
        if topic in self._encoders:
            self._writer.write(topic, self._encoders[topic](fields), log_time, log_time)


@contextmanager
def new_bag(
    out: str | os.PathLike[str], bag: BagReader, made: Mapping[str, str]
) -> Iterator[NewBag]:
    """Write a bag with the topics and notes of another one; if anything fails, no bag is left.

    `made` has the types of the topics that are made anew, by full name; the new bag has these
    topics even if the other one does not. An OSError tells the name of the new bag.
    """
    writer = BagWriter(out)
    try:
        with writer:
            yield NewBag(writer, _begin(writer, bag, made))
    except BaseException as error:
        shutil.rmtree(out, ignore_errors=True)
        if isinstance(error, OSError) and error.filename is None:
            raise OSError(error.errno, error.strerror, os.fspath(out)) from None
        raise


def encoder(type_name: str, definition: str) -> EncoderFunction:
    """Return what encodes the fields of a message type with a given definition as CDR."""
    return serialize_dynamic(type_name, definition)[type_name]


def _begin(
    writer: BagWriter, bag: BagReader, made: Mapping[str, str]
) -> dict[str, EncoderFunction]:
    """Add topics and notes, and return the encoders of the topics that are made anew."""
    for topic in bag.topics.values():
        writer.add_topic(
            topic.name,
            topic.type_name,
            qos=topic.qos,
            type_hash=topic.type_hash,
            definition=topic.definition,
            encodings=topic.encodings,
        )
    encoders = {}
    for name, type_name in made.items():
        known = bag.topics.get(name)
        definition = known.definition if known and known.decodes else schema_text(type_name)
        encoders[name] = encoder(type_name, definition)
        if known is None:
            writer.add_topic(name, type_name, definition=definition)
    for key, text in bag.notes.items():
        writer.note(key, text)
    return encoders
