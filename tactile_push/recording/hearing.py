# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Hears one topic of a running ROS graph, for a command that is no node."""

from collections.abc import Collection
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.signals import SignalHandlerOptions
from rclpy.subscription import Subscription

from tactile_push.bags import BagWriter
from tactile_push.recording.recorder import (
    Taken,
    common_type_hash,
    compatible_profile,
    message_class,
    qos_entry,
    take_all,
)


class Hearing:
    """Takes the messages of a topic when it is asked for them, once there is a publisher.

    Parameters
    ----------
    topic : str
        Name of the topic.
    types : collection of str
        Types that it may have; publishers of others are not heard.
    depth : int
        Number of messages that wait to be taken; the oldest give way.

    Raises
    ------
    ValueError
        If that is no name of a topic.
    """

    def __init__(self, topic: str, types: Collection[str], depth: int) -> None:
        self._types, self._depth = types, depth
        self._context = Context()
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self._node = Node(
            *('tactile_push_command',),
            context=self._context,
            enable_rosout=False,
            start_parameter_services=False,
        )
        self._subscription: Subscription | None = None
        self.type_name = ''  #: of the topic; empty until it is heard
        try:
            self.topic = self._node.resolve_topic_name(topic)  #: its full name
        except RuntimeError:  # rclpy's RCLError, which is not public
            self.close()
            raise ValueError(f'expected the name of a topic, got {topic!r}') from None

    def __enter__(self) -> 'Hearing':
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Leave the graph."""
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def take(self) -> list[Taken]:
        """Return the messages that have come since the last call, in their order."""
        if self._subscription is None:
            self._look()
        return [] if self._subscription is None else list(take_all(self.topic, self._subscription))

    def content(self, message: Taken) -> Any:
        """Return a message with its fields."""
        return deserialize_message(message.data, message_class(self.type_name))

    def add_topic(self, bag: BagWriter) -> None:
        """Add the topic that is heard to a bag, as its publishers offer it."""
        ours = self._publishers()
        bag.add_topic(
            self.topic,
            self.type_name,
            qos=[qos_entry(publisher.qos_profile) for publisher in ours],
            type_hash=common_type_hash(ours),
        )

    def _publishers(self) -> list[Any]:
        found = self._node.get_publishers_info_by_topic(self.topic)
        return [one for one in found if one.topic_type in (self.type_name, *self._types)]

    def _look(self) -> None:
        if publishers := self._publishers():
            self.type_name = publishers[0].topic_type
            profile = compatible_profile(self._publishers())
            profile.depth = self._depth
            self._subscription = self._node.create_subscription(
                *(message_class(self.type_name), self.topic, lambda data: None, profile), raw=True
            )
