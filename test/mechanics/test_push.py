# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import (
    FREE,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    friction_cone,
    push,
    push_rates,
)

checked = settings(derandomize=True, deadline=None, max_examples=50)
FINGER = 0.0135
EDGE, DISK = (0.0, 0.02375, 0.0187), (1.0 / 0.0285, 0.0285, 0.019)  # curvature, l, c
thetas = st.floats(-0.5, 0.5)
contacts = st.floats(-0.02, 0.02)
headings = st.floats(0.6, math.pi - 0.6)
paths = st.floats(1e-4, 0.03)
outlines = st.sampled_from([EDGE, DISK])
frictions = st.sampled_from([0.0, math.inf]) | st.floats(1e-3, 3.0)


def pushed(theta, s, phi, path, outline=EDGE, mu_c=math.inf, v=0.005, r=FINGER):
    return push(theta, s, v, phi, path / v, *outline, *friction_cone(mu_c), r)


def law_18_on_the_papers_block(periods):
    # kp = 0.05, kd = 5, theta_d = -10 degrees; the belt's 5 mm/s, 10 Hz, phi within 33 to 147.
    theta, d, phi = math.radians(20.0), -0.006, math.pi / 2.0
    history = [(theta, phi, d)]
    for _ in range(periods):
        speed = 0.005 / math.sin(phi)
        before = theta
        theta, d, elapsed, mode = push(
            theta, d, speed, phi, 0.1, 0.0, 0.02375, 0.0187, *friction_cone(math.inf), FINGER
        )
        assert elapsed == 0.1
        assert mode != FREE
        phi += 0.05 * (theta + math.radians(10.0)) + 5.0 * (theta - before)
        phi = min(max(phi, math.radians(33.0)), math.radians(147.0))
        history.append((theta, phi, d))
    return np.array(history).T


def simulated_in_the_plane(theta, s, phi, path, outline, mu_c, r, steps):
    # The same push without contact coordinates: the object's pose (x, y, angle) is integrated by
    # Runge and Kutta's method; at each instant the contact is found from the pose, the force by
    # trial: the one that sticks if Coulomb allows it, else the edge of the cone that opposes.
    curvature, l, c = outline
    heading = np.array([math.cos(phi), math.sin(phi)])

    def frame(pose, finger):
        if curvature == 0.0:
            angle = pose[2]
        else:
            angle = math.atan2(finger[0] - pose[0], pose[1] - finger[1])
        normal = np.array([-math.sin(angle), math.cos(angle)])
        tangent = np.array([math.cos(angle), math.sin(angle)])
        along = (finger - pose[:2]) @ tangent if curvature == 0.0 else 0.0
        return angle, normal, tangent, along * tangent - l * normal

    def rates(pose, travelled):
        _, normal, tangent, x_c = frame(pose, travelled * heading)
        lever = np.array([-x_c[1], x_c[0]])  # moment of f: lever @ f
        mobility = np.eye(2) + np.outer(lever, lever) / c**2  # contact velocity of f
        force = np.linalg.solve(mobility, heading)
        across, ahead = force @ tangent, force @ normal
        if ahead < 0.0 or (not math.isinf(mu_c) and abs(across) > mu_c * ahead):
            for side in (-1.0, 1.0):
                edge = side * tangent if math.isinf(mu_c) else normal + side * mu_c * tangent
                advance = (mobility @ edge) @ normal
                if advance <= 0.0:
                    continue
                trial = (heading @ normal) / advance * edge
                if (heading - mobility @ trial) @ tangent * side >= 0.0:
                    force = trial
        return np.array([force[0], force[1], lever @ force / c**2])

    normal = np.array([-math.sin(theta), math.cos(theta)])
    tangent = np.array([math.cos(theta), math.sin(theta)])
    start = (r + l) * normal - (s * tangent if curvature == 0.0 else 0.0)
    pose = np.array([*start, theta - s * curvature])
    h = path / steps
    for i in range(steps):
        k1 = rates(pose, i * h)
        k2 = rates(pose + h / 2.0 * k1, (i + 0.5) * h)
        k3 = rates(pose + h / 2.0 * k2, (i + 0.5) * h)
        k4 = rates(pose + h * k3, (i + 1) * h)
        pose = pose + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    angle, normal, tangent, x_c = frame(pose, path * heading)
    gap = (pose[:2] + x_c - path * heading) @ normal - r
    s = x_c @ tangent if curvature == 0.0 else (angle - pose[2]) / curvature
    return angle, s, gap


