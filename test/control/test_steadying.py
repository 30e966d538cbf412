# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The trim of theta_d, by hand and against the mechanics of a tip that turns."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import Limits, PushControl, PushLaw, Steadying
from tactile_push.mechanics import friction_cone, push
from tactile_push.simulation import paper_block

PERIOD = 0.1
L, R = 0.02, 0.01
AHEAD = math.pi / 2.0
BOUND = math.radians(15.0)
checked = settings(derandomize=True, deadline=None, max_examples=60)


def steadying(bound=BOUND):
    return Steadying(bound, L, R)


def rested(trimming, x=0.0, psi=AHEAD, theta=0.0, theta_desired=0.0, ticks=200):
    """Return the trim after a time in which nothing moves."""
    for _ in range(ticks):
        trim = trimming.follow(theta, theta_desired, x, psi, PERIOD)
    return trim


def test_an_object_carried_aside_is_turned_back_four_times_as_far_at_twice_l():
    trimming = steadying()
    assert rested(trimming) == 0.0
    # 1 mm seen from 2 l = 40 mm is an angle of 1/40.
    assert rested(trimming, x=0.001) == pytest.approx(4.0 / 40.0)
    assert rested(trimming, x=-0.001) == pytest.approx(-4.0 / 40.0)
    assert rested(trimming, x=0.0) == pytest.approx(0.0, abs=1e-15)


def test_turning_the_object_about_the_point_at_twice_l_is_no_way_aside():
    trimming = steadying()
    rested(trimming, theta=0.05)
    x = 2.0 * L * (math.sin(0.1) - math.sin(0.05))
    assert rested(trimming, x=x, theta=0.1) == pytest.approx(0.0, abs=1e-15)


def test_what_the_tip_rolls_by_its_own_turning_is_no_way_aside():
    trimming = steadying()
    rested(trimming)
    # The tip turns by 0.1 rad while its centre moves by 0.1 r: its surface stays.
    assert rested(trimming, x=0.1 * R, psi=AHEAD + 0.1) == pytest.approx(0.0, abs=1e-15)


def test_the_trim_changes_slowly():
    trimming = steadying()
    rested(trimming)
    trims = [rested(trimming, x=0.001, ticks=1) for _ in range(80)]
    steps = [after - before for before, after in zip([0.0, *trims], trims, strict=False)]
    assert max(steps) == pytest.approx(math.radians(0.1))  # 1 degree a second
    assert trims[0] == pytest.approx(math.radians(0.1))
    assert trims[-1] == pytest.approx(0.1)


@checked
@given(st.lists(st.tuples(st.floats(-1.5, 1.5), st.floats(-0.1, 0.1)), min_size=1, max_size=40))
def test_the_trim_is_bounded_whatever_is_felt(felt):
    trimming = steadying(bound=0.02)
    for theta, x in felt:
        assert abs(trimming.follow(theta, theta, x, AHEAD, PERIOD)) <= 0.02


def test_at_its_bound_nothing_winds_up():
    trimming = steadying(bound=0.05)
    rested(trimming)
    assert rested(trimming, x=0.1) == 0.05
    # Back by 0.25 mm, which is 0.025 rad.
    assert rested(trimming, x=0.1 - 0.00025) == pytest.approx(0.025)


def test_it_begins_when_theta_is_within_the_bound_of_its_desired_value():
    trimming = steadying()
    away = BOUND + 0.01
    assert rested(trimming, theta=away) == 0.0
    assert rested(trimming, x=0.001, theta=away) == 0.0
    assert rested(trimming, x=0.001, theta=BOUND) != 0.0


def test_once_begun_it_goes_on_where_theta_is_farther_away():
    trimming = steadying()
    rested(trimming)
    rested(trimming, theta=0.4)
    before = rested(trimming, theta=0.4)
    assert rested(trimming, x=0.0005, theta=0.4) == pytest.approx(
        min(BOUND, before + 0.05), abs=1e-12
    )


@pytest.mark.parametrize(('x', 'psi'), [(math.nan, AHEAD), (0.002, math.nan)])
def test_without_a_position_the_trim_stays_and_then_goes_on_from_there(x, psi):
    trimming = steadying()
    rested(trimming)
    before = rested(trimming, x=0.001)
    assert rested(trimming, x=x, psi=psi) == before
    assert rested(trimming, x=0.05) == before  # nobody knows what was between
    assert rested(trimming, x=0.0495) == pytest.approx(before - 0.05)


