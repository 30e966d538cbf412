# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What happens when a bag is played, and when, by the bag's own time."""

import difflib
import heapq
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from tactile_push.bags import BagError, BagReader, Message
from tactile_push.interface import CLOCK


@dataclass(frozen=True)
class Part:
    """What is played of a bag: some topics, from `begin` up to and including `end` [ns]."""

    bag: BagReader
    topics: tuple[str, ...]
    begin: int
    end: int

    def messages(self) -> Iterator[Message]:
        """Read the messages in order of their log time."""
        return self.bag.messages(self.topics, self.begin, self.end + 1)


def part_of(
    bag: BagReader,
    topics: Sequence[str] = (),
    start: float = 0.0,
    duration: float = 0.0,
    *,
    with_clock: bool = False,
    loop: bool = False,
) -> Part:
    """Choose what of a bag is played: from `start`, for `duration` [s], which 0 leaves open.

    Topics may lack the leading slash; all are played if none are named. `with_clock` leaves the
    bag's `/clock` out, because the player publishes its own; `loop` says that the part repeats.
    BagError if the bag has no such topic, no message there or, for a loop, no length.
    """
    if not any(bag.counts.values()):
        raise BagError(f'{bag.path}: expected messages, got none')
    begin = bag.start_time + round(start * 1e9)
    if begin > bag.end_time:
        length = (bag.end_time - bag.start_time) * 1e-9
        raise BagError(f'{bag.path}: nothing at {start:g} s, the bag is {length:g} s long')
    end = min(begin + round(duration * 1e9), bag.end_time) if duration else bag.end_time
    if loop and end == begin:
        raise BagError(f'{bag.path}: a loop of 0 s at {start:g} s would never rest')
    named = {topic_in_bag(bag, name) for name in topics} or set(bag.topics)
    chosen = tuple(sorted(named - {CLOCK} if with_clock else named))
    part = Part(bag, chosen, begin, end)
    if not chosen or next(part.messages(), None) is None:
        what = ', '.join(chosen) or f'other topics than {CLOCK}'
        until = (end - bag.start_time) * 1e-9
        raise BagError(f'{bag.path}: no message of {what} from {start:g} s to {until:g} s')
    return part


def topic_in_bag(bag: BagReader, name: str) -> str:
    """Return the full name of a topic that a person named with or without the leading slash.

    BagError lists similar names if the bag has no such topic.
    """
    full = name if name in bag.topics else '/' + name.lstrip('/')
    if full not in bag.topics:
        similar = difflib.get_close_matches(full, list(bag.topics), n=1)
        hint = f'did you mean {similar[0]}?' if similar else f'it has {", ".join(bag.topics)}'
        raise BagError(f'{bag.path}: no topic {full}, {hint}')
    return full


@dataclass(frozen=True, slots=True)
class Event:
    """A moment of a play.

    `played` is how long the play has lasted by then, by the bag's own rate and over all rounds
    [ns]; `time` is the bag's clock [ns]; without a `message`, only the clock goes on.
    """

    played: int
    time: int
    message: Message | None


def events(
    read: Callable[[], Iterable[Message]],
    begin: int,
    end: int,
    *,
    clock_rate: float = 0.0,
    loop: bool = False,
) -> Iterator[Event]:
    """Yield what happens in a play: messages, which `read` returns anew for each round, and ticks.

    Ticks come `clock_rate` times a second of the bag's time, from `begin` on. Each round ends with
    an event at `end`, so that the silence after the last message counts.
    """
    played = -begin
    while True:
        told = ((time, None) for time in _ticks(begin, end, clock_rate))
        sent = ((message.log_time, message) for message in read())
        for time, message in heapq.merge(told, sent, key=lambda pair: pair[0]):
            yield Event(played + time, time, message)
        yield Event(played + end, end, None)
        if not loop:
            return
        played += end - begin


def _ticks(begin: int, end: int, rate: float) -> Iterator[int]:
    count, tick = 0, begin
    while rate and tick < end:
        yield tick
        count += 1
        tick = begin + round(count * 1e9 / rate)
