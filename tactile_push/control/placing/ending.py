# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How plans end: where they aim, and how much belt they keep before their end."""

import math

from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.horizon import Plan
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Goal, Situation
from tactile_push.control.placing.planner import DETOUR

# Nothing is let go of while less is known than these standard deviations [m, rad]: so much belt [m]
# is kept before the end, but for no longer than a share of all the belt; picked.
SURE, SURE_ANGLE, KEPT_BACK, KEPT_SHARE = 3.5e-4, math.radians(0.3), 0.01, 0.05
# Belt at the end of a plan on which a turn that differs from what is believed is made up for [m],
# the share by which it may differ though c is known, and the drift for which that is worth while.
LAST_TURN, OWN_DOUBT, CLEAR_DRIFT = 0.02, 0.02, 0.2


class Ending:
    """Says how the next plan for a goal shall end, by what is known and how the last ones ended.

    Parameters
    ----------
    belt, piece, delay : float
        Belt that there is for a goal, that of a control period, and that of the lift [m].
    """

    def __init__(self, belt: float, piece: float, delay: float) -> None:
        self._belt = belt
        self._piece = piece
        self._delay = delay
        self.begin()

    def begin(self) -> None:
        """Begin with a goal."""
        self._goes_around = False  # whether the end was missed, so that a plan is to go around
        self._kept_since = math.inf  # belt used when the end was near for the first time [m]
        self._cannot_wait = False  # whether no plan that keeps belt before the end arrives any more

    def aim(self, goal: Goal, last: Plan | None, now: Situation, belief: Belief) -> Goal:
        """Return the goal, moved against the object's drift there by what the turn may be wrong.

        An object that turns more or less than believed is aside when theta is right. If it is too
        far up the drift, it drifts to the goal; from too far down nothing short leads back.

        Parameters
        ----------
        goal, last, now, belief : Goal, Plan or None, Situation, Belief
            The goal, the last plan, and where finger and object are by what is believed.
        """
        if last is None:
            return goal
        pushed = belief.pushed
        d = now.d + pushed.r * (now.theta - goal.theta)  # on the leaf
        drift = math.tan(goal.theta + math.atan2(d, pushed.l))  # towards smaller x
        left = min(max(last.length - self._piece, 0.0), LAST_TURN)
        doubt = (belief.spread.log_c + OWN_DOUBT) * left
        side = min(max(drift / CLEAR_DRIFT, -1.0), 1.0)
        return goal._replace(x=goal.x + side * doubt)

    def least(self, last: Plan | None, spread: Spread, used: float) -> float:
        """Return the belt that a plan takes at the least [m].

        Parameters
        ----------
        last, spread, used : Plan or None, Spread, float
            The last plan, how well things are known, and the belt that is used [m].
        """
        if self._goes_around:
            return DETOUR
        sure = spread.d <= SURE and spread.theta <= SURE_ANGLE
        waited = used - self._kept_since > KEPT_SHARE * self._belt
        fails = last is not None and not last.arrives
        if sure or waited or fails or self._cannot_wait:
            return 0.0
        return KEPT_BACK + self._delay

    def take(self, plan: Plan | None, last: Plan | None, used: float) -> bool:
        """Take note of a plan.

        Parameters
        ----------
        plan, last, used : Plan or None, Plan or None, float
            The plan, the last one, and the belt that is used [m].

        Returns
        -------
        bool
            Whether the word to let go would have to be given before the next plan.
        """
        if plan is None or not plan.arrives:
            self._cannot_wait |= last is not None and last.arrives
        if plan is None:
            return False
        word = self._piece + self._delay
        is_near = plan.length < KEPT_BACK + word
        if is_near:
            self._kept_since = min(self._kept_since, used)
        if plan.arrives:
            self._goes_around = False
            self._cannot_wait = self._cannot_wait and is_near
        elif plan.length < word and not plan.near:
            self._goes_around = True
        return plan.length < word
