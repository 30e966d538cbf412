# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What became of goals to place objects at, by the controller's account and by the simulator's."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tactile_push.control.placing.stages import (
    ENDS,
    LEARNING,
    LETTING_GO,
    NO_GOAL,
    PLACING,
    REASONS,
    REGRASPING,
    RELEASED,
    SETTLES,
    STAGES,
    STEERS,
    VERDICTS,
)
from tactile_push.placed_way import PlacedWay
from tactile_push.report.columns import Table
from tactile_push.report.data import Scene

# How a goal ends beside the law's own `ENDS`.
PREEMPTED, OPEN = 'preempted', 'not ended'
SERVES = (LEARNING, PLACING, REGRASPING, LETTING_GO)
LASTING = tuple(float(STAGES.index(stage)) for stage in (*SETTLES, *STEERS))  # goals do not end
FIELDS = ('stage', 'goals', 'goal_x', 'goal_theta')  # without which nothing is told
TRUTH = ('lifted', 'object_x', 'edge_angle')
DEGREES, MILLIMETRES = 180.0 / math.pi, 1e3
GOAL_HEADS = ('goal', 'let go at', 'error', 'belt', 'in reach', 'end')


@dataclass(frozen=True)
class Placing:
    """What became of one goal. What is not known is None."""

    x: float  # where the centre of mass was to be across the belt [m]
    theta: float  # the angle that the pushed edge was to have [rad]
    start: float  # from when on, from the start of the bag [s]
    end: float  # until when, or the last that is told of it [s]
    stage: str  # how it ended: one of `ENDS`, `PREEMPTED` or `OPEN`
    # Whether it was in reach, one of `VERDICTS`: when the controller committed itself to a plan, or
    # else as of the last look
    verdict: str
    reason: str  # what forbade it, one of `REASONS`
    belt: float | None  # that was used [m]
    regrasps: int  # how often the finger has touched the object elsewhere
    miss: tuple[float, float] | None  # errors that the law expected at last [m, rad]
    # When an object was let go [s], and its x [m] and theta [rad] then
    freed: float | None
    reached: tuple[float, float] | None

    @property
    def error(self) -> tuple[float, float] | None:
        """By how much x [m] and theta [rad] are off."""
        if self.reached is None:
            return None
        return self.reached[0] - self.x, self.reached[1] - self.theta


def placings(states: Table, truth: Table) -> list[Placing]:
    """Return what became of each goal that was taken, in their order.

    `states` and `truth` are the columns of `place/state` and `ground_truth/state`, empty if they
    were not recorded.
    """
    if not all(name in states for name in FIELDS):
        return []
    goals, time = states['goals'], states['time']
    changes = np.flatnonzero(np.diff(goals) != 0.0) + 1
    found = []
    for first, after in pairwise([0, *changes.tolist(), len(goals)]):
        if goals[first] > 0.0 and states['stage'][first] not in LASTING:
            rows = {name: column[first:after] for name, column in states.items()}
            until = time[after] if after < len(time) else math.inf
            found.append(_placing(rows, truth, until))
    return found


def way_of(placing: Placing, truth: Table, poses: Table, scene: Scene) -> PlacedWay | None:
    """Return the way to a goal, None if the simulator does not tell it.

    `truth` and `poses` are the columns of `ground_truth/state` and `ground_truth/object_pose`,
    `scene` is what was pushed by what.
    """
    if not all(name in truth for name in ('belt_travel', *TRUTH)) or not poses:
        return None
    _, at, pose_at = np.intersect1d(truth['time'], poses['time'], return_indices=True)
    time, lifted = truth['time'][at], truth['lifted'][at]
    end = placing.end if placing.freed is None else placing.freed
    touched = (time >= placing.start) & (time <= end) & (lifted == 0.0)
    if not touched.any():
        return None
    last = int(np.flatnonzero(touched)[-1])
    free = min(last + 1, len(time) - 1)
    kept = np.flatnonzero(touched).tolist() + ([free] if lifted[free] else [])
    x, y, yaw = (poses[name][pose_at][kept] for name in ('x', 'y', 'yaw'))
    object_x, travel, theta = (
        truth[name][at][kept] for name in ('object_x', 'belt_travel', 'edge_angle')
    )
    finger_y = travel + truth.get('along', np.zeros(len(truth['time'])))[at][kept]
    finger = np.stack([object_x - x, finger_y], axis=1)
    return PlacedWay(
        finger,
        np.stack([object_x, finger_y + y, theta], axis=1),
        edge=float(theta[0] - yaw[0]),
        outline=scene.outline,
        radius=scene.radius,
        goal=(placing.x, placing.theta),
    )


