# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import AHEAD, PushLaw, finger_velocity, motion_angle, push_angle

checked = settings(derandomize=True, deadline=None, max_examples=60)
LOWER, UPPER = math.radians(33.0), math.radians(147.0)
readings = st.floats(-1.0, 1.0)
gains = st.floats(0.0, 10.0)


def papers_law(theta_desired=-0.1745):
    return PushLaw(kp=0.05, kd=5.0, theta_desired=theta_desired)


def exactly(value):
    return pytest.approx(value, rel=1e-14, abs=1e-16)


def test_a_finger_at_rest_pushes_straight_ahead():
    assert math.degrees(AHEAD) == 90.0
    assert papers_law().phi == AHEAD


def test_three_steps_as_computed_by_hand():
    law = PushLaw(kp=0.5, kd=2.0, theta_desired=-0.1)

    phi = [law.update(theta) for theta in (0.3, 0.2, 0.25, 0.25)]

    # - 90 degrees; + 0.5 * 0.3 - 2 * 0.1; + 0.5 * 0.35 + 2 * 0.05; + 0.5 * 0.35
    assert [value - AHEAD for value in phi] == pytest.approx([0.0, -0.05, 0.225, 0.4], abs=1e-15)
    assert law.phi == phi[-1]


def test_push_angle_as_computed_by_hand():
    # 1.5 + 0.5 (0.3 + 0.1) + 2 (0.3 - 0.35) = 1.6
    phi = push_angle(1.5, 0.3, 0.35, 0.5, 2.0, -0.1, LOWER, UPPER)

    assert phi == exactly(1.6)


@pytest.mark.parametrize(
    ('theta', 'theta_before', 'kp', 'kd', 'phi'),
    [(0.2, 0.2, 0.1, 7.0, 1.53), (-0.1, 0.0, 3.0, 0.2, 1.48), (0.9, -0.7, 0.0, 0.0, 1.5)],
)
def test_push_angle_takes_each_term_of_18(theta, theta_before, kp, kd, phi):
    # theta_d = -0.1: the proportional term alone, the derivative alone, neither.
    found = push_angle(1.5, theta, theta_before, kp, kd, -0.1, LOWER, UPPER)

    assert found == exactly(phi)


@checked
@given(
    phi=st.floats(0.5, 2.5),
    theta=st.floats(-1e6, 1e6),
    theta_before=st.floats(-1e6, 1e6),
    kp=gains,
    kd=gains,
    theta_desired=readings,
)
def test_push_angle_never_leaves_its_bounds(phi, theta, theta_before, kp, kd, theta_desired):
    found = push_angle(phi, theta, theta_before, kp, kd, theta_desired, 1.0, 2.0)

    free = phi + kp * (theta - theta_desired) + kd * (theta - theta_before)
    assert 1.0 <= found <= 2.0
    if 1.0 + 1e-6 < free < 2.0 - 1e-6:
        assert found == pytest.approx(free, rel=0, abs=1e-6)
    elif free >= 2.0 + 1e-6:
        assert found == 2.0
    elif free <= 1.0 - 1e-6:
        assert found == 1.0


@checked
@given(
    phi=st.floats(1.0, 2.1),
    theta=readings,
    theta_before=readings,
    theta_desired=readings,
    kp=gains,
    kd=gains,
)
def test_mirrored_readings_give_the_mirrored_push_angle(
    phi, theta, theta_before, theta_desired, kp, kd
):
    one = push_angle(phi, theta, theta_before, kp, kd, theta_desired, LOWER, UPPER)
    other = push_angle(math.pi - phi, -theta, -theta_before, kp, kd, -theta_desired, LOWER, UPPER)

    assert other - AHEAD == pytest.approx(AHEAD - one, rel=0, abs=1e-12)


@pytest.mark.parametrize('phi', [AHEAD, 1.0, 2.0])
@pytest.mark.parametrize('theta', [-1.5, 0.0, 0.35, 100.0])
def test_the_first_reading_gives_no_kick(phi, theta):
    law = papers_law()
    law.reset(phi)

    assert law.update(theta) == phi


