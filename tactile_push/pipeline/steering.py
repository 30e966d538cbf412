# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals of the law that steers: places across the belt.

Until there is a goal, and after one was given up, law (18) acts as it is. Without an estimate
`Steering` trims its angle by what the edge alone tells.
"""

import math
from collections.abc import Sequence

from tactile_push.control import Drift, Outlook, Steering, Tick
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.stages import OUTSIDE_WORKSPACE, STEERS
from tactile_push.pipeline.lasting import Lasting


class Carrying(Lasting):
    """Serves places where the object shall be carried straight ahead, at whatever angle."""

    STAGES = STEERS

    def take(self, goal: Goal) -> None:
        """Serve a goal, in place of the one that is served."""
        super().take(goal)
        self._aim_trim()

    def cancel(self) -> bool:
        """Give up the goal; return whether there was one."""
        had = super().cancel()
        self._aim_trim()
        return had

    @property
    def doubt(self) -> str:
        """What somebody should hear of, in words: that nothing is known of the object."""
        return '' if math.isnan(self._law.goal) else super().doubt

    def begin(self) -> None:
        """Begin a control period, before the control ticks."""
        super().begin()
        if self._known:
            self._push.steadying.reset()  # so that without an estimate it begins where theta is

    def outlook(self, drift: Drift, tick: Tick, turning: float) -> Outlook:
        """Return where the finger's drift leads; to a goal it may move on."""
        goal = self._law.goal
        if math.isnan(goal):
            return super().outlook(drift, tick, turning)
        # At whatever angle, and it does not grow by itself: the law sees to that.
        told = drift.follow(tick, tick.theta, 0.0)
        x, _, _ = self._where
        return told._replace(lasts=math.inf) if told.drift * (goal - x) > 0.0 else told

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        return super().values() | {'goal_x': self._law.goal}

    def _aim_trim(self) -> None:
        """Let `Steering`, unless a replay has its trim, have the goal of the law."""
        if isinstance(self._push.steadying, Steering):
            self._push.steadying.goal = self._law.goal

    def _wanted(self, goal: Goal) -> float:
        """Return the number of a goal that matters."""
        return goal.x

    def _numbers(self, x: float, rotation: Sequence[float]) -> Sequence[float]:
        """Return the numbers of a message that matter."""
        return (x,)

    def _refusal(self, goal: Goal) -> str:
        """Return why a goal of finite numbers is refused, empty if it is not."""
        limits = self._push.limits
        if not limits.workspace_min <= goal.x <= limits.workspace_max:
            return OUTSIDE_WORKSPACE
        return super()._refusal(goal._replace(theta=0.0))
