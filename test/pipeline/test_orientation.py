# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Rotations about z against the definition of a quaternion: (sin(yaw / 2) z, cos(yaw / 2)).

Covariances against the order of geometry_msgs/PoseWithCovariance: x, y, z, rotations about X, Y, Z.
"""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.pipeline.orientation import (
    covariance_in_space,
    quaternion_of_yaw,
    yaw_of_quaternion,
)

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
HALF = math.sqrt(0.5)


@pytest.mark.parametrize(
    ('degrees', 'z', 'w'),
    [(0, 0, 1), (90, HALF, HALF), (-90, -HALF, HALF), (180, 1, 0), (60, 0.5, math.sqrt(0.75))],
)
def test_known_rotations(degrees, z, w):
    assert quaternion_of_yaw(math.radians(degrees)) == pytest.approx((z, w), abs=1e-15)
    assert math.degrees(yaw_of_quaternion(0.0, 0.0, z, w)) == pytest.approx(degrees)


@given(yaw=st.floats(-100.0, 100.0), length=st.floats(1e-3, 1e3))
@PROPERTY
def test_yaw_comes_back_whatever_the_length_of_the_quaternion(yaw, length):
    z, w = quaternion_of_yaw(yaw)
    assert math.hypot(z, w) == pytest.approx(1.0, abs=1e-12)
    back = yaw_of_quaternion(0.0, 0.0, length * z, length * w)
    assert -math.pi <= back <= math.pi
    assert (math.cos(back), math.sin(back)) == pytest.approx(
        (math.cos(yaw), math.sin(yaw)), abs=1e-12
    )


@given(yaw=st.floats(-3.1, 3.1))
@PROPERTY
def test_both_quaternions_of_a_rotation_give_the_same_yaw(yaw):
    z, w = quaternion_of_yaw(yaw)
    assert yaw_of_quaternion(0.0, 0.0, z, w) == pytest.approx(yaw, abs=1e-12)
    assert yaw_of_quaternion(0.0, 0.0, -z, -w) == pytest.approx(yaw, abs=1e-12)


@given(yaw=st.floats(-10.0, 10.0), x=st.floats(-1.0, 1.0), y=st.floats(-1.0, 1.0))
@PROPERTY
def test_quaternion_turns_a_vector_counterclockwise_by_the_yaw(yaw, x, y):
    z, w = quaternion_of_yaw(yaw)
    # v' = v + 2 q x (q x v + w v) with the vector part q = (0, 0, z)
    inner_x, inner_y = -z * y + w * x, z * x + w * y
    turned = (x - 2.0 * z * inner_y, y + 2.0 * z * inner_x)
    expected = (
        x * math.cos(yaw) - y * math.sin(yaw),
        x * math.sin(yaw) + y * math.cos(yaw),
    )
    assert turned == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ('z', 'w'),
    [(0.0, 0.0), (math.nan, 1.0), (0.0, math.nan), (math.inf, 1.0), (0.0, -math.inf)],
)
def test_components_that_are_no_rotation_give_no_yaw(z, w):
    assert math.isnan(yaw_of_quaternion(0.0, 0.0, z, w))


@pytest.mark.parametrize(
    ('x', 'y'), [(HALF, 0.0), (0.0, 0.01), (-0.01, 0.0), (math.nan, 0.0), (0.0, math.inf)]
)
def test_rotation_about_a_leaning_axis_has_no_yaw(x, y):
    assert math.isnan(yaw_of_quaternion(x, y, HALF, HALF))


@pytest.mark.parametrize(('x', 'y'), [(1e-9, 0.0), (0.0, -1e-6), (0.0, 0.0)])
def test_what_rounding_leaves_of_x_and_y_does_no_harm(x, y):
    assert yaw_of_quaternion(x, y, HALF, HALF) == pytest.approx(math.pi / 2.0)
    assert yaw_of_quaternion(1e3 * x, 1e3 * y, 1e3, 1e3) == pytest.approx(math.pi / 2.0)


def test_covariance_in_space_has_the_planar_one_in_its_rows_of_x_y_and_yaw():
    numbers = covariance_in_space([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])
    assert [numbers[row * 6 : row * 6 + 6] for row in range(6)] == [
        [1.0, 2.0, 0.0, 0.0, 0.0, 3.0],
        [4.0, 5.0, 0.0, 0.0, 0.0, 6.0],
        [0.0] * 6,
        [0.0] * 6,
        [0.0] * 6,
        [7.0, 8.0, 0.0, 0.0, 0.0, 9.0],
    ]
