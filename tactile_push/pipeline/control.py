# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From contacts to commands: what `push_controller` does with each message and at each tick."""

import math
import typing
from collections.abc import Iterator, Sequence

from tactile_push.control import UNKNOWN, Drift, PushControl, Tick, plausible, tick_values
from tactile_push.interface import (
    COMMAND,
    CONTROLLER_STATE,
    FINGER_DISK,
    JOINT_STATES,
    is_frame,
)
from tactile_push.pipeline.messages import Output, command_fields, joint_state_fields
from tactile_push.pipeline.named import OTHER_JOINTS, REFUSED, TAKEN, Joints
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.pipeline.stamps import Seconds, Stamp
from tactile_push.tactile import PlanarFinger
from tactile_push.tactile.planar_finger import pole_angle

if typing.TYPE_CHECKING:
    from tactile_push.pipeline.believing import Believing


class Control:
    """Runs the control law on contacts.

    Parameters
    ----------
    push : PushControl
        Law, limits and stops.
    finger, joint_names : PlanarFinger, sequence of str
        The finger's links, which say where the joints bring the disk, and its moving joints, those
        of the links first. A third one is a wrist that holds the tip straight.
    seconds : callable
        Returns the time [s] of a stamp.

    Attributes
    ----------
    turning : float
        By how much the tip turns where the finger is for each metre across the belt, dpsi/dx
        [rad/m]; NaN if unknown.
    line : float
        Where the disk's centre is along the belt, in `finger_base` [m]; NaN if unknown.
    bend : float
        Where the second link is bent to from the first: 1 counterclockwise, -1 clockwise, and 0 if
        a wrist holds the tip straight; NaN if unknown.
    outlook : Outlook
        Where the finger's drift leads, as of the last tick; unknown while an object is placed.
    placing : Believing or None
        What serves goals, if the law believes.
    """

    def __init__(
        self, push: PushControl, finger: PlanarFinger, joint_names: Sequence[str], seconds: Seconds
    ) -> None:
        self.push = push
        self._finger = finger
        self._joints = Joints(joint_names)
        self._seconds = seconds
        self._located_at = math.nan  # stamp of the newest joint states, nan before the first [s]
        self._heard_joints = False
        self._drift = Drift(
            *(push.steadying.l, push.steadying.r, push.belt_speed, push.period),
            *(push.limits.workspace_min, push.limits.workspace_max),
        )
        self.turning = self.line = self.bend = math.nan
        self.outlook = UNKNOWN
        self.placing: Believing | None = None
        self._now = math.nan  # of the last tick [s]

    @property
    def links(self) -> tuple[float, float, float, float]:
        """How the tip turns on its way: lengths of the finger's links [m], `line`, `bend`."""
        return self._finger.proximal_length, self._finger.distal_length, self.line, self.bend

    @property
    def steadies(self) -> bool:
        """Whether steadying can hold an object where the finger is."""
        return self.push.steadying.holds(self.turning)

    @property
    def trouble(self) -> str:
        """Why joint states do not tell where the finger is, as of the last tick.

        It is empty if they do, if they fell silent, and if there were none.
        """
        if not self._heard_joints:
            return ''
        if trouble := self._joints.trouble:
            return trouble
        age = self._now - self._located_at
        if abs(age) <= self.push.limits.joint_state_timeout:
            return ''
        return f'{JOINT_STATES}: stamped {abs(age):.1f} s {"ago" if age > 0.0 else "ahead"}'

    def contact(self, stamp: Stamp, theta: float) -> bool:
        """Take a contact.

        Parameters
        ----------
        stamp, theta : tuple of int, float
            When the sensor was read [s, ns], and the angle of the pushed edge [rad].

        Returns
        -------
        bool
            Whether a pushed edge can have that angle; the finger stops if not.
        """
        self.push.feel(theta, self._seconds(*stamp))
        return plausible(theta)

    def joint_states(self, stamp: Stamp, names: Sequence[str], positions: Sequence[float]) -> str:
        """Take a message of `joint_states`.

        Once there was any, of whatever joints, the finger's position has to become known.

        Parameters
        ----------
        stamp, names, positions : tuple of int, sequence of str, sequence of float
            When the joints were read [s, ns], their names and their angles [rad].

        Returns
        -------
        str
            What the message was: `TAKEN`, `REFUSED` or `OTHER_JOINTS`.
        """
        self._heard_joints = True
        joints = self._joints.angles(names, positions)
        if joints is None:
            return OTHER_JOINTS
        if not all(map(math.isfinite, joints[:2])):
            return REFUSED
        x, turning = self._finger.forward(*joints[:2]).x, self._finger.turning(*joints[:2])
        psi = pole_angle(self._finger.mount_angle, joints)
        self._located_at = self._seconds(*stamp)
        self.push.locate_finger(x, self._located_at, psi)
        self.turning = turning if len(joints) == 2 else 0.0
        self.line, self.bend = self._finger.line(joints)
        return TAKEN

    def tick(self, stamp: Stamp, elapsed: float = math.nan) -> Tick:
        """Decide on the command of a control period.

        Parameters
        ----------
        stamp : tuple of int
            When the period begins [s, ns].
        elapsed : float, optional
            Time since the last tick by a clock that cannot be set [s]; NaN if that is not known.

        Returns
        -------
        Tick
            What to command and why.
        """
        now, timeout = self._seconds(*stamp), self.push.limits.joint_state_timeout
        self._now = now
        if self._heard_joints:
            self.push.expect_finger(now + timeout)
        if self.placing is None:
            tick = self.push.tick(now, elapsed)
            self.outlook = self._drift.follow(tick, self.push.law.aim, self.turning)
        else:
            self.placing.begin()
            tick = self.push.tick(now, elapsed)
            self.placing.finish(now, tick, self.turning, self.links)
            self.outlook = self.placing.outlook(self._drift, tick, self.turning)
        return tick

    def deactivate(self) -> Tick:
        """Give up the goal, if there is one, and rest until the next activation.

        Returns
        -------
        Tick
            The last one, with a velocity of 0.
        """
        if self.placing is not None:
            self.placing.cancel()
        return self.push.deactivate()

    def outputs(self, stamp: Stamp, tick: Tick) -> Iterator[Output]:
        """Yield the messages of a control period: the command, if there is one, and the states.

        Parameters
        ----------
        stamp, tick : tuple of int, Tick
            When the period begins [s, ns], and what was decided.

        Yields
        ------
        tuple
            Topic and fields.
        """
        if self.placing is not None:
            yield from self.placing.outputs(stamp)
        if tick.v_x is not None:
            yield COMMAND, command_fields(stamp, tick.v_x, tick.v_y)
        yield CONTROLLER_STATE, joint_state_fields(stamp, tick_values(tick, self.push.law))


def edge_angle(frame: str, x: float, y: float, z: float, w: float) -> float:
    """Return the angle of the edge that a message of `contact` tells of.

    Parameters
    ----------
    frame, x, y, z, w : str, float
        The message's frame, `finger_disk` if it is empty, and its quaternion.

    Returns
    -------
    float
        The angle [rad]; NaN in another frame, or if the quaternion is no rotation about z.
    """
    return yaw_of_quaternion(x, y, z, w) if is_frame(frame, FINGER_DISK) else math.nan
