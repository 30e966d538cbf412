# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Plans from nothing: the best push from where the object is to a goal, over the belt left.

A plan is made in pieces of bounded work, for who has little time in each control period.
"""

import math
from collections.abc import Generator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS
from tactile_push.control.placing.model import Bounds, Goal, Pushed, Situation
from tactile_push.control.placing.refinement import refine
from tactile_push.control.placing.search import (
    COLUMNS,
    FAMILIES,
    ROUNDABOUT,
    arcs,
    search,
    search_roundabout,
)
from tactile_push.mechanics.compiled import Array

T = TypeVar('T')
# Pushes of the search that are refined, more of them if none arrives, and rounds of each.
TRIES, MORE_TRIES, ROUNDS = 3, 8, 12
# What more tries are not worth: a miss at the end [m, rad].
X_ENOUGH, THETA_ENOUGH = 1e-4, math.radians(0.1)
# What plans are compared by: misses [m, rad] and bounds as squares of these, and the belt [m] that
# is worth one; picked. A plan that goes around once more for a miss of 0.2 mm would not end better.
X_MISS, THETA_MISS, BEYOND_MISS, BELT_WORTH = 2e-4, math.radians(0.2), 5.0, 0.05
# A plan gets there if it ends so near the goal [m, rad], and no farther beyond bounds, in their
# units.
X_THERE, THETA_THERE, BEYOND = 2e-4, math.radians(0.2), 5.0
X_NEAR, THETA_NEAR = 1e-3, math.radians(1.0)

Problem = tuple[Situation, Goal, Pushed]


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
    def is_exact(self) -> bool:
        """Whether it ends so near that looking on is not worth it."""
        return abs(self.x_error) <= X_ENOUGH and abs(self.theta_error) <= THETA_ENOUGH

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


def pushes(
    problem: Problem,
    bounds: Bounds,
    least: float,
    most: float,
    count: int,
    *,
    roundabout: bool = False,
) -> list[Array]:
    """Search for pushes that come near a goal.

    Parameters
    ----------
    problem : tuple of Situation, Goal and Pushed
        From where and to where, under which numbers.
    bounds : Bounds
        What they keep to.
    least, most : float
        Belt that they may take [m].
    count : int
        How many at the most.
    roundabout : bool, optional
        Whether another push comes first; see `search_roundabout`.

    Returns
    -------
    list of ndarray, shape (8,)
        The best first, as in `Plan.push`.
    """
    found = np.empty((ROUNDABOUT if roundabout else FAMILIES, COLUMNS))
    searching = search_roundabout if roundabout else search
    searching(*problem, bounds, least, most, found)
    some = []
    for row in found[np.argsort(found[:, 0], kind='stable')[:count]]:
        if row[0] < math.inf:
            push = np.empty(UNKNOWNS)
            arcs(row, push)
            some.append(push)
    return some


def refined(
    push: Array, problem: Problem, bounds: Bounds, least: float, most: float, rounds: int
) -> Plan | None:
    """Make a plan of a push, which is improved in place; None if contact is lost."""
    told = refine(push, *problem, bounds, least, most, rounds)
    return Plan(push, *told) if told[0] < math.inf else None


def planning(
    problem: Problem,
    bounds: Bounds,
    least: float,
    most: float,
    tries: int = MORE_TRIES,
    *,
    roundabout: bool = False,
) -> Generator[None, None, Plan | None]:
    """Plan from nothing.

    Parameters
    ----------
    problem, bounds, least, most, roundabout : tuple, Bounds, float, float, bool
        As for `pushes`.
    tries : int, optional
        Pushes of the search that are refined at the most, if none of the first few arrives.

    Yields
    ------
    None
        Before each push but the first is refined.

    Returns
    -------
    Plan or None
        The best one found; None if contact is lost whatever is done.
    """
    best: Plan | None = None
    some = pushes(problem, bounds, least, most, tries, roundabout=roundabout)
    for k, push in enumerate(some):
        if k >= TRIES and best is not None and best.is_exact:
            break
        if k > 0:
            yield
        new = refined(push, problem, bounds, least, most, ROUNDS)
        if new is not None and (best is None or new.cost < best.cost):
            best = new
    return best


def at_once(pieces: Generator[None, None, T]) -> T:
    """Return the result of a generator that pauses between pieces of work.

    Parameters
    ----------
    pieces : generator
        Such as `planning` returns.

    Returns
    -------
    object
        What it returns in the end.
    """
    while True:
        try:
            next(pieces)
        except StopIteration as end:
            return end.value
