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
"""Quality of service of the package's topics (REP-2003)."""

from rclpy.qos import QoSProfile, ReliabilityPolicy

# Reliable, and so deep that whoever listens reliably, as a recorder does, may be kept from running
# for a while and yet misses nothing.
PUBLISHED = QoSProfile(depth=1000)
# The newest is worth more than all. Deep enough that no bad message hides behind a good one.
SENSOR_DATA = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
