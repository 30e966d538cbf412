# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A second touch: the finger leaves the object and touches it elsewhere on the same edge.

The object lies on the belt meanwhile, so theta and x stay, and d becomes what one likes: the
finger goes over to another leaf (docs/placing.md).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from tactile_push.control.placing.horizon import Plan, at_once
from tactile_push.control.placing.model import Bounds, Goal, Situation, centre_of_mass
from tactile_push.control.placing.planner import LOOK_TRIES
from tactile_push.control.placing.reachability import Task, with_reserve

TOUCHES = 11  # places on the edge that are tried
NEAREST = 2e-3  # the least way along the edge that is worth a detour [m]; picked
THERE = 1e-4  # so near to its place the finger has got there [m]
NEARLY = 2e-3  # so near to the end of its way back it slows down [m]
LATE = 0.01  # belt by which the object may come later than expected [m]; picked


@dataclass(frozen=True)
class Moves:
    """How a finger of two axes gets about off the object.

    Raises
    ------
    ValueError
        If the finger is no faster than the belt.
    """

    speed: float  #: along each axis, at the most [m/s]
    acceleration: float  #: of it [m/s^2]
    belt_speed: float  #: of the belt, which is slower [m/s]
    clearance: float = 2e-3  #: between finger and edge until the finger waits, along the belt [m]

    def __post_init__(self) -> None:
        if not self.speed > self.belt_speed:
            raise ValueError(
                f'speed: expected more than the belt has, {self.belt_speed}, got {self.speed}'
            )

    def time(self, way: float) -> float:
        """Return how long a way [m] takes from rest to rest [s]."""
        if way < self.speed**2 / self.acceleration:
            return 2.0 * math.sqrt(way / self.acceleration)
        return way / self.speed + self.speed / self.acceleration

    def retreat(self, gap: float) -> float:
        """Return the way along the belt after which the edge is so far away [m]."""
        belt, acceleration = self.belt_speed, self.acceleration
        root = belt / math.sqrt(acceleration)
        short = (root + math.sqrt(root**2 + gap)) ** 2
        if short < self.speed**2 / acceleration:
            return short
        return (gap + belt * self.speed / acceleration) / (1.0 - belt / self.speed)

    def towards(self, rest: float, period: float) -> float:
        """Return the velocity with which to go the rest of a way and stop at its end.

        Parameters
        ----------
        rest : float
            The way [m].
        period : float
            Time for which the velocity holds [s].

        Returns
        -------
        float
            The velocity [m/s].
        """
        # What is left after slowing down by the acceleration from period to period.
        step = self.acceleration * period
        brake = step / 2.0 * (math.sqrt(1.0 + 8.0 * abs(rest) / (step * period)) - 1.0)
        return math.copysign(min(self.speed, abs(rest) / period, brake), rest)


@dataclass(frozen=True)
class Detour:
    """How a finger of two axes gets from one contact to another one.

    It retreats along the belt, faster than that, moves across and waits for the object.
    """

    across: float  #: way across the belt [m]
    back: float  #: way along it, by which the line of pushing moves on [m]
    belt: float  #: belt that passes [m]
    gap: float  #: between finger and edge along the belt before it goes across [m]


@dataclass(frozen=True)
class Touch:
    """Where to touch next."""

    d: float  #: contact along the edge [m]
    detour: Detour  #: the way there
    plan: Plan  #: from there to the goal

    @property
    def belt(self) -> float:
        """The belt until the goal [m]."""
        return self.detour.belt + self.plan.length

    @property
    def arrives(self) -> bool:
        """Whether the plan gets to the goal."""
        return self.plan.arrives


def detour(now: Situation, d: float, moves: Moves) -> Detour:
    """Return the way to another contact on the same edge.

    Parameters
    ----------
    now : Situation
        Where finger and object are.
    d : float
        The other contact along the edge [m].
    moves : Moves
        How the finger gets about.
    """
    way = d - now.d
    # Along the edge the finger's place changes by (cos theta, sin theta) d.
    across, ahead = way * math.cos(now.theta), way * math.sin(now.theta)
    over = moves.time(abs(across))
    # The gap falls or grows on the way across: its ends decide.
    gap = max(moves.clearance, moves.clearance - ahead + moves.belt_speed * over)
    back = moves.retreat(gap)
    return Detour(across, back, back + ahead, gap)


