# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals that last until they are given up, of laws that do what law (18) does without estimates."""

import math
from abc import abstractmethod

from tactile_push.control import PUSHING, Drift, Outlook, Tick
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.control.placing.steer_law import SteerLaw
from tactile_push.pipeline.believing import OLDEST, Believing


class Lasting(Believing):
    """Serves goals of which one number matters."""

    _law: SettleLaw | SteerLaw

    STAGES = '', ''  #: while the law acts by what is known of the object, and otherwise

    def take(self, goal: Goal) -> None:
        """Serve a goal, in place of the one that is served."""
        super().take(goal)
        self._law.goal = self._wanted(goal)

    def cancel(self) -> bool:
        """Give up the goal; return whether there was one."""
        had = not math.isnan(self._law.goal)
        self._law.goal = math.nan
        return had

    @property
    def stage(self) -> str:
        """Whether the law acts by what is known of the object, one of its `STAGES`."""
        return self.STAGES[0 if self._known else 1]

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

    def outlook(self, drift: Drift, tick: Tick, turning: float) -> Outlook:
        """Return where the finger's drift leads while theta is what the law brings it to."""
        return drift.follow(tick, self._law.aim, turning)

    def look_ahead(self) -> None:
        """Look for nothing: what cannot be reached is brought as near as it can be."""

    @abstractmethod
    def _wanted(self, goal: Goal) -> float:
        """Return the number of a goal that matters."""

    @property
    def _known(self) -> bool:
        """Whether there is an estimate that is not too old."""
        return self._belief is not None and self._unknown <= OLDEST

    @property
    def _acts(self) -> bool:
        """Whether the law needs estimates, which it always does."""
        return True
