# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's block as plans have it, with an even load, and how it is pushed where it sticks."""

import numpy as np

from tactile_push.control.placing.model import Bounds, Pushed
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT

PRESSURE = Pressure(0.0187**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)))
STICKING = Pushed(0.02375, 0.0135, PRESSURE, 0.0, 1.0, STRAIGHT, 0.0)
BOUNDS = Bounds(1.5, 1e9, -0.1, 0.1, -0.022, 0.022, 0.8)
