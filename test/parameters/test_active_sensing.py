# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The estimator that the parameters of `active_sensing` make."""

import math

import pytest

from tactile_push.parameters import ActiveSensingParameters
from tactile_push.parameters.active_sensing import make_sensing

TRIANGLE = [-0.03, -0.015, 0.04, -0.02, -0.01, 0.035]


def first_estimate(**values):
    """Return what is known after one reading, which tells nothing but theta."""
    return make_sensing(ActiveSensingParameters(**values)).tick(0.0, 0.1, 0.0, 0.0)


def test_by_default_any_edge_of_the_papers_block_may_be_pushed():
    estimate = first_estimate()
    assert [edge.length for edge in estimate.edges] == pytest.approx([0.05, 0.0475] * 2)
    # As likely as they are long.
    assert estimate.weights == pytest.approx([0.05 / 0.195, 0.0475 / 0.195] * 2)
    assert (estimate.c.least, estimate.c.most) == (0.005, 0.036)
    assert (estimate.mu_c.least, estimate.mu_c.most) == (0.0, math.inf)


def test_a_known_edge_is_the_only_one_and_keeps_its_number():
    (edge,) = first_estimate(vertices=TRIANGLE, edge=2).edges
    assert edge.number == 2
    assert edge.length == pytest.approx(math.hypot(0.02, 0.05))


@pytest.mark.parametrize('edge', [-1, 0, 2])
def test_distances_are_those_of_the_edges_that_may_be_pushed(edge):
    values = {'vertices': TRIANGLE, 'edge': edge}
    # Twice the area of the triangle of an edge and the centre of mass, over the edge, by hand.
    by_hand = [
        (0.03 * 0.02 + 0.04 * 0.015) / math.hypot(0.07, 0.005),
        (0.04 * 0.035 - 0.01 * 0.02) / math.hypot(0.05, 0.055),
        (0.01 * 0.015 + 0.03 * 0.035) / math.hypot(0.02, 0.05),
    ]
    expected = by_hand if edge < 0 else [by_hand[edge]]
    assert ActiveSensingParameters(**values).distances == pytest.approx(expected)
    assert [one.l for one in first_estimate(**values).edges] == pytest.approx(expected)
    assert ActiveSensingParameters(disk_radius=0.03, **values).distances == [0.03]


def test_a_disk_has_no_edges():
    estimate = first_estimate(disk_radius=0.03, vertices=[])
    assert estimate.edges == ()
    # Its centre is straight ahead of the contact, across both radii.
    assert math.hypot(*estimate.pose[:2]) == pytest.approx(0.03 + 0.0135)


def test_ranges_and_the_finger_are_those_of_the_parameters():
    values = {'c_min': 0.01, 'c_max': 0.02, 'mu_c_min': 0.1, 'mu_c_max': 0.1}
    estimate = first_estimate(edge=0, finger_radius=0.02, **values)
    assert (estimate.c.least, estimate.c.most) == (0.01, 0.02)
    assert (estimate.mu_c.least, estimate.mu_c.most) == pytest.approx((0.1, 0.1))
    assert estimate.estimates[0].radius == pytest.approx(0.02)


def test_after_the_timeout_the_estimate_starts_over():
    sensing = make_sensing(ActiveSensingParameters(disk_radius=0.03, contact_timeout=1.0))
    sensing.tick(0.0, 0.1, 0.0, 0.0)
    sensing.tick(0.9, 0.1, 0.0, 0.0)
    assert sensing.readings == 2
    sensing.tick(2.0, 0.1, 0.0, 0.0)
    assert (sensing.forgot, sensing.readings) == ('ticks missing', 1)


@pytest.mark.parametrize(
    ('values', 'refusal'),
    [
        ({'vertices': TRIANGLE[:5]}, 'vertices: expected x and y of three corners or more, got 5'),
        ({'vertices': TRIANGLE[:4]}, 'vertices: expected x and y of three corners or more, got 4'),
        ({'vertices': [0.0] * 6}, 'vertices'),
        (
            {'vertices': [1e3 * x for x in TRIANGLE]},
            r'^vertices: expected metres, .* millimetres\?$',
        ),
        ({'edge': 4}, 'edge: expected -1 to 3, got 4'),
        ({'c_min': 0.02, 'c_max': 0.02}, r'c_max: expected more than c_min = 0\.02, got 0\.02'),
        ({'mu_c_min': 0.5, 'mu_c_max': 0.4}, r'mu_c_max: expected more than mu_c_min = 0\.5'),
    ],
)
def test_what_describes_no_object_is_refused(values, refusal):
    with pytest.raises(ValueError, match=refusal):
        make_sensing(ActiveSensingParameters(**values))
