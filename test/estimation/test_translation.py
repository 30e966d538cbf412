# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.estimation import (
    bounds_of_translation,
    centre_on_ray,
    contact_of_translation,
    surface_direction,
    translates,
)

checked = settings(derandomize=True, deadline=None, max_examples=60)
thetas = st.floats(-1.5, 1.5)
betas = st.floats(0.01, math.pi - 0.01)
distances = st.floats(0.001, 0.1)
BLOCK = 0.02375


def d_in_cm(phi_less_theta):
    theta = math.radians(-10.0)
    return 100.0 * contact_of_translation(theta, theta + math.radians(phi_less_theta), BLOCK)


@checked
@given(thetas, betas, distances)
def test_both_branches_of_17(theta, beta, l):
    phi = theta + beta
    if phi - theta < math.pi / 2.0:
        expected = l / math.tan(theta - phi)
    else:
        expected = l / math.tan(math.pi + theta - phi)

    assert contact_of_translation(theta, phi, l) == pytest.approx(expected, rel=1e-12, abs=1e-16)


@checked
@given(thetas, st.floats(0.3, math.pi - 0.3), st.floats(-20.0, 20.0), st.floats(0.0, 0.02))
def test_surface_of_a_turning_tip_moves_as_its_material_does(theta, phi, turning, lever):
    def surface(way):
        """Return where the tip's material is that touches the edge when the way is 0."""
        x, y = way * math.cos(phi), way * math.sin(phi)
        angle = theta + math.pi / 2.0 + turning * x  # from the centre to the contact
        return np.array([x + lever * math.cos(angle), y + lever * math.sin(angle)])

    x, y = surface(1e-6) - surface(-1e-6)
    difference = surface_direction(theta, phi, turning, lever) - math.atan2(y, x)
    assert math.remainder(difference, math.tau) == pytest.approx(0.0, abs=1e-6)


def test_the_bounds_that_the_paper_finds():
    # phi - theta between 90.6 and 95.0 degrees, themselves rounded to tenths.
    assert round(d_in_cm(95.0), 2) == 0.21
    assert round(d_in_cm(90.55), 2) < 0.03 == round(d_in_cm(90.65), 2)
    assert d_in_cm(90.6) == pytest.approx(2.375 * 0.6 * math.pi / 180.0, rel=1e-4)  # tan x = x


@pytest.mark.parametrize(
    ('degrees', 'd'),
    [(45.0, -1.0), (135.0, 1.0), (60.0, -1.0 / math.sqrt(3.0)), (150.0, math.sqrt(3.0))],
)
def test_contacts_as_computed_by_hand(degrees, d):
    # A push to the right, towards +t, comes from the left of the centre of mass.
    assert contact_of_translation(0.2, 0.2 + math.radians(degrees), 1.0) == pytest.approx(
        d, rel=1e-14
    )


def test_a_straight_push_comes_from_the_middle():
    assert contact_of_translation(0.0, math.pi / 2.0, BLOCK) == pytest.approx(0.0, abs=1e-17)


@checked
@given(thetas, betas, distances)
def test_the_ray_of_pushing_passes_through_the_centre_of_mass(theta, beta, l):
    d = contact_of_translation(theta, theta + beta, l)

    # In the frame of the base, from the contact: -d along the tangent and l along the normal.
    x = -d * math.cos(theta) - l * math.sin(theta)
    y = -d * math.sin(theta) + l * math.cos(theta)
    assert math.atan2(y, x) == pytest.approx(
        math.remainder(theta + beta, math.tau), rel=0, abs=1e-13
    )


@checked
@given(betas, st.floats(-1.0, 1.0))
def test_it_is_continuous_where_the_branches_meet(theta, side):
    phi = theta + math.pi / 2.0 + side * 1e-9

    assert contact_of_translation(theta, phi, 1.0) == pytest.approx(side * 1e-9, rel=0, abs=1e-15)


