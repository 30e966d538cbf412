# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest

from tactile_push.control import JointBounds, ServoLimits
from tactile_push.parameters import FingerServoParameters
from tactile_push.parameters.finger_servo import make_servo

AXIS = {
    'kinematics': 'linear',
    'joint_names': ['slide'],
    'joint_min': [-0.1],
    'joint_max': [0.1],
    'joint_speed': [0.05],
}


def test_defaults_are_those_of_the_servo():
    servo = make_servo(FingerServoParameters())
    assert servo.bounds == JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0))
    assert servo.limits == ServoLimits()


def test_every_value_reaches_the_servo():
    given = {
        'joint_min': [-1.0, -2.0],
        'joint_max': [2.0, -0.5],
        'joint_speed': [0.3, 0.4],
        'workspace_min': -0.08,
        'workspace_max': 0.02,
        'max_speed': 0.01,
        'least_manipulability': 0.3,
        'line_gain': 4.0,
        'command_timeout': 0.3,
        'joint_state_timeout': 0.1,
        'follow_tolerance': 0.001,
    }
    servo = make_servo(FingerServoParameters.of(given))
    bounds = JointBounds((-1.0, -2.0), (2.0, -0.5), (0.3, 0.4), -0.08, 0.02, 0.01, 0.3)
    assert servo.bounds == bounds
    assert servo.limits == ServoLimits(4.0, 0.3, 0.1, 0.001)


def test_an_axis_has_one_joint():
    assert make_servo(FingerServoParameters.of(AXIS)).bounds.joint_speed == (0.05,)


@pytest.mark.parametrize(
    ('given', 'reason'),
    [
        ({'joint_names': ['a']}, 'joint_names: expected 2 different names for planar'),
        ({'joint_names': ['a', 'a']}, 'joint_names: expected 2 different names'),
        ({**AXIS, 'joint_names': ['a', 'b']}, 'joint_names: expected 1 name for linear'),
        ({'joint_min': [-1.0]}, r"joint_min: expected a number for each of \['proximal_joint'"),
        ({'joint_speed': [1.0]}, 'joint_speed: expected a number for each of the 2 joints'),
        ({'joint_min': [1.0, -3.0], 'joint_max': [0.5, 3.0]}, 'joint_min: expected less than'),
        ({'joint_min': [-3.0, -0.1], 'joint_max': [3.0, 0.1]}, 'joint_min: expected a pose'),
        ({'workspace_min': 0.2}, 'workspace_min: expected less'),
        ({**AXIS, 'workspace_min': 0.11, 'workspace_max': 0.2}, 'joint_min: expected x between'),
    ],
)
def test_joints_that_are_none_are_refused_with_a_reason(given, reason):
    with pytest.raises(ValueError, match=f'^{reason}'):
        make_servo(FingerServoParameters.of(given))
