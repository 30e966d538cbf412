# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import Outline, Support

checked = settings(derandomize=True, deadline=None, max_examples=30)
seldom = settings(derandomize=True, deadline=None, max_examples=6)
lengths = st.floats(1e-3, 1.0)
coordinates = st.floats(-1.0, 1.0)
feet = st.lists(st.tuples(coordinates, coordinates, st.floats(0.01, 10.0)), min_size=1, max_size=20)
TRIANGLE = ((0.01, -0.02), (0.06, 0.0), (0.02, 0.05))
BLOCK = (0.05, 0.0475)


def outlines():
    return {
        'block': Outline.rectangle(*BLOCK),
        'triangle': Outline.polygon(TRIANGLE),
        'disk': Outline.circle(0.0285),
        'ellipse': Outline.ellipse(0.03, 0.02),
    }


def split(points):
    return [(x, y) for x, y, _ in points], [load for _, _, load in points]


def mean_distance_in_rectangle(width, height):
    # By hand: the integral of the distance over the four triangles between centre and sides.
    a, b = width / 2.0, height / 2.0
    reach = math.hypot(a, b)
    return (
        reach / 3.0 + a * a / (6.0 * b) * math.asinh(b / a) + b * b / (6.0 * a) * math.asinh(a / b)
    )


def grid_in_rectangle(width, height, n=1000):
    steps = (np.arange(n) + 0.5) / n - 0.5
    return np.meshgrid(width * steps, height * steps, indexing='ij')


def grid_in_triangle(corners, n=600):
    # Centroids of n^2 triangles of one area.
    a, b, c = (np.array(corner) for corner in corners)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing='ij')
    upright, inverted = i + j < n, i + j < n - 1
    shares = np.concatenate(
        [
            np.stack([i[upright] + 1.0 / 3.0, j[upright] + 1.0 / 3.0]),
            np.stack([i[inverted] + 2.0 / 3.0, j[inverted] + 2.0 / 3.0]),
        ],
        axis=1,
    )
    return a[:, None] + (np.outer(b - a, shares[0]) + np.outer(c - a, shares[1])) / n


def weighed(x, y, weight):
    """Give the centre and the mean distance from it."""
    x_0, y_0 = (weight * x).sum() / weight.sum(), (weight * y).sum() / weight.sum()
    return (x_0, y_0), (weight * np.hypot(x - x_0, y - y_0)).sum() / weight.sum()


def test_the_papers_block_on_its_corners_has_a_c_of_3_45_cm():
    assert round(100.0 * Support.corners(Outline.rectangle(*BLOCK)).c, 2) == 3.45


def test_the_papers_block_with_uniform_support_has_a_c_of_1_87_cm():
    assert round(100.0 * Support.uniform(Outline.rectangle(*BLOCK)).c, 2) == 1.87


def test_uniform_support_in_a_circle_of_1_cm_has_a_c_of_0_67_cm():
    assert round(100.0 * Support.circle(0.01).c, 2) == 0.67


@pytest.mark.parametrize(
    ('points', 'loads', 'centre', 'f_max', 'm_max'),
    [
        ([(0.03, 0.04)], None, (0.03, 0.04), 1.0, 0.0),
        ([(0.03, 0.04)], [5.0], (0.03, 0.04), 5.0, 0.0),
        ([(3.0, 4.0), (-3.0, -4.0)], None, (0.0, 0.0), 1.0, 5.0),
        ([(0.0, 1.0), (4.0, 1.0)], [3.0, 1.0], (1.0, 1.0), 4.0, 6.0),
        ([(0.0, 1.0), (4.0, 1.0)], [0.0, 7.0], (4.0, 1.0), 7.0, 0.0),
        ([(1.0, 0.0), (1.0, 0.0), (-2.0, 0.0)], None, (0.0, 0.0), 1.0, 4.0 / 3.0),
    ],
)
def test_points_as_computed_by_hand(points, loads, centre, f_max, m_max):
    support = Support.at_points(points, loads)

    assert support.centre == pytest.approx(centre, rel=1e-14, abs=1e-15)
    assert support.f_max == pytest.approx(f_max, rel=1e-14)
    assert support.m_max == pytest.approx(m_max, rel=1e-14, abs=1e-15)
    assert support.c == pytest.approx(m_max / f_max, rel=1e-14, abs=1e-15)


