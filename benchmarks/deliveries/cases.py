# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Starts and goals by chance, under given conditions, and what an oracle does with them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from tactile_push import paper
from tactile_push.control.limits import RETREAT
from tactile_push.control.placing.horizon import ROUNDS, pushes, refined
from tactile_push.control.placing.model import Bounds, Goal, Situation, ahead, follow
from tactile_push.control.placing.reachability import Task, reach, with_reserve
from tactile_push.control.placing.regrasp import Moves, Touch, touches
from tactile_push.control.placing.search import FAMILIES
from tactile_push.control.placing.stages import AT_THE_LIMITS, OUT_OF_REACH, WITH_RESERVE
from tactile_push.estimation import Edge, edges_of
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.mechanics.support import COUNT
from tactile_push.simulation import Rig, RigConfig
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.placement import pushed_of, tip_of
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

Corners = tuple[tuple[float, float], ...]

FRICTIONS = (0.1, 0.3, 1.0, math.inf)
WIDEST_X, WIDEST_THETA = 0.05, 0.5  # of starts and goals, from straight ahead [m, rad]
WIDEST_D = 0.72  # of starts, as a share of half the edge
WORKSPACE = (-0.105, 0.105)  # [m]
THETA_MAX = math.radians(50.0)  # in plans
FELT = math.pi / 2.0  # largest angle between the tip's pole and a contact that is felt [rad]
HELD = 0.03  # belt on which the object translates before a reserve is asked for [m]
PATCH = 0.01  # radius of a patch that bears an object [m]
RATE = 0.05 / paper.BELT_SPEED**2  # largest change of cot(phi) a metre of belt [1/m]

MOVES = Moves(0.02, 0.05, paper.BELT_SPEED)  # of a finger of two axes, off the object
FROM_ELSEWHERE = 'from another contact'  # a verdict beside those of `reach`

BLOCK: Corners = paper.BLOCK_CORNERS
PLATE: Corners = ((-0.04, -0.02), (0.04, -0.02), (0.04, 0.02), (-0.04, 0.02))
TRIANGLE: Corners = ((-0.03, -0.015), (0.04, -0.02), (-0.01, 0.035))  # about its centroid
BESIDE = (0.004, -0.002)  # of a mass off centre, from the centroid [m]


@dataclass(frozen=True)
class Group:
    """Runs of one kind: the object, the conditions, and what is told to whom."""

    name: str
    corners: Corners = BLOCK  # of the object
    centre: tuple[float, float] = (0.0, 0.0)  # of mass, in the same frame [m]
    noise: float = 0.3  # of a reading of theta [degrees]
    lag: float = 0.1  # time constant of the finger [s]
    belt: float = 0.3  # what there is of it [m]
    l_share: float = 0.01  # standard deviation of l and r that the estimator is told, as a share
    l_error: float = 0.0  # by how much the l that is told is wrong, up or down, as a share
    outlier: float = 0.0  # probability of a reading that is anywhere
    tip_turns: bool = False
    state_told: bool = False  # whether the law is told the true state, else it estimates
    law: str = 'plans'  # or 'law (18)' or 'cascade'
    axes: int = 1  # of the finger; with 2 the goals count that only another contact leads to

    @property
    def counted(self) -> str:
        """Verdict of the goals that count."""
        return FROM_ELSEWHERE if self.axes == 2 else WITH_RESERVE


@dataclass(frozen=True)
class Case:
    """One start and goal."""

    config: RigConfig
    edge: Edge  # the pushed one
    support: int  # its kind, see `support`
    goal: Goal
    task: Task  # under the true numbers
    verdict: str  # of `reach`, and with reserve only if it still is after a while; or another one
    seed: int


