# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps in the headers of messages."""

import re
import struct

from tactile_push.bags.fields import fields_of
from tactile_push.bags.reader import BagError, BagReader, Message
from tactile_push.bags.topic import Topic

# The first fields of a definition that begins with a header; signs do not matter here.
_HEADER = re.compile(r'(\w+)\.stamp\.sec u?int32, \1\.stamp\.nanosec u?int32, \1\.frame_id string')

_STAMP = {0: struct.Struct('>iI'), 1: struct.Struct('<iI')}  # by the encapsulation's last bit
_STAMP_AT = 4  # behind the encapsulation header


class HeaderStamps:
    """The stamps of a bag's messages, read without decoding the messages.

    A topic has a header if that is the first field of its type, as is the custom.
    """

    def __init__(self, bag: BagReader) -> None:
        self._bag = bag
        self._topics = {
            name for name, topic in bag.topics.items() if topic.decodes and _begins(topic)
        }

    def __contains__(self, topic: str) -> bool:
        """Return whether the messages of a topic have a header."""
        return topic in self._topics

    def of(self, message: Message) -> int:
        """Return the stamp of a message [ns]; BagError if the message ends before it."""
        try:
            sec, nanosec = _STAMP[message.data[1] & 1].unpack_from(message.data, _STAMP_AT)
        except (IndexError, struct.error):
            at = (message.log_time - self._bag.start_time) * 1e-9
            raise BagError(
                f'{self._bag.path}: expected a header in the message of {message.topic} at '
                f'{at:.6f} s, got {len(message.data)} bytes'
            ) from None
        return sec * 10**9 + nanosec


def _begins(topic: Topic) -> bool:
    """Return whether the first field of a topic's messages is a header."""
    try:
        fields = fields_of(topic.type_name, topic.definition)
    except ValueError:
        return False
    return _HEADER.match(', '.join(map(' '.join, fields.items()))) is not None
