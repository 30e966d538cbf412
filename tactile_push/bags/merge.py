# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Merge the messages of many batches of a bag by time, with few of them in memory at once."""

import heapq
from bisect import bisect_left
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from operator import attrgetter

from tactile_push.bags.mcap_file import Message

# Memory for overlapping batches, 32 chunks of a usual size; picked. Beyond it, some are freed and
# read again later [bytes].
_BUDGET = 1 << 25

# Memory of a message besides its data, roughly [bytes].
_OVERHEAD = 200

_BY_LOG_TIME = attrgetter('log_time')


@dataclass(frozen=True, slots=True)
class Batch:
    """Messages that `load` reads at once, sorted by log time; none is older than `start` [ns]."""

    start: int
    load: Callable[[], list[Message]]


def in_order(batches: Sequence[Batch]) -> Iterator[Message]:
    """Yield the messages of all batches by log time, and by batch where that is equal.

    A batch is loaded when time has come to its start.
    """
    waiting = deque(sorted(enumerate(batches), key=lambda batch: batch[1].start))
    heap: list[tuple[int, int, _OpenBatch]] = []
    while waiting or heap:
        if waiting and (not heap or waiting[0][1].start <= heap[0][0]):
            number, batch = waiting.popleft()
            opened = _OpenBatch(batch)
            if opened.size:
                heapq.heappush(heap, (opened.time, number, opened))
                _forget_some(heap)
            continue
        _, number, opened = heap[0]
        if not opened.size:
            opened.read()
            _forget_some(heap)
        # No other batch has a message before this time.
        bound = waiting[0][1].start if waiting else 2**64
        for time, other, _ in heap[1:3]:
            bound = min(bound, time + (number < other))
        yield from opened.take(bound)
        if opened.is_done:
            heapq.heappop(heap)
        else:
            heapq.heapreplace(heap, (opened.time, number, opened))


def _forget_some(heap: list[tuple[int, int, '_OpenBatch']]) -> None:
    """Forget the messages that are needed last, if there are too many in memory."""
    excess = sum(opened.size for _, _, opened in heap) - _BUDGET
    if excess > 0:
        for _, _, opened in sorted(heap[1:], reverse=True):
            excess -= opened.forget()
            if excess <= 0:
                break


class _OpenBatch:
    """A batch whose messages are needed now."""

    def __init__(self, batch: Batch) -> None:
        self._load = batch.load
        self._position = 0
        self.read()
        self.time = self._messages[0].log_time if self._messages else 0

    @property
    def is_done(self) -> bool:
        """Whether all its messages have been taken."""
        return self._position >= self._count

    def take(self, bound: int) -> list[Message]:
        """Return the next messages, up to a time [ns]."""
        messages, start = self._messages, self._position
        end = self._count
        if end and messages[-1].log_time >= bound:
            end = bisect_left(messages, bound, start, key=_BY_LOG_TIME)
        self._position = end
        if end < self._count:
            self.time = messages[end].log_time
        return messages[start:end]

    def read(self) -> None:
        """Read the messages."""
        self._messages = self._load()
        self._count = len(self._messages)
        self.size = sum(len(message.data) + _OVERHEAD for message in self._messages)

    def forget(self) -> int:
        """Free the memory until they are read again; return how much it was [bytes]."""
        size = self.size
        self._messages = []
        self.size = 0
        return size
