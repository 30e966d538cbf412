# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The slow mode against the mechanics of a tip that turns, and the way that is left."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tactile_push.control import NO_REASON, PUSHING, STOPPED, Drift, Tick, growth_rate, time_left
from tactile_push.mechanics import Finger, friction_cone
from tactile_push.mechanics.push import push_rates
from tactile_push.simulation import paper_block

R, BELT, PERIOD = 0.0135, 0.005, 0.1
L = 0.02375
MU = friction_cone(math.inf)


def drift_at(theta, d, turning):
    """Return the v_x at which the block translates, by bisection on the mechanics of (9)-(11)."""
    config = paper_block(theta=0.0, d=d)
    body, finger = config.body, Finger(*MU, R)

    def omega(v_x):
        # The pushed edge lies along the axes of the frame that is turned with it.
        cos, sin = math.cos(theta), math.sin(theta)
        t, n = cos * v_x + sin * BELT, cos * BELT - sin * v_x
        return push_rates(0.0, config.sigma, 0, t, n, body, finger, turning * v_x)[0]

    left, right = -0.02, 0.02
    assert omega(left) * omega(right) < 0.0
    for _ in range(100):
        middle = (left + right) / 2.0
        if omega(left) * omega(middle) <= 0.0:
            right = middle
        else:
            left = middle
    return middle


@pytest.mark.parametrize('turning', [-25.0, -12.5, -3.0, 4.0, 20.0])
@pytest.mark.parametrize('theta', [-0.4, -0.1745, 0.0, 0.3])
def test_growth_is_how_fast_rolling_changes_the_drift(theta, turning):
    # At the angle theta the drift is 0 where d = -l tan theta. Rolling: d' = r psi' = r turning x'.
    balanced, step = -L * math.tan(theta), 1e-6
    assert drift_at(theta, balanced, turning) == pytest.approx(0.0, abs=1e-12)
    slope = drift_at(theta, balanced + step, turning) - drift_at(theta, balanced - step, turning)
    assert growth_rate(theta, L, R, turning, BELT) == pytest.approx(
        R * turning * slope / (2.0 * step), rel=1e-4
    )


def test_a_straight_tip_has_no_slow_mode():
    assert growth_rate(-0.17, L, R, 0.0, BELT) == 0.0


def test_a_knuckle_at_the_left_of_the_usual_finger_makes_it_unstable_in_half_a_minute():
    # Its tip turns by -1/b = -12.5 rad/m at home.
    growth = growth_rate(math.radians(-10.0), L, R, -12.5, BELT)
    assert 1.0 / growth == pytest.approx(33.9, abs=0.1)
    assert growth_rate(math.radians(-10.0), L, R, 12.5, BELT) < 0.0


def test_an_infinite_turning_makes_the_growth_that_of_a_tip_whose_surface_stands():
    assert growth_rate(0.0, L, R, math.inf, BELT) == pytest.approx(BELT / L)


@pytest.mark.parametrize('growth', [-0.02, 0.0, 0.03])
def test_time_left_is_that_of_a_drift_that_grows(growth):
    speed, way, step = 0.0005, 0.02, 0.001
    times = np.arange(0.0, 200.0, step)
    gone = np.cumsum(speed * np.exp(growth * times)) * step
    expected = times[np.argmax(gone >= way)]
    assert time_left(way, speed, growth) == pytest.approx(expected, abs=0.01)


def test_a_drift_that_dies_away_before_the_end_never_comes_there():
    # All in all it goes speed / 0.05 = 10 mm.
    assert time_left(0.0101, 0.0005, -0.05) == math.inf
    assert time_left(0.0099, 0.0005, -0.05) < math.inf


def test_a_finger_that_does_not_drift_stays():
    assert time_left(0.1, 0.0, 0.03) == math.inf


def test_without_a_known_growth_the_drift_is_taken_to_stay_as_it_is():
    assert time_left(0.02, 0.0005, math.nan) == pytest.approx(40.0)


TICK = Tick(PUSHING, NO_REASON, 0.0, 1.5, 0.001, 0.02, False, False, 0.0, 12, 0, math.nan, 0.01)


def outlooks(xs, turning=math.nan, **changes):
    """Return what is known while the finger passes places, one a control period."""
    drift = Drift(L, R, BELT, PERIOD, -0.105, 0.105)
    return [drift.follow(replace(TICK, finger_x=float(x), **changes), 0.0, turning) for x in xs]


@pytest.mark.parametrize(('v_x', 'way'), [(0.0005, 0.085), (-0.0005, 0.085)])
def test_workspace_lasts_for_the_way_to_the_end_that_the_finger_drifts_to(v_x, way):
    start = math.copysign(0.02, v_x)
    last = outlooks(start + v_x * PERIOD * np.arange(100))[-1]
    gone = abs(v_x) * PERIOD * 99
    assert last.drift == pytest.approx(v_x)
    assert last.lasts == pytest.approx((way - gone) / abs(v_x))
    assert not last.soon


def test_it_is_shorter_where_the_drift_grows():
    xs = 0.0005 * PERIOD * np.arange(100)
    growing, steady, dying = (outlooks(xs, turning)[-1].lasts for turning in (-12.5, 0.0, 12.5))
    assert growing < steady < dying


@pytest.mark.parametrize('turning', [0.0, 12.5])
def test_a_drift_that_does_not_grow_has_no_time_in_which_it_does(turning):
    assert outlooks([0.0], turning)[-1].e_fold == math.inf


def test_the_end_of_the_workspace_is_soon_within_half_a_minute():
    xs = 0.105 - 0.0005 * PERIOD * (np.arange(400, 0, -1) + 0.5)
    told = outlooks(xs, turning=0.0)
    # The k-th has 400.5 - k periods left.
    assert [k for k, outlook in enumerate(told) if outlook.soon] == list(range(101, 400))


def test_noise_of_the_commands_is_averaged():
    way = np.cumsum(np.tile([0.002, -0.0012], 200)) * PERIOD  # in the mean 0.4 mm/s
    drifts = [outlook.drift for outlook in outlooks(way)[200:]]
    assert drifts == pytest.approx([0.0004] * 200, abs=0.00004)


def test_a_drift_is_told_once_it_lasted_five_seconds():
    told = outlooks(0.0005 * PERIOD * np.arange(60), turning=0.0)
    assert [k for k, outlook in enumerate(told) if math.isnan(outlook.drift)] == list(range(50))


@pytest.mark.parametrize('changes', [{'theta': 0.06}, {'state': STOPPED}, {'theta': math.nan}])
def test_a_finger_that_still_turns_the_object_or_rests_tells_nothing_of_a_drift(changes):
    last = outlooks(0.0005 * PERIOD * np.arange(50), turning=-12.5, **changes)[-1]
    assert math.isnan(last.drift)
    assert math.isnan(last.lasts)
    assert not last.soon
    assert last.growth > 0.0
    assert last.e_fold == pytest.approx(1.0 / last.growth)


def test_a_finger_that_is_not_known_to_be_anywhere_tells_nothing():
    last = outlooks([math.nan] * 50)[-1]
    assert math.isnan(last.growth)
    assert math.isnan(last.e_fold)
    assert math.isnan(last.lasts)
    assert not last.soon
