# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Publish events when they are due.

Nothing here reads a clock: the caller passes the time, in nanoseconds.
"""

from collections.abc import Callable, Iterator

from tactile_push.bags import Message
from tactile_push.playing.schedule import Event

LATE = 10_000_000  # delay from which an event counts as late [ns]: a tenth of the paper's period


class Playhead:
    """How much of a bag has been played at a time; it rests until `resume` is called."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        # How much was played at which time: one object, since other threads read it.
        self._anchor: tuple[int, int | None] = (0, None)

    @property
    def paused(self) -> bool:
        """Whether it rests."""
        return self._anchor[1] is None

    def played(self, now: int) -> int:
        """Return how much of the bag has been played at a time [ns of the bag's own time]."""
        played, since = self._anchor
        return played if since is None else played + round((now - since) * self._rate)

    def due(self, played: int) -> int | None:
        """Return the time at which so much will have been played [ns]; None while it rests."""
        before, since = self._anchor
        return None if since is None else since + round((played - before) / self._rate)

    def pause(self, now: int) -> None:
        """Rest where it is."""
        self._anchor = (self.played(now), None)

    def resume(self, now: int) -> None:
        """Go on from where it is."""
        self._anchor = (self.played(now), now)

    def skip_to(self, played: int) -> None:
        """Rest where so much has been played; it never goes back."""
        self._anchor = (max(played, self._anchor[0]), None)


class Playback:
    """Publishes events, in order, when `advance` finds them due; `rate` is that of the bag's time.

    `late` counts the events that were published more than `LATE` after they were due.
    """

    def __init__(
        self, events: Iterator[Event], rate: float, publish: Callable[[Event], None]
    ) -> None:
        self.head = Playhead(rate)
        self.late = 0
        self._events = events
        self._publish = publish
        self._next = next(events, None)

    @property
    def done(self) -> bool:
        """Whether nothing is left to publish."""
        return self._next is None

    def advance(self, now: int) -> int | None:
        """Publish the next event if it is due by now.

        Return when the event after that is due [ns]; None if there is none or the playhead rests.
        """
        due = self._due()
        if due is not None and due <= now:
            self.late += now - due > LATE
            self._take()
            due = self._due()
        return due

    def step(self) -> Message | None:
        """Publish the next message at once and rest there; return it, or None at the end."""
        while (event := self._next) is not None:
            self.head.skip_to(event.played)
            self._take()
            if event.message is not None:
                return event.message
        return None

    def _due(self) -> int | None:
        return None if self._next is None else self.head.due(self._next.played)

    def _take(self) -> None:
        assert self._next is not None
        self._publish(self._next)
        self._next = next(self._events, None)