@checked
@given(feet, st.floats(0.1, 2.0))
def test_points_obey_1_and_2_and_mu_s_scales_both(standing, mu_s):
    points, loads = split(standing)
    total = sum(loads)
    x = sum(load * p for load, (p, _) in zip(loads, points, strict=True)) / total
    y = sum(load * p for load, (_, p) in zip(loads, points, strict=True)) / total
    m_max = sum(load * math.dist((x, y), point) for load, point in zip(loads, points, strict=True))

    support = Support.at_points(points, [mu_s * load for load in loads])

    assert support.centre == pytest.approx((x, y), rel=0, abs=1e-13)
    assert support.f_max == pytest.approx(mu_s * total, rel=1e-13)
    assert support.m_max == pytest.approx(mu_s * m_max, rel=1e-12, abs=1e-12)
    assert support.c == pytest.approx(m_max / total, rel=1e-12, abs=1e-13)


@checked
@given(feet, coordinates, coordinates, st.floats(-4.0, 4.0), st.floats(0.01, 100.0))
def test_c_follows_the_object_when_it_moves_and_grows(standing, x, y, angle, scale):
    points, loads = split(standing)
    cos, sin = math.cos(angle), math.sin(angle)
    turn = np.array([[cos, -sin], [sin, cos]])
    support = Support.at_points(points, loads)

    moved = Support.at_points(scale * np.array(points) @ turn.T + [x, y], loads)

    assert moved.c == pytest.approx(scale * support.c, rel=1e-10, abs=1e-13 * (1.0 + scale))
    expected = scale * turn @ support.centre + [x, y]
    assert moved.centre == pytest.approx(expected, rel=0, abs=1e-12 * (1.0 + scale))


@checked
@given(feet)
def test_points_without_load_and_their_order_do_not_count(standing):
    points, loads = split(standing)
    support = Support.at_points(points, loads)

    other = Support.at_points(points[::-1] + [(9.0, 9.0)], loads[::-1] + [0.0])

    assert other.centre == pytest.approx(support.centre, rel=0, abs=1e-13)
    assert other.m_max == pytest.approx(support.m_max, rel=1e-12, abs=1e-13)


@pytest.mark.parametrize('corners', [3, 4, 5, 8])
def test_a_regular_polygon_rests_on_its_corners_at_their_radius(corners):
    angles = np.arange(corners) * math.tau / corners + 0.3
    outline = Outline.polygon(np.stack([0.04 * np.cos(angles), 0.04 * np.sin(angles)], axis=-1))

    support = Support.corners(outline)

    assert support.c == pytest.approx(0.04, rel=1e-13)
    assert support.f_max == pytest.approx(1.0, rel=1e-14)
    assert len(support.points) == corners


def test_corners_that_are_no_corners_bear_nothing():
    support = Support.corners(Outline.polygon([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)]))

    assert len(support.points) == 4
    assert support.centre == pytest.approx((1.0, 1.0))
    assert support.c == pytest.approx(math.sqrt(2.0))


@pytest.mark.parametrize('radius', [1e-3, 0.0285, 7.0])
def test_a_uniform_disk_has_a_c_of_two_thirds_of_its_radius(radius):
    assert Support.uniform(Outline.circle(radius)).c == pytest.approx(2.0 / 3.0 * radius, rel=1e-12)
    assert Support.circle(radius, 0.3, -0.2).c == pytest.approx(2.0 / 3.0 * radius, rel=1e-12)