def turned_after(angle, rate, time):
    # u' = -rate cos(u) has the solution tan(u/2 + pi/4) = tan(u0/2 + pi/4) exp(-rate t).
    start = angle / 2.0 + math.pi / 4.0
    end = math.atan2(math.sin(start) * math.exp(-rate * time), math.cos(start))
    return 2.0 * end - math.pi / 2.0


def time_to_turn(angle, angle_end, rate):
    # The same, solved for the time.
    start, end = (math.tan(u / 2.0 + math.pi / 4.0) for u in (angle, angle_end))
    return math.log(start / end) / rate


@pytest.mark.parametrize(
    ('curvature', 's', 'mu_c', 'expected'),
    [
        # l = c = r = 1, the finger at speed 2 along the normal: omega = 2 / 3 sticking at d = 1,
        # s' = -r omega by (16).
        (0.0, 1.0, math.inf, (2.0 / 3.0, -2.0 / 3.0, STICK)),
        (0.0, -1.0, math.inf, (-2.0 / 3.0, 2.0 / 3.0, STICK)),
        # Without friction omega = 1 and v_slip = -1: s' = -1 - 1.
        (0.0, 1.0, 0.0, (1.0, -2.0, SLIP_LEFT)),
        (0.0, -1.0, 0.0, (-1.0, 2.0, SLIP_RIGHT)),
        # On a disk the normal passes through the centre of mass, wherever the contact is.
        (1.0, 0.7, math.inf, (0.0, 0.0, STICK)),
    ],
)
def test_rates_as_computed_by_hand(curvature, s, mu_c, expected):
    rates = push_rates(
        0.3, s, 2.0, 0.3 + math.pi / 2.0, curvature, 1.0, 1.0, *friction_cone(mu_c), 1.0
    )

    assert rates[2] == expected[2]
    assert rates[:2] == pytest.approx(expected[:2], rel=0, abs=1e-14)


def test_rates_on_a_disk_as_computed_by_hand():
    # R = c = r = v = 1, pushed at 45 degrees from the tangent, sticking: omega = cos / 2 by
    # v_x = (c^2 + 0) v_px / (c^2 + R^2), omega = R v_x / c^2; s' = -r omega / (1 + r / R),
    # theta' = omega + s' / R.
    omega = math.sqrt(0.5) / 2.0

    theta_dot, s_dot, mode = push_rates(
        0.0, 0.4, 1.0, math.pi / 4.0, 1.0, 1.0, 1.0, *friction_cone(math.inf), 1.0
    )

    assert mode == STICK
    assert s_dot == pytest.approx(-omega / 2.0, rel=1e-14)
    assert theta_dot == pytest.approx(omega / 2.0, rel=1e-14)


@pytest.mark.parametrize(
    ('theta', 's', 'phi', 'outline', 'mu_c'),
    [
        (0.35, -0.006, 1.57, EDGE, math.inf),
        (0.0, -0.005, 1.57, EDGE, 0.0),
        (0.0, -0.005, 1.57, EDGE, 0.25),
        (-0.4, 0.012, 2.0, EDGE, 0.1),
        (0.3, 0.015, 1.2, (0.0, 0.01, 0.0067), 0.5),
        (-0.7, 0.02, 1.4, (0.0, 0.01, 0.0067), math.inf),
        (0.7, -0.02, 0.9, (0.0, 0.02375, 0.0345), math.inf),
        (0.35, 0.0, 1.57, DISK, math.inf),
        (-0.6, 0.01, 1.3, DISK, 0.2),
        (0.9, 0.0, 2.1, DISK, 0.0),
        (0.2, 0.003, 1.0, (1.0 / 0.0285, 0.0285, 0.005), 0.7),
    ],
)
def test_a_push_agrees_with_a_simulation_of_the_objects_pose(theta, s, phi, outline, mu_c):
    *expected, gap = simulated_in_the_plane(theta, s, phi, 0.012, outline, mu_c, FINGER, 400)
    assert abs(gap) < 1e-8  # the simulation is a valid one: the finger still touches

    theta_end, s_end, elapsed, mode = pushed(theta, s, phi, 0.012, outline, mu_c)

    assert elapsed == 0.012 / 0.005
    assert mode != FREE
    assert theta_end == pytest.approx(expected[0], rel=0, abs=1e-6)
    assert s_end == pytest.approx(expected[1], rel=0, abs=1e-8)


