# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

from statistics import NormalDist

import numpy as np
import pytest

from tactile_push.estimation.mixture import EXACT, hull_of_intervals, quantile

SHARES = [0.025, 0.1, 0.5, 0.9, 0.975]


def test_quantiles_of_one_gaussian_and_of_two_far_apart():
    ones, zeros = np.ones(1), np.zeros(1)

    assert quantile(ones, zeros, ones, 0.025) == pytest.approx(-1.959964, abs=1e-3)
    assert quantile(3.0 * ones, 2.0 * ones, 4.0 * ones, 0.975) == pytest.approx(5.919928, abs=2e-3)
    # The upper one has a quarter of the weight: the share 0.775 lies a tenth into it.
    found = quantile(np.array([0.75, 0.25]), np.array([0.0, 100.0]), np.ones(2), 0.775)
    assert found == pytest.approx(100.0 - 1.281552, abs=2e-2)
    assert quantile(ones, 7.0 * ones, zeros, 0.025) == pytest.approx(7.0)


@pytest.mark.parametrize('share', SHARES)
@pytest.mark.parametrize('seed', range(8))
def test_the_share_below_a_quantile_is_the_one_asked_for(seed, share):
    rng = np.random.default_rng(seed)
    weights, means = rng.uniform(0.1, 3.0, 5), rng.normal(0.0, 2.0, 5)
    variances = rng.uniform(0.01, 4.0, 5)

    value = quantile(weights, means, variances, share)

    below = [NormalDist(m, v**0.5).cdf(value) for m, v in zip(means, variances, strict=True)]
    # Beyond 4.5 deviations, where it takes a Gaussian to have nothing, lie 3.4e-6.
    assert weights @ below / weights.sum() == pytest.approx(share, rel=0, abs=EXACT + 4e-6)


def test_the_median_of_a_symmetric_mixture_is_its_middle():
    found = quantile(np.ones(2), np.array([-3.0, 7.0]), np.full(2, 4.0), 0.5)
    # Where the density is that of a normal distribution at 2.5 deviations: 0.0088 by 1 unit.
    assert found == pytest.approx(2.0, abs=EXACT / 0.0087)


@pytest.mark.parametrize(('share', 'expected'), [(0.25, 1.0), (0.65, 2.0), (0.95, 5.0)])
def test_quantiles_of_certain_numbers_are_among_them(share, expected):
    weights, means = np.array([0.3, 0.1, 0.6]), np.array([2.0, 5.0, 1.0])
    found = quantile(weights, means, np.zeros(3), share)
    assert found == pytest.approx(expected, abs=1e-5)


def test_quantiles_grow_with_the_share_and_shift_with_the_means():
    weights, means, variances = np.array([1.0, 2.0]), np.array([0.0, 1.0]), np.array([0.2, 0.5])
    found = [quantile(weights, means, variances, share) for share in SHARES]
    shifted = [quantile(weights, means + 10.0, variances, share) for share in SHARES]
    assert found == sorted(found)
    assert shifted == pytest.approx(np.array(found) + 10.0, abs=1e-6)


@pytest.mark.parametrize(('evidence', 'least'), [(0.021, -5.0), (0.019, 5.0)])
def test_the_hull_of_intervals_leaves_out_a_kind_of_little_evidence(evidence, least):
    means, kinds = np.array([5.0, -5.0]), np.array([0, 2])  # none of the kind 1
    shares = np.array([0.5, 0.25, 0.25])
    weights = np.array([0.5, 0.25 * evidence])

    found = hull_of_intervals(weights, means, np.ones(2), kinds, shares)

    assert found == pytest.approx((least - 1.959964, 5.0 + 1.959964), abs=2e-3)
