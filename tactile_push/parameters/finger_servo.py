# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `finger_servo`, and the servo that they make."""

from dataclasses import dataclass

from tactile_push.control import JointBounds, JointServo, ServoLimits
from tactile_push.control.joint_rates import Arm
from tactile_push.interface import KINEMATICS, LINEAR, PLANAR
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.tactile import LinearAxis, PlanarFinger

BOUNDS = JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0))
LIMITS = ServoLimits()
JOINTS = {PLANAR: 2, LINEAR: 1}


@dataclass(frozen=True)
class FingerServoParameters(NodeParameters):
    """The finger's joints and what they allow, and when they have to stand."""

    # fmt: off
    kinematics: str = parameter(PLANAR, '',
        'planar: two joints turn the links of the finger; linear: one joint slides along x of '
        'finger_base', choices=KINEMATICS, read_only=True)
    joint_names: list[str] = parameter(shared.JOINT_NAMES, '',
        'the joints in joint_states, in the order in which the velocity controller has them',
        read_only=True)
    proximal_length: float = shared.proximal_length
    distal_length: float = shared.distal_length
    mount_angle: float = shared.mount_angle
    joint_min: list[float] = parameter(list(BOUNDS.joint_min), 'rad',
        'where each joint stops moving down; m if it slides', read_only=True)
    joint_max: list[float] = parameter(list(BOUNDS.joint_max), 'rad',
        'where each joint stops moving up; m if it slides', read_only=True)
    joint_speed: list[float] = parameter(list(BOUNDS.joint_speed), 'rad/s',
        'greatest speed of each joint; m/s if it slides', read_only=True)
    workspace_min: float = parameter(BOUNDS.workspace_min, 'm',
        'where the finger stops moving left, x of its disk in finger_base',
        -10.0, 10.0, read_only=True)
    workspace_max: float = parameter(BOUNDS.workspace_max, 'm',
        'where the finger stops moving right, x of its disk in finger_base',
        -10.0, 10.0, read_only=True)
    least_manipulability: float = parameter(BOUNDS.least_manipulability, '',
        'sine of the angle of the second joint below which the finger, nearly stretched or folded, '
        'only moves where it grows', 0.01, 0.9, read_only=True)
    max_speed: float = parameter(BOUNDS.max_speed, 'm/s',
        'largest velocity across the belt, and back to the line', 1e-4, 1.0, read_only=True)
    line_gain: float = parameter(LIMITS.line_gain, '1/s',
        'rate at which the disk goes back to its line across the belt', 0.01, 20.0)
    command_timeout: float = parameter(LIMITS.command_timeout, 's',
        'the joints stand after this long without a command', 0.01, 10.0)
    joint_state_timeout: float = parameter(LIMITS.joint_state_timeout, 's',
        'the joints stand after this long without joint states', 0.01, 10.0)
    follow_tolerance: float = parameter(LIMITS.follow_tolerance, 'm',
        'the finger stops until it is activated anew when its disk is so far from where the '
        'commands of the last centimetre should have brought it', 1e-4, 1.0)
    rate: float = parameter(50.0, 'Hz',
        'velocities a second at the least; there are new ones at each joint state and command, too',
        10.0, 1000.0, read_only=True)
    autostart: bool = shared.autostart
    # fmt: on


def make_servo(p: FingerServoParameters) -> JointServo:
    """Make the servo, inactive.

    Raises
    ------
    ValueError
        If there are not as many names and limits as joints, or the limits leave no workspace.
    """
    joints = JOINTS[p.kinematics]
    if not len(p.joint_names) == len(set(p.joint_names)) == joints:
        raise ValueError(
            f'joint_names: expected {joints} {"different names" if joints > 1 else "name"} for '
            f'{p.kinematics} kinematics, got {p.joint_names}'
        )
    if len(p.joint_min) != joints:
        raise ValueError(
            f'joint_min: expected a number for each of {p.joint_names}, got {p.joint_min}'
        )
    arm: Arm = LinearAxis()
    if p.kinematics == PLANAR:
        arm = PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle)
    bounds = JointBounds(
        *(tuple(p.joint_min), tuple(p.joint_max), tuple(p.joint_speed)),
        *(p.workspace_min, p.workspace_max, p.max_speed, p.least_manipulability),
    )
    return JointServo(arm, bounds, make_limits(p))


def make_limits(p: FingerServoParameters) -> ServoLimits:
    """Return what may change while the servo runs."""
    return ServoLimits(p.line_gain, p.command_timeout, p.joint_state_timeout, p.follow_tolerance)
