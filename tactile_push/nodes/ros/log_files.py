# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Lets a node start where ROS cannot write a log file."""

import os
from pathlib import Path

from tactile_push.streams import complain

WITHOUT = ['--ros-args', '--disable-external-lib-logs']


def log_arguments(node: str) -> list[str]:
    """Return the ROS arguments with which logging starts here, and say if that is without a file.

    rcl ends the process if it cannot make its folder, which is found as rcl_logging_interface finds
    it (rcl_logging_interface/src/logging_dir.c).
    """
    named, home = os.environ.get('ROS_LOG_DIR'), os.environ.get('HOME')
    ros_home = os.environ.get('ROS_HOME') or (home and f'{home}/.ros')
    folder = named or (ros_home and f'{ros_home}/log')
    if not folder:
        reason = 'none of ROS_LOG_DIR, ROS_HOME and HOME names a folder'
    else:
        try:
            Path(folder).expanduser().mkdir(parents=True, exist_ok=True)
        except (OSError, RuntimeError) as error:  # the latter without a home
            reason = f'{folder}: {getattr(error, "strerror", None) or error}'
        else:
            if os.access(folder, os.W_OK):
                return []
            reason = f'{folder}: cannot be written'
    complain(node, f'no log file: {reason}')
    return WITHOUT
