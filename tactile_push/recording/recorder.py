# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Record topics of a running ROS graph into a bag."""

import math
import re
import struct
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from rosgraph_msgs.msg import Clock as ClockMessage

from tactile_push.bags import BagWriter
from tactile_push.bags.writer import FLUSH_PERIOD
from tactile_push.interface import CLOCK
from tactile_push.recording.simulated_time import SimulatedTime

_TAKE_PERIOD = 0.02  # between looks for messages [s]; shorter costs processor time, see `_DEPTH`
_LAST_FLIGHT = 0.05  # in which what was sent before the end arrives [s]; usually 1 ms
_SEARCH_PERIOD = 0.1  # between looks for new topics, as in rosbag2 [s]
_WATCH_LOOKS = 10  # looks for new topics between two at the publishers of recorded topics

# Messages of a topic that may wait while the process does not run: those of a second, at the
# highest rate at which none may be lost.
_DEPTH = 5000


# As ROS names message types; Python's own names begin otherwise.
_TYPE_NAME = re.compile(r'([A-Za-z][A-Za-z0-9_]*)/msg/([A-Z][A-Za-z0-9]*)')


class _TakenFrom(CallbackGroup):
    """Keeps subscriptions from the executor, which takes too long for each message."""

    def can_execute(self, entity: object) -> bool:
        return False

    def beginning_execution(self, entity: object) -> bool:
        return False

    def ending_execution(self, entity: object) -> None:
        pass


@dataclass(frozen=True, slots=True)
class Taken:
    """A message and the middleware's stamps on it."""

    topic: str  #: on which it came
    data: bytes  #: as it came
    received: int  #: when it came [ns]
    sent: int  #: when it was published [ns]
    latched: bool  #: whether it may be older than the subscription


class Recorder:
    """Subscriptions whose messages are written to a bag undecoded.

    A topic is subscribed to as soon as it has a publisher. Its type hash and offered quality of
    service are those of the publishers that it has at that moment; the subscription asks for what
    all of them offer, and for less when one comes that offers less.

    A message gets the times that rosbag2 gives it (rosbag2_transport/src/rosbag2_transport/
    recorder.cpp, create_subscription): when it was received and sent, as the middleware stamped it.
    If the node uses simulated time, the former is what ``/clock`` showed when the message was
    received; until that clock runs nothing is recorded but latched messages, at its first tick.

    If the type of a topic is not installed, or differs from the type that is recorded, the recorder
    reports that once.

    The caller spins the node, where an OSError is raised if the bag cannot be written, and closes
    the writer after `stop`. `topics` are expanded and remapped like all names of the node; None
    stands for all that are not hidden. `counts` are the messages written by full topic name.
    """

    def __init__(self, node: Node, topics: Sequence[str] | None, writer: BagWriter) -> None:
        self._node = node
        self._writer = writer
        self._everything = topics is None
        self.counts = {node.resolve_topic_name(topic): 0 for topic in topics or ()}
        self._subscriptions: dict[str, Subscription] = {}
        self._types: dict[str, str] = {}
        self._refused: set[tuple[str, str]] = set()
        self._looks = 0
        self._group = _TakenFrom()
        self._simulated: SimulatedTime | None = None
        if node.get_clock().ros_time_is_active:
            node.get_logger().info('waiting for /clock')
            profile = QoSProfile(depth=_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
            self._clock_subscription = self._subscribe(CLOCK, ClockMessage, profile)
            self._simulated = SimulatedTime()
        # Timers must run even while simulated time stands still.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timers = [
            node.create_timer(_TAKE_PERIOD, self._take, clock=steady),
            node.create_timer(_SEARCH_PERIOD, self._look_at_graph, clock=steady),
            # The writer flushes by itself only when a message is written.
            node.create_timer(FLUSH_PERIOD, writer.flush, clock=steady),
        ]
        self._look_at_graph()

    def missing(self) -> list[str]:
        """Return the full names of the topics that are not subscribed to yet."""
        return [topic for topic in self.counts if topic not in self._subscriptions]

    def stop(self) -> None:
        """Record what has been sent, and nothing more; further calls do nothing.

        The end is the same for all topics, although a message may overtake one that led to it.
        """
        if not self._timers:
            return
        end = time.time_ns()
        while self._timers:
            self._node.destroy_timer(self._timers.pop())
        time.sleep(_LAST_FLIGHT)
        try:
            self._take(end)
        finally:
            for subscription in self._subscriptions.values():
                self._node.destroy_subscription(subscription)
            self._subscriptions.clear()
            if self._simulated is not None:
                self._node.destroy_subscription(self._clock_subscription)
                self._simulated = None

    def _look_at_graph(self) -> None:
        watch = self._looks % _WATCH_LOOKS == 0
        self._looks += 1
        for topic, types in self._node.get_topic_names_and_types():
            if not (
                topic in self.counts or (self._everything and not topic_or_service_is_hidden(topic))
            ):
                continue
            if topic in self._subscriptions:
                if not watch:
                    continue
            elif all((topic, type_name) in self._refused for type_name in types):
                continue
            if publishers := self._node.get_publishers_info_by_topic(topic):
                self._adapt(topic, publishers)

    def _adapt(self, topic: str, publishers: list[TopicEndpointInfo]) -> None:
        """Subscribe as the publishers of a topic ask for."""
        for publisher in publishers:
            self._judge(topic, publisher.topic_type)
        if topic not in self._types:
            return
        ours = [entry for entry in publishers if entry.topic_type == self._types[topic]]
        if not ours:
            return
        profile = compatible_profile(ours)
        subscription = self._subscriptions.get(topic)
        if subscription is None:
            self._add_topic(topic, ours)
        elif _demands_more(subscription.qos_profile, profile):
            # A publisher has come that offers less than the others.
            self._take()
            self._node.destroy_subscription(subscription)
        else:
            return
        type_ = message_class(self._types[topic])
        self._subscriptions[topic] = self._subscribe(topic, type_, profile)

    def _judge(self, topic: str, type_name: str) -> None:
        """Decide on the type of a topic, and report types that are not recorded."""
        if self._types.get(topic) == type_name or (topic, type_name) in self._refused:
            return
        reason = ''
        if topic in self._types:
            reason = f'its other type, {self._types[topic]}, is recorded'
        else:
            try:
                message_class(type_name)
            except LookupError as error:
                reason = str(error)
        if reason:
            self._refused.add((topic, type_name))
            self._node.get_logger().error(f'cannot record {topic} as {type_name}: {reason}')
        else:
            self._types[topic] = type_name

    def _add_topic(self, topic: str, publishers: list[TopicEndpointInfo]) -> None:
        type_name = self._types[topic]
        self._writer.add_topic(
            topic,
            type_name,
            qos=[qos_entry(publisher.qos_profile) for publisher in publishers],
            type_hash=common_type_hash(publishers),
        )
        self.counts.setdefault(topic, 0)
        self._node.get_logger().info(f'recording {topic} ({type_name})')

    def _subscribe(self, topic: str, type_: type, profile: QoSProfile) -> Subscription:
        return self._node.create_subscription(
            type_,
            topic,
            lambda data: None,  # never called
            profile,
            callback_group=self._group,
            raw=True,
        )

    def _take(self, end: float = math.inf) -> None:
        """Write what was sent or received until a time [ns], in the order in which it came."""
        waiting = self._simulated is not None and not self._simulated.running
        taken = [
            message
            for topic, subscription in self._subscriptions.items()
            if not (waiting and _is_latched(subscription))
            for message in take_all(topic, subscription)
            if min(message.sent, message.received) <= end
        ]
        if self._simulated is not None:
            for tick in take_all(CLOCK, self._clock_subscription):
                self._simulated.tick(tick.received, _clock_time(tick.data))
        for message in sorted(taken, key=lambda message: message.received):
            log_time = self._log_time(message)
            if log_time is not None:
                self._writer.write(message.topic, message.data, log_time, message.sent)
                self.counts[message.topic] += 1

    def _log_time(self, message: Taken) -> int | None:
        if self._simulated is None:
            return message.received
        if message.topic == CLOCK and (tick := _clock_time(message.data)):
            return tick  # even if this subscription received it before the other one
        return self._simulated.at(message.received, latched=message.latched)


