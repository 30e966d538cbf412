# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bank of hypotheses: Bayes' rule, and what the hypotheses say together."""

import math
from statistics import NormalDist

import numpy as np
import pytest

from support.pushed_block import HALF, RADIUS
from tactile_push.estimation.bank import Bank, Liberties
from tactile_push.estimation.prior import Prior
from tactile_push.estimation.unknowns import ALPHA, THETA, D, L

NOISE = 0.002
RIGID = Liberties((0.0, 0.0), (0.0, 0.0), 0.0, 0.0, 0.0)
# Three parts of c: 8 to 12, 12 to 18 and 18 to 27 mm. Four parts of d, 5 mm long.
C, EDGE = (0.008, 0.027), (0.0, 0.02)


def bank(density=None, mu_c=(math.inf, math.inf), d=EDGE, liberties=RIGID, l_sigma=0.0):
    prior = Prior(d, HALF, l_sigma, C, mu_c, density=density)
    return Bank(prior, (RADIUS, 0.0), liberties, NOISE, 1e-12, False)


def light(d, c, mu_c):
    return float(0.005 < d < 0.01 and c < 0.012)


def heavy(d, c, mu_c):
    return float(0.005 < d < 0.01 and c > 0.018)


def either(d, c, mu_c):
    return light(d, c, mu_c) + heavy(d, c, mu_c)


def test_two_hypotheses_are_weighed_as_bayes_does():
    banks = both, *alone = [bank(density) for density in (either, light, heavy)]
    for one in banks:
        one.start(0.2)
        for _ in range(6):
            one.push(0.001, 0.005, 0.1, 0.0)
    # As likely as their parts of c are wide, 4 and 9 mm.
    assert both.weights == pytest.approx([4.0 / 13.0, 9.0 / 13.0])
    reading = 0.26
    densities = []
    for one in alone:
        mean, variance = one.theta()
        densities.append(NormalDist(mean, math.sqrt(variance + NOISE**2)).pdf(reading))
    assert 0.1 < abs(math.log(densities[0] / densities[1])) < 3.0  # which tells, not too much

    told = both.read(reading)

    products = np.array([4.0, 9.0]) / 13.0 * densities
    assert told == pytest.approx(math.log(products.sum()), abs=1e-6)
    assert both.weights == pytest.approx(products / products.sum(), rel=1e-6)
    assert both.weights.sum() == pytest.approx(1.0, rel=1e-12)


def test_an_unlikely_hypothesis_is_dropped_and_the_weights_still_sum_to_one():
    both, true = bank(either), bank(light)
    for one in (both, true):
        one.start(0.2)
    for _ in range(60):
        for one in (both, true):
            one.push(0.001, 0.005, 0.1, 0.0)
        both.read(true.theta()[0])
    assert both.weights == pytest.approx([1.0])


def test_before_any_push_the_moments_are_those_of_the_prior():
    one = bank(liberties=Liberties((1.5, 1.2), (0.0, 0.0)), l_sigma=0.001)
    one.start(0.3)

    mean, covariance = one.moments()

    # Evenly over 2 cm: the four middles, 5 mm apart, and a third of 5 mm within each part.
    assert mean[D] == pytest.approx(0.01)
    assert covariance[D, D] == pytest.approx(0.005**2 * (15.0 / 12.0 + 1.0 / 9.0))
    assert (mean[THETA], mean[L], mean[ALPHA]) == pytest.approx((0.3, HALF, math.pi / 2.0))
    assert covariance[THETA, THETA] == pytest.approx(NOISE**2)
    assert covariance[L, L] == pytest.approx(0.001**2)
    assert one.theta() == pytest.approx((0.3, NOISE**2))


def test_a_long_push_is_as_several_short_ones():
    long, short = bank(), bank()
    for one in (long, short):
        one.start(0.2)
    long.push(0.001, 0.004, 0.6, 0.0)  # 2.5 mm, in three parts
    for _ in range(3):
        short.push(0.001, 0.004, 0.2, 0.0)
    for found, expected in zip(long.moments(), short.moments(), strict=True):
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-18)


def test_an_interval_is_the_hull_under_each_kind_of_friction():
    def places(d, c, mu_c):  # on the right if it slips freely, on the left if it sticks
        return float(d > 0.015 if mu_c == 0.0 else d < 0.005 and math.isinf(mu_c))

    one = bank(places, mu_c=(0.0, math.inf))
    one.start(0.0)
    # 95 % of a normal distribution lie within 1.96 deviations, here of a third of 5 mm.
    outer = 1.959964 * 0.005 / 3.0
    expected = (0.0025 - outer, 0.0175 + outer)
    assert one.interval(D, -1.0, 1.0) == pytest.approx(expected, abs=1e-5)
    assert one.interval(D, 0.001, 0.018) == (0.001, 0.018)


def test_contacts_that_run_off_the_edge_are_counted():
    one = bank(mu_c=(0.0, 0.0))
    one.start(0.0)
    one.read(0.0)
    assert one.off == 0.0
    for _ in range(60):
        one.push(0.01, 0.0001, 0.1, 0.0)
    assert one.read(one.theta()[0]) < math.log(1e-9)
    assert one.off == pytest.approx(1.0)
    one.start(0.0)
    assert one.off == 0.0


@pytest.mark.parametrize('name', ['drift', 'scatter', 'skew'])
@pytest.mark.parametrize('value', [-0.1, math.nan, math.inf])
def test_liberties_that_are_none_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        Liberties(**{name: value})


def test_another_contact_is_as_far_along_the_edge_as_the_finger_went_and_the_rest_stays():
    one, theta, way = bank(d=(-0.02, 0.02), l_sigma=1e-3, liberties=Liberties()), 0.4, -0.006
    one.start(theta)
    for k in range(30):
        one.push(0.004 * math.sin(k / 5.0), 0.005, 0.1, 0.0)
        one.read(theta + 0.002 * k)
    (before, spread), weights = one.moments(), one.weights
    one.touch_again(way, 0.0)
    after, now = one.moments()
    others = [i for i in range(len(after)) if i != D]
    assert after[others] == pytest.approx(before[others])
    assert now[np.ix_(others, others)] == pytest.approx(spread[np.ix_(others, others)])
    assert one.weights == pytest.approx(weights)
    # (cos theta, sin theta) d is the way along the edge. Theta is known to a few thousandths.
    assert after[D] - before[D] == pytest.approx(way / math.cos(before[THETA]), rel=1e-3)
    slope = way * math.sin(before[THETA]) / math.cos(before[THETA]) ** 2
    expected = spread[D, D] + 2.0 * slope * spread[D, THETA] + slope**2 * spread[THETA, THETA]
    assert now[D, D] == pytest.approx(expected, rel=1e-3)


def test_what_may_have_turned_unseen_is_not_known_any_more_and_has_rolled():
    one, turn = bank(d=(-0.02, 0.02)), 0.01
    one.start(0.0)
    _, before = one.moments()
    one.touch_again(0.0, turn)
    _, after = one.moments()
    added = after - before
    assert added[THETA, THETA] == pytest.approx(turn**2)
    assert added[D, THETA] == added[THETA, D] == pytest.approx(-RADIUS * turn**2)
    assert added[D, D] == pytest.approx((RADIUS * turn) ** 2)