@pytest.mark.parametrize('beta', [1.2, 1.56, 1.9, 2.5])
@pytest.mark.parametrize('d', [-0.01, 0.0, 0.004])
def test_a_pointed_finger_that_sticks_follows_the_closed_form(beta, d):
    # r = 0, so d stays. With w = (l, d) = |w| (cos gamma, sin gamma) the moment is w . f and
    # omega = w . v_p / (c^2 + w^2), so u = beta - gamma obeys u' = -K cos u.
    l, c, v, duration = 0.02375, 0.0187, 0.005, 0.8
    reach, gamma = math.hypot(l, d), math.atan2(d, l)
    turned = turned_after(beta - gamma, v * reach / (c**2 + reach**2), duration)

    theta, s, elapsed, mode = push(
        0.1, d, v, 0.1 + beta, duration, *EDGE, *friction_cone(math.inf), 0.0
    )

    assert (s, elapsed, mode) == (d, duration, STICK)
    assert theta == pytest.approx(0.1 + beta - gamma - turned, rel=0, abs=1e-8)


@pytest.mark.parametrize('beta', [0.4, 1.2, 1.9, 2.6])
def test_a_disk_that_sticks_follows_the_closed_form(beta):
    # theta' = omega / (1 + r / R) and omega = R v cos(beta) / (c^2 + R^2); s' = -r theta'.
    (_, radius, c), v, duration = DISK, 0.005, 2.0
    rate = v * radius**2 / ((c**2 + radius**2) * (radius + FINGER))
    turned = beta - turned_after(beta, rate, duration)

    theta, s, elapsed, mode = pushed(0.1, 0.001, 0.1 + beta, v * duration, DISK)

    assert (elapsed, mode) == (duration, STICK)
    assert theta == pytest.approx(0.1 + turned, rel=0, abs=1e-8)
    assert s == pytest.approx(0.001 - FINGER * turned, rel=0, abs=1e-10)


@pytest.mark.parametrize('side', [-1.0, 1.0])
@pytest.mark.parametrize('aside', [0.1, 0.5, 1.2])
def test_a_disk_that_turned_out_of_the_way_is_free_when_the_closed_form_says(aside, side):
    # The finger moves along the tangent when beta is 0 or 180 degrees, 90 degrees aside.
    (_, radius, c), v = DISK, 0.005
    rate = v * radius**2 / ((c**2 + radius**2) * (radius + FINGER))
    expected = time_to_turn(aside, 0.0, rate)
    phi = math.pi / 2.0 + side * (math.pi / 2.0 - aside)

    theta, s, elapsed, mode = pushed(0.0, 0.0, phi, 10.0 * v * expected, DISK)

    assert mode == FREE
    assert elapsed == pytest.approx(expected, rel=0, abs=1e-7 / rate)
    assert theta == pytest.approx(-side * aside, rel=0, abs=1e-7)
    assert s == pytest.approx(side * aside * FINGER, rel=0, abs=1e-8)


@pytest.mark.parametrize('side', [-1.0, 1.0])
@pytest.mark.parametrize('aside', [0.1, 0.5, 1.2])
def test_a_finger_that_slides_around_a_disk_is_free_when_the_closed_form_says(aside, side):
    # Without friction the disk does not turn and slips aside, theta' = v cos(beta) / (R + r):
    # again beta' = -K cos(beta).
    (_, radius, _), v = DISK, 0.005
    rate = v / (radius + FINGER)
    expected = time_to_turn(aside, 0.0, rate)
    phi = math.pi / 2.0 + side * (math.pi / 2.0 - aside)

    theta, s, elapsed, mode = pushed(0.0, 0.0, phi, 10.0 * v * expected, DISK, 0.0)

    assert mode == FREE
    assert elapsed == pytest.approx(expected, rel=0, abs=1e-7 / rate)
    assert theta == pytest.approx(-side * aside, rel=0, abs=1e-7)
    assert s == pytest.approx(-side * aside * radius, rel=0, abs=1e-8)


