# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Publish a bag into a running ROS graph."""

import contextlib
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future, TimeoutError
from dataclasses import replace
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock as ClockMessage

from tactile_push.bags import BagError, Message, Topic, schema_text
from tactile_push.bags.fields import fields_of, same_fields
from tactile_push.interface import CLOCK
from tactile_push.playing.offers import Offer, combined_offer
from tactile_push.playing.playback import Playback
from tactile_push.playing.read_ahead import ReadAhead
from tactile_push.playing.schedule import Event, Part, events
from tactile_push.recording.recorder import message_class

LOOK_PERIOD = 0.05  # between looks at the graph [s]; a person does not notice less
QUIET = 2.0  # for which the graph must not change [s]: nodes are discovered one by one
PATIENCE = 5.0  # after which the play begins in any case [s]; discovery takes up to 3 s
ANSWER_TIMEOUT = 1.0  # of the playing thread, which may have to wait for the disk [s]
LAST_WORDS = 1.0  # for subscribers to acknowledge the last messages [s]; picked
LAST_FLIGHT = 0.5  # for the last messages, if somebody need not acknowledge them [s]; picked
TIME_ENDS = 2**31 * 10**9  # the first time that builtin_interfaces/Time cannot hold [ns]


class Player:
    """Publishers of a bag's topics, and a thread that publishes each message when it is due.

    Each topic is offered with a quality of service that serves whoever any of the recorded
    publishers served. The play begins when the graph has subscribers, all of them are matched and
    nothing has changed for `QUIET`, or after `PATIENCE`.

    A topic is left out with a warning if its messages are not CDR, or if its type is not installed
    or is another version of the recorded one. The player decodes the first message of each topic
    when it is due and warns if that fails; it publishes all messages as they are.
    """

    def __init__(
        self,
        node: Node,
        part: Part,
        finished: Callable[[], None],  # called in the node's thread at the end or after an error
        *,
        rate: float = 1.0,
        loop: bool = False,
        clock_rate: float = 0.0,  # of /clock by the bag's time, besides before each message [Hz]
        paused: bool = False,
        names: Mapping[str, str] | None = None,  # new ones of topics
    ) -> None:
        self.published = 0
        self.error: Exception | None = None  # what ended the play early
        self._node = node
        self._publishers = _make_publishers(node, part, names or {})
        self._part = part = replace(part, topics=tuple(self._publishers))
        self._clock: Publisher | None = None
        if clock_rate:
            if part.end >= TIME_ENDS:
                raise BagError(f'{part.bag.path}: {CLOCK} cannot hold a time of {part.end} ns')
            self._clock = node.create_publisher(ClockMessage, CLOCK, 10)
        self._clock_message = ClockMessage()  # one for all: publishing copies it
        self._told = part.begin  # time last published on /clock [ns]
        self._rate, self._loop, self._paused = rate, loop, paused
        self._events = ReadAhead(
            events(part.messages, part.begin, part.end, clock_rate=clock_rate, loop=loop)
        )
        self._untried = set(self._publishers)  # topics of which no message has been decoded
        self._playback: Playback | None = None  # since the play began
        self._requests: SimpleQueue[tuple[Callable[[], Any], Future[Any]]] = SimpleQueue()
        self._stopping = False
        self._finished = node.create_guard_condition(finished)
        self._thread = Thread(target=self._run, name='play', daemon=True)
        self._seen: dict[str, int] = {}
        self._created = self._changed = time.monotonic()
        node.get_logger().info(f'waiting up to {PATIENCE:g} s for subscribers')
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(LOOK_PERIOD, self._look, clock=steady_clock)

    @property
    def waiting(self) -> bool:
        """Whether the play has yet to begin."""
        return self._playback is None

    @property
    def paused(self) -> bool:
        """Whether it is paused."""
        return self._paused

    @property
    def position(self) -> float:
        """Time played, from the beginning of the bag [s]."""
        part, played = self._part, 0
        if self._playback is not None:
            played = self._playback.head.played(time.monotonic_ns())
        length = part.end - part.begin
        played = played % length if self._loop else min(played, length)
        return (part.begin - part.bag.start_time + played) * 1e-9

    @property
    def late(self) -> int:
        """How many events were published late."""
        return 0 if self._playback is None else self._playback.late

    def pause(self, paused: bool) -> None:
        """Pause or go on."""
        self._paused = paused
        if self._playback is not None:
            head = self._playback.head
            self._ask(lambda: (head.pause if paused else head.resume)(time.monotonic_ns()))

    def step(self) -> Message | None:
        """Publish the next message of a paused play; return it, or None if there was none."""
        if self._playback is None or not self._paused:
            return None
        return self._ask(self._playback.step)

    def stop(self) -> None:
        """End the play; further calls do nothing."""
        self._stopping = True
        self._events.close()
        if self._thread.is_alive():
            self._requests.put((lambda: None, Future()))  # ends its wait
            self._thread.join()

    def _ask(self, request: Callable[[], Any]) -> Any:
        """Let the playing thread call `request`; return the outcome, None if none comes in time."""
        outcome: Future[Any] = Future()
        self._requests.put((request, outcome))
        with contextlib.suppress(TimeoutError):
            return outcome.result(ANSWER_TIMEOUT)

    def _look(self) -> None:
        """Begin to play when all subscribers are matched."""
        publishers = [*self._publishers.values(), *([self._clock] if self._clock else [])]
        seen = {publisher.topic: self._count_subscribers(publisher) for publisher in publishers}
        now = time.monotonic()
        if seen != self._seen:
            self._seen, self._changed = seen, now
        deaf = [p.topic for p in publishers if p.get_subscription_count() < seen[p.topic]]
        heard = [f'{name} ({count})' for name, count in seen.items() if count and name != CLOCK]
        quiet = now - self._changed >= QUIET
        if not (heard and quiet and not deaf) and now - self._created < PATIENCE:
            self._tell(self._told)
            return
        self._node.destroy_timer(self._timer)
        logger = self._node.get_logger()
        if deaf:
            logger.warning(f'subscribers are not all matched yet of {", ".join(deaf)}')
        if heard:
            logger.info(f'playing to the subscribers of {", ".join(heard)}')
        else:
            logger.warning('playing, but nobody listens')
        self._thread.start()

    def _count_subscribers(self, publisher: Publisher) -> int:
        """Count the subscribers that can be served."""
        return sum(
            qos_check_compatible(publisher.qos_profile, subscriber.qos_profile)[0]
            != QoSCompatibility.ERROR
            for subscriber in self._node.get_subscriptions_info_by_topic(publisher.topic)
        )

    def _is_not_acknowledged(self, publisher: Publisher) -> bool:
        """Return whether some subscriber never says that a message has arrived."""
        return any(
            subscriber.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
            for subscriber in self._node.get_subscriptions_info_by_topic(publisher.topic)
        )

    def _run(self) -> None:
        try:
            self._play()
            deadline = time.monotonic() + LAST_WORDS
            publishers = self._publishers.values()
            for publisher in publishers:
                left = 0.0 if self._stopping else max(deadline - time.monotonic(), 0.0)
                publisher.wait_for_all_acked(Duration(seconds=left))
            if not self._stopping and any(map(self._is_not_acknowledged, publishers)):
                time.sleep(LAST_FLIGHT)
        except Exception as error:
            self.error = error
        if not self._stopping:
            self._finished.trigger()

    def _play(self) -> None:
        self._playback = playback = Playback(self._events, self._rate, self._publish)
        if not self._paused:
            playback.head.resume(time.monotonic_ns())
        while not self._stopping:
            due = playback.advance(time.monotonic_ns())
            if playback.done:
                return
            wait = LOOK_PERIOD if due is None else max(due - time.monotonic_ns(), 0) * 1e-9
            try:
                request, outcome = self._requests.get(timeout=wait)
            except Empty:
                if due is None:  # it is paused
                    self._tell(self._told)
            else:
                outcome.set_result(request())

    def _publish(self, event: Event) -> None:
        if event.message is None or event.time != self._told:
            self._tell(event.time)
        if event.message is not None:
            publisher = self._publishers[event.message.topic]
            if event.message.topic in self._untried:
                self._try(event.message, publisher.msg_type)
            publisher.publish(event.message.data)
            self.published += 1

    def _try(self, message: Message, message_type: type) -> None:
        """Warn of a message that subscribers cannot decode."""
        self._untried.remove(message.topic)
        try:
            deserialize_message(message.data, message_type)
        except Exception:  # rclpy's RMWError, which is not public
            self._node.get_logger().warning(
                f'{message.topic}: the first message does not decode, subscribers will not get it'
            )

    def _tell(self, now: int) -> None:
        """Publish /clock, also while time stands still: a subscriber may come later."""
        self._told = now
        if self._clock is not None:
            self._clock_message.clock.sec, self._clock_message.clock.nanosec = divmod(now, 10**9)
            self._clock.publish(self._clock_message)


