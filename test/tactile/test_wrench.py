# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.touches import RADIUS, unit, wrench
from tactile_push.tactile import angle_noise, contact_of_wrench

checked = settings(derandomize=True, deadline=None, max_examples=200)
azimuths, elevations = st.floats(-3.1, 3.1), st.floats(-0.2, 1.57)
offsets = st.tuples(*[st.floats(-0.05, 0.05)] * 3)


@checked
@given(
    azimuths,
    elevations,
    st.floats(0.05, 20.0),
    st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)),
    st.floats(-0.02, 0.02),
    offsets,
)
def test_contact_that_presses_and_twists_is_found(
    azimuth, elevation, pressing, sideways, torsion, offset
):
    centre = np.array(offset)
    sideways = pressing * np.array(sideways)
    normal = unit(azimuth, elevation)
    found = contact_of_wrench(*wrench(normal, pressing, sideways, torsion, centre), centre, RADIUS)
    assert found.normal == pytest.approx(normal, abs=1e-6)
    assert found.normal_force == pytest.approx(pressing, rel=1e-6)
    assert found.tangential_force == pytest.approx(math.hypot(*sideways), rel=1e-5, abs=1e-5)
    assert found.torsion == pytest.approx(torsion, rel=1e-6, abs=1e-8)


def test_reading_is_that_of_the_direction():
    centre = np.array([0.0, 0.0, 0.03])
    force, moment = wrench(unit(2.0, 0.5), 1.5, (0.2, 0.0), 0.0, centre)
    reading = contact_of_wrench(force, moment, centre, RADIUS).reading
    assert reading.azimuth == pytest.approx(2.0)
    assert reading.elevation == pytest.approx(0.5)
    assert reading.normal_force == pytest.approx(1.5)


def test_force_through_the_centre_has_its_contact_where_it_presses():
    found = contact_of_wrench([0.0, 0.0, -2.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.02], RADIUS)
    assert found.normal == pytest.approx([0.0, 0.0, 1.0])
    assert (found.normal_force, found.tangential_force) == (2.0, 0.0)
    assert found.torsion == 0.0


@pytest.mark.parametrize('turned', [0.0, 1.0])
def test_moment_that_no_contact_on_the_tip_has_becomes_torsion(turned):
    # The force passes the tip at twice its radius, as of a contact beside the hemisphere.
    force = np.array([0.0, -math.sin(turned), -math.cos(turned)])
    moment = np.cross([2.0 * RADIUS, 0.0, 0.0], force)
    found = contact_of_wrench(force, moment, np.zeros(3), RADIUS)
    assert abs(found.torsion) > RADIUS * 1.0
    assert found.normal_force == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ('force', 'moment', 'radius', 'words'),
    [
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0], RADIUS, 'force: expected 1e-09 to 1e.09 N'),
        ([1e-12, 0.0, 0.0], [0.0, 0.0, 0.0], RADIUS, 'force: expected 1e-09 to'),
        ([1e200, 0.0, 0.0], [0.0, 0.0, 0.0], RADIUS, 'force: expected 1e-09 to'),
        ([math.nan, 0.0, 0.0], [0.0, 0.0, 0.0], RADIUS, 'three finite numbers'),
        ([1.0, 0.0, 0.0], [0.0, math.inf, 0.0], RADIUS, 'three finite numbers'),
        ([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], 0.0, 'radius: expected a positive length'),
        ([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], math.nan, 'radius: expected a positive length'),
    ],
)
def test_wrench_without_a_contact_is_refused(force, moment, radius, words):
    with pytest.raises(ValueError, match=words):
        contact_of_wrench(force, moment, [0.0, 0.0, 0.0], radius)


@pytest.mark.parametrize('elevation', [0.4, 1.0, math.pi / 2.0])
@pytest.mark.parametrize('height', [0.0, 0.02])  # of the tip's centre above the sensor [m]
@pytest.mark.parametrize('pressing', [1.0, 5.0])
def test_noise_spreads_the_direction_as_derived(elevation, height, pressing):
    noise = 0.02, 0.0002  # small, so that the spread is linear
    centre, normal = np.array([0.0, 0.0, height]), unit(0.3, elevation)
    force, moment = wrench(normal, pressing, (0.3 * pressing, 0.0), 0.0, centre)
    rng = np.random.default_rng(3)
    squares = []
    for _ in range(2000):
        found = contact_of_wrench(
            force + noise[0] * rng.standard_normal(3),
            moment + noise[1] * rng.standard_normal(3),
            *(centre, RADIUS),
        )
        across = found.normal - (found.normal @ normal) * normal
        squares.append(across @ across / 2.0)
    derived = angle_noise(normal, pressing, centre, RADIUS, *noise)
    assert math.sqrt(np.mean(squares)) == pytest.approx(derived, rel=0.06)


def test_noise_of_a_usual_sensor():
    # 0.05 N and 0.5 mN m at the centre of the tip: (0.5/13.5)^2 + 0.05^2 = 0.0622^2.
    usual = np.zeros(3), RADIUS, 0.05, 0.0005
    normal = unit(0.0, 1.0)
    at_1_n, at_5_n = (math.degrees(angle_noise(normal, f, *usual)) for f in (1.0, 5.0))
    assert at_1_n == pytest.approx(3.566, abs=0.01)
    assert at_5_n == pytest.approx(0.713, abs=0.01)
