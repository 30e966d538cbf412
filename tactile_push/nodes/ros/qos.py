# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Quality of service of the package's topics (REP-2003)."""

from rclpy.qos import QoSProfile, ReliabilityPolicy

# Reliable, and so deep that a reliable subscriber, such as a recorder, misses nothing even if it is
# kept from running for a while.
PUBLISHED = QoSProfile(depth=1000)
# The newest message counts. Deep enough that a bad message does not push out a good one.
SENSOR_DATA = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
# Images, of which one that waited behind others would be late.
IMAGES = QoSProfile(depth=2, reliability=ReliabilityPolicy.BEST_EFFORT)
# The newest message alone.
FRESHEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
# To notice whoever else commands: a reliable subscription misses no command; a best-effort one
# hears publishers that are so, too.
EVERYBODY = (
    QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE),
    QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT),
)
