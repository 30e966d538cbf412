# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import EllipsoidalLimitSurface, ExactLimitSurface, Outline, Support

checked = settings(derandomize=True, deadline=None, max_examples=50)
maxima = st.floats(0.01, 100.0)
angles = st.floats(-math.pi, math.pi)
latitudes = st.floats(-math.pi / 2.0, math.pi / 2.0)
coordinates = st.floats(-1.0, 1.0)
feet = st.lists(st.tuples(coordinates, coordinates, st.floats(0.1, 2.0)), min_size=3, max_size=12)
grid = st.integers(-3, 3)
lattice = st.lists(st.tuples(grid, grid, st.integers(1, 3)), min_size=2, max_size=9)
directions = st.tuples(coordinates, coordinates, coordinates).filter(lambda q: math.hypot(*q) > 0.1)


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


def resting_on(standing):
    points, loads = [foot[:2] for foot in standing], [foot[2] for foot in standing]
    return Support.at_points(points, loads)


def frictions(support, twist):
    """Give positions about the centre, frictions and speeds of the points, by their definition."""
    rows = []
    for (x, y), load in zip(support.points - support.centre, support.loads, strict=True):
        velocity = np.array([twist[0] - twist[2] * y, twist[1] + twist[2] * x])
        speed = np.linalg.norm(velocity)
        rows.append((x, y, *(load * velocity / speed if speed > 0.0 else (0.0, 0.0)), speed))
    return np.array(rows)


def direct_wrench(support, twist):
    x, y, f_x, f_y, _ = frictions(support, twist).T
    return np.array([f_x.sum(), f_y.sum(), (x * f_y - y * f_x).sum()])


def dissipation(support, twist):
    speeds = frictions(support, twist)[:, 4]
    return support.loads @ speeds


def is_spread(support):
    """Tell whether the surface has a volume on all scales."""
    offsets = (support.points - support.centre) * np.sqrt(support.loads)[:, None]
    return np.linalg.svd(offsets, compute_uv=False)[-1] > 0.05


def turning_about(point, support, sense):
    """Give the twist about a point: it stands still."""
    x, y = np.asarray(point) - support.centre
    return sense * np.array([y, -x, 1.0])


def assert_supplies_least(support, wrench, twist, slack=1e-11):
    """Assert that no other motion dissipates less than the wrench supplies: p lies on the surface.

    That holds at, and only at, the twist normal to the surface, however sharp it is there.
    """
    dissipated = dissipation(support, twist)
    factor = dissipated / (np.asarray(wrench) @ twist)
    assert factor > 0.0
    c = support.c
    random = np.random.default_rng(3)
    scale = np.array([1.0, 1.0, 1.0 / c])
    size = np.linalg.norm(twist / scale)
    for step in (1e-5, 1e-3, 0.1, 1.0, 10.0):
        for _ in range(12):
            other = twist + step * size * scale * random.uniform(-1.0, 1.0, 3)
            supplied = factor * (np.asarray(wrench) @ other)
            assert dissipation(support, other) >= supplied - slack * support.f_max * size


@checked
@given(feet, directions)
def test_the_wrench_is_the_sum_of_all_frictions(standing, twist):
    support = resting_on(standing)
    assume(support.m_max > 0.01)

    wrench = ExactLimitSurface(support).wrench(twist)

    scale = [support.f_max, support.f_max, support.m_max]
    np.testing.assert_allclose(wrench / scale, direct_wrench(support, twist) / scale, atol=1e-12)
    assert wrench @ twist == pytest.approx(dissipation(support, twist), rel=1e-12)


@checked
@given(feet, directions, directions)
def test_of_all_wrenches_the_one_of_a_motion_resists_it_most(standing, twist, other):
    support = resting_on(standing)
    assume(support.m_max > 0.01)
    surface = ExactLimitSurface(support)

    greatest = surface.wrench(twist) @ twist

    assert surface.wrench(other) @ twist <= greatest * (1.0 + 1e-12)


@checked
@given(feet, directions, directions, st.floats(0.0, 1.0))
def test_the_surface_is_convex(standing, twist, other, share):
    support = resting_on(standing)
    assume(is_spread(support))
    surface = ExactLimitSurface(support)

    between = share * surface.wrench(twist) + (1.0 - share) * surface.wrench(other)

    assert surface.level(between) <= 1.0 + 1e-9


