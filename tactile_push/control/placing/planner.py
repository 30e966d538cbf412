# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Plans from what is believed of object and finger to the goal, again and again."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS, rest_of
from tactile_push.control.placing.horizon import plan
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation, narrowed
from tactile_push.control.placing.refinement import refine
from tactile_push.mechanics.compiled import Array

# Pushes of the search that are refined, more of them if none arrives, and rounds of each.
TRIES, MORE_TRIES, ROUNDS = 3, 8, 12
LOOK_TRIES = 2  # of a search between others, for which there is little time
LOOK_AROUND = 10  # plans after which a new one is compared with what is left of the last one
WARM_ROUNDS = 6  # of what is left of the last plan
# What plans are compared by: misses [m, rad] and bounds as squares of these, and the belt [m] that
# is worth one; picked. A plan that goes around once more for a miss of 0.2 mm would not end better.
X_MISS, THETA_MISS, BEYOND_MISS, BELT_WORTH = 2e-4, math.radians(0.2), 5.0, 0.05
KEPT = 0.5  # by how much a new plan must be better than what is left of the last one; picked
# What a plan spares of the bounds for what it does not know, if it can: a share of cot(phi), of
# the ends of the edge and of the workspace [m] and of theta [rad].
SPARED, D_SPARED, X_SPARED, THETA_SPARED = 0.2, 1e-3, 2e-3, math.radians(5.0)
# A plan gets there if it ends so near the goal [m, rad], and no farther beyond bounds, in their
# units.
X_THERE, THETA_THERE, BEYOND = 2e-4, math.radians(0.2), 5.0
X_NEAR, THETA_NEAR = 1e-3, math.radians(1.0)
DETOUR = 0.02  # belt of a plan that goes around once more, at least [m]
WIDEST = math.radians(65.0)  # of theta in plans, where nothing else arrives


@dataclass(frozen=True)
class Plan:
    """A push that ends at the goal, or near it."""

    push: Array  #: commands cot(phi) of the arcs and their belt in units of `LENGTH`, shape (8,)
    cost: float  #: what it misses, and what it takes
    x_error: float  #: where it ends, less where it should [m]
    theta_error: float  #: the same of the angle [rad]
    beyond: float  #: how far it is beyond bounds, in units of 0.1 mm and 0.2 degrees

    @property
    def length(self) -> float:
        """Belt that it takes [m]."""
        return float(self.push[ARCS:].sum()) * LENGTH

    @property
    def merit(self) -> float:
        """What speaks against it, 0 or more."""
        misses = self.x_error / X_MISS, self.theta_error / THETA_MISS, self.beyond / BEYOND_MISS
        return sum(miss * miss for miss in misses) + self.length / BELT_WORTH

    @property
    def arrives(self) -> bool:
        """Whether it ends at the goal and keeps to its bounds."""
        near = abs(self.x_error) <= X_THERE and abs(self.theta_error) <= THETA_THERE
        return near and self.beyond <= BEYOND

    @property
    def near(self) -> bool:
        """Whether it ends so near that going around once more is not worth it."""
        return abs(self.x_error) <= X_NEAR and abs(self.theta_error) <= THETA_NEAR

    def command(self, way: float) -> float:
        """Return the mean command over its first piece of belt [m]."""
        left = wanted = min(way, self.length) / LENGTH
        if not wanted > 0.0:
            return float(self.push[0])
        mean = 0.0
        for u, belt in zip(self.push[:ARCS], self.push[ARCS:], strict=True):
            used = min(left, belt)
            mean += u * used
            left -= used
        return float(mean / wanted)


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


LIKELY = Taken(0, False)
LIKELY_LOOKS = Look(LIKELY, spares=True), Look(LIKELY)

Problem = tuple[Situation, Goal, Pushed]


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
        taken = self._taken
        best = _first_that_arrives(
            self._rest((now, goal, kinds[taken.kind]), one, least, most, way)
            # What was spared of the steepness is for correcting the plan on its way.
            for one in (
                _spared(taken.bounds(bounds))._replace(steepest=bounds.steepest),
                taken.bounds(bounds),
            )
        )
        arrives = best is not None and best.arrives
        if not arrives or self._plans % LOOK_AROUND == 0:
            # One search in a period is what there is time for.
            looks = LIKELY_LOOKS if arrives else _looks(len(kinds))
            look = looks[self._looks % len(looks)]
            self._looks += 1
            other = look.taken.bounds(bounds)
            new = new_plan(
                (now, goal, kinds[look.taken.kind]),
                _spared(other) if look.spares else other,
                min(max(least, look.least), most),
                most,
                LOOK_TRIES,
                roundabout=look.roundabout,
            )
            if new is not None and self._is_better(new, look.taken, best):
                best, self._taken = new, look.taken
        self._last = best
        return best

    def _is_better(self, new: Plan, taken: Taken, best: Plan | None) -> bool:
        """Return whether to go over to a new plan."""
        if best is None:
            return True
        if taken != self._taken and new.arrives:
            return taken == LIKELY or not best.arrives
        return taken in (LIKELY, self._taken) and new.merit < best.merit - KEPT

    def _rest(
        self, problem: Problem, bounds: Bounds, least: float, most: float, way: float
    ) -> Plan | None:
        """Go on with the last plan."""
        if self._last is None:
            return None
        push = np.empty(UNKNOWNS)
        rest_of(self._last.push, way, push)
        told = refine(push, *problem, bounds, least, most, WARM_ROUNDS)
        return Plan(push, *told) if told[0] < math.inf else None


def new_plan(
    problem: Problem,
    bounds: Bounds,
    least: float,
    most: float,
    tries: int = MORE_TRIES,
    *,
    roundabout: bool = False,
) -> Plan | None:
    """Plan from nothing.

    Parameters
    ----------
    problem : tuple of Situation, Goal and Pushed
        From where and to where, under which numbers.
    bounds : Bounds
        What the plan keeps to.
    least, most : float
        Belt that it may take [m].
    tries : int, optional
        Pushes of the search that are refined at the most, if none of the first few arrives.
    roundabout : bool, optional
        Whether another push comes first; see `search`.

    Returns
    -------
    Plan or None
        The best one found; None if contact is lost whatever is done.
    """
    push = np.empty(UNKNOWNS)
    told = plan(*problem, bounds, least, most, TRIES, tries, ROUNDS, roundabout, push)
    return Plan(push, *told) if told[0] < math.inf else None


def _looks(kinds: int) -> tuple[Look, ...]:
    """Return which plans to look for, one after the other, while none arrives."""
    others = (Look(Taken(kind, wide=False)) for kind in range(1, kinds))
    farther = Look(LIKELY, least=DETOUR), Look(LIKELY, roundabout=True)
    return *LIKELY_LOOKS, *others, *farther, Look(Taken(0, wide=True))


def _spared(bounds: Bounds) -> Bounds:
    """Return narrower bounds."""
    return narrowed(bounds, SPARED, X_SPARED, D_SPARED, THETA_SPARED)


def _first_that_arrives(plans: Iterable[Plan | None]) -> Plan | None:
    """Return the first plan that arrives, or else the best one."""
    made = []
    for one in plans:
        if one is not None:
            if one.arrives:
                return one
            made.append(one)
    return min(made, key=lambda one: one.merit, default=None)
