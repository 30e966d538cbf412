# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Joint velocities that move the finger's disk, within what joints and workspace allow."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple, Protocol

from tactile_push.control.servo_states import (
    JOINT_LIMIT,
    NO_REASON,
    SINGULAR_POSE,
    WORKSPACE_LIMIT,
)

# A velocity that would lead past a limit within this time is not given [s]: the joints are read
# every 0.02 s or so, and take some time to stop.
LOOK_AHEAD = 0.05
MOMENT = 1e-6  # in which the manipulability changes evenly [s]
# Manipulability below which a finger cannot tell to which side it bends, and stands; picked, 0.06
# degrees from stretched.
STUCK = 1e-3
POSES = 60  # of each joint between its limits that are tried for a workspace; picked


class Arm(Protocol):
    """Joints that carry the finger's disk, in `finger_base`: two that turn or one that slides."""

    def centre(self, joints: Sequence[float]) -> tuple[float, float]:
        """Return x and y of the disk's centre [m]."""
        ...

    def levers(self, joints: Sequence[float]) -> tuple[tuple[float, float], ...]:
        """Return the columns of the Jacobian: how the centre moves with each joint."""
        ...

    def manipulability(self, joints: Sequence[float]) -> float:
        """Return 0 in a pose in which the finger cannot move in some way, up to 1."""
        ...

    def moved(self, before: Sequence[float], after: Sequence[float]) -> tuple[float, ...]:
        """Return how far each joint has moved."""
        ...


@dataclass(frozen=True)
class JointBounds:
    """Where joints and finger may be, and how fast they may go.

    A joint's numbers are in rad and rad/s, or in m and m/s if it slides.

    Raises
    ------
    ValueError
        If the bounds of a joint or of the workspace are empty, or a speed is not positive.
    """

    joint_min: tuple[float, ...]  #: least position of each joint
    joint_max: tuple[float, ...]  #: greatest position of each joint
    joint_speed: tuple[float, ...]  #: greatest speed of each joint
    #: least x of the finger's disk in `finger_base` [m]; 5 mm beyond where the law stops the finger
    workspace_min: float = -0.11
    workspace_max: float = 0.11  #: greatest x of the finger's disk in `finger_base` [m]
    max_speed: float = 0.02  #: bound on |v_x|, and on the velocity back to the line [m/s]
    #: manipulability below which the finger only moves where it grows; 0.2 is 11.5 degrees from
    #: stretched
    least_manipulability: float = 0.2

    def __post_init__(self) -> None:
        for name in ('joint_max', 'joint_speed'):
            if len(getattr(self, name)) != len(self.joint_min):
                raise ValueError(
                    f'{name}: expected a number for each of the {len(self.joint_min)} joints of '
                    f'joint_min, got {list(getattr(self, name))}'
                )
        for lower, upper in zip(self.joint_min, self.joint_max, strict=True):
            if not -math.inf < lower < upper < math.inf:
                raise ValueError(
                    f'joint_min: expected less than joint_max, got {list(self.joint_min)} and '
                    f'{list(self.joint_max)}'
                )
        for speed in self.joint_speed:
            if not 0.0 < speed < math.inf:
                raise ValueError(
                    f'joint_speed: expected positive numbers, got {list(self.joint_speed)}'
                )
        if not self.workspace_min < self.workspace_max:
            raise ValueError(
                'workspace_min: expected less than workspace_max, '
                f'got {self.workspace_min} and {self.workspace_max}'
            )


class JointRates(NamedTuple):
    """Velocities of the joints, and why they are not those that were asked for."""

    rates: tuple[float, ...]  #: [rad/s] or [m/s]
    share: float  #: of what was asked for, 0 to 1; below 1 a joint would have been too fast
    limit: str  #: why the joints stand: a limit that the finger would pass, or `NO_REASON`


