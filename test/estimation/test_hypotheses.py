# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support import pushed_block
from support.pushed_block import HALF, RADIUS
from tactile_push.estimation.hypotheses import LASTING, ModelErrors, advance, correct, predict
from tactile_push.estimation.prior import ROUND
from tactile_push.estimation.unknowns import LOG_C, THETA, UNKNOWNS, D, L
from tactile_push.mechanics import Slider
from tactile_push.mechanics.resistance import Pressure, Push

LOG = math.log(0.0187)
MOMENTS = np.array(ROUND)


def advanced(
    theta,
    d,
    c_squared,
    alpha,
    l,
    r,
    growth,
    shape,
    moments,
    v_x,
    v_y,
    duration,
    curved,
    spin=0.0,
    tilt=0.0,
):
    pressure = Pressure(c_squared, growth, shape, moments, tilt)
    once = Push(v_x, v_y, duration, spin)
    return advance(theta, d, alpha, l, r, pressure, once, curved)


def pushed(means, covariances, motions, moments, v_x, v_y, duration, scatter, skew, drift, curved):
    once, errors = Push(v_x, v_y, duration), ModelErrors(scatter, skew, drift)
    predict(means, covariances, motions, moments, once, errors, curved)


def exactly(theta, d, c, mu_c, v_x, spin=0.0):
    return pushed_block.pushed(Slider(pushed_block.OUTLINE, c), theta, d, mu_c, v_x, spin=spin)


@pytest.mark.parametrize('spin', [0.0, -0.06, 0.1])  # of the finger's disk [rad/s]
@pytest.mark.parametrize('mu_c', [0.0, 0.2, 1.0, math.inf])
def test_a_push_is_that_of_the_mechanics(mu_c, spin):
    rng = np.random.default_rng(1)
    for _ in range(40):
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.02, 0.02)
        c, v_x = rng.uniform(0.005, 0.036), rng.uniform(-0.004, 0.004)
        found = advanced(
            *(theta, d, c * c, math.atan(mu_c), HALF, RADIUS, 0.0, 0.0, MOMENTS),
            *(v_x, 0.005, 0.1, False, spin),
        )

        expected = exactly(theta, d, c, mu_c, v_x, spin)
        assert found[0] == pytest.approx(expected[0], rel=0, abs=5e-5)
        assert found[1] == pytest.approx(expected[1], rel=0, abs=2e-6)


@pytest.mark.parametrize('mu_c', [0.0, 0.2, 1.0, math.inf])
def test_a_push_above_the_support_turns_the_object_about_the_shifted_centre(mu_c):
    rng = np.random.default_rng(1)
    moved = 0.0
    for _ in range(20):
        theta, d = rng.uniform(-0.4, 0.4), rng.uniform(-0.015, 0.015)
        c, v_x, tilt = rng.uniform(0.01, 0.036), rng.uniform(-0.004, 0.004), 0.006
        at_height, at_ground = (
            advanced(
                *(theta, d, c * c, math.atan(mu_c), HALF, RADIUS, 0.0, 0.0, MOMENTS),
                *(v_x, 0.005, 0.1, False),
                tilt=height,
            )
            for height in (tilt, 0.0)
        )

        expected = pushed_block.pushed_above(tilt, theta, d, c, mu_c, v_x)
        assert at_height[0] == pytest.approx(expected[0], rel=0, abs=1e-4)
        assert at_height[1] == pytest.approx(expected[1], rel=0, abs=3e-6)
        moved = max(moved, abs(at_height[1] - at_ground[1]))
    assert moved > 1e-5


def one(mean, deviations):
    return np.array([mean]), np.diag(np.square(deviations))[np.newaxis].copy()


