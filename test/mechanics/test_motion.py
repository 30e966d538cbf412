# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.strategies import frictions
from tactile_push.mechanics import (
    FREE,
    MODES,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    contact_mode,
    contact_velocity,
    friction_cone,
    motion_cone,
    pushed_twist,
    slipping_twist,
    sticking_twist,
    twist_under_force,
    voted_rotation,
)

checked = settings(derandomize=True, deadline=None, max_examples=60)
coordinates = st.floats(-0.05, 0.05)
distances = st.floats(0.005, 0.05)
velocities = st.floats(-1.0, 1.0)
directions = st.floats(0.01, math.pi - 0.01)
mu_cs = frictions()


def pushed(beta, d, l, mu_c, c, speed=1.0):
    return pushed_twist(
        speed * math.cos(beta), speed * math.sin(beta), d, -l, *friction_cone(mu_c), c
    )


def random_pushes(count, friction, seed):
    random = np.random.default_rng(seed)
    for _ in range(count):
        mu_c = {'none': 0.0, 'finite': random.exponential(), 'infinite': math.inf}[friction]
        yield (
            random.uniform(0.0, math.pi),
            random.uniform(-0.05, 0.05),
            random.uniform(0.005, 0.05),
            mu_c,
            random.uniform(0.005, 0.05),
        )


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def turned(vector, angle):
    x, y = vector
    return (
        x * math.cos(angle) - y * math.sin(angle),
        x * math.sin(angle) + y * math.cos(angle),
    )


@checked
@given(velocities, velocities, velocities, coordinates, coordinates)
def test_the_contact_moves_as_a_point_of_the_rigid_body(v_x, v_y, omega, x_c, y_c):
    step = 1e-5

    def position(time):
        x, y = turned((x_c, y_c), omega * time)
        return np.array([v_x * time + x, v_y * time + y])

    expected = (position(step) - position(-step)) / (2.0 * step)

    np.testing.assert_allclose(
        contact_velocity(v_x, v_y, omega, x_c, y_c), expected, rtol=0, atol=1e-10
    )


@checked
@given(velocities, velocities, coordinates, coordinates, distances)
def test_a_force_moves_the_object_by_4_5_and_8(f_x, f_y, x_c, y_c, c):
    v_x, v_y, omega = twist_under_force(f_x, f_y, x_c, y_c, c)

    m = x_c * f_y - y_c * f_x  # (8)
    assert v_x * m == pytest.approx(omega * c**2 * f_x, rel=1e-12, abs=1e-16)  # (4)
    assert v_y * m == pytest.approx(omega * c**2 * f_y, rel=1e-12, abs=1e-16)  # (5)
    assert f_x * v_x + f_y * v_y + m * omega >= 0.0  # the normal points outward


def test_a_force_moves_the_object_as_computed_by_hand():
    # m = 3 * 2 - (-4) * 1 = 10, omega = 10 / 5**2
    assert twist_under_force(1.0, 2.0, 3.0, -4.0, 5.0) == pytest.approx((1.0, 2.0, 0.4), rel=1e-15)


@checked
@given(distances, coordinates, mu_cs, distances)
def test_the_motion_cone_holds_the_velocities_under_the_friction_cones_edges(l, d, mu_c, c):
    alpha = math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c)
    expected = []
    for angle in (math.pi / 2.0 + alpha, math.pi / 2.0 - alpha):
        f = np.array([math.cos(angle), math.sin(angle)])
        omega = (d * f[1] + l * f[0]) / c**2
        expected.extend([f[0] + omega * l, f[1] + omega * d])

    edges = motion_cone(d, -l, *friction_cone(mu_c), c)

    np.testing.assert_allclose(edges, expected, rtol=1e-12, atol=1e-12)


@checked
@given(distances, coordinates, distances)
def test_without_friction_the_motion_cone_is_a_ray(l, d, c):
    v_lx, v_ly, v_rx, v_ry = motion_cone(d, -l, *friction_cone(0.0), c)

    assert (v_lx, v_ly) == (v_rx, v_ry)
    assert v_ly > 0.0


