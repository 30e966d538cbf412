# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from tactile_push.parameters import MujocoPlantParameters, SimPlantParameters
from tactile_push.parameters.mujoco_plant import mujoco_config


def test_it_has_all_parameters_of_the_other_plant_with_the_same_defaults():
    given = {known.name: known for known in MujocoPlantParameters.declared()}
    assert [given[known.name] for known in SimPlantParameters.declared()] == list(
        SimPlantParameters.declared()
    )


def test_an_even_support_is_that_of_the_paper():
    _, physics = mujoco_config(MujocoPlantParameters(object='disk', disk_radius=0.03))
    assert physics.support.c == pytest.approx(2.0 / 3.0 * 0.03)
    # The feet that stand for it are few, and have nearly the same c.
    shares = physics.support.loads / physics.support.loads.sum()
    assert shares @ np.hypot(*physics.support.points.T) == pytest.approx(0.02, rel=0.02)


@pytest.mark.parametrize(
    ('support', 'c'), [('corners', math.hypot(0.025, 0.02375)), ('rim', 0.0277)]
)
def test_a_support_has_its_c(support, c):
    # Of a square's rim: side / 4 (sqrt(2) + asinh(1)) = 0.574 side, here with the mean side.
    _, physics = mujoco_config(MujocoPlantParameters(support=support))
    assert physics.support.c == pytest.approx(c, rel=0.02)


@pytest.mark.parametrize(('spread', 'c'), [(1.0, 0.0187), (3.0, math.hypot(0.025, 0.02375))])
def test_a_load_may_be_spread_by_a_number(spread, c):
    given = {'support': 'spread', 'spread': spread}
    _, physics = mujoco_config(MujocoPlantParameters(**given))
    shares = physics.support.loads / physics.support.loads.sum()
    assert shares @ np.hypot(*physics.support.points.T) == pytest.approx(c, rel=0.02)
    assert shares @ physics.support.points == pytest.approx([0.0, 0.0], abs=1e-12)


def test_the_push_and_the_object_are_as_given():
    given = {'mass': 2.0, 'object_height': 0.08, 'push_height': 0.02, 'mu_s': 0.4}
    _, physics = mujoco_config(MujocoPlantParameters(**given))
    assert {name: getattr(physics, name) for name in given} == given
    assert physics.inertia is None
    assert mujoco_config(MujocoPlantParameters(inertia=1e-3))[1].inertia == 1e-3


@pytest.mark.parametrize(
    ('given', 'refusal'),
    [
        ({'c': 0.02}, 'parameter c: expected 0.0, as the support gives it here, got 0.02'),
        ({'f_max': 1.0}, 'parameter f_max: expected 2.7, as mu_s and mass give it here, got 1.0'),
        ({'push_height': 0.06}, 'parameter push_height: expected a height of the object'),
        ({'object': 'disk', 'support': 'corners'}, 'parameter support: expected a polygon'),
        (
            {'object': 'disk', 'support': 'spread', 'spread': 2.5},
            'parameter spread: expected a number from 0 to 2, got 2.5',
        ),
        ({'d_initial': 0.3}, 'parameter d_initial: expected a contact'),
    ],
)
def test_a_rig_that_is_none_is_refused(given, refusal):
    with pytest.raises(ValueError) as refused:
        mujoco_config(MujocoPlantParameters(**given))
    assert str(refused.value).startswith(refusal)
