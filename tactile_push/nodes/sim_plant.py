# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package's own simulated rig as a node."""

import sys
from collections.abc import Callable

from tactile_push.interface import JOINT_VELOCITIES, SIM_PLANT
from tactile_push.nodes.ros.plant import PlantNode
from tactile_push.nodes.ros.process import run
from tactile_push.parameters.sim_plant import SimPlantParameters, faults, rig_config
from tactile_push.simulation import JointRig, Rig


class SimPlant(PlantNode[SimPlantParameters]):
    """Node: the simulated rig."""

    NAME = SIM_PLANT
    PARAMETERS = SimPlantParameters

    @staticmethod
    def rig_maker(p: SimPlantParameters) -> Callable[[], Rig]:
        """Check the parameters."""
        config, beginning = rig_config(p), faults(p)
        kind = JointRig if p.commands == JOINT_VELOCITIES else Rig

        def made() -> Rig:
            Rig(config).step(0.0, 1.0)  # compiles the mechanics before time begins
            return kind(config, beginning)

        return made


def main() -> int:
    """Run the node as a process."""
    return run(SimPlant)


if __name__ == '__main__':
    sys.exit(main())