@checked
@given(distances, coordinates, distances)
def test_with_infinite_friction_the_motion_cone_is_exactly_180_degrees_wide(l, d, c):
    v_lx, v_ly, v_rx, v_ry = motion_cone(d, -l, *friction_cone(math.inf), c)

    assert (v_lx, v_ly) == (-v_rx, -v_ry)
    assert v_rx > 0.0


@checked
@given(velocities, velocities, coordinates, coordinates, distances)
def test_sticking_solves_6_to_8_with_the_force_parallel_to_the_velocity(v_px, v_py, x_c, y_c, c):
    # (6), (7), and (8) with f = v, m = c^2 omega, linear in (v_x, v_y, omega).
    system = [[1.0, 0.0, -y_c], [0.0, 1.0, x_c], [-y_c, x_c, -(c**2)]]
    expected = np.linalg.solve(system, [v_px, v_py, 0.0])

    twist = sticking_twist(v_px, v_py, x_c, y_c, c)

    np.testing.assert_allclose(twist[:2], expected[:2], rtol=0, atol=1e-13)
    np.testing.assert_allclose(twist[2], expected[2], rtol=0, atol=1e-11)


@checked
@given(velocities, velocities, coordinates, coordinates, distances, velocities)
def test_sticking_dissipates_least_of_all_motions_that_go_with_the_finger(
    v_px, v_py, x_c, y_c, c, more
):
    def power(omega):  # over f_max, by the support function of the ellipsoid
        return math.hypot(v_px + omega * y_c, v_py - omega * x_c, c * omega)

    omega = sticking_twist(v_px, v_py, x_c, y_c, c)[2]

    assert power(omega) <= power(omega + more) * (1.0 + 1e-14)
    assert power(omega) <= power(omega + 1e-3 * more) * (1.0 + 1e-14)


def test_sticking_as_computed_by_hand():
    # c = x_c = 1, y_c = -1, straight ahead: the denominator is 3.
    assert sticking_twist(0.0, 1.0, 1.0, -1.0, 1.0) == pytest.approx(
        (-1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0), rel=1e-15
    )


@checked
@given(velocities, velocities, coordinates, coordinates, distances, st.floats(-10.0, 10.0))
def test_sticking_holds_in_any_frame(v_px, v_py, x_c, y_c, c, angle):
    v_x, v_y, omega = sticking_twist(v_px, v_py, x_c, y_c, c)

    there = sticking_twist(*turned((v_px, v_py), angle), *turned((x_c, y_c), angle), c)

    assert there[:2] == pytest.approx(turned((v_x, v_y), angle), rel=0, abs=1e-13)
    assert there[2] == pytest.approx(omega, rel=0, abs=1e-11)


def test_slipping_as_computed_by_hand():
    # No friction, c = x_c = 1, y_c = -1: the force (0, 1) gives v_b = (1, 2), so kappa = 3/2.
    assert slipping_twist(3.0, 0.0, 1.0, 1.0, -1.0, 1.0) == pytest.approx((0.0, 1.5, 1.5))


@checked
@given(st.floats(0.01, 1.0), distances, distances, distances, st.floats(0.1, 10.0))
def test_slipping_does_not_depend_on_the_forces_unit(v_py, x_c, l, c, unit):
    force = (0.3, 0.9)
    twist = slipping_twist(v_py, *force, x_c, -l, c)

    scaled = slipping_twist(v_py, unit * force[0], unit * force[1], x_c, -l, c)
    assert scaled == pytest.approx(twist, rel=1e-12)


