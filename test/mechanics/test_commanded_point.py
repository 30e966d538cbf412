# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.interface import POINTS
from tactile_push.mechanics import CENTRE, CONTACT, POLE, added_way

R = 0.0135
angles = st.floats(-1.4, 1.4)


def test_numbers_are_places_in_the_names():
    assert [POINTS[point] for point in (CENTRE, POLE, CONTACT)] == ['centre', 'pole', 'contact']


@given(angles, angles, angles)
def test_pole_goes_as_far_as_it_was_commanded(before, turned, theta):
    # From the centre the pole lies at r (cos psi, sin psi).
    before += math.pi / 2.0
    way, after = 0.004, before + turned
    pole_before = R * math.cos(before)
    pole_after = way + added_way(POLE, before, after, theta, R) + R * math.cos(after)
    assert pole_after - pole_before == pytest.approx(way, abs=1e-15)


@given(angles, st.floats(-1e-3, 1e-3), angles)
def test_material_at_the_contact_goes_as_far_as_it_was_commanded(before, turned, theta):
    # It lies at r n from the centre and turns with the disk, by little.
    normal, way = theta + math.pi / 2.0, 0.004
    moved = R * (math.cos(normal + turned) - math.cos(normal))
    moved += way + added_way(CONTACT, before, before + turned, theta, R)
    assert moved == pytest.approx(way, abs=R * turned**2 + 1e-15)


@given(angles, angles, angles)
def test_centre_that_is_commanded_goes_no_farther(before, after, theta):
    assert added_way(CENTRE, before, after, theta, R) == 0.0


@pytest.mark.parametrize('point', [CENTRE, POLE, CONTACT])
def test_disk_that_does_not_turn_goes_no_farther_whatever_is_commanded(point):
    assert added_way(point, 1.4, 1.4, 0.2, R) == 0.0
