# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from support.turning_tip import A, B, Y, psi, slope
from tactile_push.mechanics.turning_tip import (
    STRAIGHT,
    TurningTip,
    tip_direction,
    tip_turning,
)
from tactile_push.tactile import PlanarFinger

PLACES = (-0.1, -0.06, -0.01, 0.0, 0.03, 0.07, 0.1)
TIP = TurningTip(A, B, Y, -1.0)


@pytest.mark.parametrize('x', PLACES)
def test_tip_points_where_two_circles_say(x):
    assert tip_direction(x, TIP) == pytest.approx(psi(x), abs=1e-12)
    assert tip_turning(x, TIP) == pytest.approx(slope(x), abs=1e-5)


@pytest.mark.parametrize('x', PLACES)
def test_a_finger_bent_the_other_way_is_its_mirror_image(x):
    tip = TIP._replace(bend=1.0)
    assert tip_direction(x, tip) == pytest.approx(math.pi - psi(-x), abs=1e-12)
    assert tip_turning(x, tip) == pytest.approx(slope(-x), abs=1e-5)


@pytest.mark.parametrize('joints', [(1.9, -1.5), (0.8, 1.2)])
def test_the_line_of_a_finger_and_its_bend_are_enough_for_its_direction(joints):
    finger = PlanarFinger(0.05, 0.07, 0.2)
    pose = finger.forward(*joints)
    tip = TurningTip(finger.proximal_length, finger.distal_length, *finger.line(joints))
    assert tip_direction(pose.x, tip) == pytest.approx(pose.psi)
    assert tip_turning(pose.x, tip) == pytest.approx(finger.turning(*joints))


def test_a_tip_that_a_wrist_holds_points_along_the_belt():
    finger = PlanarFinger(0.05, 0.07, 0.2)
    tip = TurningTip(finger.proximal_length, finger.distal_length, *finger.line((1.9, -1.5, -0.1)))
    for one in (tip, STRAIGHT):
        assert tip_direction(0.03, one) == math.pi / 2.0
        assert tip_turning(0.03, one) == 0.0


@pytest.mark.parametrize('x', [-0.12, 0.0, 0.12])
def test_out_of_reach_it_has_no_direction(x):
    tip = TIP if x else TIP._replace(y=0.01)  # too far, and too near
    assert math.isnan(tip_direction(x, tip))
    assert math.isnan(tip_turning(x, tip))