def joint_rates(
    arm: Arm, bounds: JointBounds, joints: Sequence[float], v_x: float, v_y: float
) -> JointRates:
    """Find the joint velocities that move the disk's centre.

    All joints are slowed down alike, so that the disk keeps its direction. Where the finger would
    pass a limit within `LOOK_AHEAD`, all joints stand; back from there they move.

    Parameters
    ----------
    arm, bounds : Arm, JointBounds
        Kinematics, and what is allowed.
    joints : sequence of float
        Where the joints are [rad] or [m].
    v_x, v_y : float
        Velocity of the centre across and along the belt [m/s]; finite.

    Returns
    -------
    JointRates
        What the joints are to do; finite, and no joint faster than it may be.
    """
    still = (0.0,) * len(joints)
    if arm.manipulability(joints) < STUCK:
        return JointRates(still, 0.0, SINGULAR_POSE)
    rates = _inverse(arm.levers(joints), v_x, v_y)
    pairs = list(zip(rates, bounds.joint_speed, strict=True))
    share = min([1.0, *(most / abs(rate) for rate, most in pairs if rate)])
    rates = tuple(math.copysign(min(share * abs(rate), most), rate) for rate, most in pairs)
    limit = _limit(arm, bounds, joints, rates, share * v_x)
    return JointRates(still, 0.0, limit) if limit else JointRates(rates, share, NO_REASON)


def disk_velocity(
    levers: Sequence[tuple[float, float]], rates: Sequence[float]
) -> tuple[float, float]:
    """Find the velocity of the disk's centre.

    Parameters
    ----------
    levers, rates : sequence of (float, float), sequence of float
        Columns of the Jacobian, and velocities of the joints.

    Returns
    -------
    v_x, v_y : float
        Velocity [m/s].
    """
    pairs = list(zip(levers, rates, strict=True))
    return sum(x * rate for (x, _), rate in pairs), sum(y * rate for (_, y), rate in pairs)


def check_workspace(arm: Arm, bounds: JointBounds) -> None:
    """Refuse joint limits between which the finger cannot work.

    Parameters
    ----------
    arm, bounds : Arm, JointBounds
        Kinematics, and what is allowed.

    Raises
    ------
    ValueError
        If no pose between the joint limits has the disk in the workspace and is far enough from
        stretched and folded.
    """
    ways = [
        [lower + (upper - lower) * i / POSES for i in range(POSES + 1)]
        for lower, upper in zip(bounds.joint_min, bounds.joint_max, strict=True)
    ]
    reached = []
    for joints in product(*ways):
        if arm.manipulability(joints) >= bounds.least_manipulability:
            reached.append(arm.centre(joints)[0])
            if bounds.workspace_min <= reached[-1] <= bounds.workspace_max:
                return
    limits = f'{list(bounds.joint_min)} to {list(bounds.joint_max)}'
    if not reached:
        raise ValueError(
            f'joint_min: expected a pose that is not stretched or folded, got {limits}'
        )
    raise ValueError(
        f'joint_min: expected x between {bounds.workspace_min:g} and {bounds.workspace_max:g} m, '
        f'the workspace, got {min(reached):.3f} to {max(reached):.3f} m with joints at {limits}'
    )


def _inverse(levers: Sequence[tuple[float, float]], v_x: float, v_y: float) -> tuple[float, ...]:
    """Return the velocities of the joints. A single joint has no say in v_y."""
    (x, y), *more = levers
    if not more:
        return (v_x / x,)
    ((distal_x, distal_y),) = more
    det = x * distal_y - y * distal_x
    return (v_x * distal_y - v_y * distal_x) / det, (v_y * x - v_x * y) / det


def _limit(
    arm: Arm, bounds: JointBounds, joints: Sequence[float], rates: Sequence[float], v_x: float
) -> str:
    """Return the limit that the finger would pass."""
    x, _ = arm.centre(joints)
    ahead = x + v_x * LOOK_AHEAD
    if (v_x > 0.0 and ahead > bounds.workspace_max) or (v_x < 0.0 and ahead < bounds.workspace_min):
        return WORKSPACE_LIMIT
    after = [joint + rate * LOOK_AHEAD for joint, rate in zip(joints, rates, strict=True)]
    for joint, rate, lower, upper in zip(
        after, rates, bounds.joint_min, bounds.joint_max, strict=True
    ):
        if (rate > 0.0 and joint > upper) or (rate < 0.0 and joint < lower):
            return JOINT_LIMIT
    a_moment_later = [joint + rate * MOMENT for joint, rate in zip(joints, rates, strict=True)]
    now = arm.manipulability(joints)
    slope = (arm.manipulability(a_moment_later) - now) / MOMENT
    shrinks = slope < 0.0 and now + slope * LOOK_AHEAD < bounds.least_manipulability
    return SINGULAR_POSE if shrinks else NO_REASON
