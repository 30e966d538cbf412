# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the joints follow the command across the belt, and decides when they have to stand."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from tactile_push.control.joint_rates import (
    Arm,
    JointBounds,
    check_workspace,
    disk_velocity,
    joint_rates,
)
from tactile_push.control.servo_states import (
    AWAITING_COMMAND,
    COMMAND_SILENT,
    DOES_NOT_FOLLOW,
    FOLLOWING,
    IMPLAUSIBLE_COMMAND,
    SERVO_HELD,
    SERVO_STATES,
    SERVO_STOP_REASONS,
)
from tactile_push.control.states import (
    ANOTHER_COMMAND,
    FINGER_UNKNOWN,
    INACTIVE,
    NO_REASON,
    STOPPED,
)

# A difference between commanded and measured motion is forgotten over so long a commanded way [m],
# and at rest after this time [s]; picked. By the way, a drive that stands is noticed however slowly
# it is commanded, and one that is a tenth too slow is off by a tenth of the way. At rest there is
# no way, and what moves the finger slowly is no drive that does not follow.
FORGET_WAY, FORGET_TIME = 0.01, 1.0


@dataclass(frozen=True)
class ServoLimits:
    """How the finger keeps its line, and when it has to stand; docs/safety.md has the reasons.

    Raises
    ------
    ValueError
        If a number is not positive.
    """

    line_gain: float = 5.0  #: rate at which the disk goes back to its line across the belt [1/s]
    command_timeout: float = 0.5  #: the joints stand after this long without a command [s]
    joint_state_timeout: float = 0.2  #: the joints stand after this long without joint states [s]
    #: distance between where the disk is and where the commands of the last centimetre should have
    #: brought it, beyond which the velocity controller counts as one that does not follow [m]
    follow_tolerance: float = 0.002

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0.0 < value < math.inf:
                raise ValueError(f'{name}: expected a positive number, got {value}')


class ServoStep(NamedTuple):
    """What the servo decided, and on what."""

    state: str  #: one of `SERVO_STATES`
    stop_reason: str  #: one of `SERVO_STOP_REASONS`; `NO_REASON` unless stopped
    #: velocities of the joints [rad/s] or [m/s]; None while inactive, when whoever moves the joints
    #: is not this servo
    rates: tuple[float, ...] | None
    v_x: float  #: commanded velocity across the belt [m/s]; NaN if there is none
    share: float  #: of it that the bounds on speed allow, 0 to 1; NaN unless following
    x: float  #: where the disk is in `finger_base` [m]; NaN if unknown
    y: float  #: the same along the belt [m]
    line: float  #: the y that the disk keeps [m]; NaN before the first command
    deviation: float  #: of the disk from where the commands should have brought it [m]


