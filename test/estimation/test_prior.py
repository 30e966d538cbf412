# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is known before any data, and the hypotheses that stand for it."""

import math
from itertools import pairwise

import numpy as np
import pytest

from tactile_push.estimation.prior import NONE, SOME, STICKS, Prior, friction, spread
from tactile_push.estimation.unknowns import ALPHA, GROWTH, LOG_C, SHAPE, TILT, D, L, R

BLOCK = Prior((-0.025, 0.025), 0.02375)
SURE = (0.0135, 0.0), (1.5, 0.0), (0.5, 0.0)


@pytest.mark.parametrize(
    'changes',
    [
        {'d': (0.02, 0.01)},
        {'l': 0.0},
        {'l_sigma': 0.01},
        {'c': (0.0, 0.01)},
        {'mu_c': (0.5, 0.1)},
        {'mu_c': (-0.1, 1.0)},
        {'tilt': -1e-3},
        {'tilt': math.inf},
    ],
)
def test_priors_that_are_none_are_refused(changes):
    with pytest.raises(ValueError, match='expected'):
        Prior(**{'d': (-0.025, 0.025), 'l': 0.02375, **changes})


def test_hypotheses_share_the_kinds_of_friction_by_quarters():
    _, _, kinds, weights = spread(BLOCK, *SURE)
    assert weights.sum() == pytest.approx(1.0)
    assert np.bincount(kinds, weights) == pytest.approx([0.25, 0.5, 0.25])
    assert (np.diff(kinds) >= 0).all()  # one kind after the other


def test_hypotheses_are_even_over_the_edge_and_over_c():
    means, covariances, _, weights = spread(BLOCK, *SURE)
    # Even over 5 cm: mean 0 and variance 0.05^2/12 between the middles of the parts of the edge.
    count = len(np.unique(means[:, D]))
    assert weights @ means[:, D] == pytest.approx(0.0, abs=1e-15)
    assert weights @ means[:, D] ** 2 == pytest.approx(0.05**2 / 12.0 * (1.0 - 1.0 / count**2))
    # Each part is a third wider than the deviation, so that the density has no gaps.
    assert np.sqrt(covariances[:, D, D]) == pytest.approx(0.05 / count / 3.0)
    # Three parts of 0.005 to 0.036 m in equal ratios, each as likely as it is wide.
    edges = 0.005 * 7.2 ** (np.arange(4) / 3.0)
    for low, high in pairwise(edges):
        part = np.isclose(means[:, LOG_C], np.log(low * high) / 2.0)
        assert weights[part].sum() == pytest.approx((high - low) / 0.031)
        deviation = np.log(high / low) / math.sqrt(12.0)  # of an even density
        assert covariances[part, LOG_C, LOG_C] == pytest.approx(deviation**2)


def test_hypotheses_cover_the_tilts_up_to_the_greatest():
    means, covariances, _, _ = spread(Prior((-0.025, 0.025), 0.02375, tilt=0.006), *SURE)
    # Both ends are within two standard deviations of the middle.
    deviations = np.sqrt(covariances[:, TILT, TILT])
    assert means[:, TILT] == pytest.approx(0.003)
    assert (2.0 * deviations > 0.003).all()
    assert (deviations < 0.003).all()

    means, covariances, _, _ = spread(BLOCK, *SURE)
    assert not means[:, TILT].any()
    assert not covariances[:, TILT].any()


def test_hypotheses_of_some_friction_cover_its_angles_evenly():
    means, _, kinds, weights = spread(BLOCK, *SURE)
    assert (means[kinds == NONE, ALPHA] == 0.0).all()
    assert (means[kinds == STICKS, ALPHA] == math.pi / 2.0).all()
    some = kinds == SOME
    assert weights[some] @ means[some, ALPHA] / 0.5 == pytest.approx(math.pi / 4.0)


@pytest.mark.parametrize(
    ('mu_c', 'kinds'),
    [
        ((0.0, 0.0), {NONE}),
        ((0.3, 0.3), {SOME}),
        ((math.inf, math.inf), {STICKS}),
        ((0.2, 0.5), {SOME}),
        ((0.0, 0.5), {NONE, SOME}),
        ((0.2, math.inf), {SOME, STICKS}),
    ],
)
def test_only_possible_kinds_of_friction_have_hypotheses(mu_c, kinds):
    means, _, found, weights = spread(Prior((-0.025, 0.025), 0.02375, mu_c=mu_c), *SURE)
    assert set(found) == kinds
    assert weights.sum() == pytest.approx(1.0)
    assert (means[:, ALPHA] >= math.atan(mu_c[0])).all()
    assert (means[:, ALPHA] <= math.atan(mu_c[1])).all()


def test_what_is_known_alike_for_all_stands_in_every_hypothesis():
    prior = Prior((0.0, 0.0), 0.0285, l_sigma=0.002, moments=(2.0, 0.0, 0.5))
    means, covariances, _, _ = spread(prior, (0.0135, 0.001), (1.5, 1.2), (0.5, 0.4))
    assert (means[:, D] == 0.0).all()
    assert (covariances[:, D, D] == 0.0).all()
    for which, mean, deviation in (
        (L, 0.0285, 0.002),
        (R, 0.0135, 0.001),
        (GROWTH, 1.5, 1.2),
        (SHAPE, 0.5, 0.4),
    ):
        assert means[:, which] == pytest.approx(mean)
        assert covariances[:, which, which] == pytest.approx(deviation**2)


def test_slenderness_is_the_ratio_of_the_principal_second_moments():
    # A rectangle of 4 by 1 has second moments as 16 to 1, however it is turned.
    for turn in (0.0, 0.4, math.pi / 4.0):
        cos, sin = math.cos(turn), math.sin(turn)
        moments = 4.0 * cos**2 + 0.25 * sin**2, 3.75 * cos * sin, 4.0 * sin**2 + 0.25 * cos**2
        assert Prior((0.0, 0.1), 0.02, moments=moments).slenderness == pytest.approx(16.0)
    assert BLOCK.slenderness == 1.0


def test_an_area_without_preferred_direction_has_no_shape():
    means, covariances, _, _ = spread(BLOCK, (0.0135, 0.0), (1.5, 1.2), (0.5, 0.4))
    assert (means[:, SHAPE] == 0.0).all()
    assert (covariances[:, SHAPE, SHAPE] == 0.0).all()


def test_a_density_weighs_hypotheses_and_leaves_out_what_is_impossible():
    prior = Prior(BLOCK.d, BLOCK.l, mu_c=(0.0, 0.0), density=lambda d, c, mu_c: max(d, 0.0))
    means, _, _, weights = spread(prior, *SURE)
    assert (means[:, D] > 0.0).all()
    places = np.unique(means[:, D])
    shares = [weights[means[:, D] == place].sum() for place in places]
    assert shares == pytest.approx(places / places.sum())


@pytest.mark.parametrize('value', [0.0, -1.0, math.nan, math.inf])
def test_a_density_that_is_none_is_refused(value):
    prior = Prior(BLOCK.d, BLOCK.l, density=lambda d, c, mu_c: value)
    with pytest.raises(ValueError, match='density: expected'):
        spread(prior, *SURE)


@pytest.mark.parametrize('mu_c', [0.0, 0.3, 5.0, math.inf])
def test_friction_has_the_tangent_of_its_angle(mu_c):
    assert friction(math.atan(mu_c)) == pytest.approx(mu_c)
