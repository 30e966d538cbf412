# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.sphere import directions_of

checked = settings(derandomize=True, deadline=None, max_examples=200)
SLOPE = 100.0  # of the lens [px/rad]
UPRIGHT = (math.pi, 0.0, 0.0)  # the image's right is the tip's right, azimuth pi
BELOW, MIDDLE = (0.0, 0.0, -1.0), (0.0, 0.0, 0.0)
LEFT, UP, RIGHT = 0.0, math.pi / 2.0, math.pi


def upright(eye=BELOW, rotation=UPRIGHT, radial=(SLOPE, 0.0, 0.0)):
    return DomeCamera(400, 300, (200.0, 150.0), rotation, radial, eye)


def from_pole(azimuth, angle):
    """Return the direction at an angle from the pole."""
    return directions_of(azimuth, math.pi / 2.0 - angle)


def test_left_of_the_tip_is_left_in_an_upright_image_and_up_is_up():
    camera = upright(MIDDLE)
    assert camera.pixels(from_pole(LEFT, 0.3)) == pytest.approx((170.0, 150.0))
    assert camera.pixels(from_pole(UP, 0.3)) == pytest.approx((200.0, 120.0))
    assert camera.pixels(from_pole(RIGHT, 0.3)) == pytest.approx((230.0, 150.0))


def test_camera_in_the_middle_sees_angles_from_the_pole():
    camera = upright(MIDDLE, radial=(90.0, -4.0, 2.0))
    found = camera.pixels(from_pole(RIGHT, 1.2))[0] - 200.0
    assert found == pytest.approx(90.0 * 1.2 - 4.0 * 1.2**3 + 2.0 * 1.2**5)


def test_camera_opposite_to_the_pole_sees_half_the_angles():
    # The angle at the circumference is half the angle at the centre.
    found = upright(BELOW).pixels(from_pole(RIGHT, 1.2))[0] - 200.0
    assert found == pytest.approx(SLOPE * 0.6)


def test_roll_is_the_azimuth_of_the_images_right():
    camera = upright(MIDDLE, (0.4, 0.0, 0.0))
    assert camera.pixels(from_pole(0.4, 0.5)) == pytest.approx((250.0, 150.0))
    assert camera.pixels(from_pole(0.4 + math.pi / 2.0, 0.5)) == pytest.approx((200.0, 200.0))


def test_camera_that_looks_up_sees_the_pole_below_and_one_that_looks_right_sees_it_on_the_left():
    about_right, about_down = (math.pi, 0.1, 0.0), (math.pi, 0.0, 0.1)
    pole = from_pole(0.0, 0.0)
    assert upright(MIDDLE, about_right).pixels(pole) == pytest.approx((200.0, 160.0))
    assert upright(MIDDLE, about_down).pixels(pole) == pytest.approx((190.0, 150.0))


def test_eye_beside_the_axis_sees_the_pole_on_the_other_side():
    camera = upright((0.1, 0.0, -1.0))  # to the left of the axis
    assert camera.pixels(from_pole(0.0, 0.0)) == pytest.approx(
        (200.0 + SLOPE * math.atan(0.1 / 2.0), 150.0)
    )


@checked
@given(
    st.floats(-3.0, 3.0),
    st.floats(0.0, 1.57),
    st.floats(-3.0, 3.0),
    st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)),
    st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-3.0, 0.2)),
    st.tuples(st.floats(-0.1, 0.2), st.floats(-0.01, 0.05)),
)
def test_direction_of_a_pixel_is_where_the_point_was(azimuth, elevation, roll, tilts, eye, bends):
    camera = upright(eye, (roll, *tilts), (SLOPE, bends[0] * SLOPE, bends[1] * SLOPE))
    direction = directions_of(azimuth, elevation)
    assert camera.directions(camera.pixels(direction)) == pytest.approx(direction, abs=1e-8)


def test_past_the_sphere_there_is_nothing():
    far = upright((0.0, 0.0, -3.0))
    # From three radii away the sphere fills asin(1/3) around its middle.
    edge = SLOPE * math.asin(1.0 / 3.0)
    inside, outside = far.directions([(200.0 + edge - 0.1, 150.0), (200.0 + edge + 0.1, 150.0)])
    assert np.isfinite(inside).all()
    assert np.isnan(outside).all()


def test_where_the_polynomial_turns_back_there_is_nothing():
    turning = upright(MIDDLE, radial=(SLOPE, -SLOPE / 3.0, 0.0))  # which grows up to 1 rad
    inside, outside = turning.directions([(200.0 + 66.0, 150.0), (200.0 + 67.0, 150.0)])
    assert np.isfinite(inside).all()
    assert np.isnan(outside).all()


@pytest.mark.parametrize('alpha', [0.0, 0.7, 1.4])
def test_solid_angle_of_a_pixel(alpha):
    # sin(alpha) d alpha d phi over SLOPE^2 alpha d alpha d phi
    expected = (math.sin(alpha) / alpha if alpha else 1.0) / SLOPE**2
    found = upright(MIDDLE).solid_angle(200.0 + SLOPE * alpha, 150.0)
    assert found == pytest.approx(expected, rel=1e-4)


def test_dome_reaches_to_its_rim():
    camera = replace(upright(MIDDLE), radial=(80.0, 0.0, 0.0))
    assert np.count_nonzero(camera.dome()) == pytest.approx(
        math.pi * (80.0 * math.pi / 2.0) ** 2, rel=1e-3
    )