def test_mean_and_covariance_are_those_of_many_pushed_objects():
    rng = np.random.default_rng(2)
    middle = (0.1, 0.006, LOG, math.atan(0.3), HALF, RADIUS, 1.0, 0.5, 0.004)
    deviations = (0.01, 0.0005, 0.03, 0.05, 0.0003, 0.0005, 0.5, 0.3, 0.001)
    means, covariances = one(middle, deviations)

    moments = np.array([2.0, 0.0, 0.5])
    pushed(means, covariances, still(), moments, 0.001, 0.005, 0.1, 0.0, 0.0, 0.0, False)

    samples = rng.normal(middle, deviations, (4000, UNKNOWNS))
    for row in samples:
        theta, d, log_c, *others, tilt = row
        row[[THETA, D]] = advanced(
            *(theta, d, math.exp(2.0 * log_c), *others, moments, 0.001, 0.005, 0.1, False),
            tilt=tilt,
        )[:2]
    scale = samples.std(axis=0)
    assert (means[0] - samples.mean(axis=0)) / scale == pytest.approx(0.0, rel=0, abs=0.06)
    difference = (covariances[0] - np.cov(samples.T)) / np.outer(scale, scale)
    assert difference == pytest.approx(0.0, rel=0, abs=0.08)


def still():
    """Nothing is known of the motion before."""
    return np.full((1, 2), math.nan)


def test_what_is_known_for_certain_stays_certain():
    means, covariances = one(
        (0.2, -0.006, LOG, math.pi / 2.0, HALF, RADIUS, 0.0, 0.0, 0.0), (0.0,) * UNKNOWNS
    )

    pushed(means, covariances, still(), MOMENTS, 0.0, 0.005, 0.1, 0.0, 0.0, 0.0, False)

    assert covariances == pytest.approx(0.0, rel=0, abs=1e-20)
    assert means[0, :2] == pytest.approx(exactly(0.2, -0.006, 0.0187, math.inf, 0.0), abs=2e-5)


def test_scatter_adds_what_it_says():
    certain = (0.2, -0.006, LOG, math.pi / 2.0, HALF, RADIUS, 0.0, 0.0, 0.0)
    means, covariances = one(certain, (0.0,) * UNKNOWNS)

    pushed(means, covariances, still(), MOMENTS, 0.0, 0.005, 0.1, 0.1, 0.0, 0.01, False)

    # A tenth of what it turns in 5 mm, which are ten such pushes.
    turn = means[0, THETA] - 0.2
    deviation = 0.1 * abs(turn) * math.sqrt(10.0)
    variance = covariances[0]
    assert math.sqrt(variance[THETA, THETA]) == pytest.approx(deviation, rel=0.02)
    assert variance[D, D] == pytest.approx(RADIUS**2 * variance[THETA, THETA])
    assert variance[THETA, D] == pytest.approx(-RADIUS * variance[THETA, THETA])
    assert variance[LOG_C, LOG_C] == 0.0  # in the first push nothing changes


def test_scatter_over_a_way_does_not_depend_on_how_often_one_looks():
    spreads = []
    for count in (10, 40):
        certain = (0.2, -0.006, LOG, math.pi / 2.0, HALF, RADIUS, 0.0, 0.0, 0.0)
        means, covariances = one(certain, (0.0,) * UNKNOWNS)
        motions = still()
        for _ in range(count):
            push_once = 0.0, 0.005, 1.0 / count, 0.1, 0.0, 0.0, False
            pushed(means, covariances, motions, MOMENTS, *push_once)
        spreads.append(math.sqrt(covariances[0, THETA, THETA]))
    assert spreads[0] == pytest.approx(spreads[1], rel=0.05)


@pytest.mark.parametrize(('mu_c', 'd', 'v_x'), [(0.0, -0.006, 0.0), (0.2, 0.012, -0.004)])
def test_slip_goes_with_a_turn_that_scatters(mu_c, d, v_x):
    # With another c the object turns and slips otherwise, in the same ratio.
    alpha = math.atan(mu_c)
    ends = [
        advanced(*(0.2, d, c * c, alpha, HALF, RADIUS, 0.0, 0.0, MOMENTS, v_x, 0.005, 0.02), False)
        for c in (0.0187, 0.0188)
    ]
    assert ends[0][2] != 0.0
    means, covariances = one((0.2, d, LOG, alpha, HALF, RADIUS, 0.0, 0.0, 0.0), (0.0,) * UNKNOWNS)

    pushed(means, covariances, still(), MOMENTS, v_x, 0.005, 0.02, 0.1, 0.0, 0.0, False)

    ratio = covariances[0, THETA, D] / covariances[0, THETA, THETA]
    assert ratio == pytest.approx((ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0]), rel=0.02)
    assert covariances[0, D, D] == pytest.approx(ratio**2 * covariances[0, THETA, THETA])


