# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Plays events when they are due.

Nothing here has a clock: the time is passed in, in nanoseconds.
"""

from collections.abc import Callable, Iterator

from tactile_push.bags.reader import Message
from tactile_push.playing.schedule import Event

LATE = 10_000_000  # an event that much after it was due is counted [ns]


class Playhead:
    """Where a play is, as a function of the time; it rests until it is let go.

    Parameters
    ----------
    rate : float
        How fast the bag's time goes by.
    """

    def __init__(self, rate: float) -> None:
        self._rate = rate
        # How much was played when, and in one piece, since others ask from their own threads.
        self._anchor: tuple[int, int | None] = (0, None)

    @property
    def paused(self) -> bool:
        """Whether it rests."""
        return self._anchor[1] is None

    def played(self, now: int) -> int:
        """Give how much is played at a time.

        Parameters
        ----------
        now : int
            The time [ns].

        Returns
        -------
        int
            Duration at the bag's own rate [ns].
        """
        played, since = self._anchor
        return played if since is None else played + round((now - since) * self._rate)

    def due(self, played: int) -> int | None:
        """Give when so much will be played.

        Parameters
        ----------
        played : int
            Duration at the bag's own rate [ns].

        Returns
        -------
        int or None
            The time [ns]; None while it rests.
        """
        before, since = self._anchor
        return None if since is None else since + round((played - before) / self._rate)

    def pause(self, now: int) -> None:
        """Let it rest where it is.

        Parameters
        ----------
        now : int
            The time [ns].
        """
        self._anchor = (self.played(now), None)

    def resume(self, now: int) -> None:
        """Let it go on from where it is.

        Parameters
        ----------
        now : int
            The time [ns].
        """
        self._anchor = (self.played(now), now)

    def skip_to(self, played: int) -> None:
        """Let it rest further on.

        Parameters
        ----------
        played : int
            Where, as a duration at the bag's own rate [ns]; it never goes back.
        """
        self._anchor = (max(played, self._anchor[0]), None)


class Playback:
    """Publishes what is due, when it is asked to.

    Parameters
    ----------
    events : iterator of Event
        All that happens, in order.
    rate : float
        How fast the bag's time goes by.
    publish : callable
        Publishes what belongs to an event.

    Attributes
    ----------
    head : Playhead
        Where it is; to pause and resume.
    late : int
        Events that came more than `LATE` after they were due.
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
        """Publish the next event if it is due.

        Parameters
        ----------
        now : int
            The time [ns].

        Returns
        -------
        int or None
            When the event after that is due [ns]; None if there is none or the playhead rests.
        """
        due = self._due()
        if due is not None and due <= now:
            self.late += now - due > LATE
            self._take()
            due = self._due()
        return due

    def step(self) -> Message | None:
        """Publish the next message at once; the playhead rests there.

        Returns
        -------
        Message or None
            What was published; None at the end.
        """
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
