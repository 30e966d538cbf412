# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What docs/placing.md says of a pushed object, against the mechanics of (8) to (16)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control.placing.car import held_angle, leaf, shortest_belt
from tactile_push.mechanics import (
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    Outline,
    Slider,
    friction_cone,
    push,
    pushed_twist,
)

L, C, R = 0.02375, 0.0187, 0.0135
STEEPEST = 1.0 / math.tan(math.radians(33.0))
PHI_90 = math.pi / 2.0
checked = settings(derandomize=True, deadline=None, max_examples=40)
thetas = st.floats(-0.7, 0.7)
contacts = st.floats(-0.02, 0.02)
steerings = st.floats(-STEEPEST, STEEPEST)


def rates(theta, d, u, mu_c=math.inf, r=R):
    """Return x', theta', d' per metre of belt, the mode and v_slip, of a tip that does not turn."""
    cos, sin = math.cos(theta), math.sin(theta)
    v_x, v_y, omega, v_slip, mode = pushed_twist(
        cos * u + sin, cos - sin * u, d, -L, *friction_cone(mu_c), C
    )
    return cos * v_x - sin * v_y, omega, v_slip - r * omega, mode, v_slip


def ray(theta, d):
    """Return the angle from +y of the ray from the contact through the centre of mass."""
    return theta + math.atan2(d, L)


@pytest.mark.parametrize('spin', [0.0, -12.5])
@checked
@given(theta=thetas, d=st.floats(-0.015, 0.015), pushes=st.lists(steerings, min_size=1, max_size=6))
def test_a_contact_that_sticks_keeps_its_leaf(spin, theta, d, pushes):
    slider = Slider(Outline.rectangle(0.2, 2.0 * L), C)
    body = slider.body(R)
    angle, sigma = theta, slider.outline.sigma(R, d=d)
    start, psi = sigma, PHI_90
    for u in pushes:
        v_x = 0.005 * u
        angle, sigma, _, mode = push(
            *(angle, sigma, v_x, 0.005, 0.2, body.path, body.c, None, *friction_cone(math.inf)),
            *(R, spin * v_x),
        )
        psi += spin * v_x * 0.2
        if mode != STICK or abs(angle) > 1.4:  # turned out of the finger's way
            return
        now = leaf(d + sigma - start, angle, psi, R)
        assert now == pytest.approx(leaf(d, theta, PHI_90, R), abs=1e-12)


@checked
@given(thetas, contacts)
def test_an_object_translates_along_the_ray(theta, d):
    x, omega, d_rate, _, _ = rates(theta, d, -math.tan(ray(theta, d)))
    assert omega == pytest.approx(0.0, abs=1e-11)
    assert d_rate == pytest.approx(0.0, abs=1e-12)
    assert x == pytest.approx(-math.tan(ray(theta, d)), abs=1e-12)


@checked
@given(contacts)
def test_it_goes_straight_ahead_at_the_angle_that_its_leaf_holds(k):
    theta = held_angle(k, L, R)
    d = k - R * theta
    assert d + L * math.tan(theta) == pytest.approx(0.0, abs=1e-14)
    assert rates(theta, d, 0.0)[:3] == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@checked
@given(thetas, contacts, steerings)
def test_the_turn_and_the_way_aside_are_those_of_the_car(theta, d, u):
    chi, rho = ray(theta, d), math.hypot(d, L)
    wheelbase = (C**2 + rho**2) / rho
    x, omega, _, mode, _ = rates(theta, d, u)
    if mode != STICK:  # it would have to pull
        return
    assert omega == pytest.approx((math.sin(chi) + u * math.cos(chi)) / wheelbase, abs=1e-10)
    assert x == pytest.approx(u - rho * math.cos(chi) * omega, abs=1e-12)


@checked
@given(st.floats(1.0, 1.4), contacts, steerings)
def test_beyond_the_steepest_push_there_is_no_way_back(chi, d, u):
    if math.tan(chi) < STEEPEST:
        return
    theta = chi - math.atan2(d, L)
    assert rates(theta, d, u)[1] >= -1e-12
    assert rates(-theta, -d, u)[1] <= 1e-12


def test_no_push_near_rest_changes_d_alone():
    # Brockett: the map of state and input onto the rates misses (0, 0, e) for every e but 0.
    theta = held_angle(0.003, L, R)
    d = 0.003 - R * theta
    at_rest = np.array((theta, d, 0.0))
    step = 1e-6
    slopes = np.array(
        [
            np.subtract(rates(*(at_rest + e), 0.5)[:3], rates(*(at_rest - e), 0.5)[:3])
            for e in np.eye(3) * step
        ]
    ) / (2.0 * step)
    assert np.abs(slopes[:, 2] + R * slopes[:, 1]).max() < 1e-6
    assert np.linalg.matrix_rank(slopes, 1e-4) == 2


def test_on_its_leaf_the_pair_x_theta_is_controllable_with_the_determinant_of_the_docs():
    theta = held_angle(0.003, L, R)
    k, step = 0.003, 1e-6

    def on_leaf(theta, u):
        return np.array(rates(theta, k - R * theta, u)[:2])

    by_theta = (on_leaf(theta + step, 0.0) - on_leaf(theta - step, 0.0)) / (2.0 * step)
    by_u = (on_leaf(theta, step) - on_leaf(theta, -step)) / (2.0 * step)
    rho = math.hypot(k - R * theta, L)
    growth = 1.0 - R * L / rho**2
    reached = np.array((by_u, by_theta * by_u[1]))
    expected = growth / ((C**2 + rho**2) / rho) ** 2
    assert abs(np.linalg.det(reached)) == pytest.approx(expected, rel=1e-6)


