# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Quality of service of the package's topics (REP-2003)."""

from rclpy.qos import QoSProfile, ReliabilityPolicy

# Reliable, and so deep that whoever listens reliably, as a recorder does, may be kept from running
# for a while and yet misses nothing.
PUBLISHED = QoSProfile(depth=1000)
# The newest is worth more than all. Deep enough that no bad message hides behind a good one.
SENSOR_DATA = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
