# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of a group: what was promised in advance, and how it ended."""

import math
from dataclasses import dataclass, replace

import numpy as np

from deliveries.cases import (
    FROM_ELSEWHERE,
    MOVES,
    WORKSPACE,
    Case,
    Group,
    case,
    long_search,
    rig_of,
    shortest_from_elsewhere,
)
from deliveries.rivals import Rival
from tactile_push import paper
from tactile_push.control import Limits
from tactile_push.control.limits import RETREAT
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.reachability import Task, reach
from tactile_push.control.placing.stages import LEARNING, OUT_OF_REACH, RELEASED, WITH_RESERVE
from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator
from tactile_push.simulation.placement import Placement, place

TIMEOUT = 0.3  # of the contact [s]
ENOUGH = 0.5  # [mm] and degrees within which a goal counts as reached


class WatchedLaw(PlaceLaw):
    """Remembers what was believed when it committed itself."""

    _committed: Task | None = None

    def update(self, theta: float) -> float:
        """Give the push angle, as in `PlaceLaw`."""
        learning = self.stage == LEARNING
        phi = super().update(theta)
        if learning and self.stage != LEARNING:
            self._committed = self.task()
        return phi

    def promise(self) -> str:
        """Return the verdict on its goal under what it believed; empty if it never knew."""
        return reach(self._committed, self.goal).verdict if self._committed else ''


@dataclass(frozen=True)
class Outcome:
    """What one run showed."""

    seed: int
    verdict: str  # of `reach` under the true numbers, before anything moves
    promise: str  # the same under what was believed when the law committed itself; may be empty
    shortest: float  # belt that a long search under the true numbers finds [m]; NaN if none
    placement: Placement | None  # None if it was not run

    @property
    def error(self) -> float:
        """The larger of the errors in millimetres and in degrees."""
        p = self.placement
        if p is None:
            return math.nan
        return max(1e3 * abs(p.x_error), math.degrees(abs(p.theta_error)))

    @property
    def placed(self) -> bool:
        """Whether the object was let go at the goal."""
        return self.placement is not None and self.let_go and self.error <= ENOUGH

    @property
    def let_go(self) -> bool:
        """Whether it was let go at all."""
        return self.placement is not None and self.placement.stage == RELEASED


def law_for(one: Case, group: Group) -> PlaceLaw | Rival:
    """Return the law of a group, for a case."""
    piece = paper.CONTROL_PERIOD * one.config.belt_speed
    if group.law != 'plans':
        return Rival(one.goal, group.belt, piece, cascade=group.law == 'cascade')
    return WatchedLaw(
        *(one.goal, group.belt, one.config.belt_speed, paper.CONTROL_PERIOD),
        lag=group.lag,
        workspace=WORKSPACE,
        moves=MOVES if group.axes == 2 else None,
        room=RETREAT,
    )


def sensing_for(one: Case, group: Group, tilt: float = 0.0) -> ActiveSensing:
    """Return an estimator that is told the outline, and l as the group has it.

    l is wrong upwards in the runs of even seeds, downwards in the others.
    """
    wrong = 1.0 + (group.l_error if one.seed % 2 == 0 else -group.l_error)
    radius = one.config.radius
    edge = replace(one.edge, l=one.edge.l * wrong)
    estimator = ObjectEstimator(
        *((edge,), math.radians(group.noise)),
        l_share=group.l_share,
        radius=radius,
        radius_share=group.l_share,
        outlier=max(group.outlier, 0.001),
        tilt=tilt,
    )
    motion = FingerMotion(group.lag)
    return ActiveSensing(estimator, motion, one.config.belt_speed, TIMEOUT, radius=radius)


def run(seed: int, group: Group, every: bool) -> Outcome:
    """Draw a case and run it, if its goal counts or `every` case is to be run."""
    one = case(seed, group)
    if one.verdict != group.counted and not every:
        return Outcome(seed, one.verdict, '', math.nan, None)
    law = law_for(one, group)
    sensing = None if group.state_told else sensing_for(one, group)
    limits = Limits(retreat_max=RETREAT if group.axes == 2 else 0.0)
    placed = place(rig_of(one, group), law, sensing=sensing, limits=limits, seed=seed)
    promise = law.promise() if isinstance(law, WatchedLaw) and sensing else ''
    shortest = shortest_from_elsewhere if group.axes == 2 else long_search
    return Outcome(seed, one.verdict, promise, shortest(one.task, one.goal), placed)


def row(name: str, outcomes: list[Outcome], within: tuple[float, ...]) -> tuple[str, ...]:
    """Return the cells of a group's runs whose goals count."""
    counted = (WITH_RESERVE, FROM_ELSEWHERE)
    some = [one for one in outcomes if one.verdict in counted and one.placement is not None]
    if not some:
        return name, '0'
    error = np.array([one.error if one.let_go else math.inf for one in some])
    shares = [f'{np.mean(error <= most):.1%}' for most in within]
    x = np.abs([1e3 * one.placement.x_error for one in some])
    theta = np.degrees(np.abs([one.placement.theta_error for one in some]))
    errors = [f'{np.median(e):.2f}, {np.quantile(e, 0.95):.2f}' for e in (x, theta)]
    placed = [one for one in some if one.placed]
    belt = learned = ratio = ''
    if placed:
        belt = f'{1e3 * np.median([one.placement.belt for one in placed]):.0f}'
        learned = f'{1e3 * np.median([one.placement.learned for one in placed]):.0f}'
        ratio = f'{np.nanmedian([one.placement.belt / one.shortest for one in placed]):.2f}'
    return name, str(len(some)), *shares, *errors, belt, learned, ratio


def judged(told: list[Outcome], estimated: list[Outcome]) -> list[tuple[str, ...]]:
    """Return how often goals were refused, and promised with reserve, and how often wrongly.

    `told` and `estimated` are the same cases, all of them run. An oracle does what one of both runs
    does, or a long search.
    """
    done = {one.seed for one in told if one.placed}
    by_touch = {one.seed for one in estimated if one.placed}
    oracle = done | by_touch | {one.seed for one in told if not math.isnan(one.shortest)}
    rows = []
    for name, outcomes, verdict in (
        ('in advance, numbers told', told, 'verdict'),
        ('once committed, as believed', estimated, 'promise'),
    ):
        verdicts = {one.seed: getattr(one, verdict) for one in outcomes if getattr(one, verdict)}
        can = oracle & set(verdicts)
        refused = [seed for seed in can if verdicts[seed] == OUT_OF_REACH]
        promised = {seed for seed in verdicts if verdicts[seed] == WITH_RESERVE}
        broken = (promised - by_touch, promised - done, promised - by_touch - done)
        rows.append(
            (
                name,
                f'{len(verdicts)}',
                f'{len(can)}',
                _share(len(refused), len(can)),
                f'{len(promised)}',
                *(_share(len(some), len(promised)) for some in broken),
            )
        )
    return rows


def _share(some: int, of: int) -> str:
    return f'{some} ({some / of:.1%})' if of else '0'
