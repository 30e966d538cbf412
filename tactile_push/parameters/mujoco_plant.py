# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `mujoco_plant`, and the rig in MuJoCo that they describe."""

import re
import typing
from dataclasses import dataclass

from tactile_push.parameters.parameter import parameter
from tactile_push.parameters.sim_plant import SimPlantParameters, rig_config

if typing.TYPE_CHECKING:
    from tactile_push.simulation import RigConfig
    from tactile_push.simulation.mujoco_model import MujocoPhysics

UNIFORM, CORNERS, RIM, SPREAD = 'uniform', 'corners', 'rim', 'spread'
FEET = 36  # that stand for a uniform support or a rim; their c is 1 % below that of uniform support
EVEN_PRISM = 0.0


@dataclass(frozen=True)
class MujocoPlantParameters(SimPlantParameters):
    """Those of `sim_plant`, of which `c` follows from the support here; then what MuJoCo needs."""

    # fmt: off
    support: str = parameter(UNIFORM, '',
        'what the object rests on: many feet under its area, feet under its corners or its rim; or '
        'feet with loads that are spread by the parameter spread, as `identify` finds it',
        choices=(UNIFORM, CORNERS, RIM, SPREAD), read_only=True)
    spread: float = parameter(1.0, '',
        'how far the load is spread if support says so: 1 evenly, 2 to the rim, 3 to the corners',
        0.2, 3.0, read_only=True)
    mu_s: float = parameter(0.3, '',
        'friction between object and belt', 1e-3, 10.0, read_only=True)
    mass: float = parameter(0.93, 'kg',
        "mass of the object; by default that of the paper's steel block if it is 5 cm high",
        1e-3, 100.0, read_only=True)
    object_height: float = parameter(0.05, 'm',
        'height of the object, its centre of mass halfway up', 1e-3, 1.0, read_only=True)
    inertia: float = parameter(EVEN_PRISM, 'kg m^2',
        'moment of inertia of the object about its upright axis; 0 for that of an even prism',
        0.0, 100.0, read_only=True)
    push_height: float = parameter(0.016, 'm',
        "height of the tip's centre above the belt; 0 for a push that does not tilt the object",
        0.0, 1.0, read_only=True)
    # fmt: on


def mujoco_config(p: MujocoPlantParameters) -> tuple['RigConfig', 'MujocoPhysics']:
    """Return the rig that the parameters describe; ValueError if there is no such rig."""
    from tactile_push.mechanics import Support  # which loads the compiler
    from tactile_push.simulation.mujoco_model import MujocoPhysics

    if p.c != 0.0:
        raise ValueError(f'parameter c: expected 0.0, as the support gives it here, got {p.c}')
    if p.f_max != MujocoPlantParameters.f_max:
        raise ValueError(
            f'parameter f_max: expected {MujocoPlantParameters.f_max}, as mu_s and mass give it '
            f'here, got {p.f_max}'
        )
    config = rig_config(p)
    outline = config.slider.outline
    inertia = None if p.inertia == EVEN_PRISM else p.inertia
    try:
        if p.support == CORNERS:
            support = Support.corners(outline)
        elif p.support == SPREAD:
            support = Support.spread(outline, p.spread, FEET).carrying((0.0, 0.0))
        else:
            spread = Support.rim if p.support == RIM else Support.uniform
            support = spread(outline, FEET)
        return config, MujocoPhysics(
            support, p.mu_s, p.mass, p.object_height, p.push_height, inertia
        )
    except ValueError as error:
        named = re.sub('^outline:', 'support:', str(error))
        raise ValueError(f'parameter {named}') from None