@pytest.mark.parametrize('radius', [1e-3, 0.0285, 7.0])
def test_the_rim_of_a_circle_has_its_radius_as_c(radius):
    assert Support.rim(Outline.circle(radius)).c == pytest.approx(radius, rel=1e-12)


def test_a_circle_bears_the_object_where_it_is():
    support = Support.circle(0.01, 0.02, -0.03)

    assert support.centre == (0.02, -0.03)
    assert support.loads @ support.points == pytest.approx((0.02, -0.03), rel=1e-12)
    assert np.hypot(*(support.points - [0.02, -0.03]).T).max() <= 0.01


@checked
@given(lengths, lengths)
def test_a_uniform_rectangle_has_the_known_c(width, height):
    support = Support.uniform(Outline.rectangle(width, height), count=4)

    expected = mean_distance_in_rectangle(width, height)
    assert support.c == pytest.approx(expected, rel=1e-11)
    assert support.centre == pytest.approx((0.0, 0.0), abs=1e-15 * (width + height))


def test_a_uniform_rectangle_agrees_with_brute_force_over_a_grid():
    x, y = grid_in_rectangle(*BLOCK)

    support = Support.uniform(Outline.rectangle(*BLOCK))

    assert support.c == pytest.approx(np.hypot(x, y).mean(), rel=1e-6)


def test_a_uniform_square_has_the_known_c():
    expected = (math.sqrt(2.0) + math.log(1.0 + math.sqrt(2.0))) / 6.0

    assert Support.uniform(Outline.rectangle(1.0, 1.0)).c == pytest.approx(expected, rel=1e-13)


def test_a_thin_rectangle_becomes_a_segment_with_a_quarter_of_its_length():
    for outline in (Outline.rectangle(0.1, 1e-6), Outline.rectangle(1e-6, 0.1)):
        assert Support.uniform(outline, count=4).c == pytest.approx(0.025, rel=1e-6)
        assert Support.rim(outline, count=4).c == pytest.approx(0.025, rel=1e-4)


@checked
@given(st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=3))
def test_a_uniform_triangle_agrees_with_many_small_triangles(corners):
    (a_x, a_y), (b_x, b_y), (c_x, c_y) = corners
    area = abs((b_x - a_x) * (c_y - a_y) - (b_y - a_y) * (c_x - a_x)) / 2.0
    assume(area > 0.02)

    support = Support.uniform(Outline.polygon(corners), count=4)

    x, y = grid_in_triangle(corners)
    centre, c = weighed(x, y, np.ones_like(x))
    assert support.centre == pytest.approx(centre, rel=0, abs=1e-12)
    assert support.centre == pytest.approx(np.mean(corners, axis=0), rel=0, abs=1e-12)
    assert support.c == pytest.approx(c, rel=2e-5)


@pytest.mark.slow
@seldom
@given(st.floats(0.02, 0.1), st.floats(0.02, 0.1))
def test_a_uniform_ellipse_agrees_with_the_double_integral(a, b):
    # x = a s cos t, y = b s sin t: the integral over s by hand, over t periodic.
    t = (np.arange(4000) + 0.5) / 4000.0 * math.tau

    support = Support.uniform(Outline.ellipse(a, b), count=4)

    assert support.centre == pytest.approx((0.0, 0.0), abs=1e-12)
    expected = 2.0 / 3.0 * np.hypot(a * np.cos(t), b * np.sin(t)).mean()
    assert support.c == pytest.approx(expected, rel=2e-6)


@pytest.mark.slow
@seldom
@given(st.floats(0.02, 0.1), st.floats(0.02, 0.1))
def test_the_rim_of_an_ellipse_agrees_with_the_integral_along_it(a, b):
    t = (np.arange(4000) + 0.5) / 4000.0 * math.tau
    speed = np.hypot(a * np.sin(t), b * np.cos(t))
    expected = (np.hypot(a * np.cos(t), b * np.sin(t)) @ speed) / speed.sum()

    support = Support.rim(Outline.ellipse(a, b), count=8)

    assert support.c == pytest.approx(expected, rel=2e-6)


