# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Loads under a weight against levers by hand and a solver of least squares."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls

from tactile_push.mechanics.statics import spring_loads

checked = settings(derandomize=True, deadline=None, max_examples=50)
TRIPOD = np.array([(-0.02, -0.02), (0.02, -0.02), (0.0, 0.02)])
PLANK = np.array([(0.0, 0.0), (0.01, 0.0), (0.02, 0.0), (0.04, 0.0)])


def alike(points):
    return np.ones(len(points))


@pytest.mark.parametrize(
    ('centre', 'loads'),
    # The third leg bears the share of the height, the others the rest by the lever between them.
    [
        ((0.0, -0.02 / 3.0), (1 / 3, 1 / 3, 1 / 3)),
        ((0.0, 0.0), (0.25, 0.25, 0.5)),
        ((0.005, 0.0), (0.125, 0.375, 0.5)),
        ((0.0, 0.02), (0.0, 0.0, 1.0)),
        ((-0.01, -0.02), (0.75, 0.25, 0.0)),
        ((0.01, 0.0), (0.0, 0.5, 0.5)),
    ],
)
@pytest.mark.parametrize('stiffness', [(1.0, 1.0, 1.0), (1.0, 30.0, 0.2)])
def test_three_legs_have_one_answer_however_stiff_they_are(centre, loads, stiffness):
    assert spring_loads(TRIPOD, np.array(stiffness), centre) == pytest.approx(loads, abs=1e-9)


@pytest.mark.parametrize(('at', 'loads'), [(0.01, (0.75, 0.25)), (0.04, (0.0, 1.0))])
def test_two_legs_bear_by_the_lever(at, loads):
    assert spring_loads(PLANK[[0, 3]], np.ones(2), (at, 0.0)) == pytest.approx(loads, abs=1e-9)


def test_four_corners_bear_as_much_as_a_plane_between_them_says():
    corners = np.array([(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)])

    # a + b x + c y with the sum 1 and the centre (0.6, 0.2): b = 0.6/16, c = 0.2/4.
    expected = 0.25 + 0.6 / 16.0 * corners[:, 0] + 0.2 / 4.0 * corners[:, 1]
    assert spring_loads(corners, np.ones(4), (0.6, 0.2)) == pytest.approx(expected, abs=1e-12)


def test_a_leg_that_would_have_to_pull_bears_nothing():
    # Springs at 0, 1, 2 and 4 under a weight at 3: with all touching, the one at 0 would pull.
    # Those at 1, 2 and 4 then bear 1/3 + (x - 7/3) b with the mean 3: b = (2/3)/(14/3) = 1/7.
    expected = (0.0, 1 / 3 - 4 / 21, 1 / 3 - 1 / 21, 1 / 3 + 5 / 21)

    assert spring_loads(PLANK, np.ones(4), (0.03, 0.0)) == pytest.approx(expected, abs=1e-9)


def test_loads_are_alike_where_they_can_be():
    assert spring_loads(PLANK, np.ones(4), (0.0175, 0.0)) == pytest.approx([0.25] * 4, abs=1e-12)


@checked
@given(
    st.lists(
        st.tuples(st.integers(-9, 9), st.integers(-9, 9), st.integers(1, 9), st.integers(0, 3)),
        min_size=2,
        max_size=12,
        unique_by=lambda leg: leg[:2],
    ).filter(lambda legs: any(leg[3] for leg in legs))
)
def test_loads_balance_and_have_the_least_squares(legs):
    # Any loads of 0 or more have a centre that the legs can bear, at the support's edge too.
    points, stiffness, some = np.array(legs, dtype=float)[:, [0, 1]], *np.array(legs).T[2:]
    centre = tuple(some @ points / some.sum())

    loads = spring_loads(points, stiffness.astype(float), centre)

    balance = np.vstack([np.ones(len(points)), (points - centre).T])
    assert balance @ loads == pytest.approx([1.0, 0.0, 0.0], abs=1e-8)
    assert (loads >= 0.0).all()
    root = np.sqrt(stiffness)
    heavy = 1e6
    rows, sides = np.vstack([heavy * balance * root, np.eye(len(points))]), np.zeros(len(points))
    least, _ = nnls(rows, np.concatenate([[heavy, 0.0, 0.0], sides]))
    assert loads == pytest.approx(root * least, abs=1e-6)


def test_a_leg_that_is_not_stiff_bears_nothing():
    points = np.vstack([TRIPOD, [(0.5, 0.5)]])

    loads = spring_loads(points, np.array([1.0, 1.0, 1.0, 0.0]), (0.0, 0.0))

    assert loads == pytest.approx([0.25, 0.25, 0.5, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    ('centre', 'side'),
    # The tripod's right leg leans by atan2(0.04, 0.02): its outside looks to 26.6 degrees.
    [((0.0, -0.021), 270), ((0.015, 0.0), 27), ((-0.015, 0.0), 153), ((0.0, 0.03), 90)],
)
def test_a_centre_of_mass_beside_the_support_is_refused_with_the_side(centre, side):
    with pytest.raises(ValueError, match=r'^centre_of_mass: .* got \(') as refused:
        spring_loads(TRIPOD, alike(TRIPOD), centre)
    message = str(refused.value)
    assert str(centre) in message
    named = float(message.split(' at ')[1].split(' degrees')[0])
    # The side named has no support: all of it lies on the other side of the centre of mass.
    away = np.array([math.cos(math.radians(named)), math.sin(math.radians(named))])
    assert ((TRIPOD - centre) @ away < 0.0).all()
    assert named == pytest.approx(side, abs=20.0)


@checked
@given(st.tuples(st.floats(-0.024, 0.024), st.floats(-0.023, 0.023)))
def test_a_centre_of_mass_is_accepted_exactly_over_the_tripod(centre):
    edges, offsets = np.roll(TRIPOD, -1, axis=0) - TRIPOD, np.array(centre) - TRIPOD
    left = edges[:, 0] * offsets[:, 1] - edges[:, 1] * offsets[:, 0]
    if abs(left).min() < 1e-9:
        return
    if (left > 0.0).all():
        assert spring_loads(TRIPOD, alike(TRIPOD), centre) @ TRIPOD == pytest.approx(centre)
    else:
        with pytest.raises(ValueError, match='^centre_of_mass: '):
            spring_loads(TRIPOD, alike(TRIPOD), centre)


@pytest.mark.parametrize('beside', [3e-8, 1e-9, 1e-11, 1e-13, 1e-15, 0.0])
@pytest.mark.parametrize('count', [3, 4])
def test_a_weight_just_beside_the_support_is_borne_as_at_its_edge(count, beside):
    corners = np.array([(-0.025, -0.024), (0.025, -0.024), (0.025, 0.024), (-0.025, 0.024)])
    corners = corners[:count]

    at_a_corner = spring_loads(corners, alike(corners), (0.025 + beside, -0.024 - beside))
    assert at_a_corner == pytest.approx([0.0, 1.0, 0.0, 0.0][:count], abs=1e-8)
    if beside < 1e-11:  # an edge has less room
        on_an_edge = spring_loads(corners, alike(corners), (0.025 + beside, 0.0))
        assert on_an_edge == pytest.approx([0.0, 0.5, 0.5, 0.0][:count], abs=1e-8)


@pytest.mark.parametrize('centre', [(math.nan, 0.0), (0.0, math.inf)])
def test_a_centre_of_mass_that_is_no_place_is_refused(centre):
    with pytest.raises(ValueError, match='^centre_of_mass: '):
        spring_loads(TRIPOD, alike(TRIPOD), centre)
