# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Loads between the centroid and the corners against sums and closed forms made otherwise."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import ExactLimitSurface, Outline, Support
from tactile_push.mechanics.spread import spread_at

checked = settings(derandomize=True, deadline=None, max_examples=15)
SIDE = 0.06
SQUARE = Outline.rectangle(SIDE, SIDE)
EQUILATERAL = Outline.polygon([(0.0, 0.0), (SIDE, 0.0), (SIDE / 2.0, SIDE * math.sqrt(0.75))])
TRIANGLE = [(0.045, 0.045), (-0.1315, 0.045), (0.045, -0.08061)]
TRAPEZOID = [(0.0, 0.0), (0.08, 0.0), (0.05, 0.03), (0.02, 0.03)]
SPREADS = (0.4, 1.0, 1.6, 2.0, 2.3, 2.8, 3.0)
MOTIONS = [(1.0, 0.0, 9.0), (0.3, -1.0, 40.0), (-0.2, 0.5, -20.0), (0.0, 1.0, 2.0)]


def mean_share(spread):
    """Give the mean share of the rays from the centroid, and that of the ways along the edges."""
    u, v = max(2.0 - spread, 0.0), max(spread - 2.0, 0.0)
    return 1.0 - u * u * (5.0 - u) / 12.0, (1.0 + v * v) / 2.0


def by_sums(corners, spread, parts=4000):
    """Give the centroid and the mean distance from it, of a load cut into parts of one weight.

    A density p s^(p - 1) from 0 to 1 has the mean p/(p + 1) and bears y within the share y^(1/p).
    """
    corners = np.array(corners)
    ends = np.roll(corners, -1, axis=0)
    cross = corners[:, 0] * ends[:, 1] - corners[:, 1] * ends[:, 0]
    centroid = cross @ (corners + ends) / 3.0 / cross.sum()
    along, across = mean_share(spread)[0], mean_share(spread)[1]
    y = (np.arange(parts) + 0.5) / parts
    way = y ** ((1.0 - across) / across)
    way = np.concatenate([-way, way])
    total = 0.0
    for start, end in zip(corners - centroid, ends - centroid, strict=True):
        weight = start[0] * end[1] - start[1] * end[0]
        points = (start + end) / 2.0 + np.outer(way, end - start) / 2.0
        total += weight * np.hypot(*points.T).mean()
    # The distance goes as the share of the ray, whose mean is a factor.
    return centroid, along * total / cross.sum()


@st.composite
def polygons(draw):
    angles = np.sort(draw(st.lists(st.floats(0.0, 6.2), min_size=3, max_size=7, unique=True)))
    gaps = np.diff(angles, append=angles[0] + math.tau)
    assume(gaps.min() > 0.1 and gaps.max() < 3.0)
    stretch = draw(st.floats(0.2, 1.0))
    return np.stack([1.0 + np.cos(angles), stretch * np.sin(angles)], axis=-1)


@pytest.mark.parametrize(
    ('outline', 'spread', 'c'),
    [
        # Of a side a: the mean of |x| in and around a square, by hand, and half its diagonal.
        (SQUARE, 1.0, (math.sqrt(2.0) + math.asinh(1.0)) / 6.0),
        (SQUARE, 2.0, (math.sqrt(2.0) + math.asinh(1.0)) / 4.0),
        (SQUARE, 3.0, math.sqrt(0.5)),
        # Edges at the height a/sqrt(12), from whose middle it is a/2 to the corners.
        (EQUILATERAL, 1.0, (1.0 / math.sqrt(3.0) + math.asinh(math.sqrt(3.0)) / 6.0) / 3.0),
        (EQUILATERAL, 2.0, (1.0 / math.sqrt(3.0) + math.asinh(math.sqrt(3.0)) / 6.0) / 2.0),
        (EQUILATERAL, 3.0, 1.0 / math.sqrt(3.0)),
    ],
)
def test_square_and_triangle_have_the_known_c(outline, spread, c):
    assert Support.spread(outline, spread).c == pytest.approx(SIDE * c, rel=1e-12)


