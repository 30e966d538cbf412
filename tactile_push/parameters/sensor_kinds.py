# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The kinds of sensor that the simulated rig can have."""

import math
from typing import Any, NamedTuple

from tactile_push.interface import (
    CAMERA,
    CAMERA_SENSOR,
    FORCE_TORQUE,
    SENSOR_DRIVER,
    SENTENCE,
    WRENCH_SENSOR,
)
from tactile_push.parameters.simulated_camera import CALIBRATION

FILTER = 0.1  # time constant with which the noise below spreads theta by 0.6° [s]

# What it is worth as noise that each control period has anew [rad]: of two periods' noise exp(-1)
# is common, so that the mean of many spreads by sqrt((e + 1)/(e - 1)) = 1.47 times as much.
FILTERED = 1.47 * math.radians(0.6)


class SensorKind(NamedTuple):
    """A sensor of the simulated rig."""

    node: str  #: which reads it
    parameters: dict[str, Any]  #: of that node
    plant: dict[str, Any]  #: parameters of the plant
    sensing: dict[str, Any]  #: parameters of active_sensing


SENSOR_KINDS = {
    SENTENCE: SensorKind(SENSOR_DRIVER, {}, {}, {}),
    FORCE_TORQUE: SensorKind(
        WRENCH_SENSOR,
        # The finger begins in contact, with a sensor of its own.
        {'needs_tare': False, 'filter_time_constant': FILTER, 'calibrated_frame': ''},
        {
            'publish_wrench': True,
            'sensor_rate': 100.0,
            'contact_lag': FILTER,
            'wrench_noise': 0.05,
            'wrench_moment_noise': 0.0005,
        },
        {'noise': FILTERED},
    ),
    CAMERA: SensorKind(
        CAMERA_SENSOR,
        {**CALIBRATION, 'reference_at_start': True, 'calibrated_frame': ''},
        {'publish_image': True, 'image_noise': 0.02},
        {},
    ),
}
"""What each of `interface.SENSORS` needs; wrenches and images have the noise of usual ones."""
