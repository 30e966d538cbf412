# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals of an object that is steered across the belt: what `push_controller` does with them.

Until there is a goal the law (18) acts as it is. `push_controller/state` tells the angle that it
then steers to, and so all that a replay needs.
"""

import math
from collections.abc import Sequence

from tactile_push.control import PushControl, Steering
from tactile_push.control.placing.stages import (
    HELD_STILL,
    NO_GOAL,
    NOT_FINITE,
    OTHER_FRAME,
    OUTSIDE_WORKSPACE,
)
from tactile_push.interface import FINGER_BASE, is_frame

STEERING = 'steering'


class SteerGoals:
    """Takes goals for a control that steers.

    Parameters
    ----------
    push : PushControl
        The control, whose steadying is a `Steering`.
    """

    def __init__(self, push: PushControl) -> None:
        self._push = push

    @property
    def stage(self) -> str:
        """Whether there is a goal, in words."""
        return NO_GOAL if math.isnan(self._steering.goal) else STEERING

    def goal(self, frame: str, x: float, rotation: Sequence[float]) -> str:
        """Take a message of `place/goal`, or refuse it and go on as before.

        Parameters
        ----------
        frame, x, rotation : str, float, sequence of float
            The message's frame, x of its position [m], and its quaternion, which does not matter.

        Returns
        -------
        str
            Why it is refused, one of `REFUSALS`; empty if it is not.
        """
        limits = self._push.limits
        if not is_frame(frame, FINGER_BASE):
            return OTHER_FRAME
        if not math.isfinite(x):
            return NOT_FINITE
        if not limits.workspace_min <= x <= limits.workspace_max:
            return OUTSIDE_WORKSPACE
        if self._push.held:
            return HELD_STILL
        self._steering.goal = x
        return ''

    def cancel(self) -> bool:
        """Give up the goal; the law (18) goes on as it is. Return whether there was one."""
        had = self.stage == STEERING
        self._steering.goal = math.nan
        return had

    @property
    def _steering(self) -> Steering:
        steering = self._push.steadying
        assert isinstance(steering, Steering)
        return steering
