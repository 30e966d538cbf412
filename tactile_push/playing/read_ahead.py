# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read a bag some way ahead of its player, which then never waits for a file or for zstd."""

from collections import deque
from collections.abc import Iterator
from threading import Condition, Thread

from tactile_push.playing.schedule import Event

MOST = 2**23  # size of what is read ahead [B]: several chunks, so zstd is never waited for
BATCH = 2**16  # size of what is handed over at once [B]; a lock for each message would cost more
OVERHEAD = 500  # memory of an event besides its message's data, roughly [B]


class ReadAhead(Iterator[Event]):
    """The same events, read in another thread.

    An exception in that thread is raised where the next event would have come.
    """

    def __init__(self, events: Iterator[Event]) -> None:
        self._changed = Condition()
        self._batches: deque[tuple[int, deque[Event]]] = deque()
        self._size = 0  # of all batches [B]
        self._ended = False
        self._error: Exception | None = None
        self._taken: deque[Event] = deque()
        self._thread = Thread(target=self._read, args=(events,), name='read ahead', daemon=True)
        self._thread.start()

    def __next__(self) -> Event:
        """Return the next event."""
        while not self._taken:
            with self._changed:
                self._changed.wait_for(lambda: self._batches or self._ended)
                if not self._batches:
                    if self._error is not None:
                        raise self._error
                    raise StopIteration
                size, self._taken = self._batches.popleft()
                self._size -= size
                self._changed.notify_all()
        return self._taken.popleft()

    def close(self) -> None:
        """Stop reading, and forget what was read."""
        with self._changed:
            self._ended = True
            self._batches.clear()
            self._changed.notify_all()
        self._thread.join()

    def _read(self, events: Iterator[Event]) -> None:
        batch: deque[Event] = deque()
        size = 0
        try:
            for event in events:
                batch.append(event)
                size += OVERHEAD + (0 if event.message is None else len(event.message.data))
                if size >= BATCH:
                    if not self._hand_over(batch, size):
                        return
                    batch, size = deque(), 0
        except Exception as error:
            self._error = error
        self._hand_over(batch, size)
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def _hand_over(self, batch: deque[Event], size: int) -> bool:
        """Wait for room; return whether anybody still wants events."""
        with self._changed:
            self._changed.wait_for(lambda: self._size < MOST or self._ended)
            if not self._ended and batch:
                self._batches.append((size, batch))
                self._size += size
                self._changed.notify_all()
            return not self._ended
