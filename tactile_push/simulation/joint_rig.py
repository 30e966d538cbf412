# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig with a finger that takes the velocities of its joints."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from tactile_push.control import JointServo, disk_velocity
from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.servo import DelayLine, lagged

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig

Mover = Callable[[float, float, bool], None]
"""Moves a rig: velocity across the belt [m/s], for how long [s], whether the belt runs."""

# Where the joints have their stops [rad]; the second one bends clockwise, as `PlanarFinger.inverse`
# has it.
STOPS = ((-3.0, 3.0), (-3.0, -0.05))


class JointRig(Rig):
    """The rig in motion, driven by the velocities of its two joints.

    Nothing keeps the disk on a line across the belt but who gives the velocities. A wrist holds its
    tip straight by itself. The velocity quantum of the servo's faults is not used.

    Parameters
    ----------
    config : RigConfig
        What the rig is made of and where it starts.
    faults : Faults, optional
        How far it is from a perfect one. Delay and lag of its servo are those of each joint.
    """

    def __init__(self, config: RigConfig, faults: Faults = NO_FAULTS) -> None:
        super().__init__(config, faults)
        self._rates: tuple[float, ...] = (0.0, 0.0)  # of the joints now [rad/s]
        self._sent: DelayLine[tuple[float, ...]] = DelayLine(self._rates)

    def drive(self, rates: Sequence[float], duration: float, belt_running: bool = True) -> None:
        """Let the joints and the belt move for a while.

        Parameters
        ----------
        rates : sequence of float
            Velocities of the two joints [rad/s], as commanded.
        duration : float
            How long [s].
        belt_running : bool, optional
            Whether the belt moves.
        """
        self.at_workspace_limit = False
        if duration == 0.0:
            return
        servo = self.faults.servo
        for arrived, left in self._sent.arriving(tuple(rates), self.time, duration, servo.delay):
            while left > 0.0:  # of commands that arrive together only the last one counts
                levers = self.config.finger.levers(self.joints[:2])
                speeds = [math.hypot(*disk_velocity(levers, r)) for r in (self._rates, arrived)]
                longest = min(left, self._even_time(max(speeds), duration, belt_running))
                elapsed = min(
                    lagged(rate, command, servo.time_constant, longest)[0]
                    for rate, command in zip(self._rates, arrived, strict=True)
                )
                followed = [
                    lagged(rate, command, servo.time_constant, elapsed)
                    for rate, command in zip(self._rates, arrived, strict=True)
                ]
                self._rates = tuple(after for _, _, after in followed)
                self._turn([mean for _, mean, _ in followed], elapsed, belt_running)
                left -= elapsed
        self.v_x = disk_velocity(self.config.finger.levers(self.joints[:2]), self._rates)[0]
        belt_speed = self.faults.belt.speed(self.config.belt_speed, self.time)
        self.v_y = belt_speed if belt_running else 0.0

    def _turn(self, rates: Sequence[float], duration: float, belt_running: bool) -> None:
        """Turn the joints evenly, and stop each at its stops and all at the workspace's end."""
        joints = self.joints[:2]
        wanted = [joint + rate * duration for joint, rate in zip(joints, rates, strict=True)]
        after = [
            min(max(joint, low), high) for joint, (low, high) in zip(wanted, STOPS, strict=True)
        ]
        (x, y), (end_x, end_y) = map(self.config.finger.centre, (joints, after))
        v_x, v_along = (end_x - x) / duration, (end_y - y) / duration
        inside = self.faults.workspace.time_inside(x, v_x, duration)
        psi = self.psi
        if self.config.tip_turns:
            psi += (sum(after) - sum(joints)) * inside / duration
        if inside > 0.0:
            self._move(v_x, psi, inside, belt_running, v_along)
        if inside < duration:
            self._move(0.0, self.psi, duration - inside, belt_running)
            after = list(joints)
        if after != wanted:
            self.at_workspace_limit = True
            self._rates = tuple(
                rate if end == aim else 0.0
                for rate, end, aim in zip(self._rates, after, wanted, strict=True)
            )


def servoed(rig: 'JointRig | MujocoJointRig', servo: JointServo) -> Mover:
    """Let a servo move a rig's joints.

    Parameters
    ----------
    rig, servo : JointRig or MujocoJointRig, JointServo
        The rig, and the servo, which this activates.

    Returns
    -------
    callable
        Moves the rig by a command across the belt, as `rig.step` does.
    """
    servo.activate(rig.time)

    def move(v_x: float, duration: float, belt_running: bool = True) -> None:
        servo.locate(rig.joints[:2], rig.time, rig.time)
        servo.command(v_x, rig.time)
        rig.drive(servo.step(rig.time).rates or (), duration, belt_running)

    return move