@pytest.mark.parametrize('outline', [EDGE, DISK])
@pytest.mark.parametrize('mu_c', [0.0, 0.5, math.inf])
@pytest.mark.parametrize('beta', [-2.0, -1e-9, math.pi + 1e-9, 4.0])
def test_a_finger_that_moves_away_pushes_nothing(outline, mu_c, beta):
    # In front of the centre of mass no motion cone reaches behind the edge: no pulling.
    assert pushed(0.3, 0.0, 0.3 + beta, 0.01, outline, mu_c) == (0.3, 0.0, 0.0, FREE)


@pytest.mark.parametrize('duration', [0.0, 0.1])
def test_a_push_without_path_changes_nothing(duration):
    v = 0.005 if duration == 0.0 else 0.0

    theta, s, _, _ = push(0.3, 0.004, v, 1.6, duration, *EDGE, *friction_cone(0.5), FINGER)

    assert (theta, s) == (0.3, 0.004)


@checked
@given(thetas, contacts, headings, paths, outlines, frictions)
def test_64_pieces_of_a_push_end_where_the_push_ends(theta, s, phi, path, outline, mu_c):
    whole = pushed(theta, s, phi, path, outline, mu_c)
    elapsed = 0.0
    for _ in range(64):
        theta, s, piece, mode = pushed(theta, s, phi, path / 64.0, outline, mu_c)
        elapsed += piece

    assert (mode == FREE) == (whole[3] == FREE)
    if mode != FREE:  # those that come free have closed forms above
        assert theta == pytest.approx(whole[0], rel=0, abs=1e-7)
        assert s == pytest.approx(whole[1], rel=0, abs=1e-9)
        assert elapsed == pytest.approx(whole[2], rel=1e-12)


@checked
@given(thetas, contacts, headings, paths, outlines, frictions)
def test_a_push_gives_finite_numbers_and_lasts_unless_the_finger_comes_free(
    theta, s, phi, path, outline, mu_c
):
    theta_end, s_end, elapsed, mode = pushed(theta, s, phi, path, outline, mu_c)

    assert math.isfinite(theta_end)
    assert math.isfinite(s_end)
    if mode == FREE:
        assert 0.0 <= elapsed < path / 0.005
        assert math.sin(phi - theta_end) == pytest.approx(0.0, abs=1e-7)
    else:
        assert elapsed == path / 0.005
        assert math.sin(phi - theta_end) > 0.0


@checked
@given(thetas, contacts, headings, paths, outlines, frictions)
def test_mirror_images_mirror(theta, s, phi, path, outline, mu_c):
    theta_end, s_end, elapsed, mode = pushed(theta, s, phi, path, outline, mu_c)

    mirrored = pushed(-theta, -s, math.pi - phi, path, outline, mu_c)

    assert mirrored[:3] == pytest.approx((-theta_end, -s_end, elapsed), rel=1e-6, abs=1e-8)
    swapped = {SLIP_LEFT: SLIP_RIGHT, SLIP_RIGHT: SLIP_LEFT}
    if abs(theta_end - theta) > 1e-6:  # else rounding decides between sticking and slipping
        assert mirrored[3] == swapped.get(mode, mode)


@checked
@given(thetas, contacts, headings, paths, outlines, frictions, st.floats(-3.0, 3.0))
def test_a_push_turned_as_a_whole_turns(theta, s, phi, path, outline, mu_c, turn):
    theta_end, s_end, elapsed, _ = pushed(theta, s, phi, path, outline, mu_c)

    turned = pushed(theta + turn, s, phi + turn, path, outline, mu_c)

    assert turned[:3] == pytest.approx((theta_end + turn, s_end, elapsed), rel=1e-6, abs=1e-8)


