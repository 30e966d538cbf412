# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that places: it learns where the contact is, plans, and says when to let go."""

import math
from dataclasses import replace

import numpy as np

from tactile_push.control.law import AHEAD, motion_angle
from tactile_push.control.placing.arcs import UNKNOWNS, rest_of
from tactile_push.control.placing.believing import D_MARGIN, Belief, BelievingLaw
from tactile_push.control.placing.elsewhere import Elsewhere
from tactile_push.control.placing.ending import Ending
from tactile_push.control.placing.horizon import Plan
from tactile_push.control.placing.learning import telling_command
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation, ahead
from tactile_push.control.placing.past import on_grid
from tactile_push.control.placing.planner import Planner
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import Moves
from tactile_push.control.placing.stages import (
    LEARNING,
    LETTING_GO,
    MISSED,
    NO_GOAL,
    OBJECT_LOST,
    PLACING,
    REGRASPING,
    RELEASED,
)
from tactile_push.control.states import NO_REASON, NOTHING_TO_DO
from tactile_push.mechanics import friction_cone

NOWHERE = Goal(math.nan, math.nan)  # no goal
ACTING = (LEARNING, PLACING, LETTING_GO, REGRASPING)
KNOWN = 1e-3  # standard deviation of d below which the law commits itself [m]
VAGUE = 2e-3  # the same beyond which no other contact is looked for [m]; picked
STILL = 0.1  # of the belt's speed, with which a finger that leaves may still go across; picked
LEARNED_SHARE = 0.08  # of the belt, after which it does so anyhow; picked
SPREADS = 1.0  # deviations of d that are kept from the edge's ends beside `D_MARGIN`
LARGEST_ANGLE = math.radians(50.0)  # of theta in plans