def test_a_finger_that_is_never_known_is_never_trimmed():
    assert rested(steadying(), x=math.nan, psi=math.nan) == 0.0


def test_after_a_reset_it_begins_anew():
    trimming = steadying()
    rested(trimming)
    assert rested(trimming, x=0.001) != 0.0
    trimming.reset()
    assert trimming.trim == 0.0
    assert rested(trimming, x=0.03, theta=0.4) == 0.0
    assert rested(trimming, x=0.05) == 0.0 or trimming.trim == pytest.approx(0.0, abs=BOUND)


def test_without_a_bound_there_is_no_trim():
    trimming = Steadying(0.0, L, R)
    rested(trimming)
    assert rested(trimming, x=0.05) == 0.0


def test_a_bound_that_is_taken_away_ends_the_trim_at_once():
    trimming = steadying()
    rested(trimming)
    assert rested(trimming, x=0.001) != 0.0
    trimming.bound = 0.0
    assert rested(trimming, ticks=1) == 0.0
    trimming.bound = BOUND
    assert rested(trimming) == 0.0


@pytest.mark.parametrize(
    ('l', 'turning', 'holds'),
    [
        (0.02375, -12.5, True),
        (0.0215, -12.5, True),
        (0.0205, -12.5, False),
        (0.02, 0.0, True),
        (0.0095, 0.0, False),  # the contact rolls farther than the edge turns the ray
        (0.0205, 12.5, True),
        (0.02375, -20.0, False),
        (0.02375, math.nan, False),
    ],
)
def test_a_trim_holds_where_it_moves_the_contact_by_more_than_the_tip_rolls_away(l, turning, holds):
    radius = 0.0135 if turning else R
    assert Steadying(BOUND, l, radius).holds(turning) == holds


def pushed(turning, bound, steps=1500):
    """Return theta, the angle steered to [rad] and x [m] of fig. 8's block under the control.

    The tip turns at a constant rate for each metre across the belt, with no bound on x.
    """
    config = paper_block()
    law = PushLaw(0.05, 5.0, math.radians(-10.0))
    control = PushControl(law, 0.005, PERIOD, Limits(workspace_min=-9.0, workspace_max=9.0))
    control.steadying.bound = bound
    control.activate(0.0)
    angle, sigma, x, found = config.theta, config.sigma, 0.0, []
    cone = friction_cone(config.mu_c)
    for k in range(steps):
        control.locate_finger(x, k * PERIOD, AHEAD + turning * x)
        control.feel(angle, k * PERIOD)  # the pushed edge is the first of the outline
        v_x = control.tick(k * PERIOD).v_x
        found.append((angle, law.aim, x))
        angle, sigma, _, _ = push(
            *(angle, sigma, v_x, 0.005, PERIOD, config.body.path, config.body.c, None),
            *(*cone, config.radius, turning * v_x),
        )
        x += v_x * PERIOD
    return np.array(found).T


@pytest.mark.parametrize('turning', [-12.5, -5.0, 0.0, 12.5])
def test_the_block_comes_to_rest_across_the_belt_however_the_tip_turns(turning):
    theta, aim, x = pushed(turning, bound=0.4)
    assert np.ptp(x[-300:]) < 0.0005
    assert np.abs(theta - aim)[-300:].max() < math.radians(0.3)
    assert np.abs(np.diff(aim)).max() <= math.radians(0.1) + 1e-12
    assert np.abs(aim - math.radians(-10.0)).max() <= 0.4


def test_without_steadying_it_runs_away_where_the_tip_turns_clockwise_to_the_right():
    _, aim, unstable = pushed(-12.5, bound=0.0)
    _, _, straight = pushed(0.0, bound=0.0)
    _, _, stable = pushed(12.5, bound=0.0)
    assert np.ptp(aim) == 0.0
    way = [np.abs(np.diff(x[::300])) for x in (unstable, straight, stable)]
    assert way[0][-1] > 2.0 * way[0][-2] > 4.0 * way[0][-3]
    assert way[1][-1] == pytest.approx(way[1][-2], rel=0.01)
    assert way[2][-1] < 0.5 * way[2][-2]