@checked
@given(betas, distances)
def test_mirror_images_mirror(beta, l):
    d = contact_of_translation(0.0, beta, l)

    assert contact_of_translation(0.0, math.pi - beta, l) == pytest.approx(-d, rel=1e-11, abs=1e-15)


@pytest.mark.parametrize(
    ('theta', 'phi'),
    [
        (0.3, 0.3),
        (0.3, 0.2),
        (0.0, math.pi),
        (-0.1, 3.1),
        (-2.0, 2.0),
        (math.nan, 1.5),
        (0.0, math.nan),
        (0.0, math.inf),
    ],
)
def test_a_finger_that_does_not_move_into_the_object_pushes_from_nowhere(theta, phi):
    with pytest.raises(ValueError, match='phi - theta'):
        contact_of_translation(theta, phi, BLOCK)


def test_the_bounds_of_the_paper_follow_from_its_range():
    lower, upper = bounds_of_translation(
        (0.0, 0.0), (math.radians(90.6), math.radians(95.0)), BLOCK
    )

    assert lower == pytest.approx(0.00025, abs=1e-5)  # 0.03 cm, from angles rounded to tenths
    assert round(100.0 * upper, 2) == 0.21


@checked
@given(thetas, st.floats(0.0, 0.3), st.floats(0.35, 2.4), st.floats(0.0, 0.3), distances)
def test_bounds_hold_for_all_angles_in_the_ranges(theta, width, beta, spread, l):
    phi = theta + beta
    lower, upper = bounds_of_translation((theta, theta + width), (phi, phi + spread), l)

    for a in (0.0, 0.4, 1.0):
        for b in (0.0, 0.7, 1.0):
            d = contact_of_translation(theta + a * width, phi + b * spread, l)
            assert lower - 1e-12 <= d <= upper + 1e-12


@pytest.mark.parametrize(('theta', 'phi'), [((0.1, 0.0), (1.0, 2.0)), ((0.0, 0.1), (0.05, 2.0))])
def test_ranges_without_bounds_are_refused(theta, phi):
    with pytest.raises(ValueError, match='theta'):
        bounds_of_translation(theta, phi, BLOCK)


def test_translation_is_claimed_wrongly_no_more_often_than_stated():
    rng = np.random.default_rng(0)
    way, noise, turn, count = 0.05, 0.005, 0.5, 4000
    line = np.linspace(0.0, way, 101)

    wrong = sum(
        translates(0.2 + turn * line + noise * rng.standard_normal(101), way, noise, 0.1, turn)
        for _ in range(count)
    )
    right = sum(
        translates(0.2 + noise * rng.standard_normal(101), way, noise, 0.1, turn)
        for _ in range(200)
    )

    assert wrong / count == pytest.approx(0.05, abs=0.012)  # one side of 10 %
    assert right == 200


def test_few_noisy_readings_show_no_translation():
    assert not translates([0.0, 0.0, 0.0], 0.001, 0.01, 0.05, 1.0)


@pytest.mark.parametrize(
    'changes',
    [
        {'theta': [0.0, 0.1]},
        {'theta': [0.0, math.nan, 0.1]},
        {'way': 0.0},
        {'noise': 0.0},
        {'error': 1.0},
        {'turn': -1.0},
    ],
)
def test_what_cannot_tell_translation_is_refused(changes):
    numbers = {'theta': [0.0] * 5, 'way': 0.01, 'noise': 0.01, 'error': 0.05, 'turn': 1.0}
    with pytest.raises(ValueError, match='expected'):
        translates(**{**numbers, **changes})


@checked
@given(thetas, betas, distances)
def test_the_centre_lies_on_the_ray_that_leaves_the_contact(theta, beta, l):
    r = 0.0135
    x, y = centre_on_ray(theta, contact_of_translation(theta, theta + beta, l), l, r)

    x, y = x + r * math.sin(theta), y - r * math.cos(theta)  # from the contact, at r n
    assert math.remainder(math.atan2(y, x) - theta - beta, math.tau) == pytest.approx(0, abs=1e-12)
