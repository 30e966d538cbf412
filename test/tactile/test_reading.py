# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the sensor says, with and without contact (Section V.A, REP-117)."""

import dataclasses
import math

import pytest

from tactile_push.tactile import NO_CONTACT, Reading


def test_no_contact_is_nan_in_both_angles_and_in_the_force():
    assert math.isnan(NO_CONTACT.azimuth)
    assert math.isnan(NO_CONTACT.elevation)
    assert math.isnan(NO_CONTACT.normal_force)
    assert not NO_CONTACT.in_contact


def test_two_angles_are_a_contact_even_if_they_are_zero():
    assert Reading(0.0, 0.0).in_contact


def test_one_angle_alone_is_not_mistaken_for_no_contact():
    assert Reading(math.nan, 1.0).in_contact
    assert Reading(1.0, math.nan).in_contact


def test_force_alone_makes_no_contact():
    assert not Reading(math.nan, math.nan, 2.0).in_contact


def test_force_is_unknown_unless_it_is_given():
    assert math.isnan(Reading(0.1, 0.2).normal_force)
    assert Reading(0.1, 0.2, 1.5).normal_force == 1.5


def test_reading_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Reading(0.1, 0.2).azimuth = 0.3
