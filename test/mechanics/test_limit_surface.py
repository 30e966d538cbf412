# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import EllipsoidalLimitSurface

checked = settings(derandomize=True, deadline=None, max_examples=50)
maxima = st.floats(0.01, 100.0)
angles = st.floats(-math.pi, math.pi)
latitudes = st.floats(-math.pi / 2.0, math.pi / 2.0)


def point_on_ellipsoid(f_max, m_max, longitude, latitude):
    return np.array(
        [
            f_max * math.cos(latitude) * math.cos(longitude),
            f_max * math.cos(latitude) * math.sin(longitude),
            m_max * math.sin(latitude),
        ]
    )


def left_side_of_3(wrench, f_max, m_max):
    f_x, f_y, m = wrench
    return (f_x / f_max) ** 2 + (f_y / f_max) ** 2 + (m / m_max) ** 2


def test_c_is_the_ratio_of_the_maxima():
    assert EllipsoidalLimitSurface(f_max=4.0, m_max=0.1).c == 0.025


@pytest.mark.parametrize(
    ('wrench', 'level'),
    [
        ((0.0, 0.0, 0.0), 0.0),
        ((2.0, 0.0, 0.0), 1.0),
        ((0.0, -2.0, 0.0), 1.0),
        ((0.0, 0.0, 0.5), 1.0),
        ((0.0, 0.0, -1.0), 4.0),
        ((1.0, -1.0, 0.25), 0.75),
    ],
)
def test_the_level_is_the_left_side_of_3(wrench, level):
    assert EllipsoidalLimitSurface(f_max=2.0, m_max=0.5).level(wrench) == level


@checked
@given(maxima, maxima, angles, latitudes)
def test_wrenches_on_the_ellipsoid_have_level_1(f_max, m_max, longitude, latitude):
    wrench = point_on_ellipsoid(f_max, m_max, longitude, latitude)

    assert EllipsoidalLimitSurface(f_max, m_max).level(wrench) == pytest.approx(1.0, rel=1e-14)


@checked
@given(maxima, maxima, angles, latitudes)
def test_the_twist_is_the_outward_normal_of_the_ellipsoid(f_max, m_max, longitude, latitude):
    wrench = point_on_ellipsoid(f_max, m_max, longitude, latitude)
    gradient = np.empty(3)
    for i, step in enumerate((1e-4 * f_max, 1e-4 * f_max, 1e-4 * m_max)):
        offset = np.zeros(3)
        offset[i] = step
        gradient[i] = (
            left_side_of_3(wrench + offset, f_max, m_max)
            - left_side_of_3(wrench - offset, f_max, m_max)
        ) / (2.0 * step)

    twist = EllipsoidalLimitSurface(f_max, m_max).twist(wrench)

    # Parallel and the same way round, each component on the scale of its own axis.
    scale = np.array([f_max, f_max, m_max])
    rates, normal = scale * twist, scale * gradient
    np.testing.assert_allclose(
        rates / np.linalg.norm(rates), normal / np.linalg.norm(normal), atol=1e-10
    )


@checked
@given(maxima, maxima, angles, st.floats(0.01, 1.56), st.sampled_from([-1.0, 1.0]))
def test_velocities_relate_to_forces_by_4_and_5(f_max, m_max, longitude, latitude, side):
    f_x, f_y, m = point_on_ellipsoid(f_max, m_max, longitude, side * latitude)
    c = m_max / f_max

    v_x, v_y, omega = EllipsoidalLimitSurface(f_max, m_max).twist((f_x, f_y, m))

    assert v_x / omega == pytest.approx(c**2 * f_x / m, rel=1e-12)
    assert v_y / omega == pytest.approx(c**2 * f_y / m, rel=1e-12)


@checked
@given(maxima, maxima, angles, latitudes)
def test_a_wrench_gives_a_twist_that_gives_it_back(f_max, m_max, longitude, latitude):
    surface = EllipsoidalLimitSurface(f_max, m_max)
    wrench = point_on_ellipsoid(f_max, m_max, longitude, latitude)

    back = surface.wrench(surface.twist(wrench))

    np.testing.assert_allclose(
        back / [f_max, f_max, m_max], wrench / [f_max, f_max, m_max], atol=1e-14
    )


@checked
@given(maxima, maxima, st.tuples(*[st.floats(-10.0, 10.0)] * 3), angles, latitudes)
def test_the_wrench_of_a_motion_resists_it_most(f_max, m_max, twist, longitude, latitude):
    twist = np.array(twist) + [0.0, 0.0, 20.0]
    surface = EllipsoidalLimitSurface(f_max, m_max)

    wrench = surface.wrench(twist)

    assert left_side_of_3(wrench, f_max, m_max) == pytest.approx(1.0, rel=1e-14)
    # The greatest power over the ellipsoid is its support function.
    greatest = math.hypot(f_max * twist[0], f_max * twist[1], m_max * twist[2])
    assert wrench @ twist == pytest.approx(greatest, rel=1e-12)
    other = point_on_ellipsoid(f_max, m_max, longitude, latitude)
    assert wrench @ twist >= other @ twist - 1e-12 * greatest


@pytest.mark.parametrize(
    ('twist', 'wrench'),
    [
        ((0.3, 0.0, 0.0), (2.0, 0.0, 0.0)),
        ((0.0, -5.0, 0.0), (0.0, -2.0, 0.0)),
        ((0.0, 0.0, 0.1), (0.0, 0.0, 0.5)),
        ((0.0, 0.0, -9.0), (0.0, 0.0, -0.5)),
    ],
)
def test_pure_motions_meet_the_maxima(twist, wrench):
    surface = EllipsoidalLimitSurface(f_max=2.0, m_max=0.5)

    np.testing.assert_allclose(surface.wrench(twist), wrench, rtol=1e-15)


def test_the_speed_does_not_change_the_wrench():
    surface = EllipsoidalLimitSurface(f_max=2.0, m_max=0.5)

    slow, fast = surface.wrench((1e-6, -2e-6, 3e-6)), surface.wrench((1e3, -2e3, 3e3))

    np.testing.assert_allclose(slow, fast, rtol=1e-14)


def test_a_resting_object_does_not_tell_its_wrench():
    with pytest.raises(ValueError, match='twist'):
        EllipsoidalLimitSurface(2.0, 0.5).wrench((0.0, 0.0, 0.0))


@pytest.mark.parametrize('value', [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize('name', ['f_max', 'm_max'])
def test_maxima_that_are_no_ellipsoid_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        dataclasses.replace(EllipsoidalLimitSurface(1.0, 1.0), **{name: value})
