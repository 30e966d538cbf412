# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from support.sticking_block import PRESSURE
from tactile_push.control.placing.believing import D_MARGIN, Belief, BelievingLaw
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.turning_tip import STRAIGHT

BELT_SPEED, PERIOD, LAG = 0.005, 0.1, 0.1
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(*friction_cone(math.inf), STRAIGHT, 0.0),
)
BELIEF = Belief(
    *(0.01, 0.1, 0.002, PUSHED, (0.0, math.inf), (-0.025, 0.02)),
    Spread(1e-3, 1e-3, 0.1, 0.005, BELT_SPEED * PERIOD),
)


def law():
    return BelievingLaw(0.0, BELT_SPEED, PERIOD, lag=LAG)


def test_nothing_is_believed_at_first_and_after_a_stop():
    one = law()
    assert one.present() is None
    one.believe(BELIEF)
    assert one.present() is not None
    one.reset()
    assert one.present() is None


@pytest.mark.parametrize('age', [0.0, 0.04])
def test_the_finger_is_believed_where_it_has_gone_since_the_reading(age):
    one = law()
    one.phi = math.atan2(1.0, 0.8)  # so that v_x is 0.8 of the belt's speed
    one.pass_time(PERIOD)
    one.believe(BELIEF, age)
    one.pass_time(PERIOD)

    now, belief = one.present()

    # It follows with a lag from rest: x = u (t - T (1 - exp(-t/T))).
    def gone(t):
        return 0.8 * BELT_SPEED * (t - LAG * (1.0 - math.exp(-t / LAG)))

    assert now.x - BELIEF.x == pytest.approx(gone(2.0 * PERIOD) - gone(PERIOD - age), rel=1e-9)
    assert belief.pushed.lag == pytest.approx(LAG * BELT_SPEED)


def test_the_contact_is_kept_a_margin_inside_the_edge_and_the_finger_in_its_workspace():
    bounds = law()._inside(BELIEF, D_MARGIN)
    assert (bounds.d_min, bounds.d_max) == pytest.approx((-0.023, 0.018))
    assert (bounds.x_min, bounds.x_max) == pytest.approx((-0.104, 0.104))
    assert bounds.steepest == pytest.approx(1.0 / math.tan(math.radians(33.0)))
