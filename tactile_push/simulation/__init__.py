# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig that stands in for the hardware, alone or inside the plant node."""

from tactile_push.simulation.batch import rollouts
from tactile_push.simulation.belt import Belt
from tactile_push.simulation.device_server import serve
from tactile_push.simulation.experiment import control_periods, experiment
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.force_sensor import ForceReadout, ForceSensor, Mount
from tactile_push.simulation.joint_rig import JointRig, servoed
from tactile_push.simulation.object_files import (
    ObjectFile,
    object_of,
    read_json,
    read_object,
    read_support,
)
from tactile_push.simulation.rig import Rig, RigConfig, paper_block, paper_disk
from tactile_push.simulation.rollout import Rollout, rollout
from tactile_push.simulation.sensor import Readout, Sensor
from tactile_push.simulation.servo import Servo, Workspace
from tactile_push.simulation.uneven_friction import UnevenFriction

__all__ = [
    'Belt',
    'Faults',
    'ForceReadout',
    'ForceSensor',
    'JointRig',
    'Mount',
    'ObjectFile',
    'Readout',
    'Rig',
    'RigConfig',
    'Rollout',
    'Sensor',
    'Servo',
    'UnevenFriction',
    'Workspace',
    'control_periods',
    'experiment',
    'object_of',
    'paper_block',
    'paper_disk',
    'read_json',
    'read_object',
    'read_support',
    'rollout',
    'rollouts',
    'serve',
    'servoed',
]
