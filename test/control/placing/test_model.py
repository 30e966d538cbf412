# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The planner's steps against the mechanics of a push."""

import math

import numpy as np
import pytest

from support.turning_tip import A, B, Y, psi
from tactile_push.control.placing.model import (
    Bounds,
    Pushed,
    Situation,
    ahead,
    bounded_step,
    centre_of_mass,
    follow,
    narrowed,
    outside,
    step,
    translating,
)
from tactile_push.mechanics import Outline, Pose, Slider, friction_cone
from tactile_push.mechanics.body import Finger
from tactile_push.mechanics.push import move_finger
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT, TurningTip

L, R, C, BELT = 0.02375, 0.0135, 0.0187, 0.005
ROUND = np.array((1.0, 0.0, 1.0))
USUAL = TurningTip(A, B, Y, -1.0)


def pushed(mu_c=math.inf, tip=STRAIGHT, lag=0.0, c=C):
    return Pushed(L, R, Pressure(c * c, 0.0, 0.0, ROUND), *friction_cone(mu_c), tip, lag)


def finger_pushes(start, way, mu_c, tip=STRAIGHT, c=C):
    """Return theta, d and the centre of mass after a push under the equations of the paper."""
    slider = Slider(Outline.rectangle(0.2, 2.0 * L), c)
    x, theta, d, u, _ = start
    turned = 0.0 if tip == STRAIGHT else psi(x + u * way) - psi(x)
    sigma = slider.outline.sigma(R, d=d)
    pose = Pose(centre_of_mass(start, pushed()), 0.0, theta)
    y = d * math.sin(theta) - (L + R) * math.cos(theta)  # of the disk, from the centre of mass
    found, contact, _, _ = move_finger(
        *(pose, sigma, True, x, y, BELT * u, BELT, way / BELT),
        *(slider.body(R), Finger(*friction_cone(mu_c), R), turned / way * BELT),
    )
    return found.angle, d + contact - sigma, found.x


@pytest.mark.parametrize('mu_c', [0.0, 0.2, 1.0, math.inf])
@pytest.mark.parametrize(('theta', 'd', 'u'), [(0.3, -0.006, -1.2), (-0.2, 0.008, 0.5)])
@pytest.mark.parametrize('tip', [STRAIGHT, USUAL])
def test_a_piece_of_belt_is_the_push_of_the_finger_over_it(mu_c, theta, d, u, tip):
    start, way = Situation(0.02, theta, d, u, u), 0.006
    after = follow(start, u, way, pushed(mu_c, tip))
    angle, contact, centre = finger_pushes(start, way, mu_c, tip)
    assert after.x == pytest.approx(start.x + u * way, abs=1e-15)
    assert after.theta == pytest.approx(angle, abs=1e-4)
    assert after.d == pytest.approx(contact, abs=5e-6)
    assert centre_of_mass(after, pushed()) == pytest.approx(centre, abs=5e-6)


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.5])
@pytest.mark.parametrize(('theta', 'd', 'u'), [(0.1, 0.008, -0.3), (-0.2, -0.008, 0.5)])
def test_a_slip_that_dies_away_within_a_step_ends_where_it_does(mu_c, theta, d, u):
    c, h = 0.004, 0.006  # the slip is over within 0.4 mm of belt
    start = now = Situation(0.02, theta, d, u, u)
    for _ in range(3):
        now, _ = step(now, u, h, pushed(mu_c, c=c))
    angle, contact, centre = finger_pushes(start, 3.0 * h, mu_c, c=c)
    assert now.theta == pytest.approx(angle, abs=math.radians(0.5))
    assert now.d == pytest.approx(contact, abs=2e-4)
    assert centre_of_mass(now, pushed()) == pytest.approx(centre, abs=3e-4)


def test_a_finger_that_lags_goes_as_far_as_a_first_order_servo():
    lag, way = 5e-4, 2e-3
    after = follow(Situation(0.0, 0.0, 0.0, 1.0, 0.0), -0.5, way, pushed(lag=lag))
    left = math.exp(-way / lag)
    assert after.u == pytest.approx(-0.5 + 1.5 * left)
    assert after.x == pytest.approx(-0.5 * way + 1.5 * lag * (1.0 - left))
    assert after.command == -0.5


