# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane as messages carry them: in space, with rotations as quaternions."""

import math
from collections.abc import Sequence

UPRIGHT = 1e-3  # x and y beside z and w that rounding may leave: a tilt of 0.1 degrees; picked
PLANE = (0, 1, 5)  # x, y and yaw among the rows of a covariance in space


def quaternion_of_yaw(yaw: float) -> tuple[float, float]:
    """Return z and w of the quaternion of a rotation about z [rad]; x and y are 0."""
    return math.sin(yaw / 2.0), math.cos(yaw / 2.0)


def yaw_of_quaternion(x: float, y: float, z: float, w: float) -> float:
    """Return the angle of a rotation about z, in [-pi, pi] [rad].

    It is NaN if the components are not finite or all 0, or if the axis leans from z by more than
    `UPRIGHT`. Their length does not matter.
    """
    length = math.hypot(z, w)
    if not (0.0 < length < math.inf and math.hypot(x, y) <= UPRIGHT * length):
        return math.nan
    return math.remainder(2.0 * math.atan2(z, w), 2.0 * math.pi)


def covariance_in_space(covariance: Sequence[Sequence[float]]) -> list[float]:
    """Return the covariance of x, y and yaw as that of a pose in space: 36 numbers, row by row.

    Those that are not of the plane are exactly 0.
    """
    numbers = [0.0] * 36
    for row, row_in_space in zip(covariance, PLANE, strict=True):
        for number, column_in_space in zip(row, PLANE, strict=True):
            numbers[6 * row_in_space + column_in_space] = number
    return numbers
