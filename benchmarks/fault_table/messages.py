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