def test_a_smooth_outline_through_points_of_a_circle_is_one():
    angles = np.arange(60) * math.tau / 60.0
    outline = Outline.smooth(np.stack([1.0 + np.cos(angles), 2.0 + np.sin(angles)], axis=-1))

    assert Support.uniform(outline).centre == pytest.approx((1.0, 2.0), abs=1e-12)
    assert Support.uniform(outline).c == pytest.approx(2.0 / 3.0, rel=1e-9)
    assert Support.rim(outline).c == pytest.approx(1.0, rel=1e-9)


def test_the_rim_of_a_square_has_the_known_c():
    # Mean of sqrt(h^2 + x^2) over one side.
    expected = (math.sqrt(2.0) + math.asinh(1.0)) / 4.0

    assert Support.rim(Outline.rectangle(1.0, 1.0)).c == pytest.approx(expected, rel=1e-13)


@checked
@given(st.lists(st.floats(0.0, 6.2), min_size=3, max_size=8, unique=True), coordinates, coordinates)
def test_the_rim_of_a_polygon_agrees_with_many_points_along_it(angles, x, y):
    angles = np.sort(angles)
    corners = np.stack([x + np.cos(angles), y + np.sin(angles)], axis=-1)
    assume(np.diff(angles, append=angles[0] + math.tau).min() > 0.05)
    assume(np.diff(angles, append=angles[0] + math.tau).max() < 3.0)
    ends = np.roll(corners, -1, axis=0)
    share = ((np.arange(20_000) + 0.5) / 20_000)[:, None, None]
    points = corners + share * (ends - corners)
    weight = np.broadcast_to(np.hypot(*(ends - corners).T), points.shape[:2])
    centre, c = weighed(points[..., 0], points[..., 1], weight)

    support = Support.rim(Outline.polygon(corners))

    assert support.centre == pytest.approx(centre, rel=0, abs=1e-12)
    assert support.c == pytest.approx(c, rel=1e-8)
    assert support.f_max == pytest.approx(1.0, rel=1e-13)


@pytest.mark.parametrize('name', ['block', 'triangle', 'disk', 'ellipse'])
@pytest.mark.parametrize('pressure', [3.0, 2e4])
def test_a_constant_density_is_uniform_support(name, pressure):
    outline = outlines()[name]
    area = {
        'block': 0.05 * 0.0475,
        'triangle': (0.05 * 0.07 - 0.02 * 0.01) / 2.0,
        'disk': math.pi * 0.0285**2,
        'ellipse': math.pi * 0.03 * 0.02,
    }[name]

    support = Support.density(outline, lambda x, y: np.full_like(x, pressure))

    uniform = Support.uniform(outline)
    assert support.f_max == pytest.approx(pressure * area, rel=1e-6)
    assert support.centre == pytest.approx(uniform.centre, rel=0, abs=1e-10)
    assert support.c == pytest.approx(uniform.c, rel=1e-8)
    np.testing.assert_allclose(support.points, uniform.points, rtol=0, atol=1e-10)
    np.testing.assert_allclose(support.loads / support.f_max, uniform.loads, rtol=1e-9)


def test_mu_s_scales_a_density_and_not_its_c():
    outline = Outline.polygon(TRIANGLE)
    support = Support.density(outline, lambda x, y: 1.0 + 10.0 * x)

    scaled = Support.density(outline, lambda x, y: 0.3 * (1.0 + 10.0 * x))

    assert scaled.f_max == pytest.approx(0.3 * support.f_max, rel=1e-12)
    assert scaled.m_max == pytest.approx(0.3 * support.m_max, rel=1e-12)
    assert scaled.c == pytest.approx(support.c, rel=1e-12)
    assert scaled.centre == pytest.approx(support.centre, rel=1e-12)


