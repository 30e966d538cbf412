# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What active sensing tells, as numbers with names."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from support.simulated_pushes import BELT, NOISE, PLATE
from tactile_push.estimation import (
    CONTRADICTIONS,
    DiskEstimator,
    ObjectEstimator,
    edges_of,
    sensing_values,
    tells_pose,
)
from tactile_push.interface import SENSING_STATE, TOPICS

REASON = CONTRADICTIONS[3]


def sensing(readings=5, took=True):
    return SimpleNamespace(readings=readings, age=0.02, took=took, noise=NOISE)


@pytest.fixture(scope='module')
def estimate():
    """Return what is known of a plate after one reading, most likely its third edge."""
    found = ObjectEstimator(edges_of(PLATE), NOISE).push(0.1, 0.0, BELT, 0.0)
    return replace(found, edge=2, weights=np.array([0.1, 0.2, 0.6, 0.1]))


def test_every_number_stands_under_its_name(estimate):
    values = sensing_values(estimate, sensing())
    assert tuple(values) == TOPICS[SENSING_STATE].field_names
    for name in ('d', 'c', 'mu_c'):
        quantity = getattr(estimate, name)
        assert values[name] == quantity.mean
        assert (values[f'{name}_lower'], values[f'{name}_upper']) == (
            quantity.lower,
            quantity.upper,
        )
        assert (values[f'{name}_least'], values[f'{name}_most']) == (quantity.least, quantity.most)
    assert values['theta'] == estimate.theta == pytest.approx(0.1)
    assert (values['edge'], values['edge_weight']) == (2.0, 0.6)
    assert (values['readings'], values['age']) == (5.0, 0.02)
    assert values['surprise'] == estimate.surprise
    assert values['noise'] == NOISE


def test_what_a_plan_takes_is_told_of_the_likeliest_edge(estimate):
    values = sensing_values(estimate, sensing())
    one = estimate.estimates[2]
    # The third edge of the plate is as long as the first: 8 cm, 1 cm from the centre of mass.
    assert (values['edge_start'], values['edge_end']) == (-0.04, 0.04)
    assert values['l'] == one.l == pytest.approx(0.01, rel=0.01)
    assert values['radius'] == pytest.approx(0.0135, rel=0.01)
    # Before it is pushed the contact may be anywhere: evenly on 8 cm.
    assert values['d_deviation'] == pytest.approx(0.08 / math.sqrt(12.0), rel=0.05)
    assert values['theta_deviation'] == pytest.approx(NOISE, rel=0.05)
    assert values['log_c_deviation'] == pytest.approx(math.log(one.c.upper / one.c.lower) / 4.0)
    pressure = one.pressure
    assert values['c_squared'] == pressure.c_squared
    assert (values['growth'], values['shape']) == (pressure.growth, pressure.shape)
    assert values['tilt'] == pressure.tilt
    moments = [values[f'moment_{way}'] for way in ('along', 'mixed', 'across')]
    # Along the long edges the area is spread four times as far as across, and the determinant is 1.
    assert moments == pytest.approx([4.0, 0.0, 0.25])


def test_an_edge_keeps_its_number_among_few(estimate):
    few = replace(estimate, edges=estimate.edges[3:], weights=np.ones(1), edge=0)
    assert sensing_values(few, sensing())['edge'] == 3.0


def test_a_disk_has_no_edge():
    values = sensing_values(DiskEstimator(0.0285, NOISE).push(0.1, 0.0, BELT, 0.0), sensing())
    assert math.isnan(values['edge'])
    assert math.isnan(values['edge_weight'])
    assert math.isnan(values['edge_start'])


@pytest.mark.parametrize('case', ['no reading', 'contradiction'])
def test_without_knowledge_there_are_bounds_but_no_middle(estimate, case):
    if case == 'contradiction':
        estimate, told = replace(estimate, contradiction=REASON), sensing()
    else:
        told = sensing(readings=0)
    values = sensing_values(estimate, told)
    assert all(math.isnan(values[name]) for name in ('d', 'c', 'mu_c'))
    assert (values['d_least'], values['d_most']) == (-0.04, 0.04)
    assert (values['edge_start'], values['edge_end']) == (-0.04, 0.04)
    assert all(math.isnan(values[name]) for name in ('d_deviation', 'l', 'growth'))
    expected = REASON if case == 'contradiction' else ''
    assert CONTRADICTIONS[int(values['contradiction'])] == expected


@pytest.mark.parametrize(
    ('took', 'reason', 'expected'),
    [(True, '', True), (False, '', False), (True, REASON, False), (False, REASON, False)],
)
def test_a_pose_comes_with_a_reading_that_agrees(estimate, took, reason, expected):
    told = tells_pose(replace(estimate, contradiction=reason), sensing(took=took))
    assert told is expected
