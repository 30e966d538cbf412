# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo as a node: physics that shares no equation with the estimator."""

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

from tactile_push.interface import JOINT_VELOCITIES, MUJOCO_PLANT
from tactile_push.needs_mujoco import mujoco_is_missing
from tactile_push.nodes.ros.plant import PlantNode
from tactile_push.nodes.ros.process import run
from tactile_push.parameters.mujoco_plant import MujocoPlantParameters, mujoco_config
from tactile_push.parameters.sim_plant import faults

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig


class MujocoPlant(PlantNode[MujocoPlantParameters]):
    """Node: the rig in MuJoCo."""

    NAME = MUJOCO_PLANT
    PARAMETERS = MujocoPlantParameters

    @staticmethod
    def rig_maker(p: MujocoPlantParameters) -> 'Callable[[], MujocoRig]':
        """Check the parameters."""
        from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig
        from tactile_push.simulation.mujoco_rig import MujocoRig

        (config, physics), beginning = mujoco_config(p), faults(p)
        kind = MujocoJointRig if p.commands == JOINT_VELOCITIES else MujocoRig
        return lambda: kind(config, physics, beginning)


def main() -> int:
    """Run the node as a process."""
    return 2 if mujoco_is_missing(MUJOCO_PLANT) else run(MujocoPlant)


if __name__ == '__main__':
    sys.exit(main())
