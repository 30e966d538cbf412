# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals and estimates of the law that settles: what `push_controller` does beside its ticks.

Until there is a goal, and after one was given up, the edge is to have theta_desired, as under
law (18). While nothing is known of the object, law (18) acts with its own gains.
"""

import math
from collections.abc import Sequence

from tactile_push.control import PUSHING
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.control.placing.stages import SETTLING, SETTLING_BLINDLY
from tactile_push.pipeline.believing import OLDEST, Believing


class Settling(Believing):
    """Serves goals with the law that settles; where the object is to be does not matter.

    Parameters
    ----------
    push, law, seconds : PushControl, SettleLaw, callable
        As in `Believing`; the law has no goal.
    """

    _law: SettleLaw

    def take(self, goal: Goal) -> None:
        """Turn to the angle of a goal from now on."""
        super().take(goal)
        self._law.goal = goal.theta

    def cancel(self) -> bool:
        """Give up the goal, so that theta_desired counts; return whether there was one."""
        had = not math.isnan(self._law.goal)
        self._law.goal = math.nan
        return had

    @property
    def stage(self) -> str:
        """Whether the law knows the object, one of `SETTLES`."""
        return SETTLING if self._known else SETTLING_BLINDLY

    @property
    def doubt(self) -> str:
        """What somebody should hear of, in words: that nothing is known of the object."""
        blind = self._unknown > OLDEST and self._push.state == PUSHING
        return 'nothing is known of the object, so law (18) acts' if blind else ''

    def begin(self) -> None:
        """Begin a control period, before the control ticks."""
        is_new = self._take_estimate()
        self._unknown = 0 if is_new and self._belief is not None else self._unknown + 1
        self._law.believe(self._belief if self._known else None, self._ticked - self._read)

    def look_ahead(self) -> None:
        """Look for nothing: each angle can be reached, or its nearest one is the best there is."""

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        return super().values() | {'goal_theta': self._law.goal}

    @property
    def _known(self) -> bool:
        """Whether there is an estimate that is not too old."""
        return self._belief is not None and self._unknown <= OLDEST

    @property
    def _acts(self) -> bool:
        """Whether the law needs estimates, which it always does."""
        return True

    def _numbers(self, x: float, rotation: Sequence[float]) -> Sequence[float]:
        """Return the numbers of a goal that matter."""
        return rotation
