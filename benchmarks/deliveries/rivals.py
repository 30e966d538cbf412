# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What one would do without a plan: law (18), and a cascade that sets its theta_d."""

import math

from tactile_push import paper
from tactile_push.control import PushLaw
from tactile_push.control.law import AHEAD
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.model import Goal, Situation, centre_of_mass
from tactile_push.control.placing.stages import MISSED, PLACING, RELEASED

X_THERE, THETA_THERE = 5e-4, math.radians(0.5)  # within which a rival lets go [m, rad]
GAIN = 15.0  # of the cascade: theta_d moves by it with the error of x [rad/m]; picked
FARTHEST = 0.6  # theta_d of the cascade from straight ahead, at the most [rad]


class Rival(PushLaw):
    """Law (18), told when to let go: as soon as x and theta are right together.

    As a `cascade` it sets theta_d by the error of x, so that the object drifts towards the goal.
    """

    def __init__(self, goal: Goal, belt: float, piece: float, *, cascade: bool) -> None:
        super().__init__(paper.KP, paper.KD, goal.theta)
        self.goal = goal
        self.belt = belt  # [m]
        self._piece = piece  # belt of a control period [m]
        self._gain = GAIN if cascade else 0.0
        self._belief: Belief | None = None
        self.used = 0.0
        self.stage = PLACING
        self.tell_in = math.nan

    def believe(self, belief: Belief | None) -> None:
        """Take what is believed at the last update's reading; None if nothing is."""
        self._belief = belief

    def told(self) -> None:
        """Take note that the word to let go was given."""
        self.tell_in = math.nan

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        self.used += self._piece
        belief = self._belief
        if self.stage != PLACING:
            self.phi = AHEAD
        elif belief is not None and self._is_there(belief):
            self.stage, self.tell_in = RELEASED, 0.0
        elif self.used >= self.belt:
            self.stage = MISSED
        else:
            super().update(theta)
        return self.phi

    def _is_there(self, belief: Belief) -> bool:
        """Return whether to let go, and set theta_d if not."""
        at = Situation(belief.x, belief.theta, belief.d, 0.0, 0.0)
        x_error = centre_of_mass(at, belief.pushed) - self.goal.x
        wanted = self.goal.theta + self._gain * x_error  # a larger theta drifts to smaller x
        self.theta_desired = min(max(wanted, -FARTHEST), FARTHEST)
        theta_error = belief.theta - self.goal.theta
        return abs(x_error) <= X_THERE and abs(theta_error) <= THETA_THERE