@checked
@given(feet, directions)
def test_a_motion_gives_a_wrench_that_gives_it_back(standing, twist):
    support = resting_on(standing)
    assume(is_spread(support))
    speeds = frictions(support, twist)[:, 4]
    assume(speeds.min() > 0.02 * speeds.max())  # nothing stands almost still: smooth
    surface = ExactLimitSurface(support)

    back = surface.twist(surface.wrench(twist))

    scale = np.array([1.0, 1.0, support.c])
    expected, back = scale * twist, scale * back
    np.testing.assert_allclose(
        back / np.linalg.norm(back), expected / np.linalg.norm(expected), rtol=0, atol=1e-6
    )


@checked
@given(feet, directions, st.floats(0.01, 100.0))
def test_the_twist_is_normal_to_the_surface_and_supplied_with_the_power_1(standing, wrench, size):
    support = resting_on(standing)
    assume(is_spread(support))
    surface = ExactLimitSurface(support)

    twist = surface.twist(size * np.array(wrench))

    assert size * np.array(wrench) @ twist == pytest.approx(1.0, rel=1e-9)
    assert_supplies_least(support, wrench, twist)


@checked
@given(lattice, st.tuples(grid, grid, grid).filter(any))
def test_the_twist_is_normal_to_the_surface_of_regular_points_too(standing, wrench):
    support = resting_on(standing)
    assume(support.m_max > 0.01)

    twist = ExactLimitSurface(support).twist(wrench)

    assert_supplies_least(support, wrench, twist)


@pytest.mark.parametrize(
    'wrench',
    [
        (0.0, 0.0, 1.0),
        (0.0, 0.0, -2.0),
        (1.0, 0.0, 2.76888245),
        (0.3, 0.1, -0.8),
        (-1.0, 2.0, 3.0),
        (0.0, 1.0, 0.5),
    ],
)
@pytest.mark.parametrize('corners', [4, 6, 11])
def test_the_twist_is_normal_to_the_surface_of_a_polygon_that_rests_on_its_centre_too(
    corners, wrench
):
    angles = np.arange(corners) * math.tau / corners
    points = np.append(np.stack([np.cos(angles), np.sin(angles)], axis=-1), [(0.0, 0.0)], axis=0)
    support = Support.at_points(points)

    twist = ExactLimitSurface(support).twist(wrench)

    assert_supplies_least(support, wrench, twist)


@checked
@given(feet, directions, st.floats(0.01, 100.0))
def test_wrenches_on_the_surface_have_level_1_and_it_grows_with_the_square(standing, twist, size):
    support = resting_on(standing)
    assume(is_spread(support))
    surface = ExactLimitSurface(support)
    speeds = frictions(support, twist)[:, 4]
    assume(speeds.min() > 1e-3 * speeds.max())

    wrench = surface.wrench(twist)

    assert surface.level(wrench) == pytest.approx(1.0, rel=1e-9)
    assert surface.level(size * wrench) == pytest.approx(size**2, rel=1e-9)


def test_no_wrench_has_level_0():
    assert ExactLimitSurface(Support.at_points([(0, 1), (1, 0)])).level((0.0, 0.0, 0.0)) == 0.0


@checked
@given(feet, angles, st.floats(0.1, 10.0))
def test_a_force_through_the_centre_of_friction_translates(standing, angle, size):
    support = resting_on(standing)
    assume(is_spread(support))
    force = size * np.array([math.cos(angle), math.sin(angle)])
    surface = ExactLimitSurface(support)

    v_x, v_y, omega = surface.twist((*force, 0.0))

    assert size * np.array([v_x, v_y]) == pytest.approx(force / size, rel=0, abs=1e-7)
    assert size * omega * support.c == pytest.approx(0.0, abs=1e-7)
    assert surface.level((*force, 0.0)) == pytest.approx((size / support.f_max) ** 2, rel=1e-12)


def symmetric_supports():
    angles = np.arange(7) * math.tau / 7.0 + 0.1
    yield Support.corners(Outline.rectangle(0.05, 0.0475))
    yield Support.uniform(Outline.rectangle(0.05, 0.0475), count=49)
    yield Support.uniform(Outline.circle(0.03), count=100)
    yield Support.rim(Outline.ellipse(0.03, 0.02), count=40)
    yield Support.at_points(np.stack([np.cos(angles), np.sin(angles)], axis=-1))
    yield Support.at_points([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 0.0)])


