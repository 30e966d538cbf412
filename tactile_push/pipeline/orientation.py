# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane as messages carry them: in space, with rotations as quaternions."""

import math
from collections.abc import Sequence

UPRIGHT = 1e-3  # size of x and y that rounding and careless publishers may leave
PLANE = (0, 1, 5)  # x, y and yaw among the rows of a covariance in space


def quaternion_of_yaw(yaw: float) -> tuple[float, float]:
    """Return the two components of a rotation about z that are not zero.

    Parameters
    ----------
    yaw : float
        Angle [rad], counterclockwise.

    Returns
    -------
    z, w : float
        Quaternion components; x = y = 0.
    """
    return math.sin(yaw / 2.0), math.cos(yaw / 2.0)


def yaw_of_quaternion(x: float, y: float, z: float, w: float) -> float:
    """Return the angle of a rotation about z.

    Parameters
    ----------
    x, y, z, w : float
        Quaternion components, of any common positive length.

    Returns
    -------
    float
        Angle [rad] in [-pi, pi]; NaN if the components are not finite or all 0, or if the axis
        leans from z by more than `UPRIGHT`.
    """
    length = math.hypot(z, w)
    if not (0.0 < length < math.inf and math.hypot(x, y) <= UPRIGHT * length):
        return math.nan
    return math.remainder(2.0 * math.atan2(z, w), 2.0 * math.pi)


def covariance_in_space(covariance: Sequence[Sequence[float]]) -> list[float]:
    """Return the covariance of a pose in the plane as that of a pose in space.

    Parameters
    ----------
    covariance : sequence of sequence of float, shape (3, 3)
        Of x, y and yaw.

    Returns
    -------
    list of float
        The 36 numbers of x, y, z and the rotations about them, row by row; those that are not of
        the plane are exactly 0.
    """
    numbers = [0.0] * 36
    for row, row_in_space in zip(covariance, PLANE, strict=True):
        for number, column_in_space in zip(row, PLANE, strict=True):
            numbers[6 * row_in_space + column_in_space] = number
    return numbers