@checked
@given(thetas, contacts, headings, paths, outlines, frictions, st.integers(-10, 10))
def test_a_rig_that_is_larger_in_every_length_moves_alike(
    theta, s, phi, path, outline, mu_c, exponent
):
    scale = 2.0**exponent  # which rounds nothing
    curvature, l, c = outline

    theta_end, s_end, elapsed, mode = pushed(theta, s, phi, path, outline, mu_c)

    larger = (curvature / scale, l * scale, c * scale)
    assert push(
        theta,
        s * scale,
        0.005 * scale,
        phi,
        path / 0.005,
        *larger,
        *friction_cone(mu_c),
        FINGER * scale,
    ) == pytest.approx((theta_end, s_end * scale, elapsed, mode), rel=1e-9, abs=1e-12)


@checked
@given(thetas, contacts, headings, paths, outlines, frictions, st.floats(1e-3, 1e3))
def test_the_path_counts_and_the_speed_does_not(theta, s, phi, path, outline, mu_c, faster):
    theta_end, s_end, elapsed, _ = pushed(theta, s, phi, path, outline, mu_c)

    fast = pushed(theta, s, phi, path, outline, mu_c, v=0.005 * faster)

    assert fast[:2] == pytest.approx((theta_end, s_end), rel=0, abs=1e-8)
    assert fast[2] * faster == pytest.approx(elapsed, rel=1e-6)


@checked
@given(thetas, st.floats(0.7, math.pi - 0.7), paths)
def test_a_contact_on_an_edge_stays_where_it_is_while_the_object_translates(theta, beta, path):
    d = -0.02375 / math.tan(beta)  # the ray of pushing passes through the centre of mass

    end = pushed(theta, d, theta + beta, path)

    # The balance is unstable: rounding grows with the path, by e^(K path), K < 40 / m.
    assert end[:2] == pytest.approx((theta, d), rel=0, abs=1e-13)
    assert end[2:] == (path / 0.005, STICK)


@checked
@given(thetas, contacts, st.floats(1.1, math.pi - 1.1), st.floats(1e-4, 0.005))
def test_on_an_edge_that_sticks_the_contact_rolls_by_r_theta(theta, d, beta, path):
    # Within these ranges the push lies well inside the motion cone of 180 degrees, whose edge
    # (1 + l^2 / c^2, l d / c^2) leaves the tangent by at most 28 degrees.
    theta_end, d_end, elapsed, mode = pushed(theta, d, theta + beta, path)

    assert (elapsed, mode) == (path / 0.005, STICK)
    assert d == pytest.approx(d_end + FINGER * (theta_end - theta), rel=0, abs=1e-15)


@checked
@given(thetas, contacts, headings, paths, st.floats(0.001, 0.05))
def test_a_disk_without_friction_never_turns(theta, s, phi, path, c):
    radius = 0.0285

    theta_end, s_end, _, _ = pushed(theta, s, phi, path, (1.0 / radius, radius, c), mu_c=0.0)

    assert theta_end - s_end / radius == pytest.approx(theta - s / radius, rel=0, abs=1e-13)


@checked
@given(thetas, contacts, headings, paths, outlines)
def test_huge_friction_is_nearly_infinite_and_tiny_friction_nearly_none(
    theta, s, phi, path, outline
):
    for mu_c, limit in ((1e9, math.inf), (1e-9, 0.0)):
        theta_end, s_end, _, mode = pushed(theta, s, phi, path, outline, limit)
        if mode != FREE:
            almost = pushed(theta, s, phi, path, outline, mu_c)

            assert almost[:2] == pytest.approx((theta_end, s_end), rel=0, abs=1e-6)


def test_the_step_response_of_fig_8():
    theta, phi, d = np.degrees(law_18_on_the_papers_block(2000))

    k = [20, 50, 100, 173]
    np.testing.assert_allclose(theta[k], [18.19, 10.73, 0.83, -6.10], rtol=0, atol=0.006)
    np.testing.assert_allclose(phi[k], [110.5, 109.8, 98.5, 88.5], rtol=0, atol=0.05)
    assert abs(theta[191] + 10.0) > 3.0
    assert (np.abs(theta[192:] + 10.0) <= 3.0).all()
    assert theta[-1] == pytest.approx(-10.0, abs=0.05)
    assert phi[-1] == pytest.approx(82.6, abs=0.05)
    assert math.radians(d[-1]) == pytest.approx(0.00107, abs=5e-6)