class JointServo:
    """Turns a velocity across the belt into joint velocities.

    From the first command on the disk's centre stays on the line across the belt on which it is
    then, by feedback as it moves. A command of 0 is 0 for every joint. All times are by a clock
    that cannot be set, unless time is simulated.

    Parameters
    ----------
    arm, bounds : Arm, JointBounds
        Kinematics, and where the joints may be and how fast.
    limits : ServoLimits, optional
        When the joints have to stand. This and `bounds` may be replaced at any time.

    Raises
    ------
    ValueError
        If the joint limits leave no workspace.
    """

    def __init__(self, arm: Arm, bounds: JointBounds, limits: ServoLimits | None = None) -> None:
        check_workspace(arm, bounds)
        self.bounds = bounds
        self.limits = limits or ServoLimits()
        self._arm = arm
        self._still = (0.0,) * len(bounds.joint_min)
        self._now = 0.0  # of the last step [s]
        self._joints: tuple[float, ...] = ()  # none before the first ones
        self._stamp = -math.inf  # of the joints [s]
        self.activate(0.0)
        self.state = INACTIVE  #: one of `SERVO_STATES`

    def activate(self, now: float) -> None:
        """Start over: no command yet, and nothing known.

        The joints rest until the first command, whatever another servo may have left in force.

        Parameters
        ----------
        now : float
            Time [s].
        """
        self.state = AWAITING_COMMAND
        self._reason = NO_REASON
        self._line = math.nan
        self._rates = self._still
        self._forget(now)

    def deactivate(self) -> tuple[float, ...]:
        """Rest until the next activation.

        Returns
        -------
        tuple of float
            The last velocities, all 0.
        """
        self.state = INACTIVE
        self._reason = NO_REASON
        self._rates = self._still
        return self._still

    def command(self, v_x: float, now: float) -> bool:
        """Take a command as it arrives.

        Parameters
        ----------
        v_x : float
            Velocity across the belt [m/s]. One that is not finite stops the joints.
        now : float
            Time [s].

        Returns
        -------
        bool
            Whether it is a velocity.
        """
        self._v_x, self._commanded_at = v_x, now
        return math.isfinite(v_x)

    def locate(self, joints: Sequence[float], stamp: float, now: float) -> None:
        """Take the joints' positions as they arrive.

        Parameters
        ----------
        joints : sequence of float
            Where the joints are [rad] or [m]; finite.
        stamp : float
            When they were there [s], by whatever clock; later than the last ones.
        now : float
            Time [s].
        """
        passed, self._stamp = stamp - self._stamp, stamp
        before, self._joints = self._joints, tuple(joints)
        self._located_at = now
        followed = self.state in (FOLLOWING, STOPPED)
        if followed and 0.0 < passed <= self.limits.joint_state_timeout:
            self._compare(self._arm.moved(before, self._joints), passed)
        else:  # nobody watched, or somebody else may have moved the joints
            self._behind = self._still

    def notice_another_command(self) -> None:
        """Take note that somebody else commands the joints: they cannot serve two."""
        self._hold(ANOTHER_COMMAND)

    def step(self, now: float) -> ServoStep:
        """Decide on the joints' velocities until the next step.

        Parameters
        ----------
        now : float
            Time [s].

        Returns
        -------
        ServoStep
            What to command and why.
        """
        if now < self._now:  # of simulated time, which somebody has set back
            self._forget(now)
        self._now = now
        is_asked = self._commanded_at > -math.inf
        if self.state == INACTIVE or (self.state == AWAITING_COMMAND and not is_asked):
            return self._said(math.nan)
        share, self._rates = math.nan, self._still
        if self._reason not in SERVO_HELD:
            self._reason = self._cause_to_rest(now)
        if not self._reason:
            share = self._follow()
        self.state = STOPPED if self._reason else FOLLOWING
        return self._said(share)

    def _follow(self) -> float:
        """Find the joints' velocities; return the share of the command that they make."""
        arm, joints, fastest = self._arm, self._joints, self.bounds.max_speed
        y = arm.centre(joints)[1]
        if math.isnan(self._line):
            self._line = y
        if self._v_x == 0.0:
            return 1.0  # a finger that is to stand, stands
        v_x = _within(self._v_x, fastest)
        v_y = _within(self.limits.line_gain * (self._line - y), fastest)
        self._rates, share, self._reason = joint_rates(arm, self.bounds, joints, v_x, v_y)
        return share * v_x / self._v_x

    def _cause_to_rest(self, now: float) -> str:
        if not now - self._located_at <= self.limits.joint_state_timeout:
            return FINGER_UNKNOWN
        if not now - self._commanded_at <= self.limits.command_timeout:
            return COMMAND_SILENT
        return NO_REASON if math.isfinite(self._v_x) else IMPLAUSIBLE_COMMAND

    def _compare(self, moved: Sequence[float], passed: float) -> None:
        """Compare how the joints have moved with what they were asked for."""
        way = passed * math.hypot(*disk_velocity(self._arm.levers(self._joints), self._rates))
        kept = math.exp(-way / FORGET_WAY if way > 0.0 else -passed / FORGET_TIME)
        self._behind = tuple(
            kept * behind + rate * passed - done
            for behind, rate, done in zip(self._behind, self._rates, moved, strict=True)
        )
        if not self._deviation <= self.limits.follow_tolerance:
            self._hold(DOES_NOT_FOLLOW)

    @property
    def _deviation(self) -> float:
        if not self._joints:
            return math.nan
        return math.hypot(*disk_velocity(self._arm.levers(self._joints), self._behind))

    def _hold(self, reason: str) -> None:
        """Stop until the next activation."""
        if self.state != INACTIVE and self._reason not in SERVO_HELD:
            self.state, self._reason = STOPPED, reason
            self._rates = self._still

    def _forget(self, now: float) -> None:
        """Forget all that was heard."""
        self._now = now
        self._v_x, self._commanded_at = math.nan, -math.inf
        self._joints = ()
        self._stamp = self._located_at = -math.inf
        self._behind = self._still

    def _said(self, share: float) -> ServoStep:
        x, y = self._arm.centre(self._joints) if self._joints else (math.nan, math.nan)
        return ServoStep(
            self.state,
            self._reason,
            None if self.state == INACTIVE else self._rates,
            self._v_x,
            share,
            x,
            y,
            self._line,
            self._deviation,
        )


def _within(value: float, most: float) -> float:
    return min(max(value, -most), most)


def servo_values(step: ServoStep) -> dict[str, float]:
    """Return what the servo decided and on what, by name.

    Parameters
    ----------
    step : ServoStep
        The step.

    Returns
    -------
    dict of str to float
        The numbers by name, SI units; NaN where there is none.
    """
    first, second = (*(step.rates or ()), math.nan, math.nan)[:2]
    return {
        'v_x': step.v_x,
        'first_velocity': first,
        'second_velocity': second,
        'share': step.share,
        'finger_x': step.x,
        'finger_y': step.y,
        'line': step.line,
        'deviation': step.deviation,
        'state': float(SERVO_STATES.index(step.state)),
        'stop_reason': float(SERVO_STOP_REASONS.index(step.stop_reason)),
    }
