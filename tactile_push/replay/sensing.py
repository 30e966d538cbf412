# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `active_sensing` said of a bag's control periods."""

import math
import typing
from collections.abc import Callable, Collection, Iterator
from typing import Any

from tactile_push.bags import Message
from tactile_push.control import Tick
from tactile_push.interface import OBJECT_POSE, SENSING_STATE
from tactile_push.pipeline import Stamp, by_name
from tactile_push.pipeline.stamps import stamp_before, stamp_of
from tactile_push.replay.comparison import SensedTick
from tactile_push.replay.messages import Written, nanoseconds

if typing.TYPE_CHECKING:
    from tactile_push.pipeline import Sensing

TOPICS = (SENSING_STATE, OBJECT_POSE)
_Waiting = tuple[Stamp, int, Tick]
NOWHERE, EVERYWHERE = (-math.inf, 0), (math.inf, 0)  # before and after all stamps


class ReplayedSensing:
    """Makes again what the node said, from where it knew nothing, as far as it was recorded.

    A node that started after the controller did not hear the first control periods. If the node
    started before the recording, its memory is unknown. So what was recorded is kept until the node
    says that there was no reading before, in a control period that was recorded, too. At the end of
    a recording the node may not have come to the last control periods yet. A topic that was not
    recorded is made from the beginning to the end.
    """

    def __init__(self, step: 'Sensing', recorded: Collection[str], start: int) -> None:
        self._step = step
        self._start = start
        self._begun = SENSING_STATE not in recorded
        self._begins: Stamp | None = (0, 0) if self._begun else None
        # How far the node has come, by topic.
        self._come_to: dict[str, tuple[float, int]] = {
            topic: NOWHERE if topic in recorded else EVERYWHERE for topic in TOPICS
        }
        # Messages of control periods to which the node has not come yet.
        self._ahead: dict[str, list[tuple[Stamp, Written]]] = {topic: [] for topic in TOPICS}
        self._before: _Waiting | None = None  # the last control period before the node begins
        self._waiting: list[_Waiting] = []
        self._pose: tuple[Stamp, Message, Any] | None = None  # may belong to where the node begins
        self._kept = False  # whether a recorded state was kept
        # What was recorded since the node seems to begin, until that control period comes.
        self._doubtful: list[tuple[Callable[..., Iterator[Written]], Message, Any]] = []
        self.sensed: list[SensedTick] = []

    def tick(self, stamp: Stamp, log_time: int, tick: Tick) -> Iterator[Written]:
        """Take a control period and its log time [ns], and yield messages to write."""
        if self._begins is None:
            self._waiting.append((stamp, log_time, tick))
            return
        if not self._begun and stamp < self._begins:
            self._before = stamp, log_time, tick
            return
        if not self._begun and stamp > self._begins:
            yield from self._not_begun((stamp, log_time, tick))
            return
        if not self._begun and self._kept and self._before is not None:
            # The node forgot what it knew, but not how the finger was moving.
            self._step.tick(self._before[0], self._before[2])
        self._begun = True
        self._doubtful = []
        sensed = self._step.tick(stamp, tick)
        since = (nanoseconds(stamp) - self._start) * 1e-9
        self.sensed.append(SensedTick.of(since, sensed.values))
        for topic, fields in sensed.outputs():
            said = stamp if topic == SENSING_STATE else sensed.read
            written = (topic, fields), log_time
            if said <= self._come_to[topic]:
                yield written
            else:
                self._ahead[topic].append((said, written))

    def state(self, message: Message, decoded: Any) -> Iterator[Written]:
        """Take a recorded message of `active_sensing/state`, and yield messages to write."""
        stamp = stamp_of(decoded)
        if self._begins is not None:
            if not self._begun:
                self._doubtful.append((self.state, message, decoded))
            yield from self._come(SENSING_STATE, stamp)
            return
        self._come_to[SENSING_STATE] = stamp
        values = by_name(decoded.name, decoded.position)
        readings, age = values.get('readings', 0.0), values.get('age', math.nan)
        # Control periods wait for their contacts: this one may still be to come.
        stamps = [waiting[0] for waiting in self._waiting]
        place = stamps.index(stamp) if stamp in stamps else len(stamps)
        if readings > 1.0:
            del self._waiting[:place]
            self._kept = True
            yield from self._keep_pose(None)
            yield message
            return
        self._begins = stamp
        self._doubtful = [(self.state, message, decoded)]
        made_again = readings == 1.0 and math.isfinite(age)
        yield from self._keep_pose(stamp_before(*stamp, age) if made_again else None)
        waiting, self._waiting = self._waiting, []
        self._before = waiting[place - 1] if place else None
        for one in waiting[place:]:
            yield from self.tick(*one)

    def pose(self, message: Message, decoded: Any) -> Iterator[Written]:
        """Take a recorded message of `object_pose`, and yield messages to write."""
        stamp = stamp_of(decoded)
        if self._begins is not None:
            if not self._begun:
                self._doubtful.append((self.pose, message, decoded))
            yield from self._come(OBJECT_POSE, stamp)
            return
        self._come_to[OBJECT_POSE] = stamp
        yield from self._keep_pose(None)
        self._pose = stamp, message, decoded

    def finish(self) -> Iterator[Written]:
        """End where the node's recorded messages end, and yield messages to write."""
        yield from self._keep_pose(None)
        yield from (message for _, message, _ in self._doubtful)
        del self.sensed[len(self.sensed) - len(self._ahead[SENSING_STATE]) :]

    def _not_begun(self, waiting: _Waiting) -> Iterator[Written]:
        """Keep what a control period led to that the recorder missed, and look on."""
        (_, message, decoded), *others = self._doubtful
        self._doubtful = []
        self._begins = None
        self._come_to[SENSING_STATE] = stamp_of(decoded)
        self._kept = True
        self._waiting.append(waiting)
        yield message
        for take, message, decoded in others:
            yield from take(message, decoded)

    def _come(self, topic: str, stamp: Stamp) -> Iterator[Written]:
        """Yield what was made up to where the node has come."""
        self._come_to[topic] = stamp
        ahead = self._ahead[topic]
        said = [place for place, (of, _) in enumerate(ahead, 1) if of <= stamp]
        if said:
            yield from (written for _, written in ahead[: said[-1]])
            del ahead[: said[-1]]

    def _keep_pose(self, made_again: Stamp | None) -> Iterator[Written]:
        """Yield the recorded pose unless it is made again."""
        if self._pose is not None and self._pose[0] != made_again:
            yield self._pose[1]
        elif self._pose is not None:
            self._doubtful.append((self.pose, *self._pose[1:]))
        self._pose = None
