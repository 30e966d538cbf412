# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The sensor's geometry against the vectors that conventions.md defines it by (Section V.A)."""

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tactile_push.tactile import (
    NO_CONTACT,
    Reading,
    ReadingRejectedError,
    contact_of_reading,
    reading_of_contact,
)
from tactile_push.tactile.hemisphere import normalized_angle

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
RADIUS = 0.0135
AHEAD = math.pi / 2.0
UPRIGHT = 1e-9

poles = st.floats(-20.0, 20.0)


def difference(a, b):
    """Return the difference of two angles, turns apart being none."""
    return math.remainder(a - b, 2.0 * math.pi)


@pytest.mark.parametrize(('theta', 'azimuth'), [(20.0, 0.0), (-20.0, 180.0)])
def test_worked_examples_of_the_conventions(theta, azimuth):
    reading = reading_of_contact(math.radians(theta), AHEAD)
    assert math.degrees(reading.azimuth) == pytest.approx(azimuth, abs=1e-12)
    assert math.degrees(reading.elevation) == pytest.approx(70.0)
    contact = contact_of_reading(
        Reading(math.radians(azimuth), math.radians(70.0)), AHEAD, RADIUS, UPRIGHT
    )
    assert math.degrees(contact.theta) == pytest.approx(theta)


def test_contact_at_the_pole_lies_straight_ahead_whatever_the_azimuth():
    for azimuth in (0.0, 1.0, -2.0, math.pi):
        contact = contact_of_reading(Reading(azimuth, math.pi / 2.0), AHEAD, RADIUS, UPRIGHT)
        assert contact.theta == pytest.approx(0.0, abs=1e-15)
        assert (contact.x, contact.y) == pytest.approx((0.0, RADIUS), abs=1e-15)


def test_edge_turned_counterclockwise_is_touched_left_of_the_pole():
    # n = (-sin 20, cos 20), and the contact is r n.
    contact = contact_of_reading(Reading(0.0, math.radians(70.0)), AHEAD, RADIUS, UPRIGHT)
    assert (contact.x, contact.y) == pytest.approx((-0.00461727, 0.01268585), abs=1e-8)


def test_finger_that_points_right_sees_the_edge_that_faces_it():
    # psi = 0: the pole is +x, so an edge with its normal along +x has theta = -90 degrees.
    contact = contact_of_reading(Reading(0.0, math.pi / 2.0), 0.0, RADIUS, UPRIGHT)
    assert math.degrees(contact.theta) == pytest.approx(-90.0)
    assert (contact.x, contact.y) == pytest.approx((RADIUS, 0.0), abs=1e-15)


@given(
    azimuth=st.floats(-math.pi, math.pi),
    elevation=st.floats(0.0, math.pi / 2.0),
    psi=poles,
)
@PROPERTY
def test_contact_is_the_direction_of_the_two_angles_projected_into_the_plane(
    azimuth, elevation, psi
):
    pole = (math.cos(psi), math.sin(psi))
    left = (-math.sin(psi), math.cos(psi))
    along = math.sin(elevation)
    across = math.cos(elevation) * math.cos(azimuth)
    assume(math.hypot(along, across) > 1e-3)  # else it has no direction in the plane
    n_x = (across * left[0] + along * pole[0]) / math.hypot(along, across)
    n_y = (across * left[1] + along * pole[1]) / math.hypot(along, across)
    contact = contact_of_reading(Reading(azimuth, elevation), psi, RADIUS, 1.0)
    assert (contact.x, contact.y) == pytest.approx((RADIUS * n_x, RADIUS * n_y), abs=1e-12)
    # n = (-sin theta, cos theta)
    assert (-math.sin(contact.theta), math.cos(contact.theta)) == pytest.approx(
        (n_x, n_y), abs=1e-12
    )
    assert -math.pi <= contact.theta <= math.pi


@given(psi=poles, from_pole=st.floats(-1.5707963, 1.5707963))
@PROPERTY
def test_round_trip_from_contact_to_reading_over_the_whole_hemisphere(psi, from_pole):
    theta = psi - AHEAD + from_pole
    reading = reading_of_contact(theta, psi)
    assert reading.azimuth in (0.0, math.pi)
    assert (reading.azimuth == 0.0) == (difference(theta + AHEAD, psi) >= 0.0)
    assert 0.0 <= reading.elevation <= math.pi / 2.0
    assert reading.elevation == pytest.approx(math.pi / 2.0 - abs(from_pole), abs=1e-12)
    contact = contact_of_reading(reading, psi, RADIUS, UPRIGHT)
    assert difference(contact.theta, theta) == pytest.approx(0.0, abs=1e-12)


@given(psi=poles, azimuth=st.sampled_from([0.0, math.pi]), elevation=st.floats(0.001, 1.57))
@PROPERTY
def test_round_trip_from_reading_to_contact_of_an_upright_face(psi, azimuth, elevation):
    contact = contact_of_reading(Reading(azimuth, elevation), psi, RADIUS, UPRIGHT)
    reading = reading_of_contact(contact.theta, psi)
    assert reading.azimuth == azimuth
    assert reading.elevation == pytest.approx(elevation, abs=1e-12)