@pytest.mark.parametrize('support', list(symmetric_supports()))
@pytest.mark.parametrize('m', [2.0, -0.3])
def test_a_moment_alone_turns_a_symmetric_support_about_its_centre(support, m):
    v_x, v_y, omega = ExactLimitSurface(support).twist((0.0, 0.0, m))

    assert omega == pytest.approx(1.0 / m, rel=1e-12)
    assert np.array([v_x, v_y]) == pytest.approx(0.0, abs=1e-7 * support.c / abs(m))


@pytest.mark.parametrize('support', list(symmetric_supports()))
def test_ellipsoid_and_exact_surface_meet_at_the_axes(support):
    # Fig. 6. Of the points, for which m_max is that of eq. (1).
    support = Support.at_points(support.points, support.loads)
    exact = ExactLimitSurface(support)
    ellipsoid = EllipsoidalLimitSurface(support.f_max, support.m_max)
    for angle in (0.0, 0.7, math.pi / 2.0, -3.0):
        force = (support.f_max * math.cos(angle), support.f_max * math.sin(angle), 0.0)
        assert ellipsoid.level(force) == pytest.approx(1.0, rel=1e-14)
        assert exact.level(force) == pytest.approx(1.0, rel=1e-12)
    for moment in (support.m_max, -support.m_max):
        # Of a point at the centre, which stands still, nothing is known and nothing needed.
        assert exact.wrench((0.0, 0.0, moment)) == pytest.approx(
            (0.0, 0.0, moment), abs=1e-15 * support.f_max
        )
        assert exact.level((0.0, 0.0, moment)) == pytest.approx(1.0, rel=1e-9)
        assert ellipsoid.level((0.0, 0.0, moment)) == pytest.approx(1.0, rel=1e-14)


def test_the_exact_section_of_fig_6_is_symmetric_and_moves_in_its_plane():
    surface = ExactLimitSurface(Support.uniform(Outline.rectangle(0.05, 0.0475)))
    for ratio in (-3.0, -0.5, 0.2, 1.0, 8.0):
        wrench = surface.wrench((0.0, 0.02, ratio))
        assert wrench[0] == pytest.approx(0.0, abs=1e-12)
        mirrored = surface.wrench((0.0, 0.02, -ratio))
        assert mirrored == pytest.approx(wrench * [1.0, 1.0, -1.0], abs=1e-12)
        assert surface.wrench((0.0, -0.02, -ratio)) == pytest.approx(-wrench, abs=1e-12)
        # v_x = 0 for forces in the plane f_x = 0.
        assert surface.twist(wrench)[0] == pytest.approx(0.0, abs=1e-6)


@checked
@given(feet, st.integers(0, 11), st.floats(0.0, 0.95), angles, st.sampled_from([-1.0, 1.0]))
def test_in_a_facet_the_object_turns_about_a_support_point(standing, index, share, angle, sense):
    # The other points' frictions are known, that of the still one is any up to its load.
    support = resting_on(standing)
    assume(is_spread(support))
    still = index % len(standing)
    pivot, load = support.points[still], support.loads[still]
    distances = np.hypot(*(support.points - pivot).T)
    assume(np.sort(distances)[1] > 1e-3)
    expected = turning_about(pivot, support, sense)
    x, y, f_x, f_y, _ = np.delete(frictions(support, expected), still, axis=0).T
    g = share * load * np.array([math.cos(angle), math.sin(angle)])
    p_x, p_y = pivot - support.centre
    wrench = np.array(
        [
            f_x.sum() + g[0],
            f_y.sum() + g[1],
            (x * f_y - y * f_x).sum() + p_x * g[1] - p_y * g[0],
        ]
    )
    surface = ExactLimitSurface(support)

    twist = surface.twist(wrench)

    assert surface.level(wrench) == pytest.approx(1.0, rel=1e-7)
    # All wrenches of the facet share one normal.
    assert twist / (sense * twist[2]) == pytest.approx(expected, rel=0, abs=1e-7)
    assert twist[2] * sense > 0.0


def test_in_an_edge_of_the_surface_of_two_points_each_of_them_can_stand_still():
    # A dumbbell at x = -1, 1, forces along y: the surface's section is |f_y + m| <= 1 (the load
    # at 1) and |f_y - m| <= 1 (that at -1), each half of the whole.
    support = Support.at_points([(1.0, 0.0), (-1.0, 0.0)], [1.0, 1.0])
    surface = ExactLimitSurface(support)
    for f_y, m, expected in (
        (1.5, 0.5, (0.0, 1.0, 1.0)),
        (1.5, -0.5, (0.0, 1.0, -1.0)),
        (-1.5, 0.5, (0.0, -1.0, 1.0)),
        (0.5, 1.5, (0.0, 1.0, 1.0)),
        (0.2, 1.8, (0.0, 1.0, 1.0)),
    ):
        assert surface.level((0.0, f_y, m)) == pytest.approx(1.0, rel=1e-9)
        twist = surface.twist((0.0, f_y, m))
        assert twist / abs(twist[2]) == pytest.approx(expected, rel=0, abs=1e-8)
    assert surface.level((0.0, 1.0, 0.5)) == pytest.approx(0.75**2, rel=1e-9)


