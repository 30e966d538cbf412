# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a goal can be reached, and if not, why and which one is nearest."""

import math
from collections.abc import Generator
from dataclasses import dataclass, replace

from tactile_push.control.placing.horizon import MORE_TRIES, Plan, at_once, planning
from tactile_push.control.placing.model import (
    Bounds,
    Goal,
    Pushed,
    Situation,
    centre_of_mass,
    narrowed,
)
from tactile_push.control.placing.planner import LIKELY, LOOK_TRIES, Look, looks_of
from tactile_push.control.placing.stages import (
    AT_THE_LIMITS,
    BELT,
    CONTACT,
    EDGE,
    FRICTION,
    OUT_OF_REACH,
    SENSOR,
    WITH_RESERVE,
    WORKSPACE,
)
from tactile_push.mechanics.turning_tip import STRAIGHT

# What is spared for a reserve: shares of cot(phi) and of the belt, ends of edge and workspace [m],
# theta [rad].
STEEPNESS_SPARED, BELT_SPARED, SPARED, THETA_SPARED = 0.15, 0.2, 3e-3, math.radians(5.0)
FAR = 10.0  # no end of an edge, a workspace or a belt [m]
# How far goals around one are tried, where a millimetre counts as a degree [mm]; and in how many
# directions.
STEPS = 32  # in which goals between one and the start are tried
RADII, DIRECTIONS, HALVINGS = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0), 12, 3


PLAIN = Look(LIKELY)


@dataclass(frozen=True)
class Reach:
    """Whether a goal can be reached."""

    verdict: str  #: `WITH_RESERVE`, `AT_THE_LIMITS` or `OUT_OF_REACH`
    reason: str  #: what forbids it, `FRICTION` to `CONTACT`; empty if nothing does
    plan: Plan | None  #: how, or what comes nearest in the planner's measure


@dataclass(frozen=True)
class Task:
    """From where, under which numbers and within which bounds."""

    now: Situation  #: where finger and object are
    pushed: Pushed  #: numbers of object and finger
    bounds: Bounds  #: what may not be left
    belt: float  #: what there is of it [m]
    others: tuple[Pushed, ...] = ()  #: what the object may also be

    def planning(
        self, goal: Goal, look: Look = PLAIN, tries: int = MORE_TRIES
    ) -> Generator[None, None, Plan | None]:
        """Return the pieces of the best plan for a goal, as `planning` does."""
        problem = self.now, goal, (self.pushed, *self.others)[look.taken.kind]
        belt = min(look.least, self.belt), self.belt
        bounds = look.bounds(self.bounds)
        return planning(problem, bounds, *belt, tries, roundabout=look.roundabout)

    def plan(self, goal: Goal) -> Plan | None:
        """Return the best plan for a goal."""
        return at_once(self.planning(goal))

    def arrives(self, goal: Goal) -> bool:
        """Return whether there is a plan that gets to a goal."""
        return _arrives(self.plan(goal))


def _arrives(plan: Plan | None) -> bool:
    return plan is not None and plan.arrives


def reach(task: Task, goal: Goal) -> Reach:
    """Find out whether a goal can be reached.

    Parameters
    ----------
    task : Task
        From where.
    goal : Goal
        Where to.

    Returns
    -------
    Reach
        Whether, and what forbids it.
    """
    return at_once(judging(task, goal))


def judging(task: Task, goal: Goal) -> Generator[None, None, Reach]:
    """Find out the same, for who has no time for all the plans at once.

    A goal is out of reach if none of the plans arrives that the law would look for. It is reached
    with reserve if one with what is most likely does that spares some of every limit.

    Parameters
    ----------
    task, goal : Task, Goal
        As for `reach`.

    Yields
    ------
    None
        After each piece of work.

    Returns
    -------
    Reach
        As `reach` does.
    """
    first = None
    for look in _looks(task):
        plan = yield from task.planning(goal, look)
        yield
        if _arrives(plan):
            spared = yield from _sparing(task, goal)
            return spared or Reach(AT_THE_LIMITS, '', plan)
        if look == PLAIN:
            first = plan
    if spared := (yield from _sparing(task, goal)):  # from which other plans are found
        return spared
    reason = yield from _reason(task, goal)
    return Reach(OUT_OF_REACH, reason, first)