@checked
@given(st.lists(readings, min_size=2, max_size=20), gains, gains, readings)
def test_within_the_bounds_phi_is_the_sum_that_18_makes(thetas, kp, kd, theta_desired):
    law = PushLaw(kp, kd, theta_desired, phi_min=1e-9, phi_max=math.pi - 1e-9)
    law.update(thetas[0])
    expected = AHEAD
    for before, theta in pairwise(thetas):
        expected += kp * (theta - theta_desired) + kd * (theta - before)
        expected = min(max(expected, 1e-9), math.pi - 1e-9)
        assert law.update(theta) == pytest.approx(expected, rel=0, abs=1e-12)


@checked
@given(st.floats(-1e-3, 1e-3), st.lists(st.floats(-1e-3, 1e-3), min_size=1, max_size=20))
def test_unsaturated_it_is_a_proportional_integral_law(first, thetas):
    # Summed up, (18) reads phi(k) = phi(0) + kp sum (theta - theta_d) + kd (theta(k) - theta(0)).
    law = papers_law(theta_desired=0.002)
    law.update(first)

    for theta in thetas:
        phi = law.update(theta)

    total = 0.05 * sum(theta - 0.002 for theta in thetas) + 5.0 * (thetas[-1] - first)
    assert phi == pytest.approx(AHEAD + total, rel=0, abs=1e-14)


@pytest.mark.parametrize(('kp', 'kd', 'phi'), [(0.1, 0.0, 0.03), (0.0, 5.0, 0.5), (0.0, 0.0, 0.0)])
def test_either_gain_works_without_the_other(kp, kd, phi):
    law = PushLaw(kp, kd, theta_desired=0.0)
    law.update(0.2)

    assert law.update(0.3) - AHEAD == pytest.approx(phi, rel=1e-14, abs=0.0)


def test_the_default_bounds_are_the_papers():
    law = papers_law()
    law.update(0.0)

    assert law.update(10.0) == UPPER
    assert law.update(-10.0) == LOWER


@checked
@given(st.lists(st.floats(-1e6, 1e6), max_size=20), gains, gains, readings)
def test_phi_never_leaves_its_bounds(thetas, kp, kd, theta_desired):
    law = PushLaw(kp, kd, theta_desired, phi_min=1.0, phi_max=2.5)

    for theta in thetas:
        phi = law.update(theta)
        assert 1.0 <= phi <= 2.5
        assert law.saturated == (phi in (1.0, 2.5))


@pytest.mark.parametrize(('side', 'bound'), [(1.0, UPPER), (-1.0, LOWER)])
def test_a_long_saturation_leaves_nothing_to_unwind(side, bound):
    law = papers_law(theta_desired=0.0)
    for _ in range(10_000):
        law.update(side * 0.5)
    assert law.phi == bound
    assert law.saturated

    phi = law.update(side * 0.5 - side * 0.2)

    assert phi == exactly(bound + side * (0.05 * 0.3 - 5.0 * 0.2))
    assert not law.saturated


def test_the_first_reversed_error_alone_moves_phi_off_its_bound():
    law = PushLaw(kp=0.05, kd=0.0, theta_desired=0.0)
    for _ in range(10_000):
        law.update(0.5)

    assert law.update(-0.1) == exactly(UPPER - 0.005)


def test_new_gains_act_on_what_follows_only():
    law = papers_law(theta_desired=0.1)
    for theta in (0.1, 0.12, 0.15, 0.11):
        before = law.update(theta)

    law.kp, law.kd = 1.0, 50.0

    assert law.phi == before
    assert law.update(0.11) == exactly(before + 1.0 * 0.01)
    assert law.update(0.111) == exactly(before + 0.01 + 1.0 * 0.011 + 50.0 * 0.001)


def test_no_gain_jumps_at_the_desired_angle_at_rest():
    law = papers_law(theta_desired=0.1)
    for theta in (0.2, 0.15, 0.1, 0.1):
        before = law.update(theta)

    law.kp, law.kd = 100.0, 100.0

    assert law.update(0.1) == before


