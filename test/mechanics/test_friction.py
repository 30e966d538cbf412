# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import (
    check_friction,
    friction_cone,
    translation_contacts,
    voted_rotation,
)

checked = settings(derandomize=True, deadline=None, max_examples=60)
CLOCKWISE, TRANSLATION, COUNTERCLOCKWISE = -1, 0, 1


def rotation_by_counting_rays(d, l, beta, mu_c):
    # II.A with angles: a ray whose angle is smaller than that of the ray to the centre of mass
    # passes to the right of it, and votes for counterclockwise rotation.
    alpha = math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c)
    centre = math.atan2(l, -d)
    rays = (math.pi / 2.0 + alpha, math.pi / 2.0 - alpha, beta)
    return COUNTERCLOCKWISE if sum(ray < centre for ray in rays) >= 2 else CLOCKWISE


@pytest.mark.parametrize('mu_c', [0.0, 1e-300, 0.5, 1e300, math.inf])
def test_coefficients_from_0_to_infinity_are_accepted(mu_c):
    check_friction(mu_c)


@pytest.mark.parametrize('mu_c', [-1e-300, -1.0, -math.inf, math.nan])
def test_other_coefficients_are_refused(mu_c):
    with pytest.raises(ValueError, match='mu_c'):
        check_friction(mu_c)
    with pytest.raises(ValueError, match='mu_c'):
        translation_contacts(mu_c, 0.02)


def test_without_friction_the_cone_is_exactly_the_normal():
    assert friction_cone(0.0) == (1.0, 0.0)


def test_with_infinite_friction_the_cone_is_exactly_180_degrees_wide():
    cos_alpha, sin_alpha = friction_cone(math.inf)

    assert (cos_alpha, sin_alpha) == (0.0, 1.0)
    left, right = math.atan2(cos_alpha, -sin_alpha), math.atan2(cos_alpha, sin_alpha)
    assert math.degrees(left - right) == 180.0


@pytest.mark.parametrize(
    ('mu_c', 'degrees'), [(1.0, 45.0), (math.sqrt(3.0), 60.0), (1.0 / math.sqrt(3.0), 30.0)]
)
def test_the_half_angle_is_the_arctangent_of_the_coefficient(mu_c, degrees):
    cos_alpha, sin_alpha = friction_cone(mu_c)

    assert math.degrees(math.atan2(sin_alpha, cos_alpha)) == pytest.approx(degrees, rel=1e-14)


@checked
@given(st.floats(0.0, 1e300))
def test_the_cone_has_a_unit_direction_on_the_edge_of_coulombs_law(mu_c):
    cos_alpha, sin_alpha = friction_cone(mu_c)

    assert cos_alpha**2 + sin_alpha**2 == pytest.approx(1.0, rel=1e-14)
    assert cos_alpha > 0.0
    assert sin_alpha == pytest.approx(mu_c * cos_alpha, rel=1e-14)


@pytest.mark.parametrize(
    ('mu_c', 'lower', 'upper'),
    [(0.0, 0.0, 0.0), (0.5, -0.01, 0.01), (2.0, -0.04, 0.04), (math.inf, -math.inf, math.inf)],
)
def test_translating_contacts_lie_in_the_cone_projected_from_the_centre_of_mass(mu_c, lower, upper):
    assert translation_contacts(mu_c, 0.02) == (lower, upper)


@pytest.mark.parametrize('l', [0.0, -0.02, math.nan])
def test_translating_contacts_need_a_distance(l):
    with pytest.raises(ValueError, match='l:'):
        translation_contacts(0.5, l)


