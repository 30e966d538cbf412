# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a control period of the law that places takes of a core: `make bench`."""

import math
import time

import numpy as np
import pytest

from tactile_push.control.placing.compiling import compile_placing
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.reachability import nearest_goal, reach
from tactile_push.control.placing.stages import LEARNING
from tactile_push.pipeline.outlook import ReachOutlook
from tactile_push.simulation import Rig, paper_block
from tactile_push.simulation.by_touch import LAG, NOISE, faults_of, sensing_of
from tactile_push.simulation.placement import place

GOAL = 10.0  # of a control period on one core [ms]
RUNS = 24
BELT = 0.3  # [m]
SHIFT, ANGLE = 0.03, 0.2  # of goals, at the most [m, rad]


class TimedLaw(PlaceLaw):
    """The law, which notes what it and a look at what is in reach take of a core each time [ms]."""

    def __init__(self, *numbers, **more):
        super().__init__(*numbers, **more)
        self.taken, self.looks, self.tasks = [], [], []
        self.learned = 0  # periods
        self._outlook = ReachOutlook()

    def update(self, theta):
        """Give the push angle, and note what that took."""
        before = time.thread_time()
        phi = super().update(theta)
        between = time.thread_time()
        if self._belief is not None:
            self._outlook.look(self, self.goal, self._belief.spread.d)
        self.taken.append(1e3 * (between - before))
        self.looks.append(1e3 * (time.thread_time() - between))
        self.learned += self.stage == LEARNING
        if len(self.taken) in (20, 60):
            self.tasks.append(self.task())
        return phi


@pytest.fixture(scope='module')
def laws():
    """Return the laws of some placings by touch alone."""
    compile_placing()
    random, found = np.random.default_rng(1), []
    for seed in range(RUNS):
        config = paper_block(theta=random.uniform(-0.3, 0.3), d=random.uniform(-0.01, 0.01))
        x = config.tip.x + random.uniform(-SHIFT, SHIFT)
        goal = Goal(x, random.uniform(-ANGLE, ANGLE))
        law = TimedLaw(goal, BELT, config.belt_speed, 0.1, lag=LAG)
        sensing = sensing_of(config, NOISE, LAG)
        place(Rig(config, faults_of(NOISE, LAG)), law, sensing=sensing, seed=seed)
        found.append(law)
    return found


def told(what, taken, goal=None):
    """Print the median, the 99 % quantile and the largest of some times [ms]."""
    beside = '' if goal is None else f', goal {goal:g} ms'
    middle, most = np.median(taken), np.quantile(taken, 0.99)
    print(
        f'\n    {what}: {middle:.2f} ms, 99 %: {most:.2f} ms, all {len(taken)}: {max(taken):.2f} ms'
        + beside
    )


def test_a_control_period(laws):
    """Time what the law takes of each, and what a look at what is in reach adds to it."""
    taken, looks = (
        np.concatenate([getattr(law, of)[2:] for law in laws]) for of in ('taken', 'looks')
    )
    told('a control period of the law', taken, GOAL)
    learned = np.concatenate([law.taken[2 : law.learned] for law in laws])
    told('of these, while it learns', learned, GOAL)
    told('with a look at what is in reach', taken + looks, GOAL)
    assert len(taken) > 50 * RUNS


def test_whether_a_goal_is_in_reach(laws):
    """Time a look, of which the node makes one plan a control period."""
    looks, plans, near = [], [], []
    for law in laws:
        for task in filter(None, law.tasks):
            for times, look in (
                (looks, lambda task=task, law=law: reach(task, law.goal)),
                (plans, lambda task=task, law=law: task.plan(law.goal)),
            ):
                before = time.thread_time()
                look()
                times.append(1e3 * (time.thread_time() - before))
        far = Goal(law.goal.x, math.copysign(1.0, law.goal.theta))
        before = time.thread_time()
        nearest_goal(law.tasks[0], far)
        near.append(1e3 * (time.thread_time() - before))
    told('one plan from nothing', plans, GOAL)
    told('whether a goal is in reach, at once', looks)
    told('the nearest goal in reach, at once', near)
