# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.tactile.sphere import angles_between, angles_of, directions_of

checked = settings(derandomize=True, deadline=None, max_examples=200)


def test_left_up_and_pole_are_the_axes_of_the_tip():
    found = directions_of([0.0, math.pi / 2.0, 1.0], [0.0, 0.0, math.pi / 2.0])
    assert found == pytest.approx(np.eye(3), abs=1e-15)


@checked
@given(st.floats(-3.14, 3.14), st.floats(-1.57, 1.57))
def test_angles_come_back(azimuth, elevation):
    found = angles_of(directions_of(azimuth, elevation))
    assert found == pytest.approx((azimuth, elevation), abs=1e-12)


def test_worked_example_of_the_conventions():
    # docs/conventions.md: theta = 20 degrees ahead is azimuth 0, elevation 70 degrees, on the left.
    x, y, z = directions_of(0.0, math.radians(70.0))
    assert (x, y, z) == pytest.approx((math.sin(math.radians(20.0)), 0.0, math.cos(0.349066)))


@checked
@given(st.floats(0.0, math.pi), st.floats(-3.14, 3.14))
def test_angle_between_is_the_turn_about_any_axis(angle, azimuth):
    turned = np.array([math.sin(angle), 0.0, math.cos(angle)])
    c, s = math.cos(azimuth), math.sin(azimuth)
    about_pole = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    found = angles_between(about_pole @ turned, [0.0, 0.0, 1.0])
    assert found == pytest.approx(angle, abs=1e-12)


def test_tiny_angles_are_exact_where_an_arc_cosine_is_not():
    angle = 1e-9
    found = angles_between([math.sin(angle), 0.0, math.cos(angle)], [0.0, 0.0, 1.0])
    assert found == pytest.approx(angle, rel=1e-6)
    assert math.acos(math.cos(angle)) == 0.0
