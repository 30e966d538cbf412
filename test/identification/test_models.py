# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.measured_pushes import OUTLINE
from tactile_push.identification.models import (
    HOME,
    NOMINAL_MU_C,
    known_support,
    nominal,
    unknown_support,
)
from tactile_push.mechanics import ExactLimitSurface, Support

FEET = Support.at_points([[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], [1.0, 2.0, 1.5])


def test_nothing_fitted_is_uniform_pressure():
    physics = nominal(OUTLINE)

    assert physics.support.c == pytest.approx(Support.uniform(OUTLINE, 10).c)
    assert (physics.mu_c, NOMINAL_MU_C) == (0.25, 0.25)


@pytest.mark.parametrize('share', [0.3, 0.7, 0.97, 1.0])
def test_numbers_say_c_friction_and_where_the_centre_is(share):
    model = unknown_support(OUTLINE)
    largest, even = Support.spread(OUTLINE, 3.0, 10).c, Support.uniform(OUTLINE, 10)
    offset = HOME * even.c * np.array([0.5, -1.0])

    physics = model.physics(np.array([share, 0.3, 0.5, -1.0]))

    assert physics.mu_c == pytest.approx(math.tan(0.3))
    assert np.subtract(physics.support.centre, even.centre) == pytest.approx(offset)
    # The tilt of the pressure changes c by the square of the offset.
    assert physics.support.c == pytest.approx(share * largest, rel=0.02)
    values = model.values(physics)
    assert [values['x'], values['y']] == pytest.approx(offset)
    assert (values['c'], values['mu_c']) == (physics.support.c, physics.mu_c)


def test_c_changes_evenly_with_its_number_across_the_rim():
    # By the spread it would stand still there.
    model = unknown_support(OUTLINE, centre=False)
    rim = Support.spread(OUTLINE, 2.0, 10).c / Support.spread(OUTLINE, 3.0, 10).c

    c = [model.physics(np.array([rim + by, 0.3])).support.c for by in (-0.02, -0.01, 0.0, 0.01)]

    assert np.diff(c) == pytest.approx(np.diff(c)[0], rel=1e-6)
    assert [*model.values(model.physics(np.array([rim, 0.3])))] == ['c', 'mu_c']


def test_of_a_known_support_friction_and_tilt_are_left():
    model = known_support(FEET, tilt=True)
    most = min(ExactLimitSurface(FEET).largest_tilt, FEET.c / 2.0)

    physics = model.physics(np.array([0.4, most / FEET.c]))

    assert physics.support is FEET
    assert (physics.mu_c, physics.tilt) == pytest.approx((math.tan(0.4), most))
    assert model.unknowns[1].upper == pytest.approx(most / FEET.c)
    assert math.isnan(physics.spread)
    assert model.values(physics) == {'mu_c': physics.mu_c, 'tilt': physics.tilt}
    assert len(known_support(FEET).unknowns) == 1


def test_two_feet_bear_no_tilt():
    assert len(known_support(Support.at_points([[0.0, 0.0], [0.05, 0.0]]), tilt=True).unknowns) == 1


def test_a_fit_starts_from_all_combinations():
    starts = unknown_support(OUTLINE).starts

    assert len(starts) == 9
    assert all((point[2:] == 0.0).all() for point in starts)
