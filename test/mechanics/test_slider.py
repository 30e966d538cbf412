# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import Outline, Pose, Slider, Support

checked = settings(derandomize=True, deadline=None, max_examples=50)
BLOCK = Outline.rectangle(0.05, 0.0475)
inside = st.tuples(st.floats(-0.024, 0.024), st.floats(-0.023, 0.023))


@pytest.mark.parametrize('c', [0.0, -0.01, math.nan, math.inf])
def test_a_ratio_that_is_no_positive_length_is_refused(c):
    with pytest.raises(ValueError, match=f'^c: expected a positive length .* got {c}$'):
        Slider(BLOCK, c)


def test_without_points_the_limit_surface_is_the_ellipsoid():
    slider = Slider(BLOCK, 0.0187)

    assert (slider.outline, slider.c, slider.points) == (BLOCK, 0.0187, None)


def test_a_block_on_its_corners_has_the_ratio_of_the_paper():
    # V.B: 3.45 cm, half the block's diagonal.
    slider = Slider.on(BLOCK, Support.corners(BLOCK))

    assert slider.c == pytest.approx(math.hypot(0.025, 0.02375), rel=1e-14)
    assert slider.c == pytest.approx(0.0345, abs=5e-5)
    assert slider.points is None
    assert slider.outline.pieces == pytest.approx(BLOCK.pieces, rel=0, abs=1e-16)


@checked
@given(st.lists(st.tuples(inside, st.floats(0.1, 5.0)), min_size=3, max_size=6))
def test_the_origin_is_the_centre_of_friction(supported):
    places = np.array([place for place, _ in supported])
    loads = np.array([load for _, load in supported])
    if np.ptp(places, axis=0).max() < 1e-3:
        return
    centre = (loads[:, np.newaxis] * places).sum(axis=0) / loads.sum()

    slider = Slider.on(BLOCK, Support.at_points(places, loads), exact=True)

    # (1) and (2) about the centre of friction.
    arms = np.hypot(*(places - centre).T)
    assert slider.c == pytest.approx((loads * arms).sum() / loads.sum(), rel=1e-12)
    assert slider.outline.points(1.0) == pytest.approx(BLOCK.points(1.0) - centre, abs=1e-16)
    assert slider.points.shape == (3, len(places))
    x, y, _ = slider.points
    assert x == pytest.approx(places[:, 0] - centre[0], rel=0, abs=1e-16)
    assert y == pytest.approx(places[:, 1] - centre[1], rel=0, abs=1e-16)
    assert slider.points[2] == pytest.approx(loads, rel=1e-15)
    assert slider.points[:2] @ slider.points[2] == pytest.approx(np.zeros(2), abs=1e-15)


@checked
@given(st.lists(inside, min_size=3, max_size=5), st.floats(1e-3, 1e3))
def test_the_unit_of_the_loads_does_not_matter(places, unit):
    if np.ptp(places, axis=0).max() < 1e-3:
        return
    shares = np.arange(1.0, len(places) + 1.0)

    one = Slider.on(BLOCK, Support.at_points(places, shares))
    other = Slider.on(BLOCK, Support.at_points(places, unit * shares))

    assert other.c == pytest.approx(one.c, rel=1e-13)
    assert other.outline.pieces == pytest.approx(one.outline.pieces, rel=0, abs=1e-15)


@pytest.mark.parametrize('place', [(0.026, 0.0), (0.0, -0.024), (0.0251, 0.0239)])
def test_a_support_beside_the_object_is_refused(place):
    support = Support.at_points([(0.0, 0.0), (0.01, 0.0), place])

    with pytest.raises(ValueError, match='^support: .* under the object, got') as refused:
        Slider.on(BLOCK, support)
    assert all(f'{number}'.rstrip('0') in str(refused.value) for number in place)


def test_a_point_without_load_is_no_support():
    support = Support.at_points([(0.01, 0.0), (-0.01, 0.0), (1.0, 1.0)], [1.0, 1.0, 0.0])

    slider = Slider.on(BLOCK, support)

    assert slider.c == pytest.approx(0.01, rel=1e-14)


@pytest.mark.parametrize(
    ('places', 'loads'),
    [
        ([(0.01, 0.01)], [1.0]),
        ([(0.01, 0.003)] * 3, [0.1, 0.2, 0.7]),
        ([(0.013, 0.007)] * 7, [0.1] * 7),
        ([(0.01, 0.01), (0.0, 0.0)], [1.0, 0.0]),
    ],
)
def test_a_support_in_one_place_is_refused(places, loads):
    # The limit surface is flat: there is no quasi-static motion (V.B).
    with pytest.raises(ValueError, match='^support: expected loads in more than one place'):
        Slider.on(BLOCK, Support.at_points(places, loads))


