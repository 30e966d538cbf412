# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The rig that stands in for the hardware, alone or inside the plant node."""

from tactile_push.simulation.batch import Rollouts, rollouts
from tactile_push.simulation.belt import Belt
from tactile_push.simulation.device import DeviceServer, serve
from tactile_push.simulation.experiment import experiment
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.files import read_object, read_support
from tactile_push.simulation.rig import Rig, RigConfig, paper_block, paper_disk
from tactile_push.simulation.rollout import Rollout, rollout
from tactile_push.simulation.sensor import Readout, Sample, Sensor
from tactile_push.simulation.servo import Servo, Workspace
from tactile_push.simulation.uneven_friction import UnevenFriction

__all__ = [
    'Belt',
    'DeviceServer',
    'Faults',
    'Readout',
    'Rig',
    'RigConfig',
    'Rollout',
    'Rollouts',
    'Sample',
    'Sensor',
    'Servo',
    'UnevenFriction',
    'Workspace',
    'experiment',
    'paper_block',
    'paper_disk',
    'read_object',
    'read_support',
    'rollout',
    'rollouts',
    'serve',
]