def case(seed: int, group: Group) -> Case:
    """Draw a start and a goal.

    A goal counts as reachable with reserve if it still is after the object has translated over
    `HELD` of belt.
    """
    rng = np.random.default_rng(seed)
    mu_c = float(rng.choice(FRICTIONS))
    outline = Outline.polygon(group.corners).about(*group.centre)
    kind = int(rng.integers(4))
    slider = Slider.on(outline, support(outline, kind, COUNT), exact=True)
    edge = edges_of(np.array(group.corners) - group.centre)[0]
    theta = float(rng.uniform(-WIDEST_THETA, WIDEST_THETA))
    d = sum(edge.d) / 2.0 + float(rng.uniform(-WIDEST_D, WIDEST_D)) * edge.length / 2.0
    config = RigConfig(slider, mu_c, theta, d, tip_turns=group.tip_turns)
    rig = Rig(config)
    x = rig.finger_pose.x
    goal = Goal(
        x + float(rng.uniform(-WIDEST_X, WIDEST_X)),
        float(rng.uniform(-WIDEST_THETA, WIDEST_THETA)),
    )
    lag = group.lag * config.belt_speed
    pushed = pushed_of(config)._replace(lag=lag, tip=tip_of(config, rig.joints))
    steepest = 1.0 / math.tan(paper.PHI_MIN)
    bounds = Bounds(steepest, RATE, *WORKSPACE, *edge.d, THETA_MAX, FELT)
    task = Task(Situation(x, theta, d, 0.0, 0.0), pushed, bounds, group.belt)
    verdict = reach(task, goal).verdict
    if verdict == WITH_RESERVE and not with_reserve(_held(task)).arrives(goal):
        verdict = AT_THE_LIMITS
    if group.axes == 2 and verdict == OUT_OF_REACH and any(_from_elsewhere(task, goal)):
        verdict = FROM_ELSEWHERE
    return Case(config, edge, kind, goal, task, verdict, seed)


def rig_of(one: Case, group: Group) -> Rig:
    """Put a case on the rig."""
    sensor = Sensor(math.radians(group.noise), outlier=group.outlier)
    return Rig(one.config, Faults(servo=Servo(time_constant=group.lag), sensor=sensor))


def long_search(task: Task, goal: Goal) -> float:
    """Return the shortest belt [m] that a long search under the true numbers finds; NaN if none.

    It refines all that the planner's search finds, and all that it finds from where another push
    has led.
    """
    found = [_length(task, goal, 0.0)]
    if math.isnan(found[0]):
        found += [_length(later, goal, way) for later, way in _later(task)]
    return min((length for length in found if length == length), default=math.nan)


def shortest_from_elsewhere(task: Task, goal: Goal) -> float:
    """Return the shortest belt [m] by way of another contact; NaN if none leads to the goal."""
    return min((touch.belt for touch in _from_elsewhere(task, goal)), default=math.nan)


def _from_elsewhere(task: Task, goal: Goal) -> Iterator[Touch]:
    """Yield the contacts that lead to a goal."""
    for touch in touches(task, goal, MOVES, RETREAT):
        if touch is not None and touch.arrives:
            yield touch


def _length(task: Task, goal: Goal, way: float) -> float:
    problem = (task.now, goal, task.pushed), task.bounds, 0.0, task.belt
    plans = (refined(push, *problem, ROUNDS) for push in pushes(*problem, FAMILIES))
    lengths = (plan.length for plan in plans if plan is not None and plan.arrives)
    return way + min(lengths, default=math.nan)


def _later(task: Task) -> Iterator[tuple[Task, float]]:
    """Yield what is left of a task after a push, and the belt of the push [m]."""
    for share in (-1.0, -0.5, 0.5, 1.0):
        for way in (0.01, 0.02, 0.04, 0.08):
            then = follow(task.now, share * task.bounds.steepest, way, task.pushed)
            if way < task.belt:
                yield replace(task, now=then, belt=task.belt - way), way


def _held(task: Task) -> Task:
    """Return what is left of a task after the object has translated for a while."""
    now, pushed = task.now, task.pushed
    then = follow(now, ahead(now, pushed, task.bounds), HELD, pushed)
    return replace(task, now=then, belt=task.belt - HELD)


def support(outline: Outline, kind: int, count: int) -> Support:
    """Return corners, area, rim or a patch that bear an object, on so many points or so."""
    if kind == 0:
        bearing = Support.corners(outline)
    elif kind == 1:
        bearing = Support.uniform(outline, count)
    elif kind == 2:
        bearing = Support.rim(outline, count)
    else:
        bearing = Support.circle(PATCH, count=count)
    return bearing.carrying((0.0, 0.0))
