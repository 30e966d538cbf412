# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration on a machine with ROS 2: the nodes, in simulated time, and RViz."""

from launch import LaunchDescription

from tactile_push.launching.actions import launch_description
from tactile_push.launching.arguments import DemoArguments
from tactile_push.launching.plan import demo_plan


def generate_launch_description() -> LaunchDescription:
    return launch_description(DemoArguments, demo_plan)
