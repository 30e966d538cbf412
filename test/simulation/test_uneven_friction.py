# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.simulation import UnevenFriction


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_friction_is_even_to_the_bit(mu_c):
    even = UnevenFriction()
    assert all(even.mu_c(mu_c, sigma) == mu_c for sigma in (-0.02, 0.0, 0.0131))
    assert even.even(0.005) == math.inf


def test_friction_goes_up_and_down_along_the_edge():
    uneven = UnevenFriction(0.5, 0.004)
    found = [uneven.mu_c(0.2, 0.001 * k) for k in range(5)]
    assert found == pytest.approx([0.2, 0.3, 0.2, 0.1, 0.2])


@pytest.mark.parametrize('mu_c', [0.0, math.inf])
def test_none_and_infinite_friction_stay_what_they_are(mu_c):
    uneven = UnevenFriction(0.99, 0.004)
    assert all(uneven.mu_c(mu_c, 0.001 * k) == mu_c for k in range(-4, 5))


def test_friction_hardly_changes_in_the_time_that_is_told():
    uneven = UnevenFriction(0.5, 0.004)
    way = 0.005 * uneven.even(0.005)
    changes = [
        abs(uneven.mu_c(0.2, 0.0001 * k + way) - uneven.mu_c(0.2, 0.0001 * k)) for k in range(40)
    ]
    assert 0.0 < max(changes) < 0.05 * 0.2


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('ripple', -0.1),
        ('ripple', 1.0),
        ('ripple', math.nan),
        ('length', 0.0),
        ('length', math.inf),
    ],
)
def test_number_out_of_its_range_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f'{name}: expected'):
        UnevenFriction(**{name: value})
