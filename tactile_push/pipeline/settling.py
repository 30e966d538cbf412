# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals of the law that settles: angles of the edge.

Until there is a goal, and after one was given up, the edge is to have theta_desired, as under
law (18).
"""

from collections.abc import Sequence

from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.stages import SETTLES
from tactile_push.pipeline.lasting import Lasting


class Settling(Lasting):
    """Serves angles that the edge shall have, wherever the object is."""

    STAGES = SETTLES

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        return super().values() | {'goal_theta': self._law.goal}

    def _wanted(self, goal: Goal) -> float:
        """Return the number of a goal that matters."""
        return goal.theta

    def _numbers(self, x: float, rotation: Sequence[float]) -> Sequence[float]:
        """Return the numbers of a message that matter."""
        return rotation
