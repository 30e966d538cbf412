# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The planner's steps against the mechanics of a push."""

import math

import numpy as np
import pytest

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

L, R, C, BELT = 0.02375, 0.0135, 0.0187, 0.005
ROUND = np.array((1.0, 0.0, 1.0))


def pushed(mu_c=math.inf, turning=0.0, lag=0.0, c=C):
    return Pushed(L, R, Pressure(c * c, 0.0, 0.0, ROUND), *friction_cone(mu_c), turning, lag)


def finger_pushes(start, way, mu_c, turning=0.0, c=C):
    """Return theta, d and the centre of mass after a push under the equations of the paper."""
    slider = Slider(Outline.rectangle(0.2, 2.0 * L), c)
    x, theta, d, u, _ = start
    sigma = slider.outline.sigma(R, d=d)
    pose = Pose(centre_of_mass(start, pushed()), 0.0, theta)
    y = d * math.sin(theta) - (L + R) * math.cos(theta)  # of the disk, from the centre of mass
    found, contact, _, _ = move_finger(
        *(pose, sigma, True, x, y, BELT * u, BELT, way / BELT),
        *(slider.body(R), Finger(*friction_cone(mu_c), R), turning * BELT * u),
    )
    return found.angle, d + contact - sigma, found.x


@pytest.mark.parametrize('mu_c', [0.0, 0.2, 1.0, math.inf])
@pytest.mark.parametrize(('theta', 'd', 'u'), [(0.3, -0.006, -1.2), (-0.2, 0.008, 0.5)])
@pytest.mark.parametrize('turning', [0.0, -12.5])
def test_a_piece_of_belt_is_the_push_of_the_finger_over_it(mu_c, theta, d, u, turning):
    start, way = Situation(0.02, theta, d, u, u), 0.006
    after = follow(start, u, way, pushed(mu_c, turning))
    angle, contact, centre = finger_pushes(start, way, mu_c, turning)
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
    assert outside(Situation(0.0, 0.1, 0.01, 0.0, 0.0), bounds) == (0.0, 0.0, 0.0)
    found = outside(Situation(-0.103, -0.6, 0.021, 0.0, 0.0), bounds)
    assert found == pytest.approx((0.001, 0.003, 0.1))


def test_an_object_that_translates_does_not_turn_and_steeper_commands_are_bounded():
    bounds = Bounds(0.5, 2000.0, -0.1, 0.1, -0.02, 0.02, 0.5)
    now = Situation(0.0, 0.2, -0.006, 0.0, 0.0)
    after = follow(now, translating(now, pushed()), 1e-3, pushed())
    assert after.theta == pytest.approx(now.theta, abs=1e-9)
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
    bounds = Bounds(1.5, 2000.0, -0.1, 0.2, -0.02, 0.03, 0.5)
    assert narrowed(bounds, 0.2, 0.01, 0.002, 0.1) == pytest.approx(
        (1.2, 2000.0, -0.09, 0.19, -0.018, 0.028, 0.4)
    )