@pytest.mark.parametrize('corners', [TRIANGLE, TRAPEZOID])
def test_spread_1_is_an_even_pressure(corners):
    outline = Outline.polygon(corners)

    even = Support.uniform(outline)

    assert Support.spread(outline, 1.0).c == pytest.approx(even.c, rel=1e-13)
    assert Support.spread(outline, 1.0).centre == pytest.approx(even.centre, rel=0, abs=1e-16)


@checked
@given(polygons(), st.floats(0.2, 3.0))
def test_a_polygons_c_is_that_of_a_load_cut_into_parts(corners, spread):
    support = Support.spread(Outline.polygon(corners), spread, count=4)

    centroid, c = by_sums(corners, spread)
    assert support.c == pytest.approx(c, rel=2e-6)
    assert support.centre == pytest.approx(centroid, rel=0, abs=1e-12)
    assert support.f_max == pytest.approx(1.0, rel=1e-14)


@pytest.mark.parametrize('spread', [2.05, 2.5, 2.95])
def test_the_c_of_a_thin_rectangle_beyond_the_rim_is_that_of_a_segment(spread):
    # The long edges are two segments of the length 1 and have half the load, evenly spread in the
    # share of the way: the mean of |x| is the mean share over 2. The short edges lie at 1/2.
    expected = (mean_share(spread)[1] / 2.0 + 0.5) / 2.0

    for width in (1e-3, 1e-5):
        c = Support.spread(Outline.rectangle(1.0, width), spread, count=4).c
        assert c == pytest.approx(expected, abs=width)


def test_a_corner_bears_half_of_what_the_edges_beside_it_do():
    # Heights of the centroid: integral of y width over area, 0.03 (0.08 + 2 0.03)/(3 0.11).
    height = 0.03 * 0.14 / 0.33
    area = 0.03 * (0.08 + 0.03) / 2.0
    lower, upper = 0.08 * height / 2.0 / area, 0.03 * (0.03 - height) / 2.0 / area
    # Its centre of mass in x: a triangle, a rectangle and another triangle side by side.
    parts = [(0.02 * 0.03 / 2.0, 0.04 / 3.0), (0.03 * 0.03, 0.035), (0.03 * 0.03 / 2.0, 0.06)]
    middle = sum(weight * x for weight, x in parts) / area
    right = ((0.08 - middle) * 0.03 - height * 0.03) / 2.0 / area  # seen from the centroid
    left = 1.0 - lower - upper - right

    support = Support.spread(Outline.polygon(TRAPEZOID), 3.0)

    loads = {corner: 0.0 for corner in TRAPEZOID}
    for point, load in zip(support.points, support.loads, strict=True):
        (corner,) = (at for at in TRAPEZOID if math.dist(at, point) < 1e-12)
        loads[corner] += load
    expected = np.array([left + lower, lower + right, right + upper, upper + left]) / 2.0
    assert list(loads.values()) == pytest.approx(expected, rel=1e-12)
    assert support.centre == pytest.approx((middle, height), rel=1e-12)


@pytest.mark.parametrize('spread', SPREADS)
@pytest.mark.parametrize('count', [1, 30, 400])
@pytest.mark.parametrize('corners', [TRIANGLE, TRAPEZOID])
def test_points_lie_around_the_centroid_and_under_the_object(corners, count, spread):
    outline = Outline.polygon(corners)

    support = Support.spread(outline, spread, count)

    assert (support.loads > 0.0).all()
    assert support.loads.sum() == pytest.approx(1.0, rel=1e-13)
    centroid, _ = by_sums(corners, spread, 1)
    assert support.loads @ support.points == pytest.approx(centroid, rel=0, abs=1e-15)
    assert outline.contains(support.points, 1e-12).all()


