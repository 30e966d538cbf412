# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Writes down what a rig does, one control period after the other."""

from typing import TYPE_CHECKING

import numpy as np

from tactile_push.simulation.rig import Rig
from tactile_push.simulation.rollout import MODE, QUANTITIES, Rollout

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig


class Trace:
    """The control periods of a run, as a `Rollout` has them."""

    def __init__(self) -> None:
        self._rows: list[list[float]] = []

    def __len__(self) -> int:
        """Return how many control periods are written down."""
        return len(self._rows)

    def add(self, rig: 'Rig | MujocoRig', phi: float) -> None:
        """Take the start of a control period and the push angle that drives it [rad]."""
        self.close(rig)
        pose = rig.object_pose
        self._rows.append([rig.theta, phi, rig.d, pose.x, pose.y, rig.mode])

    def close(self, rig: 'Rig | MujocoRig') -> None:
        """Take how the contact moved at the end of the last period, if there is one."""
        if self._rows:
            self._rows[-1][MODE] = rig.mode

    def run(self, end: str) -> Rollout:
        """Return what happened, and why it ended."""
        theta, phi, d, x, y, mode = np.reshape(np.array(self._rows), (-1, QUANTITIES)).T
        return Rollout(theta, phi, d, x, y, mode.astype(np.int64), end)