TRIPOD = [(-0.02, -0.02), (0.02, -0.02), (0.0, 0.02)]
BALANCED = (0.0, -0.02 / 3.0)  # where legs that bear alike balance


def test_loads_that_carry_the_weight_are_accepted():
    plain = Slider.on(BLOCK, Support.at_points(TRIPOD))
    # With two digits, as in a file.
    for loads in (None, [0.33, 0.33, 0.34]):
        slider = Slider.on(BLOCK, Support.at_points(TRIPOD, loads), centre_of_mass=BALANCED)
        assert slider.c == pytest.approx(plain.c, rel=0.01)

    # By levers the legs bear 1/4, 1/4 and 1/2 of a weight in the middle.
    slider = Slider.on(
        BLOCK, Support.at_points(TRIPOD).carrying((0.0, 0.0)), centre_of_mass=(0.0, 0.0)
    )
    assert slider.c == pytest.approx((math.hypot(0.02, 0.02) + 0.02) / 2.0, rel=1e-9)
    assert slider.outline.pieces == pytest.approx(BLOCK.pieces, abs=1e-12)


@pytest.mark.parametrize('centre', [(0.0, 0.0), (0.0, 0.0199), (0.0, -0.02), (0.015, 0.0)])
def test_loads_that_do_not_carry_the_weight_are_refused(centre):
    with pytest.raises(ValueError, match='^support: expected loads that carry a weight') as refused:
        Slider.on(BLOCK, Support.at_points(TRIPOD), centre_of_mass=centre)
    message = str(refused.value)
    assert str(centre) in message
    assert '(0.0, -0.006667)' in message


@pytest.mark.parametrize('centre', [(math.nan, 0.0), (0.0, math.inf)])
def test_a_centre_of_mass_that_is_no_place_is_refused(centre):
    with pytest.raises(ValueError, match='^centre_of_mass: '):
        Slider.on(BLOCK, Support.at_points(TRIPOD), centre_of_mass=centre)


@pytest.mark.parametrize('exact', [False, True])
def test_an_exact_limit_surface_has_all_points_of_the_support(exact):
    support = Support.uniform(BLOCK, 100)

    slider = Slider.on(BLOCK, support, exact=exact)

    assert slider.c == support.c
    if exact:
        assert slider.points == pytest.approx(
            np.vstack([support.points.T, support.loads]), abs=1e-15
        )
    else:
        assert slider.points is None


def test_points_come_in_rows_of_one_piece_of_memory_each():
    outline = Outline.rectangle(0.05, 0.04)
    columns = np.array([[0.01, 0.0, 1.0], [-0.01, 0.01, 1.0], [0.0, -0.01, 1.0]])

    assert Slider(outline, 0.01, columns.T).points.flags.c_contiguous
    assert Slider.on(outline, Support.uniform(outline), exact=True).points.flags.c_contiguous


@pytest.mark.parametrize('points', [[[0.0, 1.0]], [[0.0], [0.0], [math.nan]], [0.0, 0.0, 1.0]])
def test_points_that_are_no_finite_rows_are_refused(points):
    with pytest.raises(ValueError, match='points: expected finite rows x, y, load'):
        Slider(Outline.circle(0.02), 0.01, np.array(points))


def test_a_disk_that_turns_rolls_along_the_edge():
    # While the contact sticks, d + r (theta - psi) stays as it is.
    block, r, turn = Outline.rectangle(0.05, 0.05), 0.0135, -0.15
    slider = Slider.on(block, Support.uniform(block, 40), exact=True)
    start, end = (0.004, -0.025 - r), (0.004, -0.015 - r)

    after = slider.pushed(Pose(0.0, 0.0, 0.0), start, end, math.inf, r, turn)

    along = (end[0] - after.x) * math.cos(after.angle) + (end[1] - after.y) * math.sin(after.angle)
    assert abs(after.angle) > 0.01
    assert along + r * (after.angle - turn) == pytest.approx(start[0], abs=1e-7)
    straight = slider.pushed(Pose(0.0, 0.0, 0.0), start, end, math.inf, r)
    assert abs(straight.angle - after.angle) > 0.01
