# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's loop for the block through `finger_servo`, without clocks and processes."""

import math
from itertools import islice

import numpy as np

from tactile_push.control import PushControl, PushLaw
from tactile_push.parameters import FingerServoParameters
from tactile_push.parameters.finger_servo import make_servo
from tactile_push.simulation import control_periods, servoed


def servoed_theta(rig, steps):
    """Return what the law takes for theta [rad] in each of the first control periods on a rig."""
    move = servoed(rig, make_servo(FingerServoParameters()))
    control = PushControl(PushLaw(0.05, 5.0, math.radians(-10.0)), 0.005, 0.1)
    periods = islice(control_periods(rig, control, 2, 0, move), steps)
    return np.array([tick.theta for tick in periods])
