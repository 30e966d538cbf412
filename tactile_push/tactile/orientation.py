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
"""Rotation about the vertical as the quaternion that messages carry."""

import math

UPRIGHT = 1e-3  # what rounding and careless publishers may leave of x and y


def quaternion_of_yaw(yaw: float) -> tuple[float, float]:
    """Give the two components of a rotation about z that are not zero.

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
    """Give the angle of a rotation about z.

    Parameters
    ----------
    x, y, z, w : float
        Quaternion components, of any common positive length.

    Returns
    -------
    float
        Angle [rad] in [-pi, pi]; NaN if the components are no rotation about z: not finite, all 0,
        or about an axis that leans by more than `UPRIGHT`.
    """
    length = math.hypot(z, w)
    if not (0.0 < length < math.inf and math.hypot(x, y) <= UPRIGHT * length):
        return math.nan
    return math.remainder(2.0 * math.atan2(z, w), 2.0 * math.pi)