@pytest.mark.parametrize(
    ('d', 'l', 'beta', 'mu_c', 'sense'),
    [
        # The contact right of the centre of mass, the push straight ahead: three votes.
        (0.01, 0.02, 90.0, 0.1, COUNTERCLOCKWISE),
        (-0.01, 0.02, 90.0, 0.1, CLOCKWISE),
        # In front of it, between the cone's edges, the push decides.
        (0.0, 0.02, 80.0, 0.1, COUNTERCLOCKWISE),
        (0.0, 0.02, 100.0, 0.1, CLOCKWISE),
        # Right of the projected cone, d > mu_c l, no push decides.
        (0.01, 0.02, 170.0, 0.4, COUNTERCLOCKWISE),
        (0.01, 0.02, 170.0, 0.6, CLOCKWISE),
        (-0.01, 0.02, 10.0, 0.4, CLOCKWISE),
        (-0.01, 0.02, 10.0, 0.6, COUNTERCLOCKWISE),
        # Infinite friction: the two tangents vote oppositely, so the push decides anywhere.
        # From d = l the centre of mass is seen at 135 degrees.
        (0.02, 0.02, 134.0, math.inf, COUNTERCLOCKWISE),
        (0.02, 0.02, 136.0, math.inf, CLOCKWISE),
        # No friction: the push does not matter.
        (0.001, 0.02, 170.0, 0.0, COUNTERCLOCKWISE),
        (-0.001, 0.02, 10.0, 0.0, CLOCKWISE),
    ],
)
def test_the_majority_decides(d, l, beta, mu_c, sense):
    assert voted_rotation(d, l, math.radians(beta), mu_c) == sense


@pytest.mark.parametrize(
    ('d', 'l', 'beta', 'mu_c'),
    [
        # One ray through the centre of mass, the others against each other.
        (0.02, 0.02, math.radians(150.0), 1.0),  # the cone's left edge; the push is left of it
        (-0.02, 0.02, math.radians(30.0), 1.0),
        # Two: the cone is one ray that passes through it, the push does not.
        (0.0, 0.02, math.radians(60.0), 0.0),
        (0.0, 0.02, math.radians(120.0), 0.0),
        # Three: and the push does too, as nearly as its angle can be written.
        (0.0, 0.02, math.pi / 2.0, 0.0),
    ],
)
def test_a_tie_translates(d, l, beta, mu_c):
    assert voted_rotation(d, l, beta, mu_c) == TRANSLATION


@pytest.mark.parametrize(
    ('d', 'degrees', 'sense'), [(0.02, 80.0, COUNTERCLOCKWISE), (-0.02, 100.0, CLOCKWISE)]
)
def test_one_ray_through_the_centre_of_mass_does_not_outvote_two(d, degrees, sense):
    # The cone's edge passes through it; the other edge and the push agree.
    assert voted_rotation(d, 0.02, math.radians(degrees), 1.0) == sense


@pytest.mark.parametrize('friction', ['none', 'finite', 'infinite'])
def test_10000_pushes_vote_like_rays_that_are_counted(friction):
    random = np.random.default_rng(1992)
    senses = set()
    for _ in range(10_000):
        d, l = random.uniform(-0.05, 0.05), random.uniform(0.001, 0.05)
        beta = random.uniform(0.0, math.pi)
        mu_c = {'none': 0.0, 'finite': random.exponential(), 'infinite': math.inf}[friction]
        sense = voted_rotation(d, l, beta, mu_c)
        assert sense == rotation_by_counting_rays(d, l, beta, mu_c), (d, l, beta, mu_c)
        senses.add(sense)
    assert senses == {CLOCKWISE, COUNTERCLOCKWISE}


@checked
@given(
    st.floats(-0.05, 0.05),
    st.floats(0.001, 0.05),
    st.floats(0.01, math.pi - 0.01),
    st.floats(0.0, 10.0) | st.just(math.inf),
)
def test_mirror_images_vote_for_mirror_images(d, l, beta, mu_c):
    # But for pushes at the centre of mass, where rounding decides.
    if abs(d * math.sin(beta) + l * math.cos(beta)) > 1e-15:
        assert voted_rotation(-d, l, math.pi - beta, mu_c) == -voted_rotation(d, l, beta, mu_c)
