# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The control law and when it may act: Section IV."""

from tactile_push.control.law import AHEAD, PushLaw, finger_velocity, motion_angle, push_angle
from tactile_push.control.limits import Limits, plausible
from tactile_push.control.push_control import PushControl, Tick
from tactile_push.control.settling import settle_step
from tactile_push.control.slow_mode import UNKNOWN, Drift, Outlook, growth_rate, time_left
from tactile_push.control.states import (
    ANOTHER_COMMAND,
    CLOCK_JUMPED,
    CONTACT_SILENT,
    FINGER_UNKNOWN,
    HELD,
    IMPLAUSIBLE_CONTACT,
    INACTIVE,
    NO_REASON,
    PUSHING,
    STATES,
    STOP_REASONS,
    STOPPED,
    TICKS_LOST,
    WAITING,
    WORKSPACE_LIMIT,
)
from tactile_push.control.steadying import Steadying
from tactile_push.control.tick_state import tick_of, tick_values

__all__ = [
    'AHEAD',
    'ANOTHER_COMMAND',
    'CLOCK_JUMPED',
    'CONTACT_SILENT',
    'FINGER_UNKNOWN',
    'HELD',
    'IMPLAUSIBLE_CONTACT',
    'INACTIVE',
    'NO_REASON',
    'PUSHING',
    'STATES',
    'STOPPED',
    'STOP_REASONS',
    'TICKS_LOST',
    'UNKNOWN',
    'WAITING',
    'WORKSPACE_LIMIT',
    'Drift',
    'Limits',
    'Outlook',
    'PushControl',
    'PushLaw',
    'Steadying',
    'Tick',
    'finger_velocity',
    'growth_rate',
    'motion_angle',
    'plausible',
    'push_angle',
    'settle_step',
    'tick_of',
    'tick_values',
    'time_left',
]