@checked
@given(thetas, contacts, st.floats(-1.2, 1.2))
def test_the_flat_output_moves_along_the_ray_with_the_curvature_of_the_push(theta, d, u):
    chi, rho = ray(theta, d), math.hypot(d, L)
    cos, sin = math.cos(theta), math.sin(theta)
    v_x, v_y, omega, _, mode = pushed_twist(cos * u + sin, cos - sin * u, d, -L, 0.0, 1.0, C)
    if mode != STICK:
        return
    along = np.array((-d, L)) / rho  # the ray in the edge frame
    across = np.array((-along[1], along[0]))
    velocity = np.array((v_x, v_y)) + omega * C**2 / rho * across
    assert velocity @ across == pytest.approx(0.0, abs=1e-12)
    speed = velocity @ along
    assert speed == pytest.approx(math.cos(chi) - u * math.sin(chi), abs=1e-12)
    wheelbase = (C**2 + rho**2) / rho
    assert omega == pytest.approx(speed * math.tan(chi + math.atan(u)) / wheelbase, abs=1e-9)


@checked
@given(thetas, contacts, steerings, st.floats(0.0, 2.0))
def test_slipping_leaves_the_leaf_and_moves_the_object_along_the_edge_of_the_cone(
    theta, d, u, mu_c
):
    x, omega, d_rate, mode, v_slip = rates(theta, d, u, mu_c)
    assert d_rate + R * omega == pytest.approx(v_slip if mode != STICK else 0.0, abs=1e-12)
    if mode not in (SLIP_LEFT, SLIP_RIGHT):
        return
    side = 1.0 if mode == SLIP_RIGHT else -1.0
    assert v_slip * side > 0.0
    cos, sin = math.cos(theta), math.sin(theta)
    v_x, v_y, _, _, _ = pushed_twist(cos * u + sin, cos - sin * u, d, -L, *friction_cone(mu_c), C)
    assert math.atan2(-x, sin * v_x + cos * v_y) == pytest.approx(
        theta - side * math.atan(mu_c), abs=1e-9
    )
    assert omega * (d + side * L * mu_c) >= -1e-15


@checked
@given(thetas, st.floats(0.0, 0.5), st.floats(0.0, 0.01), steerings)
def test_beyond_the_cone_the_object_turns_one_way_only(theta, mu_c, more, u):
    assert rates(theta, L * mu_c + more, u, mu_c)[1] >= -1e-12
    assert rates(theta, -L * mu_c - more, u, mu_c)[1] <= 1e-12


def car(pushes, wheelbase, steps=400):
    """Return chi and the place of a finger that does not roll, after pushes (u, belt), by RK4."""
    chi = x = 0.0
    for u, belt in pushes:
        h = belt / steps
        for _ in range(steps):

            def turn(chi, u=u):
                return (math.sin(chi) + u * math.cos(chi)) / wheelbase

            k_1 = turn(chi)
            k_2 = turn(chi + h / 2.0 * k_1)
            k_3 = turn(chi + h / 2.0 * k_2)
            chi += h / 6.0 * (k_1 + 2.0 * k_2 + 2.0 * k_3 + turn(chi + h * k_3))
        x += u * belt
    return chi, x


@pytest.mark.parametrize('shift', [0.002, 0.02, 0.05])
def test_the_shortest_belt_has_one_switch_and_no_random_push_is_shorter(shift):
    wheelbase = 0.0385
    belt = shortest_belt(shift, wheelbase, STEEPEST)
    assert belt == shortest_belt(-shift, wheelbase, STEEPEST)
    # Out and back differ by shift/U, so both follow from their sum.
    out = (belt - shift / STEEPEST) / 2.0
    chi, x = car([(-STEEPEST, out), (STEEPEST, belt - out)], wheelbase)
    assert (chi, x) == pytest.approx((0.0, shift), abs=1e-6)
    rng, compared = np.random.default_rng(1), 0
    for _ in range(8):
        pushes = [(u, belt / 6.0) for u in rng.uniform(-STEEPEST, STEEPEST, 3)]
        chi, x = car(pushes, wheelbase, 50)
        if abs(chi) >= math.atan(STEEPEST) - 0.02:
            continue
        # Straight ahead again as soon as possible; what belt is left is not used.
        steep = math.copysign(STEEPEST, -chi)
        way = abs(quickest(chi, wheelbase))
        chi, x = car([*pushes, (steep, way)], wheelbase, 100)
        used = belt / 2.0 + way
        assert abs(chi) < 1e-4
        assert abs(x) <= longest_shift(used, wheelbase) + 1e-6
        compared += 1
    assert compared > 3


def quickest(chi, wheelbase):
    """Return the belt that turns the ray back to straight ahead, by quadrature."""
    angles = np.linspace(0.0, abs(chi), 4001)
    rate = (STEEPEST * np.cos(angles) - np.sin(angles)) / wheelbase
    return float(np.sum((1.0 / rate[1:] + 1.0 / rate[:-1]) / 2.0) * angles[1])


def longest_shift(belt, wheelbase):
    """Return the shift for which a belt is the shortest one."""
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = (low + high) / 2.0
        if shortest_belt(middle, wheelbase, STEEPEST) < belt:
            low = middle
        else:
            high = middle
    return low


def test_a_short_shift_takes_a_belt_as_its_root_and_a_long_one_as_itself():
    wheelbase = 0.0385
    small = shortest_belt(1e-5, wheelbase, STEEPEST)
    assert small == pytest.approx(2.0 * math.sqrt(wheelbase * 1e-5 / STEEPEST), rel=1e-3)
    more = shortest_belt(2.0, wheelbase, STEEPEST) - shortest_belt(1.0, wheelbase, STEEPEST)
    assert more == pytest.approx(1.0 / STEEPEST, rel=1e-3)
