# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How messages are read."""

import math
from typing import Any

from geometry_msgs.msg import PoseStamped


def stamp_of(message: Any) -> tuple[int, int]:
    """Return a message's stamp to the bit [s, ns]."""
    return message.header.stamp.sec, message.header.stamp.nanosec


def yaw(message: PoseStamped) -> float:
    """Return the rotation about z of a pose that has no other [rad]."""
    rotation = message.pose.orientation
    return math.remainder(2.0 * math.atan2(rotation.z, rotation.w), 2.0 * math.pi)
