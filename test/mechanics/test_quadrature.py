# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Integrals over outlines against those in closed form."""

import math

import numpy as np
import pytest

from tactile_push.mechanics import Outline
from tactile_push.mechanics.quadrature import (
    area_and_centroid,
    boundary,
    cells,
    distances,
    integrals,
    spaced,
)

SQUARE = Outline.rectangle(0.06, 0.06)
CIRCLE = Outline.circle(0.03)
TRIANGLE = Outline.polygon([(0.0, 0.0), (0.06, 0.0), (0.0, 0.03)])
ORIGIN = np.zeros(2)


def even(x, y):
    return np.ones_like(x)


def second_moments(x, y):
    return 1.0, x * x, x * y, y * y


@pytest.mark.parametrize(
    ('outline', 'area', 'centroid'),
    [
        (SQUARE, 0.0036, (0.0, 0.0)),
        (CIRCLE, math.pi * 0.0009, (0.0, 0.0)),
        (TRIANGLE, 0.0009, (0.02, 0.01)),
    ],
)
def test_area_and_centroid(outline, area, centroid):
    found, centre = area_and_centroid(outline)
    assert found == pytest.approx(area, rel=1e-13)
    assert centre == pytest.approx(centroid, abs=1e-15)


@pytest.mark.parametrize('outline', [SQUARE, CIRCLE, TRIANGLE])
def test_nodes_on_the_boundary_stand_for_its_length_and_close_it(outline):
    points, tangents, weights = boundary(outline)
    assert weights.sum() == pytest.approx(outline.length, rel=1e-14)
    assert np.hypot(*tangents.T) == pytest.approx(1.0, rel=1e-14)
    assert weights @ tangents == pytest.approx(0.0, abs=1e-15)
    # The square of the distance grows along the boundary by 2 b t ds, and not in all.
    assert weights @ (points * tangents).sum(axis=1) == pytest.approx(0.0, abs=1e-16)


@pytest.mark.parametrize('outline', [SQUARE, CIRCLE, TRIANGLE])
@pytest.mark.parametrize('count', [7, 48])
def test_spaced_points_stand_for_the_whole_length(outline, count):
    points, tangents, lengths = spaced(outline, count)
    assert lengths.sum() == pytest.approx(outline.length, rel=1e-14)
    assert len(points) == pytest.approx(count, abs=2)
    assert np.hypot(*tangents.T) == pytest.approx(1.0, rel=1e-14)


def test_spaced_points_of_a_circle_are_the_corners_of_a_regular_polygon():
    points, tangents, lengths = spaced(CIRCLE, 12)
    assert np.hypot(*points.T) == pytest.approx(0.03)
    assert lengths == pytest.approx(math.tau * 0.03 / 12)
    turned = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    assert np.diff(turned) == pytest.approx(math.tau / 12)
    assert (points * tangents).sum(axis=1) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize('power', [0, 1, 2, 3])
def test_distances_along_a_circle_and_a_square(power):
    # On a circle of radius R height and distance are R: R^(p + 1) 2 pi R.
    assert distances(CIRCLE, power) == pytest.approx(math.tau * 0.03 ** (power + 2), rel=1e-13)
    # Along each side of length 2 a in the height a: a^p a^2 (sqrt(2) + asinh(1)).
    side = 0.03 ** (power + 2) * (math.sqrt(2.0) + math.asinh(1.0))
    assert distances(SQUARE, power) == pytest.approx(4.0 * side, rel=1e-13)


@pytest.mark.parametrize(
    ('outline', 'expected'),
    [
        (SQUARE, (0.0036, 0.06**4 / 12.0, 0.0, 0.06**4 / 12.0)),
        (CIRCLE, (math.pi * 0.03**2, math.pi * 0.03**4 / 4.0, 0.0, math.pi * 0.03**4 / 4.0)),
        # b^3 h/12, b^2 h^2/24 and b h^3/12 about the corner of the right angle.
        (
            TRIANGLE,
            (0.0009, 0.06**3 * 0.03 / 12.0, 0.0018**2 / 24.0, 0.06 * 0.03**3 / 12.0),
        ),
    ],
)
@pytest.mark.parametrize('origin', [ORIGIN, np.array([0.011, 0.004])])
def test_second_moments_of_an_even_density(outline, expected, origin):
    found = integrals(outline, origin, even, second_moments)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-18)


def test_a_density_weighs_what_is_integrated():
    # (1 - r^2/R^2) on a disk: mass pi R^2/2, and pi (R^4/4 - R^4/6) both ways.
    found = integrals(CIRCLE, ORIGIN, lambda x, y: 1.0 - (x * x + y * y) / 0.03**2, second_moments)
    moment = math.pi * 0.03**4 / 12.0
    assert found == pytest.approx((math.pi * 0.03**2 / 2.0, moment, 0.0, moment), abs=1e-18)


def test_a_density_with_a_step_is_integrated_roughly():
    # Half a disk: a step along a diameter off the centre of the rays.
    found = integrals(CIRCLE, np.array([0.0, 0.01]), lambda x, y: 1.0 * (y > 0.0), second_moments)
    assert found[0] == pytest.approx(math.pi * 0.03**2 / 2.0, rel=3e-3)


@pytest.mark.slow
def test_a_density_whose_integral_does_not_converge_is_refused():
    with pytest.raises(ValueError, match='density: expected one whose integral converges'):
        integrals(CIRCLE, ORIGIN, lambda x, y: 1.0 / (x * x + y * y) ** 2, second_moments)


@pytest.mark.parametrize('outline', [SQUARE, CIRCLE, TRIANGLE])
def test_cells_have_the_area_and_its_centroid(outline):
    area, centroid = area_and_centroid(outline)
    points, areas = cells(outline, area / 50.0)
    assert 40 < len(points) < 100
    assert areas.sum() == pytest.approx(area, rel=0.02)
    assert areas @ points / areas.sum() == pytest.approx(centroid, abs=3e-4)
    assert areas.max() < 1.3 * area / 50.0


def test_cells_of_a_square_are_a_grid():
    points, areas = cells(SQUARE, 0.0004)
    assert areas == pytest.approx(0.0004)
    places = [-0.02, 0.0, 0.02]
    assert sorted(map(tuple, points.round(12) + 0.0)) == [(x, y) for x in places for y in places]