@pytest.mark.parametrize(
    ('v_p', 'x_c', 'mu_c', 'expected', 'slip', 'mode'),
    [
        # c = 1, y_c = -1. Contact velocity under f: f + m (1, x_c) with m = x_c f_y + f_x.
        ((0.0, 1.0), 1.0, math.inf, (-1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0), 0.0, STICK),
        ((0.0, 1.0), 1.0, 0.0, (0.0, 0.5, 0.5), -0.5, SLIP_LEFT),
        ((0.0, 1.0), -1.0, 0.0, (0.0, 0.5, -0.5), 0.5, SLIP_RIGHT),
        # The right edge under infinite friction, (1, 0), moves the contact along (2, 1).
        ((3.0, 1.0), 1.0, math.inf, (1.0, 0.0, 1.0), 1.0, SLIP_RIGHT),
        ((-3.0, 1.0), -1.0, math.inf, (-1.0, 0.0, -1.0), -1.0, SLIP_LEFT),
        # mu_c = 1/2, straight in front: the left edge (-1/2, 1) moves the contact along (-1, 1).
        ((-2.0, 1.0), 0.0, 0.5, (-0.5, 1.0, -0.5), -1.0, SLIP_LEFT),
        ((2.0, 1.0), 0.0, 0.5, (0.5, 1.0, 0.5), 1.0, SLIP_RIGHT),
        ((0.5, 1.0), 0.0, 0.5, (0.25, 1.0, 0.25), 0.0, STICK),
        # Inside the motion cone along the edge and away from it: "pulling". The left edge under
        # infinite friction moves the contact along (-2, -1); the force is along (v_x, v_y).
        ((-1.0, 0.0), 1.0, math.inf, (-2.0 / 3.0, 1.0 / 3.0, -1.0 / 3.0), 0.0, STICK),
        ((-3.0, -1.0), 1.0, math.inf, (-5.0 / 3.0, 1.0 / 3.0, -4.0 / 3.0), 0.0, STICK),
        # Away from the object, along it outside the cone, and at rest.
        ((1.0, -1.0), 1.0, 0.5, (0.0, 0.0, 0.0), 1.0, FREE),
        ((1.0, 0.0), 1.0, math.inf, (0.0, 0.0, 0.0), 1.0, FREE),
        ((0.0, 0.0), 1.0, 0.0, (0.0, 0.0, 0.0), 0.0, FREE),
        ((0.0, 0.0), 1.0, math.inf, (0.0, 0.0, 0.0), 0.0, FREE),
    ],
)
def test_pushes_as_computed_by_hand(v_p, x_c, mu_c, expected, slip, mode):
    *twist, v_slip, seen = pushed_twist(*v_p, x_c, -1.0, *friction_cone(mu_c), 1.0)

    assert seen == mode
    assert twist == pytest.approx(expected, rel=1e-14, abs=1e-15)
    assert v_slip == pytest.approx(slip, rel=1e-14, abs=1e-15)


def test_modes_are_named_in_the_order_of_their_numbers():
    assert [MODES[i] for i in (FREE, STICK, SLIP_LEFT, SLIP_RIGHT)] == [
        'free',
        'stick',
        'slip_left',
        'slip_right',
    ]


@pytest.mark.parametrize(
    ('friction', 'modes'),
    [
        ('none', {SLIP_LEFT, SLIP_RIGHT}),
        ('finite', {STICK, SLIP_LEFT, SLIP_RIGHT}),
        ('infinite', {STICK, SLIP_LEFT, SLIP_RIGHT}),
    ],
)
def test_10000_pushes_obey_coulomb_the_ellipsoid_and_the_contact(friction, modes):
    met = set()
    for beta, d, l, mu_c, c in random_pushes(10_000, friction, 41):
        push = (beta, d, l, mu_c, c)
        v_x, v_y, omega, v_slip, mode = pushed(*push)
        met.add(mode)
        v_px, v_py = math.cos(beta), math.sin(beta)
        v_ox, v_oy = v_x + omega * l, v_y + omega * d
        # The force that moves the object so, on the scale of its velocity: (4) and (5).
        f_t, f_n, m = v_x, v_y, c**2 * omega
        size = max(1.0, math.hypot(f_t, f_n), math.hypot(v_ox, v_oy))
        assert abs(m - (d * f_n + l * f_t)) <= 1e-14 * size, push  # (8)
        assert abs(v_ox + v_slip - v_px) <= 1e-13 * size, push  # (12)
        assert abs(v_oy - v_py) <= 1e-13 * size, push  # (12): slip is along the tangent
        assert f_t * v_ox + f_n * v_oy > 0.0, push
        if mode == STICK:
            assert v_slip == 0.0
            assert f_n >= -1e-13 * size, push
            assert math.isinf(mu_c) or abs(f_t) <= mu_c * f_n + 1e-13 * size, push
        else:
            # The finger slides over the object and drags it along: greatest friction, its way.
            side = {SLIP_LEFT: -1.0, SLIP_RIGHT: 1.0}[mode]
            assert v_slip * side > 0.0, push
            if math.isinf(mu_c):
                assert f_n == 0.0, push
                assert f_t * side > 0.0, push
            else:
                assert f_n > 0.0, push
                assert abs(f_t - side * mu_c * f_n) <= 1e-13 * size, push
    assert met == modes


