# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math

import numpy as np
import pytest

pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.measured_pushes import OUTLINE, RADIUS, content, measured, pushes_in, ways
from tactile_push.identification import models
from tactile_push.identification.fitting import Fitter
from tactile_push.identification.models import HOME, known_support, unknown_support
from tactile_push.identification.records import Push, Pushes
from tactile_push.mechanics import Outline, Pose, Support

FEET = Support.at_points([[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], [1.0, 2.0, 1.5])


@pytest.fixture(autouse=True)
def _few_points(monkeypatch):
    monkeypatch.setattr(models, 'POINTS', 40)


@pytest.fixture
def read(tmp_path):
    """Return a function that gives pushes as read from a file."""

    def written(pushes):
        file = tmp_path / 'block.json'
        file.write_text(json.dumps(content(pushes)))
        return pushes_in(file)

    return written


def pushed_on(support, mu_c, count, tilt=0.0):
    return [measured(support, mu_c, *way, tilt) for way in ways(count)]


def test_pushes_without_noise_give_their_numbers(read):
    even = Support.spread(OUTLINE, 2.4, 40)
    offset = HOME * Support.uniform(OUTLINE, 40).c * np.array([1.0, -0.5])
    support = even.carrying((even.centre[0] + offset[0], even.centre[1] + offset[1]))
    pushes = read(pushed_on(support, 0.2, 11))

    fit = Fitter(unknown_support(OUTLINE), pushes).fit(range(11))

    expected = {'c': support.c, 'mu_c': 0.2, 'x': offset[0], 'y': offset[1]}
    assert fit.values == pytest.approx(expected, rel=0.01, abs=2e-5)
    assert fit.physics.spread == pytest.approx(2.4, abs=0.05)
    assert fit.deviations['c'] < 1e-3 * support.c


@pytest.mark.parametrize('tilt', [0.0, 3e-3])
def test_pushes_on_a_known_support_say_how_far_above_it_they_are(read, tilt):
    pushes = read(pushed_on(FEET, 0.4, 8, tilt))

    fit = Fitter(known_support(FEET, tilt=True), pushes).fit(range(8))

    assert fit.values == pytest.approx({'mu_c': 0.4, 'tilt': tilt}, abs=1e-4)


def test_pushes_are_fitted_by_those_that_are_chosen(read):
    mixed = read(
        [
            push
            for pair in zip(pushed_on(FEET, 0.15, 6), pushed_on(FEET, 0.45, 6), strict=True)
            for push in pair
        ]
    )

    fitter = Fitter(known_support(FEET), mixed)

    found = [fitter.fit(range(first, 12, 2)).values['mu_c'] for first in (0, 1)]
    assert found == pytest.approx([0.15, 0.45], abs=1e-3)


def test_what_no_push_tells_is_not_told():
    # Head on at the middle of an edge nothing slips and nothing turns: mu_c is open.
    square = Support.at_points([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    ahead = Push('', Pose(0.0, 0.0, 0.0), Pose(0.0, 0.5, 0.0), ((0.0, -2.0), (0.0, -0.5)), 1.0)
    outline = Outline.rectangle(2.0, 2.0)
    pushes = Pushes(outline, (ahead,) * 6)

    fit = Fitter(known_support(square), pushes).fit(range(6))

    assert fit.open == ['mu_c']
    assert math.isinf(fit.bound['mu_c'])


def test_the_centre_stays_at_home_unless_pushes_tell_it():
    start, begin, end = next(iter(ways(1)))
    still = Push('', Pose(*start), Pose(*start), (begin, begin), RADIUS)

    fit = Fitter(unknown_support(OUTLINE), Pushes(OUTLINE, (still,) * 4)).fit(range(4))

    assert (fit.values['x'], fit.values['y']) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert fit.open == ['c', 'mu_c']  # the prior has the centre
    assert end != begin


def test_a_few_wild_records_hardly_move_the_fit(read):
    pushes = read(pushed_on(FEET, 0.3, 12))
    noise = 1e-4 * np.random.default_rng(2).normal(size=(12, 2))
    noise[[2, 7]] = 0.05
    spoilt = tuple(
        push._replace(end=push.end._replace(x=push.end.x + dx, y=push.end.y + dy))
        for push, (dx, dy) in zip(pushes.pushes, noise.tolist(), strict=True)
    )

    fit = Fitter(known_support(FEET), Pushes(OUTLINE, spoilt)).fit(range(12))

    assert fit.values['mu_c'] == pytest.approx(0.3, abs=0.01)


def test_where_the_object_would_tip_over_the_fit_turns_back(read):
    # The load is close to the centroid, so that it does not bear a centre far from there.
    support = Support.spread(OUTLINE, 0.4, 40)
    fitter = Fitter(unknown_support(OUTLINE), read(pushed_on(support, 0.3, 10)))
    edge = np.array([0.12, 0.3, 4.9, 4.9])

    with pytest.raises(ValueError, match='centre_of_mass'):
        unknown_support(OUTLINE).physics(edge)
    fit = fitter.fit(range(10))

    assert fit.values['c'] == pytest.approx(support.c, rel=0.02)
    assert np.isfinite(fitter.judged(np.array([0.3, 0.3, 2.0, -2.0]), range(10)).covariance).all()
