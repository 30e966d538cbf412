# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `push_controller`, and the control that they make."""

import math
from dataclasses import dataclass

from tactile_push import paper
from tactile_push.control import Limits, PushControl, PushLaw, Steadying, Steering
from tactile_push.control.limits import RETREAT
from tactile_push.interface import LAWS, PUSH, STEER
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.pipeline import Control, Seconds
from tactile_push.tactile import PlanarFinger

LIMITS = Limits()
STEEPEST = 1.5  # largest angle that the edge may be asked to have [rad]; pi/2 faces away


@dataclass(frozen=True)
class PushControllerParameters(NodeParameters):
    """The law, what bounds its commands and stops the finger, and the finger's links."""

    # fmt: off
    law: str = parameter(PUSH, '',
        'what the finger does: push turns the object by the law (18), place brings it to the goals '
        'on place/goal and lets it go there, steer carries it straight ahead at the x of the goal, '
        'settle turns it to the theta of the goal by all that is known, theta_desired until there '
        'is one; counts from the next activation on', choices=LAWS)
    kp: float = parameter(paper.KP, 'rad/rad', 'proportional gain of the law (18)', 0.0, 100.0)
    kd: float = parameter(paper.KD, 'rad/rad', 'derivative gain of the law (18)', 0.0, 1000.0)
    theta_desired: float = parameter(paper.THETA_DESIRED, 'rad',
        'desired angle of the edge', -STEEPEST, STEEPEST)
    steadying_max: float = parameter(0.0, 'rad',
        'largest trim of theta_desired, by which an object with straight edges is carried straight '
        'ahead; 0 trims nothing', 0.0, 0.5)
    edge_distance: float = parameter(paper.BLOCK_L, 'm',
        'distance l from the pushed edge to the centre of mass, for the trim and for telling how '
        'fast a drift grows', 1e-3, 1.0, read_only=True)
    finger_radius: float = shared.finger_radius
    detectable_range: float = parameter(math.pi / 2.0, 'rad',
        'largest angle between the pole and a contact that the sensor detects properly, as in '
        'contact_geometry, which laws with goals do not leave', 0.1, 1.6, read_only=True)
    belt_length: float = parameter(0.3, 'm',
        'belt that there is to place an object, from the first contact on; without having placed '
        'it the finger then stands still', 0.01, 100.0, read_only=True)
    release_delay: float = parameter(0.0, 's',
        'what the finger takes from place/release until the object is free', 0.0, 5.0,
        read_only=True)
    finger_lag: float = shared.finger_lag
    axes: int = parameter(1, '',
        'how many ways the finger can move: 1 across the belt; 2 along it, too, so that law place '
        'leaves the object and touches it elsewhere where no push from the first contact reaches '
        'the goal', 1, 2, read_only=True)
    retreat_max: float = parameter(RETREAT, 'm',
        'how far a finger of two axes may go with the belt, from where it is at the activation',
        0.0, 1.0, read_only=True)
    phi_min: float = parameter(paper.PHI_MIN, 'rad',
        'smallest push angle', 0.1, 1.57, read_only=True)
    phi_max: float = parameter(paper.PHI_MAX, 'rad',
        'largest push angle', 1.58, 3.04, read_only=True)
    belt_speed: float = shared.belt_speed
    control_rate: float = parameter(paper.CONTROL_RATE, 'Hz',
        'control periods a second', 0.1, 200.0, read_only=True)
    contact_timeout: float = parameter(LIMITS.contact_timeout, 's',
        'the finger stops after this long without a contact', 0.01, 10.0)
    max_ticks_lost: int = parameter(LIMITS.max_ticks_lost, '',
        'the finger stops when more control periods in a row pass without a tick', 0, 100)
    max_speed: float = parameter(LIMITS.max_speed, 'm/s', 'largest velocity', 1e-4, 1.0)
    max_acceleration: float = parameter(LIMITS.max_acceleration, 'm/s^2',
        'largest change of the velocity, except to stop', 1e-3, 100.0)
    workspace_min: float = parameter(LIMITS.workspace_min, 'm',
        'where the finger stops moving left, x of its disk in finger_base',
        -10.0, 10.0, read_only=True)
    workspace_max: float = parameter(LIMITS.workspace_max, 'm',
        'where the finger stops moving right, x of its disk in finger_base',
        -10.0, 10.0, read_only=True)
    joint_state_timeout: float = parameter(LIMITS.joint_state_timeout, 's',
        "the finger stops after this long without the finger's position, if there ever were "
        'joint_states, of whatever joints', 0.01, 10.0)
    use_joint_states: bool = parameter(True, '',
        'keep the finger in its workspace, and stop it when its position is unknown; otherwise '
        'joint_states are ignored and no limit of the workspace is kept', read_only=True)
    joint_names: list[str] = parameter(shared.JOINT_NAMES, '',
        'the two moving joints in joint_states, and a wrist that holds the tip straight if there '
        'is one', read_only=True)
    proximal_length: float = shared.proximal_length
    distal_length: float = shared.distal_length
    mount_angle: float = shared.mount_angle
    autostart: bool = shared.autostart
    # fmt: on


