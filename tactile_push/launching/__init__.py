# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the launch files start: which programs, with which parameters; checked before they start."""

from tactile_push.launching.arguments import DemoArguments, FingerArguments, LaunchArguments
from tactile_push.launching.plan import Plan, Program, demo_plan, finger_plan
from tactile_push.launching.robot import robot_description

__all__ = [
    'DemoArguments',
    'FingerArguments',
    'LaunchArguments',
    'Plan',
    'Program',
    'demo_plan',
    'finger_plan',
    'robot_description',
]
