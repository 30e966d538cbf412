# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.estimation import ParallelRaysError, Ray, intersect_rays

CENTRE = np.array([0.004, 0.023])


def towards_centre(x, y, error=0.0, sigma_angle=0.01, sigma_contact=0.0):
    angle = math.atan2(CENTRE[1] - y, CENTRE[0] - x)
    return Ray(x, y, angle + error, sigma_angle, sigma_contact)


def test_two_rays_meet_in_the_centre():
    found = intersect_rays([towards_centre(-0.01, 0.0), towards_centre(0.015, 0.0)])

    assert (found.x, found.y) == pytest.approx(tuple(CENTRE), abs=1e-12)
    assert found.chi_squared == pytest.approx(0.0, abs=1e-12)


def test_rays_at_a_right_angle_have_the_covariance_computed_by_hand():
    # Along x and y, 3 cm and 2 cm from the centre: each is uncertain across itself.
    rays = [Ray(-0.03, 0.0, 0.0, 0.01), Ray(0.0, -0.02, math.pi / 2.0, 0.01, 0.001)]
    found = intersect_rays(rays)

    assert found.covariance == pytest.approx(np.diag([0.0002**2 + 0.001**2, 0.0003**2]), abs=1e-15)


@pytest.mark.slow
def test_covariance_and_chi_squared_are_those_of_many_noisy_rays():
    rng = np.random.default_rng(0)
    places = [(-0.02, 0.0), (0.0, 0.0), (0.02, 0.0), (0.03, 0.02)]
    errors, chi, expected = [], [], 0.0
    for _ in range(1500):
        found = intersect_rays(
            [towards_centre(*place, error=0.01 * rng.standard_normal()) for place in places]
        )
        errors.append((found.x - CENTRE[0], found.y - CENTRE[1]))
        chi.append(found.chi_squared)
        expected = expected + found.covariance / 1500
    scale = np.sqrt(np.diag(expected))
    difference = (np.cov(np.array(errors).T) - expected) / np.outer(scale, scale)

    assert difference == pytest.approx(0.0, rel=0, abs=0.15)
    assert np.mean(chi) == pytest.approx(2.0, abs=0.3)


def test_nearly_parallel_rays_are_told():
    with pytest.raises(ParallelRaysError, match='degrees'):
        intersect_rays([Ray(0.0, 0.0, 1.0, 0.01), Ray(0.02, 0.0, 1.1, 0.01)])
    with pytest.raises(ParallelRaysError, match='degrees'):
        intersect_rays([Ray(0.0, 0.0, 1.0, 0.01), Ray(0.02, 0.0, 1.0 + math.pi, 0.01)])


def test_one_ray_is_too_few():
    with pytest.raises(ValueError, match='two or more'):
        intersect_rays([towards_centre(0.0, 0.0)])


@pytest.mark.parametrize('changes', [{'x': math.nan}, {'sigma_angle': 0.0}, {'sigma_contact': -1}])
def test_rays_that_are_none_are_refused(changes):
    with pytest.raises(ValueError, match='expected'):
        Ray(**{'x': 0.0, 'y': 0.0, 'angle': 1.0, 'sigma_angle': 0.01, **changes})
