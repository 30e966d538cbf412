# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of push_controller, and what the control is made of from them."""

from types import SimpleNamespace

from tactile_push.control import Limits, PushControl, PushLaw
from tactile_push.parameters.finger import LINKS
from tactile_push.parameters.parameter import Parameter

DEFAULT = Limits()

LAW = (
    Parameter('kp', 0.05, 'rad/rad', 'proportional gain of the law (18)', 0.0, 100.0),
    Parameter('kd', 5.0, 'rad/rad', 'derivative gain of the law (18)', 0.0, 1000.0),
    Parameter('theta_desired', -0.17453292519943295, 'rad', 'desired angle of the edge', -1.5, 1.5),
    Parameter(
        'phi_min', 0.5759586531581288, 'rad', 'smallest push angle', 0.1, 1.57, read_only=True
    ),
    Parameter(
        'phi_max', 2.5656340004316647, 'rad', 'largest push angle', 1.58, 3.04, read_only=True
    ),
    Parameter('belt_speed', 0.005, 'm/s', 'speed of the belt', 1e-5, 1.0, read_only=True),
    Parameter('control_rate', 10.0, 'Hz', 'rate of the law', 0.1, 200.0, read_only=True),
)
BOUNDS = (
    Parameter(
        'contact_timeout',
        DEFAULT.contact_timeout,
        's',
        'without contact for so long the finger stops',
        0.01,
        10.0,
    ),
    Parameter(
        'max_ticks_lost',
        DEFAULT.max_ticks_lost,
        '',
        'with more control periods in a row without a tick the finger stops',
        0,
        100,
    ),
    Parameter('max_speed', DEFAULT.max_speed, 'm/s', 'bound on the velocity', 1e-4, 1.0),
    Parameter(
        'max_acceleration',
        DEFAULT.max_acceleration,
        'm/s^2',
        'bound on the change of the velocity, except to stop',
        1e-3,
        100.0,
    ),
)
FINGER = (
    Parameter(
        'workspace_min',
        DEFAULT.workspace_min,
        'm',
        'where the finger stops moving left, x of its disk in finger_base',
        -10.0,
        10.0,
        read_only=True,
    ),
    Parameter(
        'workspace_max',
        DEFAULT.workspace_max,
        'm',
        'where the finger stops moving right, x of its disk in finger_base',
        -10.0,
        10.0,
        read_only=True,
    ),
    Parameter(
        'joint_state_timeout',
        DEFAULT.joint_state_timeout,
        's',
        'without joint_states for so long the finger stops, if there ever were any',
        0.01,
        10.0,
    ),
    Parameter(
        'joint_names',
        ['proximal_joint', 'distal_joint'],
        '',
        'the two moving joints in joint_states',
        read_only=True,
    ),
    *LINKS,
)
PARAMETERS = (
    *LAW,
    *BOUNDS,
    *FINGER,
    Parameter('autostart', True, '', 'configure and activate without a manager', read_only=True),
)


def make_control(p: SimpleNamespace) -> PushControl:
    """Make the control from the values of the parameters.

    Parameters
    ----------
    p : SimpleNamespace
        The values by name.

    Returns
    -------
    PushControl
        The control, inactive.

    Raises
    ------
    ValueError
        If the workspace is empty or the finger has not two joints.
    """
    if not len(p.joint_names) == len(set(p.joint_names)) == 2:
        raise ValueError(f'joint_names: expected two different names, got {p.joint_names}')
    law = PushLaw(p.kp, p.kd, p.theta_desired, p.phi_min, p.phi_max)
    limits = Limits(workspace_min=p.workspace_min, workspace_max=p.workspace_max)
    control = PushControl(law, p.belt_speed, 1.0 / p.control_rate, limits)
    take_values(control, p)
    return control


def take_values(control: PushControl, p: SimpleNamespace) -> None:
    """Let the control know of values that may change while it runs.

    Parameters
    ----------
    control : PushControl
        The control.
    p : SimpleNamespace
        The values by name.
    """
    law, limits = control.law, control.limits
    law.kp, law.kd, law.theta_desired = p.kp, p.kd, p.theta_desired
    limits.contact_timeout = p.contact_timeout
    limits.joint_state_timeout = p.joint_state_timeout
    limits.max_ticks_lost = p.max_ticks_lost
    limits.max_speed = p.max_speed
    limits.max_acceleration = p.max_acceleration