@pytest.mark.parametrize('friction', ['none', 'finite', 'infinite'])
def test_10000_pushes_turn_as_the_voting_theorem_says(friction):
    senses = set()
    for beta, d, l, mu_c, c in random_pushes(10_000, friction, 6):
        alpha = math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c)
        centre = math.atan2(l, -d)
        # A ray at a smaller angle than the centre of mass passes to its right: counterclockwise.
        votes = [ray < centre for ray in (math.pi / 2.0 + alpha, math.pi / 2.0 - alpha, beta)]
        sense = 1.0 if sum(votes) >= 2 else -1.0
        senses.add(sense)

        assert voted_rotation(d, l, beta, mu_c) == sense
        assert pushed(beta, d, l, mu_c, c)[2] * sense > 0.0, (beta, d, l, mu_c, c)
    assert senses == {-1.0, 1.0}


@checked
@given(st.floats(-0.999, 0.999), distances, distances, st.floats(1e-3, 5.0), st.booleans())
def test_a_push_through_the_centre_of_mass_translates_within_the_projected_cone(
    share, l, c, mu_c, infinite
):
    d = share * mu_c * l
    beta = math.atan2(l, -d)
    mu_c = math.inf if infinite else mu_c

    v_x, v_y, omega, v_slip, mode = pushed(beta, d, l, mu_c, c)

    assert mode == STICK
    assert v_slip == 0.0
    assert (v_x, v_y) == pytest.approx((math.cos(beta), math.sin(beta)), rel=0, abs=1e-11)
    assert omega == pytest.approx(0.0, abs=1e-10)


@checked
@given(directions, distances, distances, st.floats(0.0, 5.0), st.floats(1.001, 3.0))
def test_beyond_the_projected_cone_no_push_translates(beta, l, c, mu_c, excess):
    d = mu_c * l * excess + 1e-4

    assert pushed(beta, d, l, mu_c, c)[2] > 0.0
    assert pushed(beta, -d, l, mu_c, c)[2] < 0.0


@checked
@given(directions, distances, distances)
def test_without_friction_a_push_at_the_middle_translates_along_the_normal(beta, l, c):
    v_x, v_y, omega, v_slip, _ = pushed(beta, 0.0, l, 0.0, c)

    assert (v_x, v_y, omega) == (0.0, math.sin(beta), 0.0)
    assert v_slip == math.cos(beta)


@checked
@given(st.floats(math.radians(135.1), 3.1), distances)
def test_one_edge_of_the_cone_through_the_centre_of_mass_can_translate(beta, l):
    # d = l and mu_c = 1: the left edge passes through it. A push left of that ray slips along it,
    # the two other rays voting oppositely.
    v_x, v_y, omega, _, mode = pushed(beta, l, l, 1.0, 0.02)

    assert mode == SLIP_LEFT
    assert omega == pytest.approx(0.0, abs=1e-12)
    assert v_x == pytest.approx(-v_y, rel=1e-12)