class PlaceLaw(BelievingLaw):
    """Brings an object to a goal, one push angle a control period.

    It takes the place of law (18) in `PushControl`. Until something is believed it pushes straight
    ahead. While d is hardly known it pushes so as to learn d. Then it plans in every control period
    anew, from the newest belief moved on to the present, and says in which period to let go. If no
    plan arrives and the finger can move along the belt, it touches elsewhere (`Elsewhere`).

    Parameters
    ----------
    goal : Goal
        Where to let go; `NOWHERE` to wait for a goal.
    belt : float
        Belt that there is for a goal [m].
    belt_speed, period : float
        Speed of the belt [m/s] and control period [s].
    lag : float, optional
        Time constant with which the finger follows [s].
    delay : float, optional
        Time from the word to let go until the object is free [s].
    workspace : tuple of float, optional
        Least and greatest x of the finger's disk [m].
    rate : float, optional
        Largest change of v_x [m/s^2].
    phi_min, phi_max : float, optional
        Bounds of phi [rad], alike on both sides of straight ahead.
    felt : float, optional
        Largest angle between the tip's pole and a contact that the sensor feels [rad].
    moves : Moves, optional
        How the finger gets about off the object; None if it cannot move along the belt.
    room : float, optional
        How far it may go back in all [m].

    Attributes
    ----------
    stage : str
        One of `stages.STAGES`: `LEARNING`, `PLACING`, `REGRASPING`, `LETTING_GO`, and how it ended.
    let_go_in, tell_in : float
        When the object is free, and when to say so that it is, after the last update [s]; NaN if
        not within the period.
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
        delay: float = 0.0,
        workspace: tuple[float, float] = (-0.105, 0.105),
        rate: float = 0.05,
        phi_min: float = math.radians(33.0),
        phi_max: float = math.radians(147.0),
        felt: float = math.pi / 2.0,
        moves: Moves | None = None,
        room: float = 0.0,
    ) -> None:
        super().__init__(
            *(goal.theta, belt_speed, period),
            lag=lag,
            workspace=workspace,
            rate=rate,
            phi_min=phi_min,
            phi_max=phi_max,
            felt=felt,
        )
        self.belt = belt
        self._delay = delay * belt_speed
        self._bounds = self._bounds._replace(theta_max=LARGEST_ANGLE)
        self._planner = Planner(self._bounds)
        self._ending = Ending(belt, self._piece, self._delay)
        self._elsewhere = Elsewhere(moves, room, period)
        self.stage = NO_GOAL
        self.aim_at(goal)

    def aim_at(self, goal: Goal) -> None:
        """Take another goal, for which there is all the belt; what is believed stays.

        A finger that is on its way to another contact goes on.
        """
        self.goal = goal
        self.theta_desired = goal.theta
        self.began = False  #: whether there was a reading since
        self.used = 0.0  #: belt since then [m]
        if self.stage != REGRASPING:
            self.stage = NO_GOAL if math.isnan(goal.x) else LEARNING
            self.away = None
        self.let_go_in = self.tell_in = math.nan
        self.plan: Plan | None = None
        self._planned_at = math.nan  # on the belt's way [m]
        self._free_at = math.inf  # where the object is let go, on the belt's way [m]
        self._aim = math.nan
        self._stays = False  # although the finger is not on its line
        self._ending.begin()
        self._elsewhere.begin()
        self._planner.forget()

    def end(self, stage: str) -> None:
        """Do no more for the goal, of which this became."""
        self.stage = stage
        self.away = None
        self.let_go_in = self.tell_in = math.nan
        self._planner.forget()

    def told(self) -> None:
        """Take note that the word to let go was given."""
        self.tell_in = math.nan

    def take_back(self) -> None:
        """Take note that the object was not let go when the law said so."""
        self.stage = PLACING
        self.let_go_in = self.tell_in = math.nan

    @property
    def rests(self) -> str:
        """Why the law does not want to push: it has no goal, or that has come to an end."""
        return NO_REASON if self.stage in ACTING or self.returns else NOTHING_TO_DO

    @property
    def apart(self) -> bool:
        """Whether the finger is on its way to another contact."""
        return self.stage == REGRASPING

    @property
    def returns(self) -> bool:
        """Whether the finger goes back to its line, as it does once it has let go."""
        return self.stage == RELEASED and not (self._stays or self._elsewhere.is_home)

    @property
    def regrasps(self) -> int:
        """How often the finger has left the object for the goal."""
        return self._elsewhere.regrasps

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and what was believed, as when the finger has stopped."""
        super().reset(phi)
        self._planner.forget()
        self._stays = self._stays or self.returns
        if self.stage == REGRASPING:  # nobody brings the finger to the other contact any more
            self.stage = LEARNING

    def tune(self, kp: float, kd: float, theta_desired: float) -> None:
        """Ignore the gains of law (18) and its angle: this law has a goal."""

    def pass_time(self, seconds: float) -> None:
        """Take note of the time since the last period [s], in which phi was in force."""
        super().pass_time(seconds)
        if self.stage == LETTING_GO and self._past.way >= self._free_at:
            self.end(RELEASED)
        if self.away is not None:
            self._elsewhere.pass_time(seconds, self.away)
        if self.stage == REGRASPING and self._elsewhere.is_late:
            self.end(OBJECT_LOST)
        if self.began and self.stage in (LEARNING, PLACING, REGRASPING):
            self.used += seconds * self._belt_speed
            if self.used >= self.belt:
                self.end(MISSED)

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        self.began = True
        self._theta_before = theta
        if self.stage == REGRASPING and self._elsewhere.is_clear:
            self.stage, self.away = PLACING, None
            self._belief = None  # which was about the contact that is left
        if self.returns:  # though something is felt
            self.away = 0.0, 0.0
        else:
            self._act()
        return self.phi

    def go_on(self) -> None:
        """Plan from older readings in a period without a new one."""
        if self._theta_before is not None or self.returns:
            self._act()

    def task(self) -> Task | None:
        """Return from where the goal has to be reached; None if nothing is believed."""
        present = self.present()
        if present is None:
            return None
        now, belief = present
        bounds, left = self._inside(belief, 0.0), max(self.belt - self.used, 0.0)
        return Task(now, belief.pushed, bounds, left, _others(belief))

    def _act(self) -> None:
        """Choose the push angle."""
        self.let_go_in = self.tell_in = math.nan
        if self.stage == LETTING_GO:
            self.phi = motion_angle(self._finish(), 1.0)
            return
        if self.stage == REGRASPING:
            self._elsewhere.look(self.goal)
            self.away = self._elsewhere.velocity()
            return
        if self.returns:
            self.away = self._elsewhere.velocity_home()
            return
        present = None if self.rests else self.present()
        if present is None:
            self.phi = AHEAD
            return
        now, belief = present
        if math.isnan(self._aim):
            self._aim = belief.theta
        margin = D_MARGIN + SPREADS * min(belief.spread.d, KNOWN)
        bounds = self._inside(belief, margin)
        known = belief.spread.d <= KNOWN or self.used > LEARNED_SHARE * self.belt
        if self.stage == LEARNING and known:
            self.stage = PLACING
        if self.stage == LEARNING:
            slippery = _others(belief)[0]
            u = telling_command(now, belief.pushed, slippery, bounds, belief.spread, self._aim)
        elif self._leaves(now, belief):
            u = 0.0
        else:
            u = self._place(now, belief, bounds, self.belt - self.used)
        self.phi = motion_angle(u, 1.0) if math.isfinite(u) else AHEAD

    def _place(self, now: Situation, belief: Belief, bounds: Bounds, left: float) -> float:
        """Plan anew and return the command of the next period."""
        most = max(left, 0.0)
        way = 0.0 if math.isnan(self._planned_at) else self._past.way - self._planned_at
        self._planned_at = self._past.way
        plan = self._planner.plan(
            *(now, belief.pushed, self._ending.aim(self.goal, self.plan, now, belief), most),
            others=_others(belief),
            least=min(self._ending.least(self.plan, belief.spread, self.used), most),
            way=way,
            bounds=bounds,
        )
        arrives = plan is not None and plan.arrives
        self._elsewhere.count(arrives and self._planner.takes_the_likely)
        is_last = self._ending.take(plan, self.plan, self.used)
        self.plan = plan
        ends = plan is not None and plan.near and is_last
        if is_last and not ends:
            self._planner.drop()
        if plan is not None and ends:
            self.tell_in = max(plan.length - self._delay, 0.0) / self._belt_speed
            self._let_go(plan)
        elif left <= self._piece:
            self.stage = MISSED
        if plan is None or (is_last and not ends):
            # Translating keeps what can be reached for the longest.
            return ahead(now, belief.pushed, bounds)
        return plan.command(self._piece)

    def _leaves(self, now: Situation, belief: Belief) -> bool:
        """Leave for another contact if it is time; return whether that takes the place of a plan.

        Readings end when the finger begins to leave, and the object moves along while it touches.
        So it stands still first.
        """
        task = self.task()
        if not self._elsewhere.is_due or belief.spread.d > VAGUE or task is None:
            return False
        if abs(now.u) <= STILL:
            nearest = math.inf if self.plan is None else self.plan.merit
            if self._elsewhere.leave(task, nearest):
                self.stage, self.plan = REGRASPING, None
                self.away = self._elsewhere.velocity()
                self._planner.drop()
        return True

    def _let_go(self, plan: Plan) -> None:
        """Let go at the end of a plan."""
        self.stage = LETTING_GO
        self._free_at = self._past.way + on_grid(plan.length)
        if plan.length < self._piece:
            self.stage = RELEASED
            self.let_go_in = plan.length / self._belt_speed

    def _finish(self) -> float:
        """Return the command of the rest of the last plan, which nothing changes any more."""
        assert self.plan is not None
        rest = np.empty(UNKNOWNS)
        rest_of(self.plan.push, self._past.way - self._planned_at, rest)
        self._planned_at = self._past.way
        self.plan = replace(self.plan, push=rest)
        self._let_go(self.plan)
        return self.plan.command(self._piece)


def _others(belief: Belief) -> tuple[Pushed, ...]:
    """Return the object with the least friction, one between that and its own, and the most."""
    pushed = belief.pushed
    least, most = (friction_cone(mu_c) for mu_c in belief.friction)
    own = math.atan2(pushed.sin_alpha, pushed.cos_alpha)
    between = (math.atan2(least[1], least[0]) + own) / 2.0
    cones = least, (math.cos(between), math.sin(between)), most
    return tuple(pushed._replace(cos_alpha=cos, sin_alpha=sin) for cos, sin in cones)
