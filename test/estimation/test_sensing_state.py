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
    return SimpleNamespace(readings=readings, age=0.02, took=took)


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


def test_an_edge_keeps_its_number_among_few(estimate):
    few = replace(estimate, edges=estimate.edges[3:], weights=np.ones(1), edge=0)
    assert sensing_values(few, sensing())['edge'] == 3.0


def test_a_disk_has_no_edge():
    values = sensing_values(DiskEstimator(0.0285, NOISE).push(0.1, 0.0, BELT, 0.0), sensing())
    assert math.isnan(values['edge'])
    assert math.isnan(values['edge_weight'])


@pytest.mark.parametrize('case', ['no reading', 'contradiction'])
def test_without_knowledge_there_are_bounds_but_no_middle(estimate, case):
    if case == 'contradiction':
        estimate, told = replace(estimate, contradiction=REASON), sensing()
    else:
        told = sensing(readings=0)
    values = sensing_values(estimate, told)
    assert all(math.isnan(values[name]) for name in ('d', 'c', 'mu_c'))
    assert (values['d_least'], values['d_most']) == (-0.04, 0.04)
    expected = REASON if case == 'contradiction' else ''
    assert CONTRADICTIONS[int(values['contradiction'])] == expected


@pytest.mark.parametrize(
    ('took', 'reason', 'expected'),
    [(True, '', True), (False, '', False), (True, REASON, False), (False, REASON, False)],
)
def test_a_pose_comes_with_a_reading_that_agrees(estimate, took, reason, expected):
    told = tells_pose(replace(estimate, contradiction=reason), sensing(took=took))
    assert told is expected
