# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a goal can be reached, found out one plan a control period."""

import math
from collections.abc import Generator

from tactile_push.control.placing.law import NOWHERE, PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.reachability import Task, judging, nearing
from tactile_push.control.placing.stages import OUT_OF_REACH, UNKNOWN

VAGUE = 3e-3  # deviation of d beyond which a look would tell chance [m]; picked
BETTER = 0.5  # of the deviation of d at the last look, below which to look again; picked


class ReachOutlook:
    """Looks whether a goal can be reached, and again when d has become better known.

    A look takes two plans, up to seven for a goal out of reach, and some dozens more for the
    nearest goal that is not.

    Attributes
    ----------
    verdict, reason : str
        As of the last look, one of `VERDICTS` and one of `REASONS`.
    nearest : Goal
        The nearest goal in reach if the goal is not, `NOWHERE` if none is known.
    """

    def __init__(self) -> None:
        self.verdict, self.reason, self.nearest = UNKNOWN, '', NOWHERE
        self._looking: Generator[None, None, None] | None = None
        self._deviation = math.inf  # of d when the last look began [m]

    def look(self, law: PlaceLaw, goal: Goal, deviation: float) -> None:
        """Make a plan of the present look, or begin one.

        Parameters
        ----------
        law, goal, deviation : PlaceLaw, Goal, float
            The law, which knows from where; where to; standard deviation of d [m].
        """
        if deviation < min(VAGUE, BETTER * self._deviation):
            task = law.task()
            if task is None:
                return
            self._deviation = deviation
            self._looking = self._look(task, goal)
        if self._looking is not None and next(self._looking, True):
            self._looking = None

    def pause(self) -> None:
        """End a look that is not over."""
        self._looking = None

    def _look(self, task: Task, goal: Goal) -> Generator[None, None, None]:
        """Find out, and pause after each plan."""
        told = yield from judging(task, goal)
        self.verdict, self.reason, self.nearest = told.verdict, told.reason, NOWHERE
        if told.verdict == OUT_OF_REACH:
            self.nearest = (yield from nearing(task, goal)) or NOWHERE
