# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Find the message of one bag that belongs to a message of another."""

from collections import OrderedDict, deque
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import zip_longest

from tactile_push.bags import BagReader, Message
from tactile_push.bags.headers import HeaderStamps

# Messages that may wait for their partners in the other bag; with more, the oldest has none. Picked
# to keep memory small: ten seconds of a bag with a thousand messages a second.
MOST_MESSAGES = 10_000
MOST_BYTES = 16_000_000
# Messages after which a topic no longer tells which bag is behind; picked.
LATELY = 1000


@dataclass(frozen=True, slots=True)
class Pair:
    """Two messages of a topic that belong together, or one without a partner.

    Their `key` is the stamp [ns] that they share, or their place in the topic, counted from 0.
    """

    topic: str
    key: int
    a: Message | None
    b: Message | None


def pairs_in_order(a: BagReader, b: BagReader, topic: str) -> Iterator[Pair]:
    """Pair the first message of a topic with the first, and so on."""
    both = zip_longest(a.messages([topic]), b.messages([topic]))
    for place, (message_a, message_b) in enumerate(both):
        yield Pair(topic, place, message_a, message_b)


def pairs_by_stamp(a: BagReader, b: BagReader, topics: Collection[str]) -> Iterator[Pair]:
    """Pair messages with the same stamp, the first such of a topic with the first, and so on.

    All topics must have headers in both bags. Both bags are read once, side by side, and stamps may
    come in any order. A message waits for its partner while no more than 10,000 messages and 16 MB
    of the same bag wait; after that it has none, and comes late. A bag may start late, end early or
    lack a topic for longer than that. Partners are missed if the bags have nothing in common for so
    long, or if what they have in common is out of order by so much.
    """
    sides = (_Side(a, topics), _Side(b, topics))
    pace = _Pace(*sides)
    while side := pace.next_to_read():
        message = next(side.messages, None)
        if message is None:
            side.ended = True
            continue
        other = sides[1] if side is sides[0] else sides[0]
        topic, stamp = message.topic, side.stamps.of(message)
        pace.take_note(side, other, topic, stamp)
        partner = other.take(topic, stamp)
        if partner is None:
            side.keep(message, stamp, other.newest.get(topic))
            for left in side.give_up():
                yield _single(left, side is sides[0])
        else:
            pair = (message, partner) if side is sides[0] else (partner, message)
            yield Pair(topic, stamp, *pair)
    for side in sides:
        for left in side.waiting.values():
            yield _single(left, side is sides[0])


def _single(left: '_Waiting', of_a: bool) -> Pair:
    """Return a message without a partner."""
    pair = (left.message, None) if of_a else (None, left.message)
    return Pair(left.message.topic, left.stamp, *pair)


@dataclass(frozen=True, slots=True)
class _Waiting:
    """A message that waits for its partner."""

    message: Message
    stamp: int


class _Side:
    """One bag: how far it has been read, and which of its messages wait for their partners.

    `newest` has the last stamp read and `read_at` how many messages of both bags were read before
    it, by topic. `waiting` is in the order of reading. `ahead` are those of them that the other bag
    has not reached yet; the others find a partner only if its stamps are out of order.
    """

    def __init__(self, bag: BagReader, topics: Collection[str]) -> None:
        self.messages = iter(bag.messages(topics))
        self.stamps = HeaderStamps(bag)
        self.ended = False
        self.newest: dict[str, int] = {}
        self.read_at: dict[str, int] = {}
        self.waiting: OrderedDict[int, _Waiting] = OrderedDict()
        self.ahead: set[int] = set()
        self._numbers: dict[tuple[str, int], deque[int]] = {}
        self._queues: dict[str, deque[int]] = {topic: deque() for topic in topics}
        self._read = 0
        self._bytes = 0

    def keep(self, message: Message, stamp: int, reached: int | None) -> None:
        """Let a message wait; the other bag has reached a stamp of the topic."""
        number = self._read
        self._read += 1
        self.waiting[number] = _Waiting(message, stamp)
        self._bytes += len(message.data)
        self._numbers.setdefault((message.topic, stamp), deque()).append(number)
        if reached is None or stamp > reached:
            queue = self._queues[message.topic]
            while queue and queue[0] not in self.waiting:
                queue.popleft()
            queue.append(number)
            self.ahead.add(number)

    def take(self, topic: str, stamp: int) -> Message | None:
        """Return the first message with this stamp, which waits no longer."""
        numbers = self._numbers.get((topic, stamp))
        return self._remove(numbers[0]).message if numbers else None

    def pass_by(self, topic: str, stamp: int) -> None:
        """Note that the other bag has reached a stamp of a topic."""
        queue = self._queues[topic]
        while queue and (queue[0] not in self.waiting or self.waiting[queue[0]].stamp < stamp):
            self.ahead.discard(queue.popleft())

    def give_up(self) -> Iterator[_Waiting]:
        """Yield the messages that cannot wait any longer."""
        while len(self.waiting) > MOST_MESSAGES or (
            self._bytes > MOST_BYTES and len(self.waiting) > 1
        ):
            yield self._remove(next(iter(self.waiting)))

    def _remove(self, number: int) -> _Waiting:
        left = self.waiting.pop(number)
        self._bytes -= len(left.message.data)
        self.ahead.discard(number)
        key = (left.message.topic, left.stamp)
        numbers = self._numbers[key]
        numbers.popleft()  # the oldest of its stamp is always the first to go
        if not numbers:
            del self._numbers[key]
        return left


class _Pace:
    """Decides which bag is read next, so that partners are read soon after one another.

    The stamps of the topic that came in both bags most recently tell which bag is behind. If no
    topic did lately, because one bag lacks something or its clock was set, the bag is read of which
    fewer messages wait for the other bag to reach them.
    """

    def __init__(self, a: _Side, b: _Side) -> None:
        self._sides = a, b
        self._read = 0
        self._topic = ''
        self._in_both = -LATELY  # number of the message that showed it

    def next_to_read(self) -> _Side | None:
        """Return the bag to read, or None if both have ended."""
        a, b = self._sides
        if a.ended or b.ended:
            return None if a.ended and b.ended else b if a.ended else a
        if self._read - self._in_both < LATELY:
            newest = a.newest[self._topic], b.newest[self._topic]
            if newest[0] != newest[1]:
                return a if newest[0] < newest[1] else b
        return min(a, b, key=lambda side: (len(side.ahead), len(side.waiting)))

    def take_note(self, side: _Side, other: _Side, topic: str, stamp: int) -> None:
        """Note that a message of a bag was read."""
        other.pass_by(topic, stamp)
        side.newest[topic] = stamp
        side.read_at[topic] = self._read
        self._read += 1
        in_both = other.read_at.get(topic, -1)
        if in_both >= max(self._in_both, 0):
            self._topic, self._in_both = topic, in_both
