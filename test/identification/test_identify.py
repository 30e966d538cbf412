# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.measured_pushes import OUTLINE
from tactile_push.identification import models
from tactile_push.identification.identify import FEWEST, crosswise, halves_of, identify, model_of
from tactile_push.identification.predicting import residuals
from tactile_push.identification.records import Bad
from tactile_push.mechanics import Support

TRUE = {'mu_c': 0.3, 'x': 0.0015, 'y': -0.001}


def test_the_numbers_are_found_within_their_deviations(identified, truth):
    values, deviations = identified.fit.values, identified.fit.deviations

    for name, true in {**TRUE, 'c': truth.c}.items():
        assert abs(values[name] - true) < 3.0 * deviations[name], name
    assert deviations['c'] < 0.02 * truth.c
    assert max(deviations['x'], deviations['y']) < 3e-4
    assert deviations['mu_c'] < 0.02


def test_bad_records_are_named_and_left_out(identified):
    (untouched, reason), (far, why) = identified.pushes.bad

    assert (untouched, reason) == (
        'never touched',
        'the object moves, but the tip never touches it',
    )
    assert far == 'far off'
    assert 'from the predicted one' in why
    assert not {'never touched', 'far off'} & {push.name for push in identified.pushes.pushes}


def test_pushes_are_predicted_by_numbers_that_do_not_know_them(identified, noisy):
    # Noise of 0.2 mm in x and y is 0.25 mm in the mean.
    errors, nominal = identified.errors, identified.nominal

    assert len(errors.position) == len(noisy.pushes) - 2
    assert 1.5e-4 < errors.position.mean() < 5e-4
    assert nominal.position.mean() > 2.0 * errors.position.mean()


def test_each_half_is_predicted_from_the_other(noisy, monkeypatch):
    monkeypatch.setattr(models, 'POINTS', 40)
    some = noisy.of(range(5))

    class One:
        def __init__(self, spread):
            self.physics = models.Physics(Support.spread(OUTLINE, spread, 40), 0.2)

    first, second = One(1.0), One(2.4)

    found = crosswise(some, (first, second))

    assert list(map(list, halves_of(some))) == [[0, 2, 4], [1, 3]]
    by_first, by_second = (residuals(some, one.physics) for one in (first, second))
    assert found[1::2] == pytest.approx(by_first[1::2], nan_ok=True)
    assert found[::2] == pytest.approx(by_second[::2], nan_ok=True)
    assert np.abs(by_first - by_second)[:, :2].max() > 1e-4


def test_of_a_known_support_friction_is_found_alone(noisy, truth):
    model = model_of(replace(noisy, support=truth))

    assert [*model.values(model.physics(model.starts[0]))] == ['mu_c']
    assert model.physics(model.starts[0]).support is truth


def test_too_few_pushes_are_refused(noisy):
    with pytest.raises(ValueError, match=f'pushes: expected {FEWEST} or more, got 7'):
        identify(noisy.of(range(7)))


def test_many_bad_records_are_refused_with_the_first_of_them(noisy):
    spoilt = replace(noisy, bad=(Bad('pushes[3]', 'tip_end: expected 2 numbers, got NaN'),) * 9)

    with pytest.raises(ValueError, match=r'got 9 of 37; pushes\[3\]: tip_end: expected') as error:
        identify(spoilt)
    assert '\n' not in str(error.value)
