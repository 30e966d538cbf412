# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.simulation import paper_block, paper_disk
from tactile_push.simulation.by_touch import check_edges, faults_of, sensing_of


def test_an_object_without_an_edge_is_refused_for_what_it_is_wanted_for():
    check_edges(paper_block(), 'juggle')
    with pytest.raises(ValueError, match='expected one with straight edges to juggle'):
        check_edges(paper_disk(), 'juggle')


def test_the_finger_lags_and_the_sensor_errs_as_told():
    faults = faults_of(0.01, 0.2)
    assert (faults.sensor.noise, faults.servo.time_constant) == (0.01, 0.2)
    assert (faults.sensor.dropout, faults.servo.delay) == (0.0, 0.0)


def test_what_is_known_at_first_is_the_pushed_edge_and_no_more():
    sensing = sensing_of(paper_block(), math.radians(0.3), 0.1)
    for k in range(2):
        estimate = sensing.tick(0.1 * k, 0.2, 0.0, 0.0, math.pi / 2.0, -0.06)
    known = estimate.estimates[estimate.edge]
    assert (known.d.lower, known.d.upper) == pytest.approx((-0.025, 0.025), abs=0.003)
    assert known.l == pytest.approx(0.02375, rel=0.01)
    assert known.mu_c.lower < 0.1
    assert len(estimate.edges) == 1
