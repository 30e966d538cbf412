# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The control law and when it may act: Section IV."""

from tactile_push.control.joint_rates import (
    JointBounds,
    JointRates,
    check_workspace,
    disk_velocity,
    joint_rates,
)
from tactile_push.control.joint_servo import JointServo, ServoLimits, ServoStep, servo_values
from tactile_push.control.law import AHEAD, PushLaw, finger_velocity, motion_angle, push_angle
from tactile_push.control.limits import Limits, plausible
from tactile_push.control.push_control import PushControl
from tactile_push.control.servo_states import (
    AWAITING_COMMAND,
    COMMAND_SILENT,
    DOES_NOT_FOLLOW,
    FOLLOWING,
    IMPLAUSIBLE_COMMAND,
    JOINT_LIMIT,
    SERVO_HELD,
    SERVO_STATES,
    SERVO_STOP_REASONS,
    SINGULAR_POSE,
)
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
    NOTHING_TO_DO,
    PUSHING,
    STATES,
    STOP_REASONS,
    STOPPED,
    TICKS_LOST,
    WAITING,
    WORKSPACE_LIMIT,
)
from tactile_push.control.steadying import Steadying
from tactile_push.control.steering import Steering
from tactile_push.control.tick_state import Tick, tick_of, tick_values

__all__ = [
    'AHEAD',
    'ANOTHER_COMMAND',
    'AWAITING_COMMAND',
    'CLOCK_JUMPED',
    'COMMAND_SILENT',
    'CONTACT_SILENT',
    'DOES_NOT_FOLLOW',
    'FINGER_UNKNOWN',
    'FOLLOWING',
    'HELD',
    'IMPLAUSIBLE_COMMAND',
    'IMPLAUSIBLE_CONTACT',
    'INACTIVE',
    'JOINT_LIMIT',
    'NOTHING_TO_DO',
    'NO_REASON',
    'PUSHING',
    'SERVO_HELD',
    'SERVO_STATES',
    'SERVO_STOP_REASONS',
    'SINGULAR_POSE',
    'STATES',
    'STOPPED',
    'STOP_REASONS',
    'TICKS_LOST',
    'UNKNOWN',
    'WAITING',
    'WORKSPACE_LIMIT',
    'Drift',
    'JointBounds',
    'JointRates',
    'JointServo',
    'Limits',
    'Outlook',
    'PushControl',
    'PushLaw',
    'ServoLimits',
    'ServoStep',
    'Steadying',
    'Steering',
    'Tick',
    'check_workspace',
    'disk_velocity',
    'finger_velocity',
    'growth_rate',
    'joint_rates',
    'motion_angle',
    'plausible',
    'push_angle',
    'servo_values',
    'settle_step',
    'tick_of',
    'tick_values',
    'time_left',
]
