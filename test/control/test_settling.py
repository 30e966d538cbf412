# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import settle_step

checked = settings(derandomize=True, deadline=None, max_examples=60)


@pytest.mark.parametrize(
    ('theta', 'step'),
    [
        ([5.0, 4.0, 3.0, 1.0, -1.0], 2),
        ([0.0, 0.0, 0.0], 0),
        ([3.0, -3.0], 0),  # at the edge of the band is near
        ([5.0, 0.0, 5.0, 0.0, 0.0], 3),  # it left once more
        ([0.0, -3.5, 0.0], 2),
        ([5.0, 0.0], 1),
        ([0.0, 0.0, 5.0], None),
        ([5.0], None),
        ([], None),
        ([5.0, math.nan, 0.0], 2),  # an unknown angle is not near
        ([0.0, 0.0, math.nan], None),
    ],
)
def test_the_step_from_which_theta_stays_near(theta, step):
    assert settle_step(theta, 0.0, 3.0) == step


def test_near_is_near_the_desired_angle():
    theta = np.radians([20.0, -6.9, -7.1, -12.9])

    assert settle_step(theta, math.radians(-10.0), math.radians(3.0)) == 2


@checked
@given(
    st.lists(st.floats(-2.0, 2.0) | st.just(math.nan), max_size=15),
    st.floats(-0.5, 0.5),
    st.floats(0.0, 2.0),
)
def test_it_is_the_first_step_that_has_only_near_ones_behind_it(theta, theta_desired, band):
    near = [abs(value - theta_desired) <= band for value in theta]
    steps = [k for k in range(len(theta)) if all(near[k:])]

    assert settle_step(theta, theta_desired, band) == (steps[0] if steps else None)
