# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says what to install where ROS 2 is needed and missing."""

import sys
from importlib.util import find_spec


def ros_is_missing(who: str) -> bool:
    """Return whether Python finds no ROS 2, and print what the command or node needs if so."""
    if find_spec('rclpy') is not None:
        return False
    print(
        f'{who}: needs ROS 2: source a ROS 2 workspace, or on x86-64 Linux '
        "pip install 'tactile_push[ros]'",
        file=sys.stderr,
    )
    return True
