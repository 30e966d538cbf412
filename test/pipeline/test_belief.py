# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.estimation import ObjectEstimator, edges_of
from tactile_push.paper import BLOCK_CORNERS, BLOCK_EDGE, BLOCK_L
from tactile_push.pipeline.belief import belief_of


def test_what_is_believed_is_the_mean_under_the_pushed_edge():
    estimator = ObjectEstimator(edges_of(BLOCK_CORNERS)[:1], 0.005, mu_c=(1.0, 1.0))
    estimator.push(0.1, 0.0, 0.005, 0.0)
    estimate = estimator.push(0.12, 0.002, 0.005, 0.1)
    believed = belief_of(estimate, 0.03, -12.0, 0.005, 5e-4)
    (known,) = estimate.estimates
    assert (believed.x, believed.theta, believed.d) == (0.03, known.theta, known.d.mean)
    assert believed.ends == pytest.approx((-BLOCK_EDGE / 2.0, BLOCK_EDGE / 2.0))
    assert believed.pushed.l == pytest.approx(BLOCK_L, rel=0.1)
    assert believed.pushed.turning == -12.0
    # mu_c = 1 is known: an angle of 45 degrees.
    assert believed.pushed.sin_alpha == pytest.approx(math.sqrt(0.5))
    assert believed.pushed.cos_alpha == pytest.approx(math.sqrt(0.5))
    assert believed.spread.d == pytest.approx(math.sqrt(known.covariance[1, 1]))
    assert believed.pushed.pressure.growth == pytest.approx(1.5, abs=0.5)
    assert math.sqrt(believed.pushed.pressure.c_squared) == pytest.approx(known.c.mean, rel=0.05)