def test_a_new_desired_angle_is_no_derivative():
    law = papers_law(theta_desired=0.0)
    for theta in (0.3, 0.2, 0.2):
        before = law.update(theta)

    law.theta_desired = -0.4

    assert law.phi == before
    assert law.update(0.2) == exactly(before + 0.05 * 0.6)


@pytest.mark.parametrize('theta', [math.nan, math.inf, -math.inf])
def test_what_is_no_angle_is_refused_and_changes_nothing(theta):
    law = papers_law(theta_desired=0.0)
    law.update(0.1)
    before = law.update(0.12)

    with pytest.raises(ValueError, match='theta'):
        law.update(theta)

    assert law.phi == before
    assert law.update(0.13) == exactly(before + 0.05 * 0.13 + 5.0 * 0.01)


def test_what_is_no_angle_is_no_first_reading():
    law = papers_law()

    with pytest.raises(ValueError, match='theta'):
        law.update(math.nan)

    assert law.update(0.7) == AHEAD


def test_reset_forgets_the_last_reading():
    law = papers_law(theta_desired=0.0)
    law.update(0.1)
    law.update(0.15)

    law.reset()

    assert law.phi == AHEAD
    assert law.update(-0.6) == AHEAD
    assert law.update(-0.6) == exactly(AHEAD - 0.05 * 0.6)


@pytest.mark.parametrize(('phi', 'expected'), [(0.1, LOWER), (3.0, UPPER), (1.2, 1.2)])
def test_reset_keeps_to_the_bounds(phi, expected):
    law = papers_law()

    law.reset(phi)

    assert law.phi == expected


def test_straight_ahead_the_finger_does_not_move_at_all():
    assert finger_velocity(AHEAD, 0.005) == 0.0
    assert finger_velocity(math.radians(90.0), 0.005) == 0.0


@pytest.mark.parametrize(
    ('degrees', 'tangent'),
    [
        (45.0, 1.0),
        (135.0, -1.0),
        (60.0, math.sqrt(3.0)),
        (120.0, -math.sqrt(3.0)),
        (33.0, 0.649407593197),
        (147.0, -0.649407593197),
    ],
)
def test_the_finger_moves_across_by_the_tangent_of_the_push_angle(degrees, tangent):
    v_x = finger_velocity(math.radians(degrees), 0.005)

    assert v_x == pytest.approx(0.005 / tangent, rel=1e-11)


@checked
@given(st.floats(0.01, math.pi - 0.01), st.floats(1e-4, 0.1))
def test_belt_and_finger_together_push_in_direction_phi(phi, belt_speed):
    assert math.atan2(belt_speed, finger_velocity(phi, belt_speed)) == pytest.approx(phi, rel=1e-13)


def test_near_90_degrees_the_velocity_is_continuous():
    assert finger_velocity(AHEAD + 1e-9, 0.005) == pytest.approx(-5e-12, rel=1e-6)
    assert finger_velocity(AHEAD - 1e-9, 0.005) == pytest.approx(5e-12, rel=1e-6)


def test_a_push_of_the_papers_rig_is_0_5_to_0_9_mm_long():
    law = papers_law()
    lengths = []
    for phi in (0.0, AHEAD, math.pi):
        law.reset(phi)
        lengths.append(100.0 * math.hypot(finger_velocity(law.phi, 0.005), 0.005))  # mm in 0.1 s

    assert [round(length, 1) for length in lengths] == [0.9, 0.5, 0.9]
    assert lengths[1] == 0.5


@pytest.mark.parametrize('degrees', [33.0, 45.0, 90.0, 91.0, 147.0])
def test_push_angle_comes_back_from_the_velocity(degrees):
    phi = math.radians(degrees)
    assert motion_angle(finger_velocity(phi, 0.005), 0.005) == pytest.approx(phi, rel=1e-15)


def test_a_finger_at_rest_is_pushed_straight_ahead():
    assert motion_angle(0.0, 0.005) == AHEAD
    assert motion_angle(-0.0, 0.005) == AHEAD
    assert math.degrees(motion_angle(0.005, 0.005)) == pytest.approx(45.0)