@seldom
@given(st.floats(0.02, 0.1), st.floats(0.02, 0.1), st.floats(-0.99, 0.99))
def test_a_linear_density_shifts_the_centre_of_friction_as_computed_by_hand(width, height, tilt):
    support = Support.density(
        Outline.rectangle(width, height), lambda x, y: 1.0 + tilt * x / (width / 2.0), count=100
    )

    x, y = grid_in_rectangle(width, height, 400)
    centre, c = weighed(x, y, 1.0 + tilt * x / (width / 2.0))
    assert support.f_max == pytest.approx(width * height, rel=1e-12)
    assert support.centre == pytest.approx((tilt * width / 6.0, 0.0), rel=1e-10, abs=1e-15)
    assert support.centre == pytest.approx(centre, rel=1e-4, abs=1e-15)
    assert support.c == pytest.approx(c, rel=1e-5)


def test_a_linear_density_on_a_triangle_agrees_with_a_grid():
    x, y = grid_in_triangle(TRIANGLE)
    centre, c = weighed(x, y, 1.0 + 30.0 * x + 20.0 * y)

    support = Support.density(
        Outline.polygon(TRIANGLE), lambda x, y: 1.0 + 30.0 * x + 20.0 * y, count=100
    )

    assert support.centre == pytest.approx(centre, rel=1e-5)
    assert support.c == pytest.approx(c, rel=1e-5)


def test_a_density_that_grows_with_the_distance_is_integrated_as_by_hand():
    # On a disk: the integrals of rho^(n + 1) give f_max, m_max = 2 pi R^(n + 2) / (n + 2), ...
    for n in (0, 1, 2, 5):
        support = Support.density(
            Outline.circle(2.0), lambda x, y, n=n: np.hypot(x, y) ** n, count=50
        )

        assert support.f_max == pytest.approx(math.tau * 2.0 ** (n + 2) / (n + 2), rel=1e-9)
        assert support.c == pytest.approx(2.0 * (n + 2) / (n + 3), rel=1e-9)


def test_a_density_in_one_half_is_the_uniform_half():
    width, height = BLOCK

    support = Support.density(
        Outline.rectangle(width, height), lambda x, y: np.where(x > 0.0, 5.0, 0.0)
    )

    assert support.f_max == pytest.approx(5.0 * width * height / 2.0, rel=2e-3)
    assert support.centre == pytest.approx((width / 4.0, 0.0), rel=2e-3, abs=1e-5)
    expected = mean_distance_in_rectangle(width / 2.0, height)
    assert support.c == pytest.approx(expected, rel=2e-3)
    assert (support.points[:, 0] > 0.0).all()


@pytest.mark.parametrize('level', [-0.01, 0.0, 0.007])
def test_a_density_with_a_step_agrees_with_a_grid(level):
    def density(x, y):
        return np.where(x + 0.5 * y > level, 3.0, 1.0)

    x, y = grid_in_rectangle(*BLOCK, 1000)
    centre, c = weighed(x, y, density(x, y))

    support = Support.density(Outline.rectangle(*BLOCK), density)

    assert support.f_max == pytest.approx(density(x, y).mean() * math.prod(BLOCK), rel=2e-3)
    assert support.centre == pytest.approx(centre, rel=0, abs=5e-5)
    assert support.c == pytest.approx(c, rel=2e-3)


@pytest.mark.slow
def test_a_density_is_not_asked_for_more_than_ten_million_values_at_once():
    def density(x, y):
        assert x.size <= 10_000_000
        return np.where(x > 0.003, 2.0, 1.0)

    support = Support.density(Outline.ellipse(0.03, 0.02), density)

    x, y = grid_in_rectangle(0.06, 0.04, 2000)
    inside = (x / 0.03) ** 2 + (y / 0.02) ** 2 <= 1.0
    centre, c = weighed(x, y, np.where(x > 0.003, 2.0, 1.0) * inside)
    assert support.centre == pytest.approx(centre, rel=0, abs=5e-5)
    assert support.c == pytest.approx(c, rel=2e-3)