@checked
@given(st.floats(0.1, math.pi - 0.1), coordinates, distances, distances)
def test_huge_friction_is_nearly_infinite_and_tiny_friction_nearly_none(beta, d, l, c):
    # What 1e-9 rad of the cone do is at most this, by the condition of f -> v_o and the push.
    near = 1e-9 * (1.0 + (d**2 + l**2) / c**2) ** 2 / math.sin(0.1) ** 2
    for mu_c, limit in ((1e9, math.inf), (1e-9, 0.0)):
        almost = np.array(pushed(beta, d, l, mu_c, c)[:4])
        exact = np.array(pushed(beta, d, l, limit, c)[:4])

        assert (almost * [1.0, 1.0, c, 1.0]) == pytest.approx(
            exact * [1.0, 1.0, c, 1.0], rel=0, abs=near
        )


@checked
@given(directions, coordinates, distances, distances, st.floats(0.0, 5.0))
def test_the_motion_is_continuous_where_slipping_begins(beta, d, l, c, mu_c):
    edges = motion_cone(d, -l, *friction_cone(mu_c), c)
    for v_bx, v_by in (edges[:2], edges[2:]):
        if v_by > 1e-3:
            edge = math.atan2(v_by, v_bx)
            before, after = (
                np.array(pushed(edge + step, d, l, mu_c, c)[:4]) for step in (-1e-9, 1e-9)
            )
            assert (before * [1.0, 1.0, c, 1.0]) == pytest.approx(
                after * [1.0, 1.0, c, 1.0], rel=0, abs=1e-6
            )


@checked
@given(directions, coordinates, distances, distances, mu_cs)
def test_mirror_images_mirror(beta, d, l, c, mu_c):
    cone = friction_cone(mu_c)
    v_px, v_py = math.cos(beta), math.sin(beta)

    v_x, v_y, omega, v_slip, mode = pushed_twist(v_px, v_py, d, -l, *cone, c)

    mirrored = {FREE: FREE, STICK: STICK, SLIP_LEFT: SLIP_RIGHT, SLIP_RIGHT: SLIP_LEFT}[mode]
    assert pushed_twist(-v_px, v_py, -d, -l, *cone, c) == (-v_x, v_y, -omega, -v_slip, mirrored)


@checked
@given(directions, coordinates, distances, distances, mu_cs, st.integers(-20, 20))
def test_a_larger_rig_moves_as_the_small_one(beta, d, l, c, mu_c, exponent):
    scale = 2.0**exponent  # which rounds nothing

    v_x, v_y, omega, v_slip, mode = pushed(beta, d, l, mu_c, c)

    larger = pushed(beta, scale * d, scale * l, mu_c, scale * c)
    assert larger == (v_x, v_y, omega / scale, v_slip, mode)


@checked
@given(directions, coordinates, distances, distances, mu_cs, st.integers(-20, 20))
def test_a_faster_finger_moves_the_object_faster_and_not_otherwise(beta, d, l, c, mu_c, exponent):
    speed = 2.0**exponent

    *slow, mode = pushed(beta, d, l, mu_c, c)

    assert pushed(beta, d, l, mu_c, c, speed) == (*[speed * value for value in slow], mode)


@checked
@given(
    st.floats(-10.0, 10.0),
    st.floats(-1.0, 1.0),
    st.floats(1e-6, 1.0),
    st.sampled_from([0.0, 1e-300, 1e-9, 1.0, 1e9, 1e300, math.inf]),
    st.floats(1e-6, 10.0),
)
def test_every_valid_push_gives_a_finite_motion(beta, d, l, mu_c, c):
    *values, mode = pushed(beta, d, l, mu_c, c)

    assert np.isfinite(values).all()
    assert mode in (FREE, STICK, SLIP_LEFT, SLIP_RIGHT)
    assert (mode == FREE) == (math.sin(beta) <= 0.0)


def stick_force(v_p, x_c, y_c, c):
    """Solve (4) to (8) for the force that moves the contact so: v_p = f + (m / c^2) (-y_c, x_c)."""
    arm = np.array([-y_c, x_c]) / c
    return np.linalg.solve(np.eye(2) + np.outer(arm, arm), v_p)


