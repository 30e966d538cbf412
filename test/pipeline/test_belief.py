# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from types import SimpleNamespace

import pytest

from tactile_push.estimation import DiskEstimator, ObjectEstimator, edges_of, sensing_values
from tactile_push.mechanics.turning_tip import TurningTip
from tactile_push.paper import BLOCK_CORNERS, BLOCK_EDGE, BLOCK_L
from tactile_push.pipeline.belief import NEEDED, belief_of

NOISE, PIECE, NAN = 0.005, 5e-4, math.nan
LINKS = 0.06, 0.08, 0.08, 0.0


def pushed(estimator):
    """Return what is known after a push, as an estimate and as numbers."""
    estimator.push(0.1, 0.0, 0.005, 0.0)
    estimate = estimator.push(0.12, 0.002, 0.005, 0.1)
    sensing = SimpleNamespace(readings=2, age=0.02, noise=NOISE)
    return estimate, sensing_values(estimate, sensing)


@pytest.fixture(scope='module')
def block():
    return pushed(ObjectEstimator(edges_of(BLOCK_CORNERS)[:1], NOISE, mu_c=(1.0, 1.0)))


def test_what_is_believed_is_the_mean_under_the_pushed_edge(block):
    estimate, values = block
    believed = belief_of(values, 0.03, (0.06, 0.08, 0.09, -1.0), PIECE)
    (known,) = estimate.estimates
    assert (believed.x, believed.theta, believed.d) == (0.03, known.theta, known.d.mean)
    assert believed.ends == pytest.approx((-BLOCK_EDGE / 2.0, BLOCK_EDGE / 2.0))
    assert believed.pushed.l == pytest.approx(BLOCK_L, rel=0.1)
    assert believed.pushed.tip == TurningTip(a=0.06, b=0.08, y=0.09, bend=-1.0)
    # mu_c = 1 is known: an angle of 45 degrees.
    assert believed.pushed.sin_alpha == pytest.approx(math.sqrt(0.5))
    assert believed.pushed.cos_alpha == pytest.approx(math.sqrt(0.5))
    assert believed.spread.d == pytest.approx(math.sqrt(known.covariance[1, 1]))
    assert believed.spread.noise == NOISE
    assert believed.spread.reading == PIECE
    assert believed.pushed.pressure.growth == pytest.approx(1.5, abs=0.5)
    assert math.sqrt(believed.pushed.pressure.c_squared) == pytest.approx(known.c.mean, rel=0.05)


@pytest.mark.parametrize('name', [*NEEDED, 'mu_c'])
def test_without_one_of_the_numbers_nothing_is_believed(block, name):
    _, values = block
    assert belief_of({**values, name: math.nan}, 0.03, LINKS, PIECE) is None
    others = {other: value for other, value in values.items() if other != name}
    assert belief_of(others, 0.03, LINKS, PIECE) is None


@pytest.mark.parametrize(('x', 'y', 'bend'), [(NAN, 0.08, 1.0), (0.0, NAN, 1.0), (0.0, 0.08, NAN)])
def test_without_the_finger_s_place_nothing_is_believed(block, x, y, bend):
    assert belief_of(block[1], x, (*LINKS[:2], y, bend), PIECE) is None


def test_friction_may_be_infinite(block):
    believed = belief_of({**block[1], 'mu_c': math.inf}, 0.03, LINKS, PIECE)
    assert (believed.pushed.cos_alpha, believed.pushed.sin_alpha) == (0.0, 1.0)


def test_of_a_disk_without_edges_nothing_is_believed():
    _, values = pushed(DiskEstimator(0.03, NOISE))
    assert belief_of(values, 0.03, LINKS, PIECE) is None


@pytest.mark.parametrize(
    ('name', 'value'),
    [('l', 0.0), ('c_squared', -1.0), ('noise', 0.0), ('d_deviation', -1e-9), ('theta', 1e308)],
)
def test_of_what_is_like_no_object_nothing_is_believed(block, name, value):
    assert belief_of({**block[1], name: value}, 0.03, LINKS, PIECE) is None
