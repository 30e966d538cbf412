# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals, estimates and releases of a bag, given to a law that believes as its node had them."""

import math
import typing
from collections import deque
from collections.abc import Mapping
from typing import Any

from tactile_push.control.placing.stages import CANCELLED, REFUSALS, SETTLES, STAGES, STEERS
from tactile_push.interface import PLACE, SETTLE, STEER
from tactile_push.pipeline import Control, Seconds, Stamp, by_name
from tactile_push.pipeline.stamps import stamp_of

if typing.TYPE_CHECKING:
    from tactile_push.pipeline.believing import Believing

# Of which law a stage is; all others are of the one that places.
LAWS = dict.fromkeys(SETTLES, SETTLE) | dict.fromkeys(STEERS, STEER)
HALF_A_NANOSECOND = 0.5e-9  # two stamps differ by more [s]
REMEMBERED = 1000  # estimates that no control period has used yet


class RecordedPlacing:
    """What `place/state` and `active_sensing/state` of a bag say, by control periods.

    `place/state` counts goals, refusals and releases, and tells how old the estimate was that a
    period used. `place/goal` itself is not needed.
    """

    def __init__(self, seconds: Seconds) -> None:
        self._seconds = seconds
        self._periods: dict[Stamp, Mapping[str, float]] = {}
        self._come_to = -math.inf  # the newest of them [s]
        self._estimates: deque[tuple[float, Any]] = deque(maxlen=REMEMBERED)

    def state(self, message: Any) -> None:
        """Take a message of `place/state`."""
        stamp = stamp_of(message)
        self._periods[stamp] = by_name(message.name, message.position)
        self._come_to = max(self._come_to, self._seconds(*stamp))

    def estimate(self, message: Any) -> None:
        """Take a message of `active_sensing/state`."""
        self._estimates.append((self._seconds(*stamp_of(message)), message))

    def complete(self, stamp: Stamp, last: bool) -> bool:
        """Return whether all is there that a control period used.

        Parameters
        ----------
        stamp, last : tuple of int, bool
            When the period began [s, ns], and whether it is the one of a deactivation, which uses
            nothing new.

        Returns
        -------
        bool
            Whether it is; true as well if the law was none that believes.
        """
        if stamp not in self._periods:
            return self._come_to > self._seconds(*stamp)
        used = self._used(stamp)
        return last or math.isnan(used) or self._newest > used - HALF_A_NANOSECOND

    def law(self, stamp: Stamp) -> str | None:
        """Return which law acted in a control period; None if it was none that believes."""
        values = self._periods.get(stamp)
        if values is None:
            return None
        return LAWS.get(STAGES[int(values['stage'])], PLACE)

    def feed(self, step: Control, stamp: Stamp) -> None:
        """Repeat what happened before a control period, and forget the periods before."""
        values, placing = self._periods[stamp], step.placing
        now = self._seconds(*stamp)
        assert placing is not None
        step.turning = values['turning']
        step.line, step.bend = (values.get(name, math.nan) for name in ('finger_y', 'bend'))
        if values['released'] > placing.released:
            placing.release()
        self._repeat_goals(placing, values)
        no_goal = math.isnan(values['goal_x']) and math.isnan(values['goal_theta'])
        if STAGES[int(values['stage'])] == CANCELLED or no_goal:
            placing.cancel()
        used = self._used(stamp)
        for at, message in self._estimates:
            if abs(at - used) < HALF_A_NANOSECOND:
                placing.sensed(stamp_of(message), message.name, message.position)
        for old in [old for old in self._periods if self._seconds(*old) < now]:
            del self._periods[old]

    @staticmethod
    def _repeat_goals(placing: 'Believing', values: Mapping[str, float]) -> None:
        from tactile_push.control.placing.model import Goal  # which loads the compiler

        goals, refused = int(values['goals']), int(values['refused'])
        if goals > placing.goals:
            placing.take(Goal(values['goal_x'], values['goal_theta']))
            placing.goals = goals
        if refused > placing.refused:
            placing.refuse(REFUSALS[int(values['refusal'])])
            placing.refused = refused

    @property
    def _newest(self) -> float:
        return self._estimates[-1][0] if self._estimates else -math.inf

    def _used(self, stamp: Stamp) -> float:
        """Return the control period that the estimate is about [s]; NaN if there was none."""
        return self._seconds(*stamp) - self._periods[stamp]['estimate_age']