def take_all(topic: str, subscription: Subscription) -> Iterator[Taken]:
    """Take what waits in a raw subscription, but no more than a full queue.

    Parameters
    ----------
    topic : str
        Name of its topic.
    subscription : rclpy.subscription.Subscription
        The subscription, from which no executor takes.

    Yields
    ------
    Taken
        Messages in their order.
    """
    latched = _is_latched(subscription)
    handle = subscription.handle
    with handle:
        for _ in range(_DEPTH):
            taken = handle.take_message(subscription.msg_type, True)
            if taken is None:
                return
            data, stamps = taken
            received, sent = stamps['received_timestamp'], stamps['source_timestamp']
            yield Taken(topic, data, received, sent, latched)


def _clock_time(data: bytes) -> int:
    """Return the time in a rosgraph_msgs/Clock [ns]."""
    sec, nanosec = struct.unpack_from('<iI' if data[1] & 1 else '>iI', data, 4)
    return sec * 10**9 + nanosec


def _is_latched(subscription: Subscription) -> bool:
    return subscription.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL


def message_class(type_name: str) -> type:
    """Return the Python class of a message type; LookupError if it is not installed."""
    match = _TYPE_NAME.fullmatch(type_name)
    if match is None:
        raise LookupError(f"expected a message type package/msg/Type, got '{type_name}'")
    try:
        return getattr(import_module(f'{match[1]}.msg'), match[2])
    except (ImportError, AttributeError):
        raise LookupError(f'the message type {type_name} is not installed') from None


def compatible_profile(publishers: Sequence[TopicEndpointInfo]) -> QoSProfile:
    """Return the most demanding quality of service that all publishers of a topic offer."""
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
    """Return a quality of service with the keys and words of a bag's metadata."""
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


def common_type_hash(publishers: Sequence[TopicEndpointInfo]) -> str:
    """Return the type hash on which all publishers agree that know one, or ''."""
    known = [publisher.topic_type_hash for publisher in publishers]
    hashes = {str(type_hash) for type_hash in known if type_hash.version > 0}
    return hashes.pop() if len(hashes) == 1 else ''


def _duration_entry(duration: Duration) -> dict[str, int]:
    sec, nsec = divmod(duration.nanoseconds, 10**9)
    return {'sec': sec, 'nsec': nsec}