def test_drift_grows_with_the_change_of_motion():
    certain = (0.2, -0.006, LOG, math.pi / 2.0, HALF, RADIUS, 0.0, 0.0, 0.0)
    means, covariances = one(certain, (0.0,) * UNKNOWNS)
    motions = still()
    push_once = 0.0, 0.005, 0.1, 0.0, 0.0, 0.01, False
    pushed(means, covariances, motions, MOMENTS, *push_once)
    # The finger goes straight on: the contact, which sticks, leaves along theta from the normal.
    direction, turning = motions[0]
    turn = means[0, THETA] - 0.2
    assert direction == pytest.approx(0.2 + turn / 2.0)
    assert turning == pytest.approx(turn * HALF / 0.0005)

    motions[0] += 0.3, -0.1
    pushed(means, covariances, motions, MOMENTS, *push_once)

    share = 0.0005 / (0.0005 + LASTING)
    assert covariances[0, LOG_C, LOG_C] == pytest.approx(0.01**2 * share * 0.4, rel=0.1)


def test_skew_moves_a_slipping_contact_of_an_object_that_turns():
    means, covariances = one(
        (0.0, 0.01, LOG, math.atan(0.2), HALF, RADIUS, 0.0, 0.0, 0.0), (0.0,) * UNKNOWNS
    )

    pushed(means, covariances, still(), MOMENTS, -0.004, 0.005, 0.1, 0.0, 0.1, 0.0, False)

    slip = means[0, D] - 0.01 + RADIUS * means[0, THETA]
    assert abs(slip) > 1e-5
    way = math.hypot(-0.0004 - slip, 0.0005)
    turn = abs(means[0, THETA]) * HALF / way
    aside = 0.1 * turn * math.sin(2.0 * math.atan(0.2))  # an angle that lasts for 5 mm
    assert covariances[0, D, D] == pytest.approx(aside**2 * way * LASTING, rel=0.05)
    assert covariances[0, THETA, THETA] == pytest.approx(0.0, abs=1e-20)


def test_a_reading_is_weighed_as_bayes_does():
    # Two hypotheses with the standard deviation 0.02 of theta and a reading with 0.01.
    means = np.zeros((2, UNKNOWNS))
    means[:, THETA] = 0.0, 0.05
    covariances = np.zeros((2, UNKNOWNS, UNKNOWNS))
    covariances[:, THETA, THETA] = 0.0004
    covariances[:, L, L] = 1e-6
    covariances[:, THETA, L] = covariances[:, L, THETA] = 1e-5
    weights = np.log([0.5, 0.5])

    density = correct(means, covariances, weights, 0.01, 0.0001, 1e-9)

    normal = [
        math.exp(-(error**2) / 0.001) / math.sqrt(math.tau * 0.0005) for error in (0.01, -0.04)
    ]
    assert density == pytest.approx(sum(normal) / 2.0, rel=1e-6)
    assert np.exp(weights) == pytest.approx(np.array(normal) / sum(normal), rel=1e-6)
    assert means[:, THETA] == pytest.approx([0.008, 0.018])  # four fifths of the way
    assert means[:, L] == pytest.approx([1e-5 / 0.0005 * 0.01, -1e-5 / 0.0005 * 0.04])
    assert covariances[0, THETA, THETA] == pytest.approx(0.00008)
    assert covariances[0, L, L] == pytest.approx(1e-6 - 1e-10 / 0.0005)


def test_an_outlier_moves_nothing():
    means, covariances = one(
        (0.1, 0.0, 4e-4, 1.0, HALF, RADIUS, 0.0, 0.0, 0.0),
        (0.003, 0.001, 1e-5, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0),
    )
    before = means.copy(), covariances.copy()

    density = correct(means, covariances, np.zeros(1), 1.0, 1e-5, 0.001)

    assert density == pytest.approx(0.001 / math.pi)
    assert (means == before[0]).all()
    assert (covariances == before[1]).all()