def touches(task: Task, goal: Goal, moves: Moves, room: float) -> Iterator[Touch | None]:
    """Try contacts along the edge, with reserve, and without if none leads to the goal then.

    Likely ones come first.

    Parameters
    ----------
    task : Task
        From where, under which numbers and within which bounds; of the belt the detour takes.
    goal : Goal
        Where to.
    moves : Moves
        How the finger gets about.
    room : float
        How far it may retreat [m].

    Yields
    ------
    Touch or None
        After each plan the contact that it begins at; None if the object is lost from there.
    """
    now, found = task.now, False
    for limited in (with_reserve(task), task):
        bounds, belt = limited.bounds, limited.belt
        for d in _likely_first(limited, goal):
            way = detour(now, d, moves)
            left = belt - way.belt
            if abs(d - now.d) < NEAREST or left < 0.0 or not fits(way, now, task.bounds, room):
                continue
            there = Situation(now.x + way.across, now.theta, d, 0.0, 0.0)
            then = Task(there, task.pushed, bounds, left)
            plan = at_once(then.planning(goal, tries=LOOK_TRIES))
            found |= plan is not None and plan.arrives
            yield Touch(d, way, plan) if plan is not None else None
        if found:
            return


def _likely_first(task: Task, goal: Goal) -> list[float]:
    """Return contacts along the edge, first those whose drift at the goal's angle leads there.

    On the leaf of such a contact the object, once it has that angle, moves on towards the goal.
    """
    now, pushed, bounds = task.now, task.pushed, task.bounds
    wanted = math.atan2(goal.x - centre_of_mass(now, pushed), task.belt)

    def aside(d: float) -> float:
        leaf = d + pushed.r * (now.theta - goal.theta)
        return abs(goal.theta + math.atan2(leaf, pushed.l) + wanted)

    step = (bounds.d_max - bounds.d_min) / TOUCHES
    return sorted((bounds.d_min + (k + 0.5) * step for k in range(TOUCHES)), key=aside)


def fits(way: Detour, now: Situation, bounds: Bounds, room: float) -> bool:
    """Return whether a finger may go a way: within the workspace, and no farther back than it may.

    Parameters
    ----------
    way, now, bounds, room : Detour, Situation, Bounds, float
        The way, from where, within which bounds, and how far the finger may go back [m].
    """
    return way.back <= room and bounds.x_min <= now.x + way.across <= bounds.x_max


class Regrasp:
    """A finger on its way to another contact: back, and across once it is told where to.

    Parameters
    ----------
    moves : Moves
        How the finger gets about.

    Attributes
    ----------
    goes : bool
        Whether it was told.
    is_clear : bool
        Whether it was and has gone back, so that what it feels is another contact.
    """

    def __init__(self, moves: Moves) -> None:
        self._moves = moves
        self._across, self._back = 0.0, -moves.retreat(moves.clearance)  # what is left [m]
        self._gone = 0.0  # way back [m]
        self._gap = 0.0  # between finger and edge along the belt [m]
        self._belt = math.inf  # until the object has come [m]
        self._waits = self.goes = self.is_clear = False

    def go(self, way: Detour) -> None:
        """Take a way that begins at the contact that was left."""
        back = self.more(way)
        self._belt = self._gap + back + way.belt - way.back + LATE
        self._across, self._back = way.across, -back
        self.goes = True

    def more(self, way: Detour) -> float:
        """Return how much farther back the finger has to go for a way [m]."""
        if not self._waits:
            return max(way.back - self._gone, 0.0)
        return self._moves.retreat(way.gap - self._gap) if way.gap > self._gap else 0.0

    @property
    def is_nearly_back(self) -> bool:
        """Whether the finger slows down at the end of its way back."""
        return abs(self._back) <= NEARLY

    @property
    def is_late(self) -> bool:
        """Whether the object should have come by now."""
        return self._belt < 0.0

    def pass_time(self, seconds: float, velocity: tuple[float, float]) -> None:
        """Take note of the time [s] for which the finger had a velocity across and along [m/s]."""
        belt = self._moves.belt_speed * seconds
        self._across -= velocity[0] * seconds
        self._back -= velocity[1] * seconds
        self._gone -= velocity[1] * seconds
        self._gap -= velocity[1] * seconds + belt
        self._belt -= belt

    def velocity(self, period: float) -> tuple[float, float]:
        """Return the velocity across and along the belt for a period [s, m/s]."""
        is_back = abs(self._back) <= THERE
        self.is_clear = self.is_clear or (self.goes and is_back)
        if self.is_clear:
            return self._moves.towards(self._across, period), 0.0
        if is_back:  # and does not know where to: it keeps away from the edge
            self._waits = True
            self._back -= self._moves.belt_speed * period
        return 0.0, self._moves.towards(self._back, period)
