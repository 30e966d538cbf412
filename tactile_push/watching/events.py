# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is out of the ordinary now, and what was."""

from dataclasses import dataclass

from tactile_push.report.data import LEVELS
from tactile_push.report.labels import Label

MOST_KINDS = 50  # of events: as many as a person may read; picked
MOST_LETTERS = 200  # of a text that somebody else chose; picked


@dataclass
class Event:
    """One kind of event."""

    lane: str  #: who or what it is about
    level: str  #: one of `report.data.LEVELS`
    text: str  #: what is the matter
    times: int  #: how often it began
    start: float  #: when it began the last time [s]
    end: float | None = None  #: when it ended then [s]; None while it lasts


@dataclass
class _Source:
    """What somebody said last."""

    event: Event
    said: float  # [s]
    lasts: float  # so long unless it is said again [s]


class Events:
    """The kinds of events, no more than `MOST_KINDS`, with what is the matter now.

    Times are by one clock that does not go back [s]. `version` changes when an event begins or
    ends.
    """

    def __init__(self) -> None:
        self._kinds: dict[tuple[str, str, str], Event] = {}
        self._sources: dict[tuple[str, str], _Source] = {}
        self.version = 0

    def say(
        self, now: float, lane: str, label: Label | None, lasts: float, source: str = ''
    ) -> None:
        """Take what is the matter with a lane, None if nothing is.

        It counts for `lasts` seconds if nothing else is said. Several sources may speak of a lane.
        """
        if label is not None:
            label = label[0], label[1][:MOST_LETTERS]
        lane = lane[:MOST_LETTERS]
        key = lane, source
        before = self._sources.get(key)
        if before is not None:
            event = before.event
            known = label is not None and label == (event.level, event.text)
            if known and now <= before.said + before.lasts:
                before.said, before.lasts = now, lasts
                return
            self._end(key, min(now, before.said + before.lasts))
        if label is not None:
            self._sources[key] = _Source(self._begin(now, lane, *label), now, lasts)

    def expire(self, now: float) -> None:
        """End what nobody says any more."""
        for key, source in list(self._sources.items()):
            if now > source.said + source.lasts:
                self._end(key, source.said + source.lasts)

    def listed(self) -> list[Event]:
        """Return the events: first those that last, the gravest first; then the latest."""
        return sorted(
            self._kinds.values(),
            key=lambda event: (
                (0, -LEVELS.index(event.level), event.start)
                if event.end is None
                else (1, -event.end, event.start)
            ),
        )

    def _begin(self, now: float, lane: str, level: str, text: str) -> Event:
        event = self._kinds.setdefault((lane, level, text), Event(lane, level, text, 0, now))
        event.times, event.start, event.end = event.times + 1, now, None
        if len(self._kinds) > MOST_KINDS:
            others = (kind for kind in self._kinds.items() if kind[1] is not event)
            oldest, _ = min(others, key=lambda kind: (kind[1].end is None, kind[1].start))
            del self._kinds[oldest]
        self.version += 1
        return event

    def _end(self, key: tuple[str, str], at: float) -> None:
        self._sources.pop(key).event.end = at
        self.version += 1
