# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Plans from what is believed of object and finger to the goal, again and again."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tactile_push.control.placing.arcs import UNKNOWNS, rest_of
from tactile_push.control.placing.horizon import ROUNDS, Plan, Problem, pushes, refined
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation, narrowed
from tactile_push.mechanics.compiled import Array

# One control period has time for what is left of the last plan, under two bounds at the most, and
# for a search and one of its pushes, or for another one of an earlier search.
LOOK_TRIES = 2  # pushes of a search that are refined
LOOK_AROUND = 10  # plans after which a new one is compared with what is left of the last one
WARM_ROUNDS = 6  # of what is left of the last plan
KEPT = 0.5  # by how much a new plan must be better than what is left of the last one; picked
# What a plan spares of the bounds for what it does not know, if it can: a share of cot(phi), of
# the ends of the edge and of the workspace [m] and of theta [rad].
SPARED, D_SPARED, X_SPARED, THETA_SPARED = 0.2, 1e-3, 2e-3, math.radians(5.0)
DETOUR = 0.02  # belt of a plan that goes around once more, at least [m]
WIDEST = math.radians(65.0)  # of theta in plans, where nothing else arrives


class Taken(NamedTuple):
    """What a plan takes for granted."""

    kind: int  # which object it is: 0 for what it is most likely
    wide: bool  # whether it may be turned farther than one likes

    def bounds(self, bounds: Bounds) -> Bounds:
        """Return what a plan keeps to."""
        return bounds._replace(theta_max=max(WIDEST, bounds.theta_max)) if self.wide else bounds


class Look(NamedTuple):
    """Which plan to look for."""

    taken: Taken
    spares: bool = False  # some of the bounds
    least: float = 0.0  # belt [m]
    roundabout: bool = False

    def bounds(self, bounds: Bounds) -> Bounds:
        """Return what the plan keeps to."""
        bounds = self.taken.bounds(bounds)
        return _spared(bounds) if self.spares else bounds


LIKELY = Taken(0, False)
LIKELY_LOOKS = Look(LIKELY, spares=True), Look(LIKELY)


class Planner:
    """Makes a plan, and a new one from where the last one has led.

    Parameters
    ----------
    bounds : Bounds
        What plans keep to.
    """

    def __init__(self, bounds: Bounds) -> None:
        self.bounds = bounds
        self.forget()

    def forget(self) -> None:
        """Begin from nothing with the next plan."""
        self._looks = 0
        self.drop()

    @property
    def takes_the_likely(self) -> bool:
        """Whether the last plan is for the object as it is most likely."""
        return self._taken.kind == LIKELY.kind

    def drop(self) -> None:
        """Drop the last plan, and look on for others."""
        self._last: Plan | None = None
        self._plans = 0
        self._taken = LIKELY  # what the last plan takes for granted
        self._look = LIKELY_LOOKS[0]
        self._tries: list[Array] = []  # found by that look and not refined yet

    def plan(
        self,
        now: Situation,
        pushed: Pushed,
        goal: Goal,
        most: float,
        *,
        others: Sequence[Pushed] = (),
        least: float = 0.0,
        way: float = 0.0,
        bounds: Bounds | None = None,
    ) -> Plan | None:
        """Plan anew.

        Parameters
        ----------
        now, pushed, goal : Situation, Pushed, Goal
            From where and to where, under which numbers.
        most : float
            Belt that is left [m].
        others : sequence of Pushed, optional
            What the object may also be, always as many. While no plan arrives with what it is most
            likely, one that arrives with one of these is followed: whether it is that shows on the
            way.
        least : float, optional
            The shortest belt that the plan may take [m].
        way : float, optional
            Belt since the last plan [m].
        bounds : Bounds, optional
            In place of the planner's.

        Returns
        -------
        Plan or None
            The best one; None if contact is lost whatever is done.
        """
        bounds = bounds or self.bounds
        kinds = pushed, *others
        self._plans += 1
        self._tries = [_rest(push, way) for push in self._tries]
        best = self._go_on((now, goal, kinds[self._taken.kind]), bounds, least, most, way)
        arrives = best is not None and best.arrives
        if self._tries or not arrives or self._plans % LOOK_AROUND == 0:
            looks = LIKELY_LOOKS if arrives else looks_of(len(kinds))
            new, taken = self._look_around(looks, now, goal, kinds, bounds, least, most)
            if new is not None and self._is_better(new, taken, best):
                best, self._taken = new, taken
        self._last = best
        return best

    def _look_around(
        self,
        looks: Sequence[Look],
        now: Situation,
        goal: Goal,
        kinds: Sequence[Pushed],
        bounds: Bounds,
        least: float,
        most: float,
    ) -> tuple[Plan | None, Taken]:
        """Refine the next push of the last search, or search anew; return what that takes."""
        if not self._tries:
            self._look = looks[self._looks % len(looks)]
            self._looks += 1
        look = self._look
        belt = min(max(least, look.least), most)
        task = (now, goal, kinds[look.taken.kind]), look.bounds(bounds), belt, most
        if not self._tries:
            self._tries = pushes(*task, LOOK_TRIES, roundabout=look.roundabout)
        new = refined(self._tries.pop(0), *task, ROUNDS) if self._tries else None
        return new, look.taken

    def _is_better(self, new: Plan, taken: Taken, best: Plan | None) -> bool:
        """Return whether to go over to a new plan."""
        if best is None:
            return True
        if taken != self._taken and new.arrives:
            return taken == LIKELY or not best.arrives
        return taken in (LIKELY, self._taken) and new.merit < best.merit - KEPT

    def _go_on(
        self, problem: Problem, bounds: Bounds, least: float, most: float, way: float
    ) -> Plan | None:
        """Go on with the last plan.

        What was spared of the steepness is for correcting it on its way. The rest stays spared
        while plans arrive that way.
        """
        last, best = self._last, None
        if last is None:
            return None
        allowed = self._taken.bounds(bounds)
        spared = _spared(allowed)._replace(steepest=bounds.steepest)
        for one in (spared, allowed) if last.arrives else (allowed,):
            plan = refined(_rest(last.push, way), problem, one, least, most, WARM_ROUNDS)
            if plan is not None and plan.arrives:
                return plan
            if plan is not None and (best is None or plan.merit < best.merit):
                best = plan
        return best


def looks_of(kinds: int) -> tuple[Look, ...]:
    """Return which plans to look for, one after the other, while none arrives.

    Parameters
    ----------
    kinds : int
        How many objects it may be, what is most likely included.
    """
    others = (Look(Taken(kind, wide=False)) for kind in range(1, kinds))
    farther = Look(LIKELY, least=DETOUR), Look(LIKELY, roundabout=True)
    return *LIKELY_LOOKS, *others, *farther, Look(Taken(0, wide=True))


def _spared(bounds: Bounds) -> Bounds:
    """Return narrower bounds."""
    return narrowed(bounds, SPARED, X_SPARED, D_SPARED, THETA_SPARED)


def _rest(push: Array, way: float) -> Array:
    """Return what is left of a push after a piece of belt [m]."""
    rest = np.empty(UNKNOWNS)
    rest_of(push, way, rest)
    return rest
