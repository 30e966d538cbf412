# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A finger on a machine, as config/hardware.yaml describes it, or its simulation."""

from launch import LaunchDescription

from tactile_push.launching.actions import launch_description
from tactile_push.launching.arguments import FingerArguments
from tactile_push.launching.plan import finger_plan


def generate_launch_description() -> LaunchDescription:
    return launch_description(FingerArguments, finger_plan)
