# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the joint servo can be doing, and why the joints stand."""

from tactile_push.control.states import (
    ANOTHER_COMMAND,
    FINGER_UNKNOWN,
    INACTIVE,
    NO_REASON,
    STOPPED,
    WORKSPACE_LIMIT,
)

# Not asked to act; no command yet; the joints follow it; the joints are held at rest.
AWAITING_COMMAND, FOLLOWING = 'waiting for a command', 'following'
SERVO_STATES = (INACTIVE, AWAITING_COMMAND, FOLLOWING, STOPPED)

# The cause is seen to go away: the servo goes on by itself.
COMMAND_SILENT = 'command silent'
IMPLAUSIBLE_COMMAND = 'implausible command'
JOINT_LIMIT = 'joint limit'
SINGULAR_POSE = 'stretched or folded'
# The cause lies in the machine and may come again: somebody has to look and to activate it anew.
DOES_NOT_FOLLOW = 'finger does not follow'
SERVO_STOP_REASONS = (
    NO_REASON,
    COMMAND_SILENT,
    IMPLAUSIBLE_COMMAND,
    FINGER_UNKNOWN,
    WORKSPACE_LIMIT,
    JOINT_LIMIT,
    SINGULAR_POSE,
    DOES_NOT_FOLLOW,
    ANOTHER_COMMAND,
)
SERVO_HELD = frozenset({DOES_NOT_FOLLOW, ANOTHER_COMMAND})  # until it is activated anew
