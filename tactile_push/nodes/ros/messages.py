# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Between ROS messages and the stamps and fields of `tactile_push.pipeline`."""

from typing import Any, TypeVar

from rclpy.publisher import Publisher

from tactile_push.pipeline import Fields, Stamp

Message = TypeVar('Message')


def stamp_of(message: Any) -> Stamp:
    """Return the stamp of a message with a header [s, ns]."""
    stamp = message.header.stamp
    return stamp.sec, stamp.nanosec


def filled(message: Message, fields: Fields) -> Message:
    """Set fields of a message, those of the messages within it included, and return it."""
    for name, value in fields.items():
        if isinstance(value, dict):
            filled(getattr(message, name), value)
        else:
            setattr(message, name, value)
    return message


def publish(publisher: Publisher, fields: Fields) -> None:
    """Publish a message with given fields."""
    publisher.publish(filled(publisher.msg_type(), fields))
