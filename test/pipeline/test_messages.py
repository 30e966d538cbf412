# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which number stands in which field of a message."""

import math

import numpy as np
import pytest

from tactile_push.pipeline import messages

STAMP = (1_795_000_000, 5)


def header(frame):
    return {'stamp': {'sec': 1_795_000_000, 'nanosec': 5}, 'frame_id': frame}


def test_joint_state_has_names_and_positions_in_the_given_order():
    assert messages.joint_state_fields(STAMP, {'theta': 0.5, 'd': -1.0}) == {
        'header': header(''),
        'name': ['theta', 'd'],
        'position': [0.5, -1.0],
    }


@pytest.mark.parametrize(
    ('theta', 'z', 'w'),
    [
        (0.0, 0.0, 1.0),
        (math.pi / 2.0, math.sqrt(0.5), math.sqrt(0.5)),
        (-math.pi / 3.0, -0.5, math.sqrt(0.75)),
    ],
)
def test_contact_is_a_pose_turned_about_z_in_the_frame_of_the_finger(theta, z, w):
    fields = messages.pose_fields(STAMP, 0.1, -0.2, theta)
    assert fields['header'] == header('finger_disk')
    assert fields['pose']['position'] == {'x': 0.1, 'y': -0.2}
    assert fields['pose']['orientation'] == pytest.approx({'z': z, 'w': w})


def test_a_goal_is_a_pose_turned_about_z_in_the_frame_of_the_machine():
    fields = messages.place_goal_fields(STAMP, -0.05, math.pi / 2.0)
    assert fields['header'] == header('finger_base')
    assert fields['pose']['position'] == {'x': -0.05, 'y': 0.0}
    assert fields['pose']['orientation'] == pytest.approx(
        {'z': math.sqrt(0.5), 'w': math.sqrt(0.5)}
    )


def test_command_is_a_velocity_across_and_along_the_belt():
    assert messages.command_fields(STAMP, 0.002, -0.003) == {
        'header': header('finger_base'),
        'twist': {'linear': {'x': 0.002, 'y': -0.003}},
    }


def test_pose_of_the_object_has_its_covariance_at_x_y_and_rotation_about_z():
    covariance = np.arange(1.0, 10.0).reshape(3, 3)
    fields = messages.object_pose_fields(STAMP, np.array([0.1, -0.2, math.pi / 3.0]), covariance)
    assert fields['header'] == header('finger_disk')
    pose = fields['pose']
    assert pose['pose']['position'] == {'x': 0.1, 'y': -0.2}
    assert pose['pose']['orientation'] == pytest.approx({'z': 0.5, 'w': math.sqrt(0.75)})
    expected = np.zeros((6, 6))  # of x, y, z and the rotations about x, y, z
    expected[:2, :2] = [[1.0, 2.0], [4.0, 5.0]]
    expected[:2, 5], expected[5, :2], expected[5, 5] = [3.0, 6.0], [7.0, 8.0], 9.0
    assert pose['covariance'] == expected.ravel().tolist()
