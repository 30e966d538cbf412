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

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import c_points, c_uniform_circle, c_uniform_rectangle

checked = settings(derandomize=True, deadline=None, max_examples=30)
lengths = st.floats(1e-3, 1.0)
coordinates = st.floats(-1.0, 1.0)


def mean_distance_in_rectangle(width, height):
    # Gauss-Legendre on a quarter, in polar coordinates: the radial integral of rho^2 is exact.
    node, weight = np.polynomial.legendre.leggauss(60)
    corner = math.atan2(height, width)
    total = 0.0
    for start, stop, reach in (
        (0.0, corner, lambda angle: width / 2.0 / np.cos(angle)),
        (corner, math.pi / 2.0, lambda angle: height / 2.0 / np.sin(angle)),
    ):
        angle = start + (stop - start) * (node + 1.0) / 2.0
        total += (stop - start) / 2.0 * weight @ (reach(angle) ** 3 / 3.0)
    return total / (width * height / 4.0)


def test_the_papers_block_on_its_corners_has_a_c_of_3_45_cm():
    corners = [(x, y) for x in (-0.025, 0.025) for y in (-0.02375, 0.02375)]

    assert round(100.0 * c_points(corners), 2) == 3.45


def test_the_papers_block_with_uniform_support_has_a_c_of_1_87_cm():
    assert round(100.0 * c_uniform_rectangle(0.05, 0.0475), 2) == 1.87


def test_uniform_support_in_a_circle_of_1_cm_has_a_c_of_0_67_cm():
    assert round(100.0 * c_uniform_circle(0.01), 2) == 0.67


@pytest.mark.parametrize(
    ('points', 'weights', 'c'),
    [
        ([(0.03, 0.04)], None, 0.05),
        ([(0.0, 0.0)], None, 0.0),
        ([(0.03, 0.04), (-0.12, 0.05)], None, 0.09),
        ([(0.03, 0.04), (-0.12, 0.05)], [3.0, 1.0], 0.07),
        ([(0.03, 0.04), (-0.12, 0.05)], [0.0, 7.0], 0.13),
    ],
)
def test_points_give_the_mean_distance_weighted_by_their_load(points, weights, c):
    assert c_points(points, weights) == pytest.approx(c, rel=1e-14, abs=1e-18)


@checked
@given(
    st.lists(st.tuples(coordinates, coordinates, st.floats(0.01, 10.0)), min_size=1, max_size=20),
    st.floats(0.1, 50.0),
    st.floats(0.1, 2.0),
)
def test_c_is_m_max_over_f_max_whatever_friction_and_weight(feet, weight, mu_s):
    load = sum(share for _, _, share in feet)
    m_max = mu_s * sum(weight * share / load * math.sqrt(x * x + y * y) for x, y, share in feet)
    f_max = mu_s * weight

    c = c_points([(x, y) for x, y, _ in feet], [share for _, _, share in feet])

    assert c == pytest.approx(m_max / f_max, rel=1e-12, abs=1e-150)


@checked
@given(lengths)
def test_a_circle_agrees_with_the_integral_over_its_rings(radius):
    # The midpoints of 1000 rings, each with its own circumference: 1/4e6 too small.
    rho = (np.arange(1000) + 0.5) / 1000.0 * radius

    assert c_uniform_circle(radius) == pytest.approx(rho @ rho / rho.sum(), rel=3e-7)


@checked
@given(st.floats(0.02, 0.1), st.floats(0.02, 0.1))
def test_a_rectangle_agrees_with_the_integral_of_the_distance(width, height):
    expected = mean_distance_in_rectangle(width, height)

    assert c_uniform_rectangle(width, height) == pytest.approx(expected, rel=1e-12)


def test_the_papers_block_agrees_with_brute_force_over_a_grid():
    x = ((np.arange(1000) + 0.5) / 1000.0 - 0.5) * 0.05
    y = ((np.arange(1000) + 0.5) / 1000.0 - 0.5) * 0.0475

    grid = np.hypot(x[:, None], y[None, :]).mean()

    assert c_uniform_rectangle(0.05, 0.0475) == pytest.approx(grid, rel=1e-6)


def test_a_square_has_the_known_mean_distance_from_its_centre():
    expected = (math.sqrt(2.0) + math.log(1.0 + math.sqrt(2.0))) / 6.0

    assert c_uniform_rectangle(1.0, 1.0) == pytest.approx(expected, rel=1e-14)


def test_a_thin_rectangle_becomes_a_segment_with_a_quarter_of_its_length():
    assert c_uniform_rectangle(0.1, 1e-9) == pytest.approx(0.025, rel=1e-6)
    assert c_uniform_rectangle(1e-9, 0.1) == pytest.approx(0.025, rel=1e-6)


@checked
@given(lengths, lengths, st.floats(0.01, 100.0))
def test_c_scales_with_the_object_and_does_not_care_which_side_is_which(width, height, scale):
    c = c_uniform_rectangle(width, height)

    assert c_uniform_rectangle(height, width) == pytest.approx(c, rel=1e-14)
    assert c_uniform_rectangle(scale * width, scale * height) == pytest.approx(scale * c, rel=1e-12)


@pytest.mark.parametrize(
    'points', [[], [1.0, 2.0], [(1.0, 2.0, 3.0)], [(math.nan, 0.0)], [(0.0, math.inf)]]
)
def test_points_that_are_none_are_refused(points):
    with pytest.raises(ValueError, match='points'):
        c_points(points)


@pytest.mark.parametrize(
    'weights',
    [[1.0], [1.0, 1.0, 1.0], [0.0, 0.0], [1.0, -0.5], [1.0, math.nan], [math.inf, 1.0], 1.0],
)
def test_weights_that_are_no_load_are_refused(weights):
    with pytest.raises(ValueError, match='weights'):
        c_points([(0.0, 1.0), (1.0, 0.0)], weights)


@pytest.mark.parametrize('length', [0.0, -0.01, math.nan, math.inf])
def test_lengths_that_are_none_are_refused(length):
    with pytest.raises(ValueError, match='radius'):
        c_uniform_circle(length)
    with pytest.raises(ValueError, match='width'):
        c_uniform_rectangle(length, 0.05)
    with pytest.raises(ValueError, match='height'):
        c_uniform_rectangle(0.05, length)
