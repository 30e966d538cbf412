# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""All faults of the rig in one place."""

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
