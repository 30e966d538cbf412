# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.identification.covariance import (
    FINEST,
    ROBUST,
    deviations_with_noise_alone,
    robust_covariance,
    robust_loss,
    widths,
)

FREE = np.array([math.inf, math.inf])


def test_widths_are_standard_deviations_of_normal_residuals():
    random = np.random.default_rng(1)
    residual = random.normal(size=(20000, 4)) * [2e-3, 2e-3, 2e-3 / 0.03, 0.1]
    residual[::2, 3] = np.nan

    assert widths(residual, 0.03) == pytest.approx([2e-3, 2e-3, 2e-3 / 0.03, 0.1], rel=0.03)


def test_widths_are_positive_without_errors_and_without_forces():
    residual = np.zeros((5, 4))
    residual[:, 3] = np.nan

    found = widths(residual, 0.03)

    assert found[:2] == pytest.approx(FINEST)
    assert (found > 0.0).all()


def test_the_loss_is_the_square_of_small_residuals_and_linear_in_large_ones():
    squares = np.array([1e-6, 1e4, 9e4, 1e4])

    loss, slope, curvature = robust_loss(squares, 3)

    assert loss[0] == pytest.approx(1e-6, rel=1e-3)
    assert loss[2] - loss[1] == pytest.approx(2.0 * ROBUST * 200.0, rel=1e-3)
    assert (loss[3], slope[3], curvature[3]) == (1e4, 1.0, 0.0)  # of a prior


def test_the_derivatives_are_those_of_the_loss():
    squares, step = np.array([0.01, 0.3, 2.0, 50.0]), 1e-5
    lower, upper = (robust_loss(squares + side * step, 3) for side in (-1.0, 1.0))

    _, slope, curvature = robust_loss(squares, 3)

    assert (upper[0] - lower[0]) / step / 2.0 == pytest.approx(slope, rel=1e-5)
    assert (upper[1] - lower[1]) / step / 2.0 == pytest.approx(curvature, rel=1e-4)


@pytest.mark.parametrize('draw', ['normal', 'laplace'])
def test_the_covariance_is_that_of_robust_fits_over_draws_of_errors(draw):
    # Weighted least squares for the same loss, from scratch, for 1000 draws at once.
    random = np.random.default_rng(5)
    rates = random.normal(size=(60, 4, 2)) * [1.0, 0.4]
    errors = getattr(random, draw)(size=(1000, 60, 4))
    fits, flat = np.zeros((1000, 2)), rates.reshape(-1, 2)
    for _ in range(25):
        left = errors + np.einsum('nki,di->dnk', rates, fits)
        weight = (1.0 / np.sqrt(1.0 + (left / ROBUST) ** 2)).reshape(1000, -1)
        matrix = np.einsum('mi,dm,mj->dij', flat, weight, flat, optimize=True)
        gradient = (weight * left.reshape(1000, -1)) @ flat
        fits -= np.linalg.solve(matrix, gradient[..., np.newaxis])[..., 0]

    stated = [np.diag(robust_covariance(one, rates, FREE)) for one in left[:100]]

    # A few per cent more, as each is the larger of two estimates.
    ratio = np.mean(stated, axis=0) / np.var(fits, axis=0)
    assert ratio == pytest.approx(1.05, abs=0.15)


def test_a_number_that_the_pushes_leave_open_keeps_its_prior():
    rates = np.random.default_rng(6).normal(size=(30, 4, 2)) * [1.0, 0.0]
    residual = np.random.default_rng(7).normal(size=(30, 4))

    found = robust_covariance(residual, rates, np.array([math.inf, 0.7]))

    assert found[1] == pytest.approx([0.0, 0.49])
    alone = robust_covariance(residual, rates, FREE)
    assert math.isinf(alone[1, 1])
    assert (alone[0, 1], alone[0, 0]) == (0.0, pytest.approx(found[0, 0]))
    bound = deviations_with_noise_alone(rates, np.eye(2))
    assert bound == pytest.approx([(rates[..., 0] ** 2).sum() ** -0.5, math.inf])


def test_residuals_that_are_not_there_say_nothing():
    random = np.random.default_rng(8)
    rates, residual = random.normal(size=(30, 4, 2)), random.normal(size=(30, 4))
    residual[:, 3] = np.nan
    other = rates.copy()
    other[:, 3] *= 10.0

    found = [robust_covariance(residual, one, FREE) for one in (rates, other)]

    assert found[0] == pytest.approx(found[1])


def test_with_noise_alone_fits_scatter_by_the_bound():
    random = np.random.default_rng(9)
    rates, slopes = random.normal(size=(20, 4, 2)), np.array([[2.0, 0.0], [1.0, 3.0]])
    flat = rates.reshape(-1, 2)
    fits = [np.linalg.lstsq(flat, random.normal(size=80), rcond=None)[0] for _ in range(4000)]

    found = deviations_with_noise_alone(rates, slopes)

    assert found == pytest.approx(np.std(fits @ slopes.T, axis=0), rel=0.05)