@pytest.mark.parametrize('spread', SPREADS)
@pytest.mark.parametrize('corners', [TRIANGLE, TRAPEZOID])
def test_the_c_of_the_points_converges_to_that_of_the_load(corners, spread):
    outline = Outline.polygon(corners)
    for count in (25, 100, 400):
        support = Support.spread(outline, spread, count)
        alone = Support.at_points(support.points, support.loads)
        assert alone.c == pytest.approx(support.c, rel=0.8 / count)


@pytest.mark.parametrize('outline', [SQUARE, Outline.polygon(TRIANGLE)])
def test_c_grows_with_the_spread_and_has_no_kink(outline):
    step = 0.05
    spreads = np.arange(step, 3.0, step)

    c = np.array([Support.spread(outline, spread, 1).c for spread in spreads])

    assert (np.diff(c) > 0.0).all()
    # A kink would leave a change of the slope that does not go to 0 with the step.
    slope = np.diff(c) / step / c[-1]
    assert np.abs(np.diff(slope)).max() < 2.5 * step


@pytest.mark.parametrize('outline', [SQUARE, Outline.polygon(TRIANGLE)])
def test_the_limit_surface_has_neither_step_nor_kink_at_the_rim(outline):
    def wrenches(spread):
        surface = ExactLimitSurface(Support.spread(outline, spread))
        return np.array([surface.wrench(motion) for motion in MOTIONS]) / [1.0, 1.0, SIDE]

    for middle in (1.0, 2.0, 2.5):
        for step in (1e-2, 1e-3):
            before, at, after = (wrenches(middle + k * step) for k in (-1, 0, 1))
            # Each is at most a number times the step; of a kink they would be the slope.
            assert np.abs(after - at).max() < 1.0 * step
            assert np.abs(after - 2.0 * at + before).max() / step < 4.0 * step


@pytest.mark.parametrize('outline', [Outline.circle(0.03), Outline.ellipse(0.03, 0.02)])
def test_without_corners_the_load_spreads_to_the_rim(outline):
    even = Support.uniform(outline).c
    for spread in (0.5, 1.0, 1.9, 2.0):
        # Three halves of the mean distance under an even pressure, times the mean share.
        expected = 1.5 * even * mean_share(spread)[0]
        assert Support.spread(outline, spread).c == pytest.approx(expected, rel=1e-12)

    with pytest.raises(ValueError, match=r'^spread: expected a number from 0 to 2, got 2\.01$'):
        Support.spread(outline, 2.01)


@pytest.mark.parametrize('spread', [-0.1, 3.001, math.nan, math.inf])
def test_a_spread_out_of_range_is_refused(spread):
    with pytest.raises(ValueError, match='^spread: expected a number from 0 to 3, got '):
        Support.spread(SQUARE, spread)


def test_spread_0_is_all_load_in_the_centroid():
    support = Support.spread(Outline.polygon(TRAPEZOID), 0.0)

    assert support.c == 0.0
    assert np.ptp(support.points, axis=0) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize('spread', [0.3, 1.0, 1.9, 2.0, 2.2, 2.9, 3.0])
def test_the_spread_follows_from_the_mean_distance(spread):
    centroid, distance = by_sums(TRAPEZOID, spread)

    found = spread_at(Outline.polygon(TRAPEZOID).about(*centroid), distance)

    # At the rim the distance hardly tells: it grows by the square of what the spread is off.
    assert found == pytest.approx(spread, abs=0.02 if spread == 2.0 else 1e-3)


def test_beyond_all_loads_the_spread_is_at_its_bound():
    square = Outline.rectangle(SIDE, SIDE)

    assert spread_at(square, 0.0) == pytest.approx(0.0, abs=1e-9)
    assert spread_at(square, SIDE) == pytest.approx(3.0)
    assert spread_at(Outline.circle(SIDE), 2.0 * SIDE) == pytest.approx(2.0)
