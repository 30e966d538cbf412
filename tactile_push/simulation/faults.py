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
"""All that may go wrong with the rig, in one place."""

from dataclasses import dataclass

from tactile_push.simulation.belt import Belt
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo, Workspace
from tactile_push.simulation.uneven_friction import UnevenFriction


@dataclass(frozen=True)
class Faults:
    """How far the rig is from a perfect one; by default not at all.

    Parameters
    ----------
    servo : Servo, optional
        How the finger follows its command.
    workspace : Workspace, optional
        Where the finger may be.
    belt : Belt, optional
        How the belt runs.
    friction : UnevenFriction, optional
        How mu_c varies around the object.
    sensor : Sensor, optional
        How the sensor errs.
    """

    servo: Servo = Servo()
    workspace: Workspace = Workspace()
    belt: Belt = Belt()
    friction: UnevenFriction = UnevenFriction()
    sensor: Sensor = Sensor()


NO_FAULTS = Faults()