def place_in_motion_cone(v_p, d, l, cone, c):
    """Place the finger's velocity by II.C: 0 inside the motion cone, -1 left of it, 1 right.

    And give the distance from the cone's edges, as the sine of an angle.
    """
    v_l, v_r = np.reshape(motion_cone(d, -l, *cone, c), (2, 2))
    v_l, v_r = v_l / np.linalg.norm(v_l), v_r / np.linalg.norm(v_r)
    ahead = contact_velocity(*twist_under_force(0.0, 1.0, d, -l, c), d, -l)  # inside every cone
    from_left, from_right = cross(v_p, v_l), cross(v_r, v_p)
    margin = min(abs(from_left), abs(from_right))
    # The cone is at most 180 degrees wide.
    if from_left >= 0.0 and from_right >= 0.0:
        return 0, margin
    return (-1 if cross(ahead, v_p) > 0.0 else 1), margin


@pytest.mark.parametrize('friction', ['none', 'finite', 'infinite'])
def test_the_mode_is_that_of_the_motion_cone_whichever_way_the_finger_moves(friction):
    random = np.random.default_rng(8)
    met, pulling = set(), 0
    for _, d, l, mu_c, c in random_pushes(10_000, friction, 17):
        cone = friction_cone(mu_c)
        angle = random.uniform(-math.pi, math.pi)
        v_p = (math.cos(angle), math.sin(angle))
        place, margin = place_in_motion_cone(v_p, d, l, cone, c)
        if margin < 1e-9:
            continue
        if place == 0:
            expected = STICK
            pulling += v_p[1] < 0.0
        elif v_p[1] <= 0.0:
            expected = FREE
        else:
            expected = SLIP_LEFT if place < 0 else SLIP_RIGHT

        assert contact_mode(*v_p, *stick_force(v_p, d, -l, c), *cone) == expected
        assert pushed_twist(*v_p, d, -l, *cone, c)[4] == expected
        met.add(expected)
    assert met == {FREE, SLIP_LEFT, SLIP_RIGHT} | ({STICK} if friction != 'none' else set())
    assert pulling > 20 or friction == 'none'


@checked
@given(directions, coordinates, distances, distances, st.floats(0.01, 5.0) | st.just(math.inf))
def test_the_mode_changes_at_the_motion_cones_edges(beta, d, l, c, mu_c):
    cone = friction_cone(mu_c)
    edges = motion_cone(d, -l, *cone, c)
    for (v_bx, v_by), inwards, outside in (
        (edges[:2], -1e-6, SLIP_LEFT),
        (edges[2:], 1e-6, SLIP_RIGHT),
    ):
        for turn in (inwards, -inwards):
            v_p = turned((v_bx, v_by), turn)
            mode = contact_mode(*v_p, *stick_force(v_p, d, -l, c), *cone)

            if turn == inwards:
                assert mode == STICK
            else:
                assert mode == (outside if v_p[1] > 0.0 else FREE)


@checked
@given(directions, coordinates, distances, distances)
def test_without_friction_the_mode_is_the_side_of_the_ray(beta, d, l, c):
    ray = motion_cone(d, -l, *friction_cone(0.0), c)[:2]
    for turn, expected in ((1e-6, SLIP_LEFT), (-1e-6, SLIP_RIGHT)):
        v_p = turned(ray, turn)
        force = stick_force(v_p, d, -l, c)

        assert contact_mode(*v_p, *force, *friction_cone(0.0)) == expected