def test_a_density_may_be_one_number():
    support = Support.density(Outline.circle(1.0), lambda x, y: 2.0)

    assert support.f_max == pytest.approx(2.0 * math.pi, rel=1e-9)


def test_a_support_that_carries_a_weight_has_its_centre_and_the_loads_of_statics():
    support = Support.at_points([(0.0, 0.0), (0.04, 0.0), (0.0, 0.03)], [5.0, 5.0, 2.0])

    carrying = support.carrying((0.01, 0.01))

    # By levers: 1/4 of the weight at the right, 1/3 at the top.
    assert carrying.loads == pytest.approx([5.0, 3.0, 4.0], abs=1e-9)
    assert carrying.centre == (0.01, 0.01)
    assert carrying.f_max == pytest.approx(12.0)
    arms = [math.hypot(0.01, 0.01), math.hypot(0.03, 0.01), math.hypot(0.01, 0.02)]
    assert carrying.m_max == pytest.approx(np.dot([5.0, 3.0, 4.0], arms), rel=1e-9)


def test_a_weight_in_its_place_changes_nothing():
    for support in families(Outline.polygon(TRIANGLE), 50):
        same = support.carrying(support.centre)
        assert same.loads == pytest.approx(support.loads, rel=1e-9)
        assert same.m_max == pytest.approx(support.m_max, rel=1e-9)


def test_an_even_pressure_becomes_a_linear_one_under_a_weight_beside_the_middle():
    # By hand: with the density 1 + t x/a the centre moves by t a/3, a half the width.
    width, height = BLOCK
    outline = Outline.rectangle(width, height)
    linear = Support.density(outline, lambda x, y: 1.0 + 0.6 * x / (width / 2.0))

    carrying = Support.uniform(outline).carrying((0.1 * width, 0.0))

    assert carrying.c == pytest.approx(linear.c, rel=2e-4)
    x = carrying.points[:, 0]
    even = carrying.loads / Support.uniform(outline).loads
    assert even == pytest.approx(1.0 + 0.6 * x / (width / 2.0), rel=0.01)


def test_the_loads_of_measured_three_point_supports_are_those_of_statics():
    # Zhou et al. 2016: a triangle on three screws, its centre of mass in its centroid.
    for points, loads in (
        ([(-0.04, -0.04), (0.04, -0.02), (-0.04, 0.08)], [0.25, 0.5, 0.25]),
        ([(-0.04, -0.04), (0.08, -0.04), (-0.04, 0.08)], [1 / 3, 1 / 3, 1 / 3]),
    ):
        assert Support.at_points(points).carrying((0.0, 0.0)).loads == pytest.approx(
            loads, abs=1e-9
        )


def families(outline, count):
    yield Support.uniform(outline, count)
    yield Support.rim(outline, count)
    yield Support.density(outline, lambda x, y: 1.0 + 8.0 * x - 5.0 * y, count)


@pytest.mark.slow
@pytest.mark.parametrize('name', ['block', 'triangle', 'disk', 'ellipse'])
@pytest.mark.parametrize('count', [1, 20, 400])
def test_points_bear_f_max_together_and_lie_around_the_centre(name, count):
    outline = outlines()[name]
    for support in families(outline, count):
        assert support.points.shape == (len(support.loads), 2)
        assert (support.loads > 0.0).all()
        assert support.loads.sum() == pytest.approx(support.f_max, rel=1e-13)
        mean = support.loads @ support.points / support.f_max
        assert mean == pytest.approx(support.centre, rel=0, abs=1e-15)
        # Shifted by no more than what a coarse cut is off the centre.
        assert outline.contains(support.points, 0.01 / math.sqrt(count)).all()
        assert count / 3.0 <= len(support.points) <= 2.0 * count + 4.0


