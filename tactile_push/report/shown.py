# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which quantities of a run are shown, where they come from, and in which units."""

import math

import numpy as np
import numpy.typing as npt

from tactile_push.interface import (
    CONTACT,
    CONTROLLER_STATE,
    OBJECT_POSE,
    SENSING_STATE,
    TRUE_POSE,
    TRUE_STATE,
)

DEGREES, MILLIMETRES, SECONDS = 180.0 / math.pi, 1e3, 1.0

# What is shown against time: factor from SI, offset and decimals.
LENGTHS = ('v_x', 'v_x_true', 'd', 'd_lower', 'd_upper', 'd_least', 'd_most', 'd_true')
SERIES = {
    **dict.fromkeys(('theta', 'theta_desired'), (DEGREES, 0.0, 3)),
    **dict.fromkeys(('phi', 'psi'), (DEGREES, -90.0, 3)),
    **dict.fromkeys(LENGTHS, (MILLIMETRES, 0.0, 4)),  # and lengths a second
    **dict.fromkeys(('silence', 'interval'), (SECONDS, 0.0, 4)),
}
# What only the view from above shows.
VIEWED = {
    **dict.fromkeys(('object_x', 'object_y'), (MILLIMETRES, 0.0, 3)),
    'object_angle': (DEGREES, 0.0, 3),
    **dict.fromkeys(('estimate_x', 'estimate_y'), (MILLIMETRES, 0.0, 3)),
    'estimate_angle': (DEGREES, 0.0, 3),
    **dict.fromkeys(('finger_x', 'belt_travel'), (MILLIMETRES, 0.0, 2)),
    'state': (1.0, 0.0, 0),
}
HOLD = 1.0  # the view shows no value that is older [s]: ten control periods of the paper

# Where a quantity comes from: the first topic of these that there is, and the name there.
SOURCES = {
    'theta': ((CONTROLLER_STATE, 'theta'), (CONTACT, 'yaw'), (TRUE_STATE, 'theta')),
    'theta_desired': ((CONTROLLER_STATE, 'theta_desired'),),
    'phi': ((CONTROLLER_STATE, 'phi'), (TRUE_STATE, 'phi')),
    'psi': ((CONTROLLER_STATE, 'psi'),),
    'v_x': ((CONTROLLER_STATE, 'v_x'),),
    'v_x_true': ((TRUE_STATE, 'v_x'),),
    **{d: ((SENSING_STATE, d),) for d in ('d', 'd_lower', 'd_upper', 'd_least', 'd_most')},
    'd_true': ((TRUE_STATE, 'd'),),
    'silence': ((CONTROLLER_STATE, 'silence'),),
    'finger_x': ((CONTROLLER_STATE, 'finger_x'), (TRUE_STATE, 'finger_x')),
    'belt_travel': ((TRUE_STATE, 'belt_travel'),),
    'object_x': ((TRUE_POSE, 'x'),),
    'object_y': ((TRUE_POSE, 'y'),),
    'object_angle': ((TRUE_POSE, 'yaw'),),
    'estimate_x': ((OBJECT_POSE, 'x'),),
    'estimate_y': ((OBJECT_POSE, 'y'),),
    'estimate_angle': ((OBJECT_POSE, 'yaw'),),
}


def readable(name: str, values: npt.NDArray[np.float64]) -> list[float | None]:
    """Return values of a quantity in SI units as people read them."""
    factor, offset, decimals = (SERIES | VIEWED)[name]
    with np.errstate(over='ignore'):
        return numbers(values * factor + offset, decimals)


def numbers(values: npt.NDArray[np.float64], decimals: int) -> list[float | None]:
    """Round, and write None where there is no number: JSON has no NaN."""
    rounded = np.round(values, decimals) + 0.0  # no -0.0
    return [value if math.isfinite(value) else None for value in rounded.tolist()]