def _make_publishers(node: Node, part: Part, names: Mapping[str, str]) -> dict[str, Publisher]:
    """Make the publishers of all topics that can be published, by the topic's name in the bag."""
    publishers = {}
    faults = []
    for topic in (part.bag.topics[name] for name in part.topics):
        try:
            publishers[topic.name] = _make_publisher(node, topic, names.get(topic.name, topic.name))
        except LookupError as fault:
            faults.append(f'{topic.name} ({fault})')
    if faults:
        node.get_logger().warning(f'left out: {", ".join(faults)}')
    if not publishers:
        raise BagError(f'{part.bag.path}: no topic of the bag can be published')
    return publishers


def _make_publisher(node: Node, topic: Topic, name: str) -> Publisher:
    encoding = topic.encodings[0]
    if encoding != 'cdr':
        raise LookupError(f'expected messages in cdr, got {encoding}')
    if not topic.type_hash and _is_another_version(topic):
        raise LookupError(f'{topic.type_name} is installed in another version')
    profile = profile_of(combined_offer(topic.qos))
    try:
        publisher = node.create_publisher(message_class(topic.type_name), name, profile)
    except NameValidationException:
        raise LookupError('its name is not valid in ROS') from None
    hashes = {
        str(info.topic_type_hash)
        for info in node.get_publishers_info_by_topic(name)
        if info.node_name == node.get_name()
    }
    if topic.type_hash and hashes and topic.type_hash not in hashes:
        node.destroy_publisher(publisher)
        raise LookupError(f'{topic.type_name} is installed in another version')
    return publisher


def _is_another_version(topic: Topic) -> bool:
    """Return whether the bag defines other fields than the installed type has."""
    try:
        recorded = fields_of(topic.type_name, topic.definition)
        installed = schema_text(topic.type_name)
    except (ValueError, LookupError):  # nobody knows
        return False
    return bool(recorded) and not same_fields(topic.type_name, topic.definition, installed)


def profile_of(offer: Offer) -> QoSProfile:
    """Return an offer in rclpy's form."""
    return QoSProfile(
        depth=offer.depth,
        reliability=ReliabilityPolicy.RELIABLE if offer.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if offer.latched else DurabilityPolicy.VOLATILE,
        deadline=Duration(nanoseconds=offer.deadline),
        lifespan=Duration(nanoseconds=offer.lifespan),
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC if offer.manual else LivelinessPolicy.AUTOMATIC,
        liveliness_lease_duration=Duration(nanoseconds=offer.lease),
        avoid_ros_namespace_conventions=offer.unmangled,
    )