@pytest.mark.slow
@pytest.mark.parametrize('name', ['block', 'triangle', 'disk', 'ellipse'])
def test_the_c_of_the_points_converges_to_that_of_the_integral(name):
    outline = outlines()[name]
    errors = []
    for count in (25, 100, 400):
        errors.append(
            [
                abs(Support.at_points(support.points, support.loads).c / support.c - 1.0)
                for support in families(outline, count)
            ]
        )
    # First order in the count, second order in the distance of neighbours.
    for count, error in zip((25, 100, 400), errors, strict=True):
        assert max(error) < 0.8 / count


@pytest.mark.slow
def test_the_number_of_points_does_not_change_the_integral():
    for outline in outlines().values():
        for few, many in zip(families(outline, 3), families(outline, 300), strict=True):
            assert (few.f_max, few.m_max) == pytest.approx((many.f_max, many.m_max), rel=1e-13)
            assert few.centre == pytest.approx(many.centre, rel=0, abs=1e-15)


@pytest.mark.parametrize(
    'points', [[], [1.0, 2.0], [(1.0, 2.0, 3.0)], [(math.nan, 0.0)], [(0.0, math.inf)]]
)
def test_points_that_are_none_are_refused(points):
    with pytest.raises(ValueError, match='points'):
        Support.at_points(points)


@pytest.mark.parametrize(
    'loads',
    [[1.0], [1.0, 1.0, 1.0], [0.0, 0.0], [1.0, -0.5], [1.0, math.nan], [math.inf, 1.0], 1.0],
)
def test_loads_that_are_none_are_refused(loads):
    with pytest.raises(ValueError, match='loads'):
        Support.at_points([(0.0, 1.0), (1.0, 0.0)], loads)


@pytest.mark.parametrize('outline', [Outline.circle(1.0), Outline.ellipse(2.0, 1.0)])
def test_an_outline_without_corners_is_refused(outline):
    with pytest.raises(ValueError, match='outline'):
        Support.corners(outline)


@pytest.mark.parametrize('radius', [0.0, -0.01, math.nan, math.inf])
def test_a_radius_that_is_none_is_refused(radius):
    with pytest.raises(ValueError, match='radius'):
        Support.circle(radius)


@pytest.mark.parametrize('count', [0, -3, math.nan])
def test_a_count_that_is_none_is_refused(count):
    outline = Outline.rectangle(1.0, 1.0)
    for make in (
        lambda: Support.uniform(outline, count),
        lambda: Support.rim(outline, count),
        lambda: Support.circle(1.0, count=count),
        lambda: Support.density(outline, lambda x, y: np.ones_like(x), count),
    ):
        with pytest.raises(ValueError, match='count'):
            make()


@pytest.mark.parametrize(
    'density',
    [
        lambda x, y: x,
        lambda x, y: -1.0,
        lambda x, y: math.nan,
        lambda x, y: np.where(x > 0.2, math.nan, 1.0),
        lambda x, y: math.inf,
        lambda x, y: 0.0,
        lambda x, y: np.zeros_like(x),
    ],
)
def test_a_density_that_is_none_is_refused(density):
    with pytest.raises(ValueError, match='density'):
        Support.density(Outline.rectangle(1.0, 1.0), density)


def test_a_density_too_wild_to_integrate_is_refused():
    random = np.random.default_rng(1)

    with pytest.raises(ValueError, match='density: expected one whose integral converges'):
        Support.density(Outline.rectangle(1.0, 1.0), lambda x, y: random.pareto(0.5, x.shape))


def test_a_density_between_the_points_is_refused():
    with pytest.raises(ValueError, match='count'):
        Support.density(Outline.rectangle(1.0, 1.0), lambda x, y: x**2 + y**2, count=1)