def _sparing(task: Task, goal: Goal) -> Generator[None, None, Reach | None]:
    """Return how a goal is reached with reserve, None if it is not.

    Every look is tried: that one has found a plan without reserve says nothing about the others.
    """
    spared = with_reserve(task)
    for look in _looks(task):
        if look.taken == LIKELY:
            plan = yield from spared.planning(goal, look)
            yield
            if _arrives(plan):
                return Reach(WITH_RESERVE, '', plan)
    return None


def _looks(task: Task) -> list[Look]:
    """Return which plans the law would follow, first those that take nothing for granted."""
    looks = (look for look in looks_of(1 + len(task.others)) if not look.spares)
    return sorted(looks, key=lambda look: look.taken != LIKELY)


def with_reserve(task: Task) -> Task:
    """Return a task that spares some of everything that is limited."""
    bounds = narrowed(task.bounds, STEEPNESS_SPARED, SPARED, SPARED, THETA_SPARED)
    return replace(task, belt=(1.0 - BELT_SPARED) * task.belt, bounds=bounds)


def _reason(task: Task, goal: Goal) -> Generator[None, None, str]:
    bounds, pushed = task.bounds, task.pushed
    without = {
        SENSOR: replace(task, bounds=bounds._replace(felt=FAR)),
        WORKSPACE: replace(
            task,
            bounds=bounds._replace(x_min=-FAR, x_max=FAR),
            pushed=pushed._replace(tip=STRAIGHT),  # of a finger that gets everywhere
        ),
        EDGE: replace(task, bounds=bounds._replace(d_min=-FAR, d_max=FAR)),
        FRICTION: replace(task, pushed=pushed._replace(cos_alpha=0.0, sin_alpha=1.0)),
        BELT: replace(task, belt=max(4.0 * task.belt, 0.5)),
    }
    for reason, other in without.items():
        plan = yield from other.planning(goal)
        yield
        if _arrives(plan):
            return reason
    return CONTACT


def nearest_goal(task: Task, goal: Goal) -> Goal | None:
    """Find a goal that can be reached near one that cannot.

    Parameters
    ----------
    task : Task
        From where; a task `with_reserve` gives a goal that is reached with reserve.
    goal : Goal
        The goal, of which a millimetre counts as a degree.

    Returns
    -------
    Goal or None
        The nearest one found; None if there is none within 64 mm or degrees.
    """
    return at_once(nearing(task, goal))


def nearing(task: Task, goal: Goal) -> Generator[None, None, Goal | None]:
    """Find the same, for who has no time for all the plans at once.

    Parameters
    ----------
    task, goal : Task, Goal
        As for `nearest_goal`.

    Yields
    ------
    None
        After each piece of work.

    Returns
    -------
    Goal or None
        As `nearest_goal` does.
    """

    def at(radius: float, direction: float) -> Goal:
        return Goal(
            goal.x + 1e-3 * radius * math.cos(direction),
            goal.theta + math.radians(radius) * math.sin(direction),
        )

    def arriving(goal: Goal) -> Generator[None, None, bool]:
        plan = yield from task.planning(goal, tries=LOOK_TRIES)
        yield
        return _arrives(plan)

    if (yield from arriving(goal)):
        return goal
    nearer = 0.0
    for radius in RADII:
        for k in range(DIRECTIONS):
            direction = 2.0 * math.pi * k / DIRECTIONS
            if not (yield from arriving(at(radius, direction))):
                continue
            for _ in range(HALVINGS):
                middle = (nearer + radius) / 2.0
                if (yield from arriving(at(middle, direction))):
                    radius = middle
                else:
                    nearer = middle
            return at(radius, direction)
        nearer = radius
    return None


def on_the_way(task: Task, goal: Goal) -> Goal | None:
    """Find the last goal that can be reached between where the object is and a goal.

    Parameters
    ----------
    task, goal : Task, Goal
        As for `nearest_goal`.

    Returns
    -------
    Goal or None
        One of 32 on the straight line in x and theta; None if none of them can be reached.
    """
    x, theta = centre_of_mass(task.now, task.pushed), task.now.theta
    for k in range(STEPS - 1, -1, -1):
        share = k / STEPS
        tried = Goal(x + share * (goal.x - x), theta + share * (goal.theta - theta))
        if task.arrives(tried):
            return tried
    return None
