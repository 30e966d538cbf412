# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.turning_tip import R, X, Y, psi, slope
from tactile_push.interface import POINTS
from tactile_push.mechanics import CENTRE, CONTACT, POLE
from tactile_push.simulation import paper_block
from tactile_push.simulation.tip import EVEN_TURN, Tip, move_tip, tip_angle

PROPERTY = settings(derandomize=True, deadline=None)
places = st.floats(X - 0.03, X + 0.05)
TIP = paper_block().tip


def test_tip_of_a_rig_starts_straight_ahead():
    assert pytest.approx((X, Y), abs=1e-15) == (TIP.x, TIP.y)
    turned, _ = tip_angle(TIP, TIP.x)
    assert turned == pytest.approx(math.pi / 2.0)
    assert TIP.point == CENTRE


@PROPERTY
@given(places)
def test_tip_points_where_two_circles_say(x):
    turned, rate = tip_angle(TIP, x)
    assert turned == pytest.approx(psi(x), abs=1e-12)
    assert rate == pytest.approx(slope(x), abs=1e-6)


@PROPERTY
@given(places, st.floats(-EVEN_TURN, EVEN_TURN), st.floats(-1.0, 1.0))
def test_commanded_point_goes_as_commanded(x, way, theta):
    for point, angle in ((CENTRE, None), (POLE, psi), (CONTACT, lambda _: theta + math.pi / 2.0)):
        after, turned = move_tip(TIP._replace(point=point), x, psi(x), way, theta, R)
        assert turned == pytest.approx(psi(after), abs=1e-12)
        if angle is None:
            assert after == x + way
        elif point == POLE:
            assert after + R * math.cos(turned) - x - R * math.cos(psi(x)) == pytest.approx(
                way, abs=1e-12
            )
        else:  # its velocity is x' - r psi' sin(a)
            added = R * math.sin(angle(x)) * (turned - psi(x))
            assert after - x - added == pytest.approx(way, abs=1e-12)


def test_tip_turns_evenly_enough_on_a_short_way():
    # What a tip that turns evenly between two places is off on the way.
    for k in range(-40, 41):
        x, half = X + 1e-3 * k, EVEN_TURN / 2.0
        assert abs(psi(x) - (psi(x - half) + psi(x + half)) / 2.0) < 1.2e-5


@pytest.mark.parametrize('way', [-0.2, 0.3])
@pytest.mark.parametrize('point', range(len(POINTS)))
def test_out_of_reach_there_is_no_direction(point, way):
    assert math.isnan(move_tip(TIP._replace(point=point), TIP.x, math.pi / 2.0, way, 0.0, R)[1])


def test_point_that_hardly_moves_is_not_followed():
    # A finger almost stretched to the right: the tip turns counterclockwise by so much for each
    # metre that the pole of a disk of this radius stands while the centre moves.
    knuckle, straight = math.radians(80.0), math.radians(75.0)
    x = 0.06 * math.cos(knuckle) + 0.08 * math.cos(straight)
    y = 0.06 * math.sin(knuckle) + 0.08 * math.sin(straight)
    tip = Tip(0.06, 0.08, x, y, POLE)
    turned, rate = tip_angle(tip, x)
    assert turned == pytest.approx(straight)
    still = 1.0 / (rate * math.sin(straight))
    assert math.isnan(move_tip(tip, x, straight, 1e-6, 0.0, still)[1])
    assert not math.isnan(move_tip(tip, x, straight, 1e-6, 0.0, still / 2.0)[1])