def make_control(p: PushControllerParameters) -> PushControl:
    """Make the control with the law (18), inactive.

    Raises
    ------
    ValueError
        If the workspace is empty, the finger has neither two nor three joints, or other values do
        not fit together.
    """
    check_fit(p)
    if not len(p.joint_names) == len(set(p.joint_names)) in (2, 3):
        raise ValueError(f'joint_names: expected two or three different names, got {p.joint_names}')
    limits = Limits(
        workspace_min=p.workspace_min,
        workspace_max=p.workspace_max,
        retreat_max=p.retreat_max if p.axes == 2 else 0.0,
    )
    law = make_law(p)
    steadying = make_steadying(law, p)
    control = PushControl(law, p.belt_speed, 1.0 / p.control_rate, limits, steadying)
    take_values(control, p)
    return control


def make_law(p: PushControllerParameters) -> PushLaw:
    """Make the law (18)."""
    return PushLaw(p.kp, p.kd, p.theta_desired, p.phi_min, p.phi_max)


def make_steadying(law: PushLaw, p: PushControllerParameters) -> Steadying | Steering:
    """Make what trims theta_d for a law (18); steering has no goal yet."""
    if p.law == STEER:
        return Steering(law, p.belt_speed, math.nan, p.edge_distance, p.finger_radius)
    return Steadying(p.steadying_max, p.edge_distance, p.finger_radius)


def choose_law(steps: Control, p: PushControllerParameters, seconds: Seconds) -> None:
    """Let a control begin anew with the law that the parameters name, compiled.

    Parameters
    ----------
    steps, p, seconds : Control, PushControllerParameters, callable
        The control's steps, the parameters, and what returns the time [s] of a stamp.
    """
    push = steps.push
    if p.law == PUSH:
        steps.placing, push.law = None, make_law(p)
    else:
        from tactile_push.parameters.goal_laws import give_law  # which loads the compiler

        steps.placing = give_law(push, p, seconds)
    push.steadying = make_steadying(push.law, p)


def make_finger(p: PushControllerParameters) -> PlanarFinger:
    """Make the finger's two links."""
    return PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle)


def check_fit(p: PushControllerParameters) -> None:
    """Refuse an angle that could be trimmed to a faced-away edge, and what cannot place.

    Raises
    ------
    ValueError
        If values do not fit together.
    """
    if p.law != PUSH and not p.use_joint_states:
        raise ValueError(f'use_joint_states: expected true with law {p.law}, got false')
    if p.law != PUSH and p.steadying_max > 0.0:
        raise ValueError(f'steadying_max: expected 0 with law {p.law}, got {p.steadying_max:g}')
    if p.axes == 2 and not p.max_speed > p.belt_speed:
        raise ValueError(
            f'max_speed: expected more than belt_speed, {p.belt_speed:g} m/s, with 2 axes, '
            f'got {p.max_speed:g}'
        )
    most = STEEPEST - p.steadying_max
    if not abs(p.theta_desired) <= most:
        raise ValueError(
            f'theta_desired: expected -{most:g} to {most:g} rad with a trim of up to '
            f'{p.steadying_max:g} rad, got {p.theta_desired}'
        )


def take_values(control: PushControl, p: PushControllerParameters) -> None:
    """Set the control's values that may change while it runs."""
    limits = control.limits
    control.law.tune(p.kp, p.kd, p.theta_desired)
    if isinstance(control.steadying, Steadying):
        control.steadying.bound = p.steadying_max
    limits.contact_timeout = p.contact_timeout
    limits.joint_state_timeout = p.joint_state_timeout
    limits.max_ticks_lost = p.max_ticks_lost
    limits.max_speed = p.max_speed
    limits.max_acceleration = p.max_acceleration
