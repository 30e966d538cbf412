# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How messages are read."""

import math
from typing import Any

from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState


def field(message: JointState, name: str) -> float:
    """Give a position by its name, NaN if it is not there."""
    names = list(message.name)
    return float(message.position[names.index(name)]) if name in names else math.nan


def seconds(stamp: Any) -> float:
    """Give a stamp as a number [s]."""
    return float(stamp.sec + stamp.nanosec * 1e-9)


def stamp_of(message: Any) -> tuple[int, int]:
    """Give a message's stamp to the bit [s, ns]."""
    return message.header.stamp.sec, message.header.stamp.nanosec


def yaw(message: PoseStamped) -> float:
    """Give the rotation about z of a pose that has no other [rad]."""
    rotation = message.pose.orientation
    return math.remainder(2.0 * math.atan2(rotation.z, rotation.w), 2.0 * math.pi)