@pytest.mark.parametrize('twist', [(1.0, 0.0, 0.0), (0.3, -1.0, 20.0), (0.0, 1.0, 60.0), (0, 0, 1)])
def test_the_surface_of_many_points_converges_to_the_integral(twist):
    outline = Outline.polygon([(0.0, 0.0), (0.05, 0.01), (0.02, 0.06)])
    # Midpoints of a fine grid, inside by the sides' half planes.
    step = (np.arange(1500) + 0.5) / 1500.0 * 0.06
    x, y = np.meshgrid(step, step, indexing='ij')
    inside = (0.05 * y - 0.01 * x >= 0) & (-0.03 * (y - 0.01) - 0.05 * (x - 0.05) >= 0)
    inside &= -0.02 * (y - 0.06) + 0.06 * (x - 0.02) >= 0
    x, y = x[inside] - x[inside].mean(), y[inside] - y[inside].mean()
    v_x, v_y = twist[0] - twist[2] * y, twist[1] + twist[2] * x
    speed = np.hypot(v_x, v_y)
    expected = np.array(
        [(v_x / speed).mean(), (v_y / speed).mean(), ((x * v_y - y * v_x) / speed).mean()]
    )
    errors = []
    for count in (30, 300, 3000):
        support = Support.uniform(outline, count)
        wrench = ExactLimitSurface(support).wrench(twist)
        errors.append(np.abs((wrench - expected) / [1.0, 1.0, support.c]).max())
    # The pivot may lie inside, where the friction turns around within one cell.
    assert errors[0] < 0.1
    assert errors[1] < 0.02
    assert errors[2] < 0.003


def test_the_speed_does_not_change_the_exact_wrench():
    surface = ExactLimitSurface(Support.at_points([(0.0, 1.0), (1.0, 0.0), (-1.0, -1.0)]))

    slow, fast = surface.wrench((1e-6, -2e-6, 3e-6)), surface.wrench((1e3, -2e3, 3e3))

    np.testing.assert_allclose(slow, fast, rtol=1e-12)


def test_mu_s_scales_the_surface():
    points, loads = [(0.0, 1.0), (1.0, 0.2), (-1.0, -0.7)], np.array([1.0, 2.0, 3.0])
    surface = ExactLimitSurface(Support.at_points(points, loads))

    scaled = ExactLimitSurface(Support.at_points(points, 0.3 * loads))

    twist = (0.1, 0.5, -0.4)
    assert scaled.wrench(twist) == pytest.approx(0.3 * surface.wrench(twist), rel=1e-12)
    wrench = (0.7, -0.1, 0.8)
    assert scaled.level(wrench) == pytest.approx(surface.level(wrench) / 0.09, rel=1e-9)
    assert scaled.twist(wrench) == pytest.approx(surface.twist(wrench), rel=1e-7)


def test_the_exact_wrench_of_a_resting_object_is_refused():
    with pytest.raises(ValueError, match='twist'):
        ExactLimitSurface(Support.at_points([(0, 1), (1, 0)])).wrench((0.0, 0.0, 0.0))


@pytest.mark.parametrize('wrench', [(0.0, 0.0, 0.0), (math.nan, 0.0, 1.0), (0.0, math.inf, 1.0)])
def test_the_exact_twist_under_no_wrench_is_refused(wrench):
    with pytest.raises(ValueError, match='wrench'):
        ExactLimitSurface(Support.at_points([(0, 1), (1, 0)])).twist(wrench)


@pytest.mark.parametrize('points', [[(0.1, 0.2)], [(0.1, 0.2), (0.1, 0.2)]])
def test_a_support_in_one_place_is_refused(points):
    with pytest.raises(ValueError, match='support'):
        ExactLimitSurface(Support.at_points(points))


def test_a_support_whose_points_are_in_one_place_is_refused():
    # It stands for an area, but with one point only: no motion follows from it.
    with pytest.raises(ValueError, match='support'):
        ExactLimitSurface(Support.uniform(Outline.rectangle(0.05, 0.0475), count=1))
