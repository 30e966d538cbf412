# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo with a finger that takes the velocities of its joints.

This module needs the package mujoco.
"""

from collections.abc import Callable, Sequence

from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.joint_rig import STOPS
from tactile_push.simulation.mujoco_model import MujocoPhysics
from tactile_push.simulation.mujoco_rig import LINKS, MujocoRig
from tactile_push.simulation.rig import RigConfig
from tactile_push.simulation.servo import DelayLine


class MujocoJointRig(MujocoRig):
    """The rig in motion by MuJoCo, driven by the velocities of its two joints, as `JointRig` is.

    Parameters
    ----------
    config, physics : RigConfig, MujocoPhysics
        What the rig is made of and where it starts, and what else MuJoCo has to know.
    faults : Faults, optional
        How far it is from a perfect one. Delay and lag of its servo are those of each joint.
    """

    def __init__(
        self, config: RigConfig, physics: MujocoPhysics, faults: Faults = NO_FAULTS
    ) -> None:
        super().__init__(config, physics, faults)
        self._rates: tuple[float, ...] = (0.0, 0.0)  # that the servos are asked for now [rad/s]
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
        delay = self.faults.servo.delay
        for arrived, length in self._sent.arriving(tuple(rates), self.time, duration, delay):
            self._simulate(self._of_joints(arrived), length, belt_running)
        self._look()

    def _of_joints(self, command: Sequence[float]) -> Callable[[float], tuple[float, ...]]:
        """Return what asks the servos, a step [s] after the other, for velocities [rad/s]."""

        def ask(step: float) -> tuple[float, ...]:
            behind = self._behind(step)
            lagging = [
                wanted + behind * (rate - wanted)
                for rate, wanted in zip(self._rates, command, strict=True)
            ]
            self._rates = self._within_stops(lagging, step)
            return self._with_wrist(self._rates)

        return ask

    def _within_stops(self, rates: Sequence[float], step: float) -> tuple[float, ...]:
        """Return 0 for a joint that would pass its stop, and all 0 at the workspace's end."""
        joints = self._data.qpos[LINKS].tolist()
        after = [joint + rate * step for joint, rate in zip(joints, rates, strict=True)]
        free = [
            low <= joint <= high or (joint < low) == (rate > 0.0)
            for joint, rate, (low, high) in zip(after, rates, STOPS, strict=True)
        ]
        x, _ = self.config.finger.centre(joints)
        v_x = (self.config.finger.centre(after)[0] - x) / step
        if self.faults.workspace.time_inside(x, v_x, step) < step:
            free = [False, False]
        self.at_workspace_limit |= not all(free)
        return tuple(rate if goes else 0.0 for rate, goes in zip(rates, free, strict=True))
