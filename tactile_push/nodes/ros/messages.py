# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Turns the fields of `tactile_push.pipeline` into ROS messages."""

from typing import TypeVar

from rclpy.publisher import Publisher

from tactile_push.pipeline import Fields

Message = TypeVar('Message')


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