@given(psi=poles, from_pole=st.floats(1.5708, math.pi), side=st.sampled_from([-1.0, 1.0]))
@PROPERTY
def test_contact_behind_the_hemisphere_cannot_be_read(psi, from_pole, side):
    assert reading_of_contact(psi - AHEAD + side * from_pole, psi) is None


def test_contact_on_the_equator_can_be_read():
    for theta, azimuth in ((math.pi / 2.0, 0.0), (-math.pi / 2.0, math.pi)):
        reading = reading_of_contact(theta, AHEAD)
        assert (reading.azimuth, reading.elevation) == (azimuth, 0.0)


def test_force_is_passed_on_and_unknown_by_default():
    assert reading_of_contact(0.0, AHEAD, 1.25).normal_force == 1.25
    assert math.isnan(reading_of_contact(0.0, AHEAD).normal_force)


def test_azimuth_of_pi_and_of_minus_pi_are_the_same_contact():
    one = contact_of_reading(Reading(math.pi, 1.0), AHEAD, RADIUS, UPRIGHT)
    other = contact_of_reading(Reading(-math.pi, 1.0), AHEAD, RADIUS, UPRIGHT)
    assert one.theta == pytest.approx(1.0 - math.pi / 2.0)
    assert one == other


def test_contact_out_of_the_plane_of_motion_is_rejected_beyond_the_bound():
    # cos(60) sin(90) = 0.5, above as below the plane
    for azimuth in (math.pi / 2.0, -math.pi / 2.0):
        tilted = Reading(azimuth, math.radians(60.0))
        assert contact_of_reading(tilted, AHEAD, RADIUS, 0.501).theta == pytest.approx(0.0)
        with pytest.raises(ReadingRejectedError, match='^out of plane$'):
            contact_of_reading(tilted, AHEAD, RADIUS, 0.499)


@pytest.mark.parametrize(
    'reading',
    [
        Reading(0.0, -0.001),
        Reading(0.0, math.pi / 2.0 + 0.001),
        Reading(math.pi + 0.001, 1.0),
        Reading(-math.pi - 0.001, 1.0),
        Reading(0.0, 1e9),
        Reading(math.inf, 1.0),
        Reading(-math.inf, 1.0),
        Reading(0.0, math.inf),
        Reading(math.nan, 1.0),
        Reading(0.0, math.nan),
    ],
)
def test_angle_off_the_hemisphere_is_rejected(reading):
    with pytest.raises(ReadingRejectedError, match='^off the hemisphere$'):
        contact_of_reading(reading, AHEAD, RADIUS, 1.0)


def test_no_contact_is_rejected_with_its_own_reason():
    with pytest.raises(ReadingRejectedError, match='^no contact$'):
        contact_of_reading(NO_CONTACT, AHEAD, RADIUS, 1.0)


@pytest.mark.parametrize('azimuth', [0.0, math.pi])
def test_contact_further_from_the_pole_than_the_detectable_range_is_rejected(azimuth):
    # 40 degrees above the equator is 50 degrees from the pole.
    reading = Reading(azimuth, math.radians(40.0))
    contact = contact_of_reading(reading, AHEAD, RADIUS, UPRIGHT, math.radians(50.1))
    assert abs(math.degrees(contact.theta)) == pytest.approx(50.0)
    with pytest.raises(ReadingRejectedError, match='^beyond the detectable range$'):
        contact_of_reading(reading, AHEAD, RADIUS, UPRIGHT, math.radians(49.9))


def test_range_is_no_matter_off_the_hemisphere_or_without_contact():
    for reading, reason in ((Reading(0.0, -0.1), 'off the hemisphere'), (NO_CONTACT, 'no contact')):
        with pytest.raises(ReadingRejectedError, match=f'^{reason}$'):
            contact_of_reading(reading, AHEAD, RADIUS, UPRIGHT, 0.1)


def test_bound_that_is_no_number_lets_nothing_pass():
    with pytest.raises(ReadingRejectedError):
        contact_of_reading(Reading(0.0, 1.0), AHEAD, RADIUS, math.nan)
    with pytest.raises(ReadingRejectedError):
        contact_of_reading(Reading(0.0, 1.0), AHEAD, RADIUS, 1.0, math.nan)


@pytest.mark.parametrize('psi', [math.nan, math.inf, -math.inf])
def test_pole_angle_that_is_not_finite_gives_no_contact(psi):
    # joint_states may carry NaN (REP-117: no value), and a contact has to be valid.
    with pytest.raises(ReadingRejectedError):
        contact_of_reading(Reading(0.0, 1.0), psi, RADIUS, 1.0)


@given(angle=st.floats(-1e4, 1e4))
@PROPERTY
def test_normalized_angle_points_where_the_angle_does(angle):
    normalized = normalized_angle(angle)
    assert -math.pi <= normalized <= math.pi
    assert difference(normalized, angle) == pytest.approx(0.0, abs=1e-9)


@given(angle=st.floats(-math.pi, math.pi))
@PROPERTY
def test_normalized_angle_leaves_an_angle_in_range_to_the_bit(angle):
    assert normalized_angle(angle) == angle
