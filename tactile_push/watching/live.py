# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the nodes say, as the page shows it: the newest values, a short history, and events."""

import math
import threading
from collections import deque
from collections.abc import Iterable, Mapping

import numpy as np

from tactile_push.interface import CONTROLLER_STATE, SENSING_STATE
from tactile_push.report.labels import (
    BOUNDS,
    DOING,
    STATUS_LASTS,
    TICK_LASTS,
    Label,
    bound_label,
    contradiction_label,
    doing,
    stop_label,
)
from tactile_push.report.shown import HOLD, SERIES, SOURCES, VIEWED, readable
from tactile_push.watching.events import Events

RATE = 20.0  # of frames [Hz]: a moving picture to the eye; picked
STATE = 'state'
# A frame's values after its time. What a report makes of many messages has no source here.
SHOWN = tuple(name for name in SERIES | VIEWED if name in SOURCES or name == STATE)
TAKEN = {topic for sources in SOURCES.values() for topic, _ in sources}

Row = list[float | None]
"""Time [s] and the values of `SHOWN`, None where there is none."""


class Live:
    """Takes what topics say and makes frames of it.

    Times are by one clock that does not go back [s], of whoever watches: a run on simulated time
    passes as fast as it does. One thread takes and makes frames; any thread may ask for `hello`.
    The memory is bounded by `history`, how long frames are kept [s].
    """

    def __init__(self, history: float) -> None:
        self._seconds = history
        self._rows: deque[Row] = deque(maxlen=max(1, round(history * RATE)))
        self._rows_lock = threading.Lock()
        self._newest: dict[str, tuple[float, Mapping[str, float]]] = {}
        self._events = Events()

    @property
    def heard(self) -> float:
        """When a topic of `TAKEN` said something last [s]; -inf if never."""
        return max((now for now, _ in self._newest.values()), default=-math.inf)

    def take(self, now: float, topic: str, values: Mapping[str, float]) -> None:
        """Take the numbers of a message by name."""
        self._newest[topic] = now, values
        if topic == CONTROLLER_STATE:
            if {STATE, 'stop_reason'} <= values.keys():
                label = stop_label(values[STATE], values['stop_reason'])
                self._events.say(now, 'controller', label, TICK_LASTS)
            for name in BOUNDS:
                flag = bound_label(name, values.get(name, math.nan))
                self._events.say(now, 'bounds', flag, TICK_LASTS, name)
        elif topic == SENSING_STATE:
            label = contradiction_label(values.get('contradiction', math.nan))
            self._events.say(now, 'object', label, TICK_LASTS)

    def take_statuses(self, now: float, statuses: Iterable[tuple[str, Label | None]]) -> None:
        """Take what nodes say of themselves, by their names."""
        for name, label in statuses:
            self._events.say(now, name, label, STATUS_LASTS)

    def frame(self, now: float) -> dict[str, object]:
        """Return what there is to show at a moment, and keep it."""
        row: Row = [round(now, 3), *(self._value(now, name) for name in SHOWN)]
        with self._rows_lock:
            self._rows.append(row)
        return {'frame': row}

    def hello(self) -> dict[str, object]:
        """Return what a page has to know that opens now."""
        with self._rows_lock:
            rows = list(self._rows)
        return {
            'hello': {
                'seconds': self._seconds,
                'names': ['time', *SHOWN],
                'states': DOING,
                'rows': rows,
            }
        }

    def events(self, now: float) -> tuple[int, dict[str, object]]:
        """Return the events, and a number that changes when they do."""
        self._events.expire(now)
        events = [vars(event) for event in self._events.listed()]
        return self._events.version, {'events': events}

    def _value(self, now: float, name: str) -> float | None:
        if name == STATE:
            values = self._fresh(now, CONTROLLER_STATE)
            number = doing(values.get(STATE, math.nan), values.get('stop_reason', math.nan))
        else:
            number = np.asarray(self._from_sources(now, name))
        (value,) = readable(name, number.reshape(1))
        return value

    def _from_sources(self, now: float, name: str) -> float:
        for topic, column in SOURCES[name]:
            values = self._fresh(now, topic)
            if column in values:
                return values[column]
        return math.nan

    def _fresh(self, now: float, topic: str) -> Mapping[str, float]:
        """Return what a topic said last, nothing if that is old."""
        then, values = self._newest.get(topic, (-math.inf, {}))
        return values if now - then <= HOLD else {}