def test_what_is_outside_is_told_one_by_one():
    bounds = Bounds(1.5, 2000.0, -0.1, 0.1, -0.02, 0.02, 0.5)
    assert outside(Situation(0.0, 0.1, 0.01, 0.0, 0.0), pushed(), bounds) == (0.0, 0.0, 0.0)
    found = outside(Situation(-0.103, -0.6, 0.021, 0.0, 0.0), pushed(), bounds)
    assert found == pytest.approx((0.001, 0.003, 0.1))


# Left of the first joint the pole points to the left, right of it to the right.
@pytest.mark.parametrize(('x', 'farthest'), [(0.05, 1.0), (-0.1, -1.0)])
def test_the_contact_is_to_be_felt_where_the_tip_points(x, farthest):
    bounds = Bounds(1.5, 2000.0, -0.1, 0.1, -0.02, 0.02, 1.4, 1.5)
    # The normal of the edge is 1.5 rad from the pole there.
    last = psi(x) + farthest * 1.5 - math.pi / 2.0
    for more in (-0.01, 0.02):
        now = Situation(x, last + farthest * more, 0.0, 0.0, 0.0)
        assert outside(now, pushed(tip=USUAL), bounds)[2] == pytest.approx(max(more, 0.0))
        assert outside(now, pushed(), bounds)[2] == 0.0


@pytest.mark.parametrize('tip', [STRAIGHT, USUAL])
def test_an_object_that_translates_does_not_turn(tip):
    now, h = Situation(0.03, 0.2, -0.006, 0.0, 0.0), 1e-5
    after = follow(now, translating(now, pushed(tip=tip)), h, pushed(tip=tip))
    assert after.theta == pytest.approx(now.theta, abs=1e-8)
    # It moves along the ray from the contact through its centre of mass, and so across the belt
    # by the tangent of the ray's angle for what it moves along. The belt moves the other way, and
    # the surface of a tip that turns passes the edge.
    turned = 0.0 if tip == STRAIGHT else psi(after.x) - psi(now.x)
    passed = R * turned
    assert after.d - now.d == pytest.approx(passed, abs=1e-9)
    across = centre_of_mass(after, pushed()) - centre_of_mass(now, pushed())
    along = h - passed * math.sin(now.theta)
    ray = now.theta + math.atan2(now.d, L)
    assert across == pytest.approx(-math.tan(ray) * along, rel=1e-3)


def test_steeper_commands_are_bounded():
    bounds = Bounds(0.5, 2000.0, -0.1, 0.1, -0.02, 0.02, 0.5)
    now = Situation(0.0, 0.2, -0.006, 0.0, 0.0)
    assert ahead(now, pushed(), bounds) == translating(now, pushed())
    steep = Situation(0.0, 0.9, 0.0, 0.0, 0.0)
    assert ahead(steep, pushed(), bounds) == -0.5 > translating(steep, pushed())


def test_a_command_changes_no_faster_than_it_may():
    bounds = Bounds(1.5, 100.0, -0.1, 0.1, -0.02, 0.02, 0.5)
    now = Situation(0.0, 0.2, -0.006, 0.3, 0.3)
    after, pushes = bounded_step(now, -1.5, 1e-3, pushed(), bounds)
    assert pushes
    assert after.command == pytest.approx(0.3 - 100.0 * 1e-3)
    assert bounded_step(now, 0.35, 1e-3, pushed(), bounds)[0].command == 0.35


def test_narrower_bounds_spare_some_of_each():
    bounds = Bounds(1.5, 2000.0, -0.1, 0.2, -0.02, 0.03, 0.5, 1.4)
    assert narrowed(bounds, 0.2, 0.01, 0.002, 0.1) == pytest.approx(
        (1.2, 2000.0, -0.09, 0.19, -0.018, 0.028, 0.4, 1.3)
    )
