# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From commands and joint states to joint velocities: what `finger_servo` does with each."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tactile_push.control import JointServo, ServoStep, servo_values
from tactile_push.interface import (
    COMMAND,
    FINGER_BASE,
    JOINT_STATES,
    SERVO_COMMANDS,
    SERVO_STATE,
    is_frame,
)
from tactile_push.pipeline.messages import Output, joint_state_fields, velocities_fields
from tactile_push.pipeline.named import OTHER_JOINTS, REFUSED, TAKEN, Joints
from tactile_push.pipeline.stamps import Seconds, Stamp

# What a command was.
COMMANDED, IMPLAUSIBLE = 'commands', 'implausible commands'
OLD_COMMAND, OLD_JOINTS = 'commands of another time', 'joint states of another time'
LATE_JOINTS = 'joint states not newer'
UNDATED = (0, 0)  # the stamp of a message whose sender has set none


class Moment(NamedTuple):
    """When a message arrived."""

    time: float  #: by the clock of the messages' stamps [s]
    steady: float  #: by a clock that cannot be set, unless time is simulated [s]


class Servo:
    """Moves the finger by its joints.

    Parameters
    ----------
    servo, joint_names : JointServo, sequence of str
        Kinematics, bounds and stops, and the joints in the order of their velocities.
    seconds : callable
        Returns the time [s] of a stamp.
    """

    def __init__(self, servo: JointServo, joint_names: Sequence[str], seconds: Seconds) -> None:
        self.servo = servo
        self._joints = Joints(joint_names)
        self._seconds = seconds
        self._command_at = self._joints_at = math.nan  # stamps of the newest that were taken [s]
        self._strange = {COMMAND: '', JOINT_STATES: ''}  # stamps of the last, empty if they are not

    @property
    def trouble(self) -> str:
        """Why the last joint states or the last command were of no use; empty if they were."""
        return self._joints.trouble or self._strange[JOINT_STATES] or self._strange[COMMAND]

    def command(self, stamp: Stamp, frame: str, v_x: float, now: Moment, v_y: float = 0.0) -> str:
        """Take a command.

        Parameters
        ----------
        stamp, frame, v_x : tuple of int, str, float
            When it was given [s, ns], all 0 for now, its frame, `finger_base` if it is empty, and
            the velocity across the belt [m/s].
        now : Moment
            When it arrived.
        v_y : float, optional
            Velocity along the belt that it asks for [m/s]. The disk is kept on a line across the
            belt, so that any but 0 makes the command implausible.

        Returns
        -------
        str
            What it was: `COMMANDED`, `IMPLAUSIBLE` or `OLD_COMMAND`.
        """
        at = now.time if stamp == UNDATED else self._seconds(*stamp)
        if self._is_strange(COMMAND, now.time - at, self.servo.limits.command_timeout):
            return OLD_COMMAND
        if not is_frame(frame, FINGER_BASE) or v_y != 0.0:
            v_x = math.nan
        self._command_at = at
        return COMMANDED if self.servo.command(v_x, now.steady) else IMPLAUSIBLE

    def joint_states(
        self, stamp: Stamp, names: Sequence[str], positions: Sequence[float], now: Moment
    ) -> str:
        """Take a message of `joint_states`.

        Parameters
        ----------
        stamp, names, positions : tuple of int, sequence of str, sequence of float
            When the joints were read [s, ns], their names and their positions [rad] or [m].
        now : Moment
            When it arrived.

        Returns
        -------
        str
            What it was: `TAKEN`, `REFUSED`, `OTHER_JOINTS`, `OLD_JOINTS` or `LATE_JOINTS`.
        """
        joints = self._joints.angles(names, positions)
        if joints is None:
            return OTHER_JOINTS
        if not all(map(math.isfinite, joints)):
            return REFUSED
        at, timeout = self._seconds(*stamp), self.servo.limits.joint_state_timeout
        if self._is_strange(JOINT_STATES, now.time - at, timeout):
            return OLD_JOINTS
        # A clock that was set back makes the newest ones those of another time.
        if at <= self._joints_at and self._joints_at - now.time <= timeout:
            return LATE_JOINTS
        self._joints_at = at
        self.servo.locate(joints, at, now.steady)
        return TAKEN

    def outputs(self, stamp: Stamp, step: ServoStep) -> Iterator[Output]:
        """Yield the messages: the velocities, if there are any, and the state.

        Parameters
        ----------
        stamp, step : tuple of int, ServoStep
            When it was decided [s, ns], and what.

        Yields
        ------
        tuple
            Topic and fields.
        """
        if step.rates is not None:
            yield SERVO_COMMANDS, velocities_fields(step.rates)
        time = self._seconds(*stamp)
        ages = {'command_age': time - self._command_at, 'joint_age': time - self._joints_at}
        yield SERVO_STATE, joint_state_fields(stamp, servo_values(step) | ages)

    def _is_strange(self, topic: str, age: float, most: float) -> bool:
        """Return whether a message is of another time, and remember it."""
        strange = not abs(age) <= most
        words = f'{topic}: stamped {abs(age):.1f} s {"ago" if age > 0.0 else "ahead"}'
        self._strange[topic] = words if strange else ''
        return strange