def goal_cells(found: Sequence[Placing]) -> list[tuple[str, ...]]:
    """Return the cells of a table with `GOAL_HEADS`, a row for each goal."""
    return [
        (
            _place(one.x, one.theta),
            '' if one.reached is None else _place(*one.reached),
            _error(one),
            '' if one.belt is None else f'{one.belt * MILLIMETRES:.0f} mm',
            f'{one.verdict}: {one.reason}' if one.reason else one.verdict,
            _end(one),
        )
        for one in found
    ]


def _placing(rows: Table, truth: Table, until: float) -> Placing:
    """Return what became of a goal, of which these rows tell, `until` another was taken [s]."""
    time = rows['time']
    stages = [STAGES[int(code)] if 0 <= code < len(STAGES) else NO_GOAL for code in rows['stage']]
    ended = next((k for k, stage in enumerate(stages) if stage in ENDS), None)
    last = len(time) - 1 if ended is None else ended
    stage = stages[last]
    if ended is None:
        stage = OPEN if until == math.inf else PREEMPTED
    looks = rows.get('reachable', np.zeros(len(time)))
    told = np.flatnonzero((looks > 0.0) & (looks < len(VERDICTS)))
    planned = [k for k in told.tolist() if stages[k] in (PLACING, LETTING_GO)]
    look = next(iter(planned), int(told[-1]) if len(told) else 0)
    reason = rows.get('reach_reason', np.zeros(len(time)))[look]
    freed = _freed(truth, float(time[0]), until) if stage == RELEASED else None
    return Placing(
        x=float(rows['goal_x'][0]),
        theta=float(rows['goal_theta'][0]),
        start=float(time[0]),
        end=float(time[last]),
        stage=stage,
        verdict=VERDICTS[int(looks[look])] if len(told) else VERDICTS[0],
        reason=REASONS[int(reason)] if 0 <= reason < len(REASONS) else '',
        belt=_belt(rows, [stage in SERVES for stage in stages], last),
        regrasps=sum(
            after == REGRASPING != before for before, after in pairwise(stages[: last + 1])
        ),
        miss=_miss(rows, last),
        freed=None if freed is None else float(truth['time'][freed]),
        reached=None
        if freed is None
        else (float(truth['object_x'][freed]), float(truth['edge_angle'][freed])),
    )


def _end(one: Placing) -> str:
    """Return how a goal ended, and how often the object was touched anew for it."""
    if not one.regrasps:
        return one.stage
    return f'{one.stage}, {one.regrasps} regrasp{"s" if one.regrasps > 1 else ""}'


def _belt(rows: Table, serves: Sequence[bool], last: int) -> float | None:
    """Return the belt from the first push for a goal to its end [m]."""
    left = rows.get('belt_left', np.full(len(serves), math.nan))[: last + 1]
    first = next((k for k, serve in enumerate(serves) if serve), last)
    left = left[first:][np.isfinite(left[first:])]
    return float(left[0] - left[-1]) if len(left) else None


def _miss(rows: Table, last: int) -> tuple[float, float] | None:
    nothing = np.full(len(rows['time']), math.nan)
    both = np.stack([rows.get(name, nothing)[: last + 1] for name in ('x_miss', 'theta_miss')])
    known = np.flatnonzero(np.isfinite(both).all(axis=0))
    return (float(both[0, known[-1]]), float(both[1, known[-1]])) if len(known) else None


def _freed(truth: Table, start: float, until: float) -> int | None:
    """Return the row in which the finger is lifted after a start and before another goal [s]."""
    if not all(name in truth for name in TRUTH):
        return None
    lifts = np.flatnonzero(np.diff(truth['lifted']) > 0.0) + 1
    times = truth['time'][lifts]
    lifts = lifts[(times > start) & (times <= until)]
    return int(lifts[0]) if len(lifts) else None


def _place(x: float, theta: float) -> str:
    return f'{x * MILLIMETRES:.2f} mm, {theta * DEGREES:.2f}°'


def _error(one: Placing) -> str:
    if one.error is not None:
        return _place(*one.error)
    return '' if one.miss is None else f'{_place(*one.miss)} (expected)'
