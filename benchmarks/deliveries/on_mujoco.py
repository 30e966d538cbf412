# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Placing on the rig in MuJoCo: the tip turns, and the finger pushes above the belt."""

import math

from deliveries.cases import Case, Group, case, rig_of, support
from deliveries.runs import Outcome, law_for, sensing_for
from tactile_push.control.placing.stages import WITH_RESERVE
from tactile_push.parameters import MujocoPlantParameters
from tactile_push.parameters.mujoco_plant import FEET
from tactile_push.simulation.mujoco_model import MujocoPhysics
from tactile_push.simulation.mujoco_rig import MujocoRig
from tactile_push.simulation.placement import place

PLANT = MujocoPlantParameters()  # mass, height and friction of the object
TILT = 0.008  # greatest mu_s times height that the estimator is told [m]
GROUP = Group('MuJoCo', tip_turns=True)


def rig(one: Case, group: Group) -> MujocoRig:
    """Put a case on the rig, on feet that bear the object as its support does."""
    bearing = support(one.config.slider.outline, one.support, FEET)
    physics = MujocoPhysics(bearing, PLANT.mu_s, PLANT.mass, PLANT.object_height, PLANT.push_height)
    return MujocoRig(one.config, physics, rig_of(one, group).faults)


def run(seed: int, group: Group = GROUP, every: bool = False) -> Outcome:
    """Draw a case and run it, as `runs.run` does."""
    one = case(seed, group)
    if one.verdict != WITH_RESERVE and not every:
        return Outcome(seed, one.verdict, '', math.nan, None)
    law = law_for(one, group)
    sensing = sensing_for(one, group, TILT)
    placed = place(rig(one, group), law, sensing=sensing, seed=seed)
    return Outcome(seed, one.verdict, '', math.nan, placed)
