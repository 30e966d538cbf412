# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag: its files, its topics and their rates."""

from array import array
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mcap.exceptions import McapError
from mcap.records import Chunk
from mcap.records import Message as MessageRecord
from mcap.stream_reader import StreamReader

from tactile_push.bags.headers import HeaderStamps
from tactile_push.bags.reader import BagError, BagReader, Message

_PROGRESS_EVERY = 1000  # messages
_SAMPLE = 16384  # intervals of a topic that are kept to find their median


@dataclass(frozen=True)
class FileInfo:
    """A file of a bag.

    Parameters
    ----------
    path : Path
        Where it is.
    size : int
        Its size [bytes].
    compression : str
        How its chunks are compressed, ``'none'`` if they are not; ``''`` if it has none.
    """

    path: Path
    size: int
    compression: str


@dataclass(frozen=True)
class TopicInfo:
    """A topic of a bag.

    Parameters
    ----------
    name, type_name : str
        Full name and message type.
    messages : int
        Number of messages.
    rate : float or None
        Messages a second, by the median time between two of them [Hz].
    largest_gap : float or None
        Longest time between two messages [s].
    gap_at : float or None
        When that gap began [s], from the start of the bag.
    out_of_order : int or None
        Messages with a stamp before that of the message before; None if they have no header.
    """

    name: str
    type_name: str
    messages: int
    rate: float | None
    largest_gap: float | None
    gap_at: float | None
    out_of_order: int | None


@dataclass(frozen=True)
class Survey:
    """The files and topics of a bag.

    Parameters
    ----------
    files : list of FileInfo
        Its files.
    messages : int
        Number of messages.
    topics : list of TopicInfo
        Its topics, in the order of their names.
    remarks : list of str
        What could not be used.
    """

    files: list[FileInfo]
    messages: int
    topics: list[TopicInfo]
    remarks: list[str]


def survey(
    bag: BagReader,
    progress: Callable[[int], None] = lambda count: None,
    hear: Callable[[Message, int | None], None] = lambda message, stamp: None,
) -> Survey:
    """Read a bag once and survey its topics.

    Parameters
    ----------
    bag : BagReader
        The bag.
    progress : callable, optional
        Told now and then how many messages have been read.
    hear : callable, optional
        Gets each message and the stamp of its header [ns], None if it has none.

    Returns
    -------
    Survey
        The files and topics.

    Raises
    ------
    BagError
        If the bag cannot be read.
    """
    encoded = Counter(topic.in_words for topic in bag.topics.values() if not topic.decodes)
    remarks = [
        f'{count} of {len(bag.topics)} topics cannot be decoded: {words}'
        for words, count in encoded.items()
    ]
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
            surveyed[name].topic_info(name, bag.topics[name].type_name, bag.start_time)
            for name in sorted(bag.topics)
        ],
        remarks,
    )


class _TopicSurvey:
    """Follows the messages of a topic."""

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
        """Take a message."""
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

    def topic_info(self, name: str, type_name: str, start: int) -> TopicInfo:
        """Return what is known now."""
        apart = float(np.median(self._intervals)) if self._intervals else 0.0
        several = self._messages > 1
        return TopicInfo(
            name,
            type_name,
            self._messages,
            rate=1e9 / apart if apart > 0.0 else None,
            largest_gap=self._gap / 1e9 if several else None,
            gap_at=(self._gap_at - start) / 1e9 if several else None,
            out_of_order=None if self._last_stamp is None else self._out_of_order,
        )


def _compression(file: Path) -> str:
    """Return how the first chunk of a file is compressed."""
    if file.suffix == '.zstd':
        return 'zstd, the whole file'
    with file.open('rb') as stream:
        try:
            for record in StreamReader(stream, emit_chunks=True).records:
                if isinstance(record, Chunk):
                    return record.compression or 'none'
                if isinstance(record, MessageRecord):
                    return 'none'
        except McapError:
            pass  # cut off before the end of its first chunk
    return ''
