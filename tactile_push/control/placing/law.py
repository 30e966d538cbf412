# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that places: it learns where the contact is, plans, and says when to let go."""

import math
from dataclasses import dataclass

from tactile_push.control.law import AHEAD, PushLaw, finger_velocity, motion_angle
from tactile_push.control.placing.learning import Spread, telling_command
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation, follow
from tactile_push.control.placing.planner import Plan, Planner

LEARNING, PLACING, RELEASED, MISSED = 'learning', 'placing', 'released', 'missed'
KNOWN = 1e-3  # standard deviation of d below which the law commits itself [m]
LEARNED_SHARE = 0.08  # of the belt, after which it does so anyhow; picked
D_MARGIN, SPREADS = 2e-3, 1.0  # kept from the edge's ends [m], and deviations of d beside it
DETOUR = 0.02  # belt of a plan that goes around once more, at least [m]
X_MARGIN = 1e-3  # kept from the ends of the workspace [m]
LARGEST_ANGLE = math.radians(50.0)  # of theta in plans


@dataclass(frozen=True)
class Belief:
    """What is believed at a reading."""

    x: float  #: centre of the finger's disk across the belt [m]
    theta: float  #: angle of the pushed edge [rad]
    d: float  #: contact along the edge [m]
    pushed: Pushed  #: numbers of object and finger
    ends: tuple[float, float]  #: of the edge, least and most d [m]
    spread: Spread  #: how well they are known


class PlaceLaw(PushLaw):
    """Brings an object to a goal, one push angle a control period.

    It takes the place of law (18) in `PushControl`. Until something is believed it pushes straight
    ahead. While d is hardly known it pushes so as to learn d. Then it plans in every control period
    anew, from the newest belief moved on to the present, and says in which period to let go.

    Parameters
    ----------
    goal : Goal
        Where to let go.
    belt : float
        Belt that there is [m].
    belt_speed, period : float
        Speed of the belt [m/s] and control period [s].
    lag : float, optional
        Time constant with which the finger follows [s].
    workspace : tuple of float, optional
        Least and greatest x of the finger's disk [m].
    rate : float, optional
        Largest change of v_x [m/s^2].
    phi_min, phi_max : float, optional
        Bounds of phi [rad], alike on both sides of straight ahead.

    Attributes
    ----------
    stage : str
        `LEARNING`, `PLACING`, `RELEASED`, or `MISSED` when the belt is over.
    let_go_in : float
        When to let go, after the last update [s]; NaN if not within the period.
    plan : Plan or None
        The newest one.
    """

    def __init__(
        self,
        goal: Goal,
        belt: float,
        belt_speed: float,
        period: float,
        *,
        lag: float = 0.0,
        workspace: tuple[float, float] = (-0.105, 0.105),
        rate: float = 0.05,
        phi_min: float = math.radians(33.0),
        phi_max: float = math.radians(147.0),
    ) -> None:
        super().__init__(0.0, 0.0, goal.theta, phi_min, phi_max)
        self.goal = goal
        self.belt = belt
        self._period, self._belt_speed = period, belt_speed
        self._piece = period * belt_speed
        self._lag = lag * belt_speed
        steepest = min(1.0 / math.tan(phi_min), -1.0 / math.tan(phi_max))
        self._bounds = Bounds(
            *(steepest, rate / belt_speed**2, workspace[0] + X_MARGIN, workspace[1] - X_MARGIN),
            *(-math.inf, math.inf, LARGEST_ANGLE),
        )
        self._planner = Planner(self._bounds)
        self._belief: Belief | None = None
        self._u = 0.0
        self.used = 0.0  #: belt since the first reading [m]
        self.stage = LEARNING
        self.let_go_in = math.nan
        self.plan: Plan | None = None
        self._aim = math.nan

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and what was believed, as when the finger has stopped."""
        super().reset(phi)
        self._belief = None
        self._u = 0.0
        self._planner.forget()

    def believe(self, belief: Belief | None) -> None:
        """Take what is believed at the last update's reading; None if nothing is."""
        self._belief = belief

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        first = self._theta_before is None
        self._theta_before = theta
        self.let_go_in = math.nan
        if first or self._belief is None or self.stage in (RELEASED, MISSED):
            self.phi = AHEAD
            return self.phi
        if math.isnan(self._aim):
            self._aim = theta
        command = finger_velocity(self.phi, 1.0)
        belief = self._belief
        pushed = belief.pushed._replace(lag=self._lag)
        then = Situation(belief.x, belief.theta, belief.d, self._u, command)
        now = follow(then, command, self._piece, pushed)
        self._u = now.u
        self.used += self._piece
        left = self.belt - self.used
        margin = D_MARGIN + SPREADS * min(belief.spread.d, KNOWN)
        bounds = self._bounds._replace(d_min=belief.ends[0] + margin, d_max=belief.ends[1] - margin)
        known = belief.spread.d <= KNOWN or self.used > LEARNED_SHARE * self.belt
        if self.stage == LEARNING and known:
            self.stage = PLACING
        if self.stage == LEARNING:
            u = telling_command(now, pushed, bounds, belief.spread, self._aim)
        else:
            u = self._place(now, pushed, bounds, left)
        self.phi = motion_angle(u, 1.0)
        return self.phi

    def _place(self, now: Situation, pushed: Pushed, bounds: Bounds, left: float) -> float:
        """Plan anew and return the command of the next period."""
        most = max(left, 0.0)
        self.plan = self._planner.plan(now, pushed, self.goal, most, way=self._piece, bounds=bounds)
        if self.plan is not None and self.plan.length < self._piece and not self.plan.near:
            self._planner.forget()
            least = min(DETOUR, most)
            self.plan = self._planner.plan(now, pushed, self.goal, most, least=least, bounds=bounds)
        plan = self.plan
        ends = plan is not None and plan.near and plan.length < self._piece
        if plan is not None and ends:
            self.stage = RELEASED
            self.let_go_in = plan.length / self._belt_speed
        elif left <= self._piece:
            self.stage = MISSED
        if plan is None or (plan.length < self._piece and not ends):
            # Translating keeps what can be reached for the longest.
            ahead = -math.tan(now.theta + math.atan2(now.d, pushed.l))
            return min(max(ahead, -bounds.steepest), bounds.steepest)
        return plan.command(self._piece)