@pytest.mark.parametrize(
    ('v_p', 'force', 'mu_c', 'mode'),
    [
        # On the edges of the friction cone the contact sticks.
        ((0.3, 1.0), (0.5, 1.0), 0.5, STICK),
        ((0.3, 1.0), (-0.5, 1.0), 0.5, STICK),
        ((0.3, 1.0), (0.0, 1.0), 0.0, STICK),
        ((0.3, 1.0), (1.0, 0.0), math.inf, STICK),
        ((0.3, 1.0), (-1.0, 0.0), math.inf, STICK),
        # Just beyond it slips, however the finger moves along the edge.
        ((-0.3, 1.0), (0.5001, 1.0), 0.5, SLIP_RIGHT),
        ((0.3, 1.0), (-0.5001, 1.0), 0.5, SLIP_LEFT),
        ((0.3, 1.0), (1e-9, 1.0), 0.0, SLIP_RIGHT),
        ((0.3, 1.0), (1.0, -1e-9), math.inf, SLIP_RIGHT),
        ((0.3, 1.0), (-1.0, -1e-9), math.inf, SLIP_LEFT),
        # A finger cannot hold an object that it leaves; it can with friction.
        ((0.3, 0.0), (0.5001, 1.0), 0.5, FREE),
        ((0.3, -1.0), (0.5, 1.0), 0.5, STICK),
        ((0.3, -1.0), (0.5, -1.0), math.inf, FREE),
        ((0.0, -1.0), (0.0, -1.0), 0.0, FREE),
        ((0.0, 0.0), (0.0, 0.0), 0.0, FREE),
        ((0.0, 0.0), (0.0, 0.0), 0.5, FREE),
        ((0.0, 0.0), (0.0, 0.0), math.inf, FREE),
    ],
)
def test_modes_as_found_by_hand(v_p, force, mu_c, mode):
    assert contact_mode(*v_p, *force, *friction_cone(mu_c)) == mode


def test_the_unit_of_the_force_does_not_change_the_mode():
    for force in ((0.2, 1.0), (0.6, 1.0), (-0.6, 1.0), (0.1, -1.0)):
        modes = {
            contact_mode(0.1, 1.0, unit * force[0], unit * force[1], *friction_cone(0.5))
            for unit in (1e-9, 1.0, 1e9)
        }
        assert len(modes) == 1


@pytest.mark.parametrize('friction', ['none', 'finite', 'infinite'])
def test_the_power_of_the_finger_is_what_the_support_dissipates(friction):
    # Of force and twist that belong together under (3): the wrench is on the ellipsoid.
    for beta, d, l, mu_c, c in random_pushes(1000, friction, 5):
        v_x, v_y, omega, _, _ = pushed(beta, d, l, mu_c, c)
        dissipated = math.hypot(v_x, v_y, c * omega)  # over f_max: greatest power on (3)
        f_x, f_y, m = v_x / dissipated, v_y / dissipated, c**2 * omega / dissipated
        v_o = contact_velocity(v_x, v_y, omega, d, -l)

        assert f_x**2 + f_y**2 + (m / c) ** 2 == pytest.approx(1.0, rel=1e-12)
        assert m == pytest.approx(d * f_y + l * f_x, rel=1e-9, abs=1e-15)
        assert f_x * v_o[0] + f_y * v_o[1] == pytest.approx(dissipated, rel=1e-9)


@checked
@given(
    st.sampled_from([-1.0, 0.0, 1.0, 1e-9, 1e-17]),
    st.sampled_from([-1.0, 0.0, 1.0, 1e-9, 1e-17, 1e-200]),
    st.sampled_from([0.0, 1e-300, 1e-17, -1e-9, 1.0, -1.0]),
    st.sampled_from([1e-9, 0.5, 1.0, 2.0]),
    st.sampled_from([0.0, 1e-300, 1e-9, 1.0, 1e9, math.inf]),
    st.sampled_from([1e-6, 0.5, 1.0]),
)
def test_no_push_makes_the_contact_slip_to_the_other_side(v_px, v_py, d, l, mu_c, c):
    v_x, v_y, omega, v_slip, mode = pushed_twist(v_px, v_py, d, -l, *friction_cone(mu_c), c)

    assert np.isfinite([v_x, v_y, omega, v_slip]).all()
    size = max(abs(v_px), abs(v_py))
    if mode == SLIP_LEFT:
        assert v_slip <= 1e-9 * size
    if mode == SLIP_RIGHT:
        assert v_slip >= -1e-9 * size
    if mode == STICK:
        assert v_slip == 0.0
    if mode == FREE:
        assert v_py <= 0.0
        assert (v_x, v_y, omega, v_slip) == (0.0, 0.0, 0.0, v_px)
    else:
        v_oy = contact_velocity(v_x, v_y, omega, d, -l)[1]
        assert v_oy == pytest.approx(v_py, rel=0, abs=1e-12 * max(size, abs(v_slip)))
