# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""All faults of the rig in one place."""

from dataclasses import dataclass

from tactile_push.simulation.belt import Belt
from tactile_push.simulation.force_sensor import ForceSensor
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo, Workspace
from tactile_push.simulation.uneven_friction import UnevenFriction


@dataclass(frozen=True)
class Faults:
    """How far the rig is from a perfect one; by default not at all."""

    servo: Servo = Servo()  #: how the finger follows its command
    workspace: Workspace = Workspace()  #: where the finger may be
    belt: Belt = Belt()  #: how the belt runs
    friction: UnevenFriction = UnevenFriction()  #: how mu_c varies around the object
    sensor: Sensor = Sensor()  #: how the sensor errs
    force_sensor: ForceSensor = ForceSensor()  #: how the force/torque sensor errs


NO_FAULTS = Faults()
