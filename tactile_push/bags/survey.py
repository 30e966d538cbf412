# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Survey a bag: its files, its topics and their rates."""

import contextlib
from array import array
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mcap.records import Chunk
from mcap.records import Message as MessageRecord
from mcap.stream_reader import StreamReader

from tactile_push.bags.headers import HeaderStamps
from tactile_push.bags.mcap_records import LARGEST_CHUNK
from tactile_push.bags.reader import EMPTY_MESSAGE, BagError, BagReader, Message
from tactile_push.bags.topic import Topic

_PROGRESS_EVERY = 1000  # messages
_SAMPLE = 16384  # intervals of a topic that are kept for their median; 128 KiB a topic
# Messages make a rate if they would last so long at it: a second, or the share of a short bag.
_LASTS, _SHARE = 10**9, 0.01  # [ns]


@dataclass(frozen=True)
class FileInfo:
    """A file of a bag."""

    path: Path
    size: int  # [bytes]
    compression: str  # of its chunks; 'none' if they are not compressed, '' if it has none


@dataclass(frozen=True)
class TopicInfo:
    """A topic of a bag; None is unknown."""

    name: str
    type_name: str
    messages: int
    rate: float | None  # by the median time between two messages [Hz]; None if they come in bursts
    largest_gap: float | None  # longest time between two messages [s]
    gap_at: float | None  # when that gap began, from the start of the bag [s]
    out_of_order: int | None  # messages stamped before the one that they follow


@dataclass(frozen=True)
class Survey:
    """The files and topics of a bag."""

    files: list[FileInfo]
    messages: int
    topics: list[TopicInfo]  # in the order of their names
    remarks: list[str]  # what could not be used


def survey(
    bag: BagReader,
    progress: Callable[[int], None] = lambda count: None,
    hear: Callable[[Message, int | None], None] = lambda message, stamp: None,
) -> Survey:
    """Read a bag once and survey its topics; BagError if it cannot be read.

    `progress` gets the number of messages read, now and then. `hear` gets each message and the
    stamp of its header [ns], None if it has none.
    """
    encoded = Counter(topic.in_words for topic in bag.topics.values() if not topic.decodes)
    remarks = [
        f'{count} of {len(bag.topics)} topics cannot be decoded: {words}'
        for words, count in encoded.items()
    ]
    decodable = [topic for topic in bag.topics.values() if topic.decodes]
    remarks += filter(None, (topic.trouble({}) for topic in decodable))
    blank = {topic.name for topic in decodable if not topic.definition.strip()}
    stamps = HeaderStamps(bag)
    surveyed = {name: _TopicSurvey() for name in bag.topics}
    broken: Counter[str] = Counter()
    messages = 0
    for messages, message in enumerate(bag.messages(), 1):
        stamp = None
        if message.topic in stamps:
            try:
                stamp = stamps.of(message)
            except BagError:
                broken[message.topic] += 1
        elif message.topic in blank and len(message.data) > EMPTY_MESSAGE:
            blank.remove(message.topic)
            type_name = bag.topics[message.topic].type_name
            remarks.append(f'the definition of {type_name} for {message.topic} is missing')
        surveyed[message.topic].add(message.log_time, stamp)
        hear(message, stamp)
        if messages % _PROGRESS_EVERY == 0:
            progress(messages)
    for name, count in broken.items():
        remarks.append(f'{count} messages of {name} end before their stamp')
    return Survey(
        [FileInfo(file, file.stat().st_size, _compression(file)) for file in bag.files],
        messages,
        [
            surveyed[name].topic_info(bag.topics[name], bag.start_time, bag.end_time)
            for name in sorted(bag.topics)
        ],
        remarks,
    )


class _TopicSurvey:
    """The times of a topic's messages."""

    def __init__(self) -> None:
        self._messages = 0
        self._last: int | None = None
        self._last_stamp: int | None = None
        self._gap, self._gap_at = -1, 0
        self._out_of_order = 0
        # Evenly spaced among all intervals, thinned out whenever there are too many.
        self._intervals = array('q')
        self._stride = 1

    def add(self, time: int, stamp: int | None) -> None:
        """Add a message."""
        if self._last is not None:
            interval = time - self._last
            if interval > self._gap:
                self._gap, self._gap_at = interval, self._last
            if (self._messages - 1) % self._stride == 0:
                self._intervals.append(interval)
                if len(self._intervals) == _SAMPLE:
                    self._intervals = self._intervals[::2]
                    self._stride *= 2
        if stamp is not None:
            if self._last_stamp is not None and stamp < self._last_stamp:
                self._out_of_order += 1
            self._last_stamp = stamp
        self._last = time
        self._messages += 1

    def topic_info(self, topic: Topic, start: int, end: int) -> TopicInfo:
        """Return what is known so far of a topic of a bag from `start` to `end` [ns]."""
        apart = float(np.median(self._intervals)) if self._intervals else 0.0
        lasts = min(_LASTS, _SHARE * (end - start))
        is_rate = apart > 0.0 and apart * (self._messages - 1) >= lasts
        several = self._messages > 1
        return TopicInfo(
            topic.name,
            topic.type_name,
            self._messages,
            rate=1e9 / apart if is_rate else None,
            largest_gap=self._gap / 1e9 if several else None,
            gap_at=(self._gap_at - start) / 1e9 if several else None,
            out_of_order=None if self._last_stamp is None else self._out_of_order,
        )


def _compression(file: Path) -> str:
    """Return how the first chunk of a file is compressed; '' if there is no whole one."""
    if file.suffix == '.zstd':
        return 'zstd, the whole file'
    # The file may be cut off or damaged there; mcap checks little, so any error may come.
    with file.open('rb') as stream, contextlib.suppress(Exception):
        reader = StreamReader(stream, emit_chunks=True, record_size_limit=LARGEST_CHUNK)
        for record in reader.records:
            if isinstance(record, Chunk):
                return record.compression or 'none'
            if isinstance(record, MessageRecord):
                return 'none'
    return ''
