# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the controller can be doing, and why it stops."""

# Not asked to act; no contact yet; the law acts; the finger is held at rest.
INACTIVE, WAITING, PUSHING, STOPPED = 'inactive', 'waiting for contact', 'pushing', 'stopped'
STATES = (INACTIVE, WAITING, PUSHING, STOPPED)

NO_REASON = ''
# The cause lies in the world and is seen to go away: the controller resumes on its own.
CONTACT_SILENT = 'contact silent'
IMPLAUSIBLE_CONTACT = 'implausible contact'
WORKSPACE_LIMIT = 'workspace limit'
FINGER_UNKNOWN = 'finger position unknown'
# The cause lies in the machine and may come again: somebody has to look before it resumes.
TICKS_LOST = 'ticks lost'
CLOCK_JUMPED = 'clock jumped'
ANOTHER_COMMAND = 'another command'
# Nothing is wrong: the law rests until somebody gives it a goal.
NOTHING_TO_DO = 'nothing to do'
STOP_REASONS = (
    NO_REASON,
    CONTACT_SILENT,
    IMPLAUSIBLE_CONTACT,
    WORKSPACE_LIMIT,
    FINGER_UNKNOWN,
    TICKS_LOST,
    CLOCK_JUMPED,
    ANOTHER_COMMAND,
    NOTHING_TO_DO,
)
HELD = frozenset({TICKS_LOST, CLOCK_JUMPED, ANOTHER_COMMAND})  # until somebody says to resume
