# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A second touch: the finger leaves the object and touches it elsewhere on the same edge.

The object lies on the belt meanwhile, so theta and x stay, and d becomes what one likes: the
finger goes over to another leaf (docs/placing.md).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from tactile_push.control.placing.model import Goal, Situation
from tactile_push.control.placing.planner import Plan
from tactile_push.control.placing.reachability import Task

TOUCHES = 15  # places on the edge that are tried


@dataclass(frozen=True)
class Detour:
    """How a finger of two axes gets from one contact to another one.

    It retreats along the belt, faster than that, moves across and waits for the object.
    """

    across: float  #: way across the belt [m]
    back: float  #: way along it, by which the line of pushing moves on [m]
    belt: float  #: belt that passes [m]
    time: float  #: how long it takes [s]


@dataclass(frozen=True)
class Touch:
    """Where to touch next."""

    d: float  #: contact along the edge [m]
    detour: Detour  #: the way there
    plan: Plan  #: from there to the goal


def detour(
    now: Situation, d: float, *, speed: float, belt_speed: float, clearance: float
) -> Detour:
    """Return the way to another contact on the same edge.

    Parameters
    ----------
    now : Situation
        Where finger and object are.
    d : float
        The other contact along the edge [m].
    speed : float
        Of the finger on its way [m/s], more than the belt's.
    belt_speed : float
        Of the belt [m/s].
    clearance : float
        What is kept between finger and edge until the finger stands where it waits [m].

    Raises
    ------
    ValueError
        If the finger is no faster than the belt.
    """
    if not speed > belt_speed:
        raise ValueError(f'speed: expected more than the belt has, {belt_speed}, got {speed}')
    way = d - now.d
    # Along the edge the finger's place changes by (cos theta, sin theta) d.
    across, ahead = way * math.cos(now.theta), way * math.sin(now.theta)
    over = abs(across) / speed
    # The gap falls or grows evenly on the way across: its ends decide.
    least = max(clearance, clearance - ahead + belt_speed * over)
    retreat = least / (speed - belt_speed)
    wait = ((speed - belt_speed) * retreat + ahead) / belt_speed - over
    time = retreat + over + wait
    return Detour(across, speed * retreat, belt_speed * time, time)


def touches(
    task: Task, goal: Goal, *, speed: float, belt_speed: float, clearance: float
) -> Iterator[Touch | None]:
    """Try contacts along the edge; yield after each the best one so far that leads to a goal.

    Parameters
    ----------
    task : Task
        From where, under which numbers and within which bounds; of the belt the detour takes.
    goal : Goal
        Where to.
    speed, belt_speed, clearance : float
        As for `detour`.

    Yields
    ------
    Touch or None
        The best one; None if there is none yet.
    """
    bounds, now, best = task.bounds, task.now, None
    for k in range(TOUCHES):
        d = bounds.d_min + (bounds.d_max - bounds.d_min) * (k + 0.5) / TOUCHES
        way = detour(now, d, speed=speed, belt_speed=belt_speed, clearance=clearance)
        x = now.x + way.across
        if bounds.x_min <= x <= bounds.x_max and way.belt < task.belt:
            there = Situation(x, now.theta, d, 0.0, 0.0)
            plan = Task(there, task.pushed, bounds, task.belt - way.belt).plan(goal)
            if plan is not None and plan.arrives:
                touch = Touch(d, way, plan)
                if best is None or _belt(touch) < _belt(best):
                    best = touch
        yield best


def _belt(touch: Touch) -> float:
    """Return the belt until the goal [m]."""
    return touch.detour.belt + touch.plan.length
