# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What happens in a play of a bag, and when by the bag's own time."""

import difflib
import heapq
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from tactile_push.bags.reader import BagError, BagReader, Message

CLOCK = '/clock'


@dataclass(frozen=True)
class Part:
    """What of a bag is played.

    Parameters
    ----------
    bag : BagReader
        The bag.
    topics : tuple of str
        Names of the topics, as in the bag.
    begin, end : int
        Times of the bag between which its messages are played, both included [ns].
    """

    bag: BagReader
    topics: tuple[str, ...]
    begin: int
    end: int

    def messages(self) -> Iterator[Message]:
        """Read the messages.

        Returns
        -------
        iterator of Message
            In order of their log time.
        """
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
    """Choose what of a bag is played.

    Parameters
    ----------
    bag : BagReader
        The bag.
    topics : sequence of str, optional
        Names of topics, with or without the leading slash; all if there are none.
    start : float, optional
        Time from the beginning of the bag at which to begin [s].
    duration : float, optional
        How long to go on from there [s]; 0 is to the end of the bag.
    with_clock : bool, optional
        Whether the player gives the time itself, so that the bag's `/clock` is left out.
    loop : bool, optional
        Whether it will be played again and again.

    Returns
    -------
    Part
        What is played; it has a message.

    Raises
    ------
    BagError
        If the bag has no such topic, no message there or, for a loop, no length.
    """
    if not any(bag.counts.values()):
        raise BagError(f'{bag.path}: the bag is empty')
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
    """Give the topic of a bag that a person means.

    Parameters
    ----------
    bag : BagReader
        The bag.
    name : str
        Its name, with or without the leading slash.

    Returns
    -------
    str
        Its full name.

    Raises
    ------
    BagError
        If there is none of that name.
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

    Parameters
    ----------
    played : int
        How long the play lasts until then, at the bag's own rate and over all rounds [ns].
    time : int
        The same on the bag's clock [ns].
    message : Message or None
        What is published; None if only the time goes on.
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
    """Line up what happens in a play.

    Each round ends with an event at `end`, so that the silence after the last message counts.

    Parameters
    ----------
    read : callable
        Gives the messages in order of their log time, anew for each round.
    begin, end : int
        Times of the bag between which they are [ns].
    clock_rate : float, optional
        How often the time is told in between, from `begin` on, by the bag's clock [Hz]; 0 is never.
    loop : bool, optional
        Whether to start over at the end, for ever.

    Returns
    -------
    iterator of Event
        In order.
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
