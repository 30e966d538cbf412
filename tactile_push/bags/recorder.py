# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Record topics of a running ROS graph into a bag."""

from collections.abc import Sequence
from functools import partial
from importlib import import_module
from typing import cast

from rclpy.clock import Clock, ClockType, ROSClock
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from tactile_push.bags.writer import FLUSH_PERIOD, BagWriter

# How often the graph is looked at while topics are missing, and after that [s].
_SEARCH_PERIOD = 0.05
_WATCH_PERIOD = 1.0

# Messages of a topic that may wait while the process is kept from running.
_DEPTH = 1000


class Recorder:
    """Subscriptions that write what they receive, undecoded, into a bag.

    A topic is subscribed to as soon as it has a publisher. Its type, type hash and offered
    quality of service are those of the publishers that it has at that moment.

    A message gets the times that rosbag2 gives it: received and sent, as the middleware stamped
    it. If the node uses simulated time, both are the node's clock at reception, since the
    middleware stamps with the system's clock and a bag must not mix two. What is received before
    the first tick of the simulated clock gets time 0.

    Parameters
    ----------
    node : rclpy.node.Node
        Node that subscribes, spun by the caller.
    topics : sequence of str
        Topics to record, expanded and remapped like all names of the node.
    writer : BagWriter
        Bag to write to. The caller closes it, after `stop`.

    Attributes
    ----------
    counts : dict of str to int
        Messages written so far, by full topic name.
    """

    def __init__(self, node: Node, topics: Sequence[str], writer: BagWriter) -> None:
        self._node = node
        self._clock = cast(ROSClock, node.get_clock())
        self._writer = writer
        self._subscriptions: dict[str, Subscription] = {}
        self._refused: set[str] = set()
        self.counts = {node.resolve_topic_name(topic): 0 for topic in topics}
        # Simulated time may stand still or not run yet.
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._graph_timer = node.create_timer(
            _SEARCH_PERIOD, self._look_at_graph, clock=steady_clock
        )
        # The writer flushes only while it is written to; the topics may fall silent.
        self._flush_timer = node.create_timer(FLUSH_PERIOD, writer.flush, clock=steady_clock)
        self._look_at_graph()

    def missing(self) -> list[str]:
        """Return the full names of the topics that are not subscribed to yet."""
        return [topic for topic in self.counts if topic not in self._subscriptions]

    def stop(self) -> None:
        """Stop recording; further calls do nothing."""
        self._node.destroy_timer(self._graph_timer)
        self._node.destroy_timer(self._flush_timer)
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)

    def _look_at_graph(self) -> None:
        for topic in self.counts:
            publishers = self._node.get_publishers_info_by_topic(topic)
            if not publishers or topic in self._refused:
                continue
            profile = compatible_profile(publishers)
            subscription = self._subscriptions.get(topic)
            if subscription is None:
                self._add_topic(topic, publishers, profile)
            elif _demands_more(subscription.qos_profile, profile):
                # A publisher has come that offers less than the others.
                self._node.destroy_subscription(subscription)
                self._subscribe(topic, publishers[0].topic_type, profile)
        if not self.missing():
            self._graph_timer.timer_period_ns = int(_WATCH_PERIOD * 1e9)

    def _add_topic(
        self, topic: str, publishers: list[TopicEndpointInfo], profile: QoSProfile
    ) -> None:
        type_name = publishers[0].topic_type
        type_hash = publishers[0].topic_type_hash
        try:
            message_class(type_name)
            self._writer.add_topic(
                topic,
                type_name,
                qos=[qos_entry(publisher.qos_profile) for publisher in publishers],
                type_hash=str(type_hash) if type_hash.version > 0 else '',
            )
        except LookupError as error:
            self._refused.add(topic)
            self._node.get_logger().error(f'cannot record {topic}: {error}')
            return
        self._subscribe(topic, type_name, profile)

    def _subscribe(self, topic: str, type_name: str, profile: QoSProfile) -> None:
        self._subscriptions[topic] = self._node.create_subscription(
            message_class(type_name), topic, partial(self._write, topic), profile, raw=True
        )

    def _write(self, topic: str, data: bytes, info: dict[str, int]) -> None:
        if self._clock.ros_time_is_active:
            log_time = publish_time = self._clock.now().nanoseconds
        else:
            log_time, publish_time = info['received_timestamp'], info['source_timestamp']
        self._writer.write(topic, data, log_time, publish_time)
        self.counts[topic] += 1


def message_class(type_name: str) -> type:
    """Return the Python class of a message type.

    Parameters
    ----------
    type_name : str
        For example ``'sensor_msgs/msg/JointState'``.

    Raises
    ------
    LookupError
        If the class is not installed.
    """
    package, *_, name = type_name.split('/')
    try:
        return getattr(import_module(f'{package}.msg'), name)
    except (ImportError, AttributeError):
        raise LookupError(f'the message type {type_name} is not installed') from None


def compatible_profile(publishers: Sequence[TopicEndpointInfo]) -> QoSProfile:
    """Return the most demanding quality of service that all publishers of a topic offer.

    Parameters
    ----------
    publishers : sequence of TopicEndpointInfo
        What the graph tells about the publishers.
    """
    offers = [publisher.qos_profile for publisher in publishers]
    reliable = all(offer.reliability == ReliabilityPolicy.RELIABLE for offer in offers)
    latched = all(offer.durability == DurabilityPolicy.TRANSIENT_LOCAL for offer in offers)
    return QoSProfile(
        depth=_DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _demands_more(ours: QoSProfile, offered: QoSProfile) -> bool:
    """Return whether a subscription demands what not all publishers offer any more."""
    reliable, latched = ReliabilityPolicy.RELIABLE, DurabilityPolicy.TRANSIENT_LOCAL
    return (ours.reliability == reliable and offered.reliability != reliable) or (
        ours.durability == latched and offered.durability != latched
    )


def qos_entry(profile: QoSProfile) -> dict[str, object]:
    """Return a quality of service with the keys and words of a bag's metadata.

    Parameters
    ----------
    profile : rclpy.qos.QoSProfile
        For example that of a publisher, as the graph tells it.
    """
    return {
        'history': profile.history.short_key,
        'depth': profile.depth,
        'reliability': profile.reliability.short_key,
        'durability': profile.durability.short_key,
        'deadline': _duration_entry(profile.deadline),
        'lifespan': _duration_entry(profile.lifespan),
        'liveliness': profile.liveliness.short_key,
        'liveliness_lease_duration': _duration_entry(profile.liveliness_lease_duration),
        'avoid_ros_namespace_conventions': profile.avoid_ros_namespace_conventions,
    }


def _duration_entry(duration: Duration) -> dict[str, int]:
    sec, nsec = divmod(duration.nanoseconds, 10**9)
    return {'sec': sec, 'nsec': nsec}
