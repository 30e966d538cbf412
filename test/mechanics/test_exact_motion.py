# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from support.strategies import frictions
from tactile_push.mechanics import (
    FREE,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    Outline,
    Support,
    exact_pushed_twist,
    friction_cone,
    sticking_twist,
    voted_rotation,
)
from tactile_push.mechanics.exact_motion import exact_slipping, exact_sticking, support_force

checked = settings(derandomize=True, deadline=None, max_examples=60)
seldom = settings(derandomize=True, deadline=None, max_examples=15)
coordinates = st.floats(-1.0, 1.0)
angles = st.floats(-math.pi, math.pi)
directions = st.floats(0.05, math.pi - 0.05)
distances = st.floats(0.1, 2.0)
mu_cs = frictions()
loads = st.floats(0.1, 2.0)
feet = st.lists(st.tuples(coordinates, coordinates, loads), min_size=2, max_size=9)
grid = st.integers(-3, 3)
lattice = st.lists(st.tuples(grid, grid, st.integers(1, 3)), min_size=2, max_size=8)
speeds = st.floats(-1.0, 1.0).filter(lambda v: v == 0.0 or abs(v) > 1e-80)
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
SIDES = {SLIP_LEFT: -1.0, SLIP_RIGHT: 1.0}
MIRRORED = {FREE: FREE, STICK: STICK, SLIP_LEFT: SLIP_RIGHT, SLIP_RIGHT: SLIP_LEFT}


def supported(points, weights):
    """Give rows x, y, load about the centre of friction."""
    points, weights = np.array(points, dtype=float), np.array(weights, dtype=float)
    return np.vstack([(points - weights @ points / weights.sum()).T, weights])


def resting_on(standing):
    support = supported([foot[:2] for foot in standing], [foot[2] for foot in standing])
    assume(lever(support) > 1e-3)
    return support


def spread(support):
    """Give the width of the support across its widest direction, 0 on a line."""
    return np.linalg.svd(support[:2] * np.sqrt(support[2]), compute_uv=False)[-1]


def spread_under(standing):
    """On a line across the force the object may turn or not: the motion is not unique."""
    support = resting_on(standing)
    assume(spread(support) > 0.02)
    return support


def lever(support):
    """Give c, by (1) and (2)."""
    x, y, load = support
    return float(load @ np.hypot(x, y) / load.sum())


def turned(support, angle):
    x, y, load = support
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([cos * x - sin * y, sin * x + cos * y, load])


def pushed(v_px, v_py, x_c, y_c, mu_c, support, angle=0.0):
    """Push in the edge frame; the support is given in it, the object's frame turned by -angle."""
    return exact_pushed_twist(
        v_px,
        v_py,
        x_c,
        y_c,
        *friction_cone(mu_c),
        lever(support),
        math.cos(angle),
        math.sin(angle),
        turned(support, angle),
    )


def velocities(twist, support):
    v_x, v_y, omega = twist[:3]
    x, y, _ = support
    return np.array([v_x - omega * y, v_y + omega * x])


def dissipation(twist, support):
    return float(support[2] @ np.hypot(*velocities(twist, support)))


def about_contact(u_x, u_y, omega, x_c, y_c):
    """Give the twist at the centre of friction of a motion that is known at the contact."""
    return u_x + omega * y_c, u_y - omega * x_c, omega


def friction_sum(twist, support, x_c, y_c):
    """Give force and moment about the contact, and speeds, by Coulomb's law for every point."""
    velocity = velocities(twist, support)
    speed = np.hypot(*velocity)
    f_x, f_y = support[2] * velocity / np.where(speed > 0.0, speed, 1.0)
    m = (support[0] - x_c) * f_y - (support[1] - y_c) * f_x
    return f_x.sum(), f_y.sum(), m.sum(), speed


def golden_section(function, lower, upper, steps=90):
    """Find the minimum of a convex function."""
    a, b = upper - GOLDEN * (upper - lower), lower + GOLDEN * (upper - lower)
    f_a, f_b = function(a), function(b)
    for _ in range(steps):
        if f_a <= f_b:
            upper, b, f_b = b, a, f_a
            a = upper - GOLDEN * (upper - lower)
            f_a = function(a)
        else:
            lower, a, f_a = a, b, f_b
            b = lower + GOLDEN * (upper - lower)
            f_b = function(b)
    return (lower + upper) / 2.0


def assert_balanced(support, push, x_c, y_c, mu_c, slack=1e-7):
    """Assert Coulomb's law at every support point and at the contact, for a finger that pushes.

    A point that stands still, up to rounding, may have any friction up to its load.
    """
    *twist, _, mode = push
    velocity = velocities(twist, support)
    speed = np.hypot(*velocity)
    total = support[2].sum()
    reach = np.hypot(support[0] - x_c, support[1] - y_c).max()
    still = speed <= 1e-8 * speed.max()
    moving = np.vstack([support[:2, ~still], support[2, ~still]])
    f_x, f_y, m, _ = friction_sum(twist, moving, x_c, y_c)
    # What the direction of a slow point's friction may err when the motion errs by 1e-10.
    slack = slack * total + 1e-10 * float((support[2, ~still] / speed[~still]).sum() * speed.max())
    load = support[2, still].sum()
    r = np.zeros(2)
    if still.any():
        r = support[:2, still] @ support[2, still] / load - [x_c, y_c]
    cos_alpha, sin_alpha = friction_cone(mu_c)
    if mode == STICK:
        # The pivot's friction across r takes the moment up, along r it helps into the cone.
        distance = np.linalg.norm(r)
        across = -m / distance if still.any() and distance > 1e-9 * reach else 0.0
        assert abs(m + across * distance) <= slack * reach
        assert abs(across) <= load + slack
        free = math.sqrt(max(load**2 - across**2, 0.0))
        along = r / distance if distance > 1e-9 * reach else np.zeros(2)
        worst = []
        for share in np.linspace(-1.0, 1.0, 401):
            g = across * np.array([-along[1], along[0]]) + share * free * along
            f_t, f_n = f_x + g[0], f_y + g[1]
            worst.append(min(sin_alpha * f_n + cos_alpha * f_t, sin_alpha * f_n - cos_alpha * f_t))
        assert max(worst) >= -slack - (0.01 * free if still.any() else 0.0)
        return
    # The force lies on the cone's edge: e times something, and the pivot gives the rest.
    e = np.array([SIDES[mode] * sin_alpha, cos_alpha])
    if not still.any():
        assert e @ [f_x, f_y] > 0.0
        assert abs(e[0] * f_y - e[1] * f_x) <= slack
        assert abs(m) <= slack * reach
        return
    # g = size e - f with r x g = -m.
    lever_arm = r[0] * e[1] - r[1] * e[0]
    needed = r[0] * f_y - r[1] * f_x - m
    if abs(lever_arm) > 1e-6 * reach:
        sizes = [needed / lever_arm]
    else:
        assert abs(needed) <= slack * reach
        sizes = np.linspace(0.0, total, 2001)
    g = [np.hypot(*(size * e - [f_x, f_y])) for size in sizes if size > 0.0]
    assert min(g) <= load + slack + (total / 1000.0 if len(sizes) > 1 else 0.0)


def assert_touching(push, v_px, v_py, x_c, y_c):
    """Assert (12): the object gives way along the normal, slip is along the tangent."""
    v_x, v_y, omega, v_slip, mode = push
    assert np.isfinite([v_x, v_y, omega, v_slip]).all()
    speed = math.hypot(v_px, v_py)
    if mode == FREE:
        assert v_py <= 0.0
        assert (v_x, v_y, omega, v_slip) == (0.0, 0.0, 0.0, v_px)
        return
    v_ox, v_oy = v_x - omega * y_c, v_y + omega * x_c
    size = speed + math.hypot(v_x, v_y) + abs(omega) * math.hypot(x_c, y_c)
    assert v_oy == pytest.approx(v_py, rel=0, abs=1e-14 * size)
    assert v_ox + v_slip == pytest.approx(v_px, rel=0, abs=1e-14 * size)
    if mode == STICK:
        assert v_slip == 0.0
    else:
        assert v_slip * SIDES[mode] >= -1e-9 * size


def assert_same_motion(push, expected, c, slack=1e-7):
    scale = np.array([1.0, 1.0, c, 1.0])
    first, second = scale * push[:4], scale * expected[:4]
    size = np.abs(second).max()
    np.testing.assert_allclose(first, second, rtol=0, atol=slack * size)


def random_supports(count, seed, most=50):
    random = np.random.default_rng(seed)
    for _ in range(count):
        n = int(min(4 + random.exponential(8.0), most))
        yield random, supported(random.normal(size=(n, 2)), random.uniform(0.1, 2.0, n))


# The wrench of a motion.


@checked
@given(feet, coordinates, coordinates, coordinates, coordinates, coordinates)
def test_the_wrench_of_a_motion_is_the_sum_of_all_frictions(standing, u_x, u_y, omega, x_c, y_c):
    support = resting_on(standing)
    assume(math.hypot(u_x, u_y) > 0.01)
    twist = about_contact(u_x, u_y, omega, x_c, y_c)
    f_x, f_y, m, speed = friction_sum(twist, support, x_c, y_c)
    assume(speed.min() > 1e-9)

    wrench = support_force(u_x, u_y, omega, x_c, y_c, support)[:3]

    slack = 1e-14 * (support[2] / speed).sum() + 1e-13
    assert wrench == pytest.approx((f_x, f_y, m), rel=0, abs=slack)
    power = wrench[0] * u_x + wrench[1] * u_y + wrench[2] * omega
    assert power == pytest.approx(dissipation(twist, support), rel=1e-12)


@checked
@given(feet, coordinates, coordinates, coordinates, coordinates, coordinates)
def test_the_derivatives_of_the_wrench_agree_with_differences(standing, u_x, u_y, omega, x_c, y_c):
    support = resting_on(standing)
    assume(math.hypot(u_x, u_y) > 0.1)
    motion = np.array([u_x, u_y, omega])
    assume(np.hypot(*velocities(about_contact(*motion, x_c, y_c), support)).min() > 0.05)
    expected = np.empty((3, 3))
    for i, offset in enumerate(1e-5 * np.eye(3)):
        ahead = friction_sum(about_contact(*(motion + offset), x_c, y_c), support, x_c, y_c)[:3]
        behind = friction_sum(about_contact(*(motion - offset), x_c, y_c), support, x_c, y_c)[:3]
        expected[i] = np.subtract(ahead, behind) / 2e-5

    xx, xy, yy, xm, ym, mm = support_force(u_x, u_y, omega, x_c, y_c, support)[3:]

    derivatives = np.array([[xx, xy, xm], [xy, yy, ym], [xm, ym, mm]])
    assert derivatives == pytest.approx(expected, rel=0, abs=1e-4)
    # The wrench does not change with the speed, and resists every change of its direction.
    assert derivatives @ motion == pytest.approx(0.0, abs=1e-9)
    assert np.linalg.eigvalsh(derivatives).min() >= -1e-9


def test_a_point_that_stands_still_has_no_friction():
    support = np.array([[1.0, -1.0], [0.0, 0.0], [3.0, 2.0]])

    # About (1, 0), and without any motion at the reference point, (1, 0) itself.
    for reference in ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, -2.0)):
        values = support_force(0.0, reference[2], 1.0, reference[0], reference[1], support)

        assert np.isfinite(values).all()
        assert values[:2] == pytest.approx((0.0, -2.0), abs=1e-12)


# Sticking.


@checked
@given(feet, angles, coordinates, distances)
def test_sticking_dissipates_least_of_all_motions_that_go_with_the_finger(standing, beta, x_c, l):
    support = resting_on(standing)
    u = math.cos(beta), math.sin(beta)
    c = lever(support)

    def power(omega):
        return dissipation(about_contact(*u, omega, x_c, -l), support)

    guess = sticking_twist(*u, x_c, -l, c)[2]
    omega = exact_sticking(*u, guess, x_c, -l, c, support)[0]

    nearest = np.hypot(support[0] - x_c, support[1] + l).max()
    best = golden_section(power, -100.0 / nearest, 100.0 / nearest)
    assert power(omega) <= power(best) * (1.0 + 1e-12)
    assert power(best) <= power(omega) * (1.0 + 1e-9)


@checked
@given(feet, angles, coordinates, distances, st.floats(-100.0, 100.0))
def test_sticking_needs_no_moment_about_the_contact_whatever_the_guess(
    standing, beta, x_c, l, guess
):
    support = resting_on(standing)
    u = math.cos(beta), math.sin(beta)
    c = lever(support)

    omega, f_x, f_y = exact_sticking(*u, guess, x_c, -l, c, support)[:3]

    # The moment never decreases with omega, and may jump where a point stands still.
    step = 1e-9 * (abs(omega) + 1.0)
    reach = np.hypot(support[0] - x_c, support[1] + l).max() * support[2].sum()
    lower, upper = (
        friction_sum(about_contact(*u, omega + s * step, x_c, -l), support, x_c, -l)[2]
        for s in (-1.0, 1.0)
    )
    assert lower <= 1e-9 * reach
    assert upper >= -1e-9 * reach
    # It supplies what is dissipated.
    dissipated = dissipation(about_contact(*u, omega, x_c, -l), support)
    assert f_x * u[0] + f_y * u[1] == pytest.approx(dissipated, rel=1e-7)


@checked
@given(feet, angles, coordinates, distances)
def test_the_force_of_sticking_is_how_the_dissipation_grows_with_the_velocity(
    standing, beta, x_c, l
):
    # The least dissipation of a given contact velocity has this gradient (envelope theorem).
    support = resting_on(standing)
    u = np.array([math.cos(beta), math.sin(beta)])
    c = lever(support)

    def least(u):
        omega = exact_sticking(*u, 0.0, x_c, -l, c, support)[0]
        return dissipation(about_contact(*u, omega, x_c, -l), support)

    f = np.array(exact_sticking(*u, 0.0, x_c, -l, c, support)[1:3])

    for step in (1e-3, 0.1, 1.0):
        for angle in np.arange(8) * math.tau / 8.0:
            other = u + step * np.array([math.cos(angle), math.sin(angle)])
            if np.hypot(*other) > 1e-9:
                assert least(other) >= f @ other - 1e-8 * support[2].sum()


@checked
@given(feet, angles, coordinates, distances)
def test_the_derivatives_of_sticking_agree_with_differences(standing, beta, x_c, l):
    support = resting_on(standing)
    u = np.array([math.cos(beta), math.sin(beta)])
    c = lever(support)
    omega, _, _, s_xx, s_xy, s_yy, o_x, o_y = exact_sticking(*u, 0.0, x_c, -l, c, support)
    speed = np.hypot(*velocities(about_contact(*u, omega, x_c, -l), support))
    assume(speed.min() > 0.02 * speed.max())

    step = 1e-4
    for i, offset in enumerate(step * np.eye(2)):
        ahead, behind = (
            np.array(exact_sticking(*(u + s * offset), omega, x_c, -l, c, support)[:3])
            for s in (1.0, -1.0)
        )
        rate = (ahead - behind) / (2.0 * step)
        expected = [(o_x, s_xx, s_xy), (o_y, s_xy, s_yy)][i]
        size = 1.0 + np.abs(rate).max()
        assert rate == pytest.approx(expected, rel=0, abs=1e-2 * size)


def test_a_support_under_the_contact_alone_follows_the_guess():
    # Nothing resists a rotation about the contact.
    support = np.array([[0.5, 0.5], [-1.0, -1.0], [1.0, 2.0]])

    omega, f_x, f_y = exact_sticking(0.6, 0.8, 0.25, 0.5, -1.0, 1.0, support)[:3]

    assert omega == 0.25
    assert (f_x, f_y) == pytest.approx((1.8, 2.4))


def elliptic_e(m):
    """Give the complete elliptic integral of the second kind by the arithmetic-geometric mean."""
    a, b, total, weight = 1.0, math.sqrt(1.0 - m), m / 2.0, 1.0
    while abs(a - b) > 1e-15:
        a, b, difference = (a + b) / 2.0, math.sqrt(a * b), (a - b) / 2.0
        total += weight * difference**2
        weight *= 2.0
    return math.pi / (2.0 * a) * (1.0 - total)


@pytest.mark.parametrize('d', [0.3, 1.0, -2.0])
@pytest.mark.parametrize('beta', [0.5, math.pi / 2.0, 2.0])
def test_a_ring_turns_as_its_elliptic_integral_says(d, beta):
    # A ring of radius 1 with its centre at the speed v dissipates the mean of |v + omega e|, which
    # is 2 / pi (v + omega) E(4 v omega / (v + omega)^2).
    l, u = 1.2, (math.cos(beta), math.sin(beta))

    def power(omega):
        v, spin = math.hypot(u[0] - omega * l, u[1] - omega * d), abs(omega)
        return 2.0 / math.pi * (v + spin) * elliptic_e(min(4.0 * v * spin / (v + spin) ** 2, 1.0))

    assert power(0.0) == pytest.approx(1.0, rel=1e-12)
    best = golden_section(power, -5.0, 5.0)
    ring = Support.rim(Outline.circle(1.0), count=4000)
    support = np.vstack([ring.points.T, ring.loads])

    omega = pushed(*u, d, -l, math.inf, support)[2]

    assert dissipation(about_contact(*u, best, d, -l), support) == pytest.approx(
        power(best), rel=1e-6
    )
    # The mean of many points is rough where the pivot is on the ring.
    assert omega == pytest.approx(best, rel=1e-3, abs=1e-6)


# Slipping.


@seldom
@given(feet, st.floats(-1.5, 1.5), coordinates, distances)
def test_slipping_dissipates_least_of_all_motions_that_the_force_drives_as_much(
    standing, lean, x_c, l
):
    support = spread_under(standing)
    e = math.sin(lean), math.cos(lean)
    c = lever(support)
    reach = np.hypot(support[0] - x_c, support[1] + l).max()

    def power(slope, omega):
        u = e[0] - slope * e[1], e[1] + slope * e[0]  # e . u = 1
        return dissipation(about_contact(*u, omega, x_c, -l), support)

    def least(slope):
        bound = 3.0 * math.hypot(1.0, slope) * support[2].sum() / (support[2].min() * reach)
        return power(
            slope,
            golden_section(lambda omega: power(slope, omega), -bound, bound, 60),
        )

    slope, omega = exact_slipping(*e, 0.0, 0.0, x_c, -l, c, support)

    best = least(golden_section(least, slope - 3.0, slope + 3.0, 45))
    assert power(slope, omega) <= best * (1.0 + 1e-10)
    assert best <= power(slope, omega) * (1.0 + 1e-7)


@checked
@given(feet, angles, coordinates, distances, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_no_motion_that_the_force_drives_as_much_dissipates_less(
    standing, lean, x_c, l, slope_0, omega_0
):
    support = resting_on(standing)
    e = np.array([math.sin(lean), math.cos(lean)])
    c = lever(support)

    slope, omega = exact_slipping(*e, slope_0, omega_0, x_c, -l, c, support)

    def power(slope, omega):
        u = e + slope * np.array([-e[1], e[0]])
        return dissipation(about_contact(*u, omega, x_c, -l), support)

    least = power(slope, omega)
    size = math.hypot(1.0, slope)
    for step in (1e-4, 1e-2, 1.0):
        for angle in np.arange(16) * math.tau / 16.0:
            other = power(
                slope + step * size * math.cos(angle), omega + step * size * math.sin(angle) / c
            )
            assert other >= least - 1e-9 * support[2].sum() * size


# Pushes.


@pytest.mark.parametrize(
    ('v_p', 'x_c', 'mu_c', 'expected', 'slip', 'mode'),
    [
        # A rod that rests on its ends, x = -1 and 1, pushed across: about the far end,
        # the moment of the near one being met by up to its own load.
        ((0.0, 1.0), 0.5, 1.0, (0.0, 2.0 / 3.0, 2.0 / 3.0), 0.0, STICK),
        ((0.0, 1.0), -0.5, 1.0, (0.0, 2.0 / 3.0, -2.0 / 3.0), 0.0, STICK),
        ((0.0, 1.0), 0.5, math.inf, (0.0, 2.0 / 3.0, 2.0 / 3.0), 0.0, STICK),
        ((0.0, 1.0), 3.0, 1.0, (0.0, 0.25, 0.25), 0.0, STICK),
        ((0.0, 1.0), 1.0, 1.0, (0.0, 0.5, 0.5), 0.0, STICK),
        # Without friction the same, whatever the finger does along the rod.
        ((0.0, 1.0), 0.5, 0.0, (0.0, 2.0 / 3.0, 2.0 / 3.0), 0.0, STICK),
        ((3.0, 1.0), 0.5, 0.0, (0.0, 2.0 / 3.0, 2.0 / 3.0), 3.0, SLIP_RIGHT),
        ((-3.0, 1.0), 0.5, 0.0, (0.0, 2.0 / 3.0, 2.0 / 3.0), -3.0, SLIP_LEFT),
        # Along itself it moves as a particle.
        ((1.0, 0.0), 0.5, math.inf, (1.0, 0.0, 0.0), 0.0, STICK),
        ((-2.0, 0.0), -7.0, math.inf, (-2.0, 0.0, 0.0), 0.0, STICK),
        # At rest, and pulled without and with friction.
        ((0.0, 0.0), 0.5, 1.0, (0.0, 0.0, 0.0), 0.0, FREE),
        ((0.0, -1.0), 0.5, 1.0, (0.0, 0.0, 0.0), 0.0, FREE),
        ((1.0, -1.0), 0.5, 1.0, (0.0, 0.0, 0.0), 1.0, FREE),
        ((1.0, 0.0), 0.5, 1.0, (0.0, 0.0, 0.0), 1.0, FREE),
    ],
)
def test_a_rod_on_its_ends_moves_as_computed_by_hand(v_p, x_c, mu_c, expected, slip, mode):
    rod = np.array([[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]])

    *twist, v_slip, seen = pushed(*v_p, x_c, 0.0, mu_c, rod)

    # The force is along the normal, on the edge of the cone without friction.
    if mu_c > 0.0:
        assert seen == mode
    assert twist == pytest.approx(expected, rel=0, abs=1e-9)
    assert v_slip == pytest.approx(slip, rel=0, abs=1e-9)


@checked
@given(feet, angles, coordinates, distances, mu_cs, angles)
def test_pushes_obey_coulomb_at_the_support_and_the_contact(standing, beta, x_c, l, mu_c, angle):
    support = resting_on(standing)
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support, angle)

    assert_touching(push, *v_p, x_c, -l)
    if push[4] != FREE:
        assert_balanced(support, push, x_c, -l, mu_c)


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=300)
@given(
    lattice,
    st.sampled_from([(0, 1), (1, 1), (-1, 1), (1, 2), (-3, 1), (1, 0), (-1, 0), (1, -1), (0, -1)]),
    grid,
    st.integers(1, 3),
    st.sampled_from([0.0, 0.25, 0.5, 1.0, 2.0, 1e-9, 1e9, math.inf]),
    st.sampled_from([0.0, math.pi / 2.0, math.pi, 0.3]),
)
def test_pushes_of_regular_supports_obey_coulomb_too(standing, v_p, x_c, l, mu_c, angle):
    # Points often lie beside the contact, beneath it, and on lines through it.
    support = resting_on(standing)

    push = pushed(*map(float, v_p), float(x_c), -float(l), mu_c, support, angle)

    assert_touching(push, *v_p, x_c, -l)
    if push[4] != FREE and mu_c not in (1e-9, 1e9):
        assert_balanced(support, push, x_c, -l, mu_c)


@pytest.mark.parametrize('friction', [0.0, None, math.inf])
def test_10000_pushes_turn_as_the_voting_theorem_says(friction):
    senses = set()
    for random, support in random_supports(10_000, 12):
        beta, d, l = random.uniform(0.0, math.pi), random.normal(), abs(random.normal()) + 0.05
        mu_c = random.exponential() if friction is None else friction
        sense = voted_rotation(d, l, beta, mu_c)

        push = pushed(math.cos(beta), math.sin(beta), d, -l, mu_c, support)

        assert push[2] * sense > 0.0, (beta, d, l, mu_c, support)
        senses.add(sense)
    assert senses == {-1, 1}


@pytest.mark.parametrize('friction', [0.0, None, math.inf])
def test_2000_pushes_dissipate_what_the_finger_supplies(friction):
    met = set()
    for random, support in random_supports(2000, 13):
        beta, d, l = random.uniform(0.0, math.pi), random.normal(), abs(random.normal()) + 0.05
        mu_c = random.exponential() if friction is None else friction
        v_p = math.cos(beta), math.sin(beta)

        push = pushed(*v_p, d, -l, mu_c, support)

        assert_touching(push, *v_p, d, -l)
        met.add(push[4])
        f_t, f_n, m, speed = friction_sum(push, support, d, -l)
        if speed.min() > 1e-5 * speed.max():  # or else not all mu_cs are known
            slack = 1e-7 * support[2].sum()
            v_ox, v_oy = push[0] + push[2] * l, push[1] + push[2] * d
            assert abs(m) <= slack * (1.0 + math.hypot(d, l))
            assert f_t * v_ox + f_n * v_oy == pytest.approx(dissipation(push, support), rel=1e-6)
            if push[4] == STICK:
                assert f_n >= -slack
                assert math.isinf(mu_c) or abs(f_t) <= mu_c * f_n + slack
            else:
                cos_alpha, sin_alpha = friction_cone(mu_c)
                e = SIDES[push[4]] * sin_alpha, cos_alpha
                assert abs(f_t * e[1] - f_n * e[0]) <= slack
                assert f_t * e[0] + f_n * e[1] > 0.0
    assert met == {SLIP_LEFT, SLIP_RIGHT} | ({STICK} if friction != 0.0 else set())


@checked
@given(feet, st.floats(-0.999, 0.999), distances, st.floats(1e-3, 5.0), st.booleans())
def test_a_push_through_the_centre_of_friction_translates_within_the_projected_cone(
    standing, share, l, mu_c, infinite
):
    support = spread_under(standing)
    d = share * mu_c * l
    reach = math.hypot(d, l)

    push = pushed(-d / reach, l / reach, d, -l, math.inf if infinite else mu_c, support)

    assert push[4] == STICK
    assert push[:2] == pytest.approx((-d / reach, l / reach), rel=0, abs=1e-7)
    assert push[2] * reach == pytest.approx(0.0, abs=1e-7)


@checked
@given(feet, directions, coordinates, distances, mu_cs)
def test_mirror_images_mirror(standing, beta, x_c, l, mu_c):
    support = spread_under(standing)
    v_px, v_py = math.cos(beta), math.sin(beta)

    v_x, v_y, omega, v_slip, mode = pushed(v_px, v_py, x_c, -l, mu_c, support)
    mirrored = pushed(-v_px, v_py, -x_c, -l, mu_c, support * [[-1.0], [1.0], [1.0]])

    assert_same_motion(mirrored, (-v_x, v_y, -omega, -v_slip), lever(support) + l)
    if abs(v_slip) > 1e-6:
        assert mirrored[4] == MIRRORED[mode]


@checked
@given(feet, directions, coordinates, distances, mu_cs, angles)
def test_the_objects_frame_does_not_matter(standing, beta, x_c, l, mu_c, angle):
    support = spread_under(standing)
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support)

    other = pushed(*v_p, x_c, -l, mu_c, support, angle)
    assert_same_motion(other, push, lever(support) + l)


@checked
@given(feet, directions, coordinates, distances, mu_cs, st.floats(1e-4, 1e4))
def test_a_larger_rig_moves_as_the_small_one(standing, beta, x_c, l, mu_c, scale):
    support = spread_under(standing)
    v_p = math.cos(beta), math.sin(beta)

    v_x, v_y, omega, v_slip, _ = pushed(*v_p, x_c, -l, mu_c, support)

    larger = pushed(*v_p, scale * x_c, -scale * l, mu_c, support * [[scale], [scale], [1.0]])
    assert_same_motion(larger, (v_x, v_y, omega / scale, v_slip), scale * (lever(support) + l))


@checked
@given(feet, directions, coordinates, distances, mu_cs, st.floats(1e-6, 1e6))
def test_a_faster_finger_moves_the_object_faster_and_not_otherwise(
    standing, beta, x_c, l, mu_c, speed
):
    support = spread_under(standing)
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support)

    faster = pushed(speed * v_p[0], speed * v_p[1], x_c, -l, mu_c, support)
    assert_same_motion(faster, speed * np.array(push[:4]), lever(support) + l)


@checked
@given(feet, directions, coordinates, distances, mu_cs, st.floats(1e-3, 1e3))
def test_mu_s_does_not_change_the_motion(standing, beta, x_c, l, mu_c, mu_s):
    support = spread_under(standing)
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support)

    rougher = pushed(*v_p, x_c, -l, mu_c, support * [[1.0], [1.0], [mu_s]])
    assert_same_motion(rougher, push, lever(support) + l)


@checked
@given(feet, directions, coordinates, distances, mu_cs)
def test_split_points_and_points_without_load_change_nothing(standing, beta, x_c, l, mu_c):
    support = spread_under(standing)
    v_p = math.cos(beta), math.sin(beta)
    split = np.hstack(
        [
            support * [[1.0], [1.0], [0.25]],
            [[x_c, 0.0, 5.0], [-l, 0.0, 3.0], [0.0, 0.0, 0.0]],
            support[:, ::-1] * [[1.0], [1.0], [0.75]],
        ]
    )

    push = pushed(*v_p, x_c, -l, mu_c, support)

    assert_same_motion(pushed(*v_p, x_c, -l, mu_c, split), push, lever(support) + l)


@pytest.mark.slow
@checked
@given(feet, directions, coordinates, distances)
def test_huge_friction_is_nearly_infinite_and_tiny_friction_nearly_none(standing, beta, x_c, l):
    support = resting_on(standing)
    assume(spread(support) > 0.2)
    v_p = math.cos(beta), math.sin(beta)
    for mu_c, limit in ((1e12, math.inf), (1e-12, 0.0)):
        almost = pushed(*v_p, x_c, -l, mu_c, support)

        exact = pushed(*v_p, x_c, -l, limit, support)

        assert_same_motion(almost, exact, lever(support) + l, 1e-5)


# Pivots where a support point stands still.


def pushes_about_a_point(count, seed, numbers):
    """Make pushes that turn the object about one of its support points, by construction.

    The others' mu_cs are known, the still one's is chosen below its load: so are the force, its
    line, on which the contact lies, and the contact's velocity. The edge frame is turned so that
    the force is on the wanted side of the friction cone's middle.
    """
    random = np.random.default_rng(seed)
    made = 0
    while made < count:
        n = int(random.choice(numbers))
        support = supported(random.normal(size=(n, 2)), random.uniform(0.3, 2.0, n))
        pivot, load = support[:2, 0], support[2, 0]
        sense = random.choice([-1.0, 1.0])
        twist = sense * np.array([pivot[1], -pivot[0], 1.0])
        rest = support[:, 1:]
        f_x, f_y, m, _ = friction_sum(twist, rest, 0.0, 0.0)
        angle = random.uniform(-math.pi, math.pi)
        g = random.uniform(0.0, 0.9) * load * np.array([math.cos(angle), math.sin(angle)])
        force = np.array([f_x, f_y]) + g
        m += pivot[0] * g[1] - pivot[1] * g[0]
        size = np.linalg.norm(force)
        if size < 0.1 * support[2].sum() or abs(m) < 0.1 * size:
            continue
        e = force / size
        contact = m / size * np.array([e[1], -e[0]]) - random.uniform(0.1, 2.0) * e
        velocity = twist[:2] + twist[2] * np.array([-contact[1], contact[0]])
        made += 1
        yield random, support, twist, contact, velocity, e


def in_edge_frame(lean, support, twist, contact, velocity, e):
    """Turn everything until the force leans so far from the normal."""
    angle = math.pi / 2.0 - lean - math.atan2(e[1], e[0])
    cos, sin = math.cos(angle), math.sin(angle)
    turn = np.array([[cos, -sin], [sin, cos]])
    return (
        turned(support, angle),
        (*(turn @ twist[:2]), twist[2]),
        turn @ contact,
        turn @ velocity,
    )


@pytest.mark.parametrize('numbers', [(2,), (3,), (4,), (5, 8, 20, 50)])
def test_a_sticking_contact_turns_the_object_about_a_support_point(numbers):
    for random, *made in pushes_about_a_point(150, 21, numbers):
        mu_c = random.choice([0.5, 2.0, math.inf])
        lean = random.uniform(-0.4, 0.4)
        support, twist, contact, velocity = in_edge_frame(lean, *made)

        push = pushed(*velocity, *contact, mu_c, support)

        # The pivot's friction along the line from the contact is open: so may be the mode.
        if push[4] == FREE:
            assert velocity[1] <= 0.0
            continue
        assert_same_motion(push, (*twist, 0.0), np.linalg.norm(contact), 1e-8)


@pytest.mark.parametrize('numbers', [(2,), (3,), (4,), (5, 8, 20, 50)])
def test_a_slipping_contact_turns_the_object_about_a_support_point(numbers):
    met = set()
    for random, *made in pushes_about_a_point(150, 22, numbers):
        mu_c = random.choice([0.0, 0.5, 2.0, math.inf])
        side = random.choice([-1.0, 1.0])
        lean = side * (math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c))
        support, twist, contact, velocity = in_edge_frame(lean, *made)
        if velocity[1] < 0.05:
            continue
        v_slip = side * random.choice([1e-3, 0.1, 1.0, 5.0])

        push = pushed(velocity[0] + v_slip, velocity[1], *contact, mu_c, support)

        assert push[4] == (SLIP_LEFT if side < 0.0 else SLIP_RIGHT)
        scale = np.linalg.norm(contact)
        assert_same_motion(push, (*twist, v_slip), scale, 1e-8 * (1.0 + 1.0 / velocity[1]))
        met.add(push[4])
    assert met == {SLIP_LEFT, SLIP_RIGHT}


@pytest.mark.parametrize('mu_c', [0.3, 1.0, math.inf])
def test_the_motion_is_continuous_where_the_object_begins_to_turn_about_a_point(mu_c):
    # Corners of a square, pushed straight on from ever further out, and from one side to the other.
    support = supported([(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)], np.ones(4))
    scale = np.array([1.0, 1.0, 1.0, 1.0])

    def motion(d, beta):
        return scale * pushed(math.cos(beta), math.sin(beta), d, -1.0, mu_c, support)[:4]

    for beta in (math.pi / 2.0, 1.0, 2.5):
        sweep = np.array([motion(d, beta) for d in np.linspace(-1.0, 1.0, 801)])
        assert np.abs(np.diff(sweep, axis=0)).max() < 0.05
    for d in (-1.0, -0.5, 0.0, 0.25, 1.0):
        sweep = np.array([motion(d, beta) for beta in np.linspace(0.3, math.pi - 0.3, 801)])
        assert np.abs(np.diff(sweep, axis=0)).max() < 0.05


@pytest.mark.parametrize('offset', [0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-4])
def test_a_point_at_the_height_of_the_contact_does_not_change_the_sides(offset):
    # Pushed straight on, points beside the contact can stand still, exactly or almost. The force
    # then follows from the moment alone: which side it leans to decides how the contact slips.
    random = np.random.default_rng(5)
    for _ in range(300):
        n = int(random.integers(3, 9))
        points, weights = random.normal(size=(n, 2)), random.uniform(0.3, 2.0, n)
        beta = random.uniform(0.3, math.pi - 0.3)
        v_p = math.cos(beta), math.sin(beta)
        x_c, l = random.normal(), abs(random.normal()) + 0.1
        # The first point is beside the contact, across the push; the second restores the centre.
        away = random.uniform(-3.0, 3.0)
        points[0] = (x_c - away * v_p[1] + offset, -l + away * v_p[0])
        points[1] = -(weights @ points - weights[1] * points[1]) / weights[1]
        support = np.vstack([points.T, weights])
        mu_c = random.choice([0.0, 0.25, 1.0, math.inf])

        push = pushed(*v_p, x_c, -l, mu_c, support)

        assert_touching(push, *v_p, x_c, -l)
        assert_balanced(support, push, x_c, -l, mu_c)


@pytest.mark.parametrize('distance', [1e-4, 1e-6, 1e-8, 1e-10, 1e-13])
def test_a_light_point_beside_the_first_guess_of_the_pivot_does_not_end_the_search(distance):
    # Newton's steps are short there, however far the root.
    random = np.random.default_rng(6)
    for _ in range(200):
        n = int(random.integers(4, 12))
        points, weights = random.normal(size=(n, 2)), random.uniform(0.3, 2.0, n)
        weights[0] = random.choice([1e-3, 0.1])
        beta = random.uniform(0.3, math.pi - 0.3)
        v_p = math.cos(beta), math.sin(beta)
        x_c, l = random.normal(), abs(random.normal()) + 0.1
        for _ in range(60):  # the ellipsoid's pivot depends on where the point is
            c = lever(np.vstack([points.T, weights]))
            v_x, v_y, omega = sticking_twist(*v_p, x_c, -l, c)
            angle = random.uniform(0.0, 1e-9)
            points[0] = (-v_y / omega + distance * math.cos(angle), v_x / omega + distance)
            points[1] = -(weights @ points - weights[1] * points[1]) / weights[1]
            if np.abs(points).max() > 100.0:
                break
        else:
            support = np.vstack([points.T, weights])

            push = pushed(*v_p, x_c, -l, math.inf, support)

            assert_touching(push, *v_p, x_c, -l)
            assert_balanced(support, push, x_c, -l, math.inf)


@pytest.mark.parametrize('mu_c', [0.0, 0.25, 1.0, math.inf])
@pytest.mark.parametrize('share', [0.0, 1.0, 3.0])
def test_a_block_on_its_corners_and_centre_is_pushed_at_every_regular_place(mu_c, share):
    points = [(2.0, 1.0), (2.0, -1.0), (-2.0, -1.0), (-2.0, 1.0), (0.0, 0.0)]
    support = supported(points, [1.0, 1.0, 1.0, 1.0, share])
    for x_c in (-2.0, -1.0, -0.5, 0.0, 0.25, 2.0):
        for v_p in ((0.0, 1.0), (1.0, 1.0), (-1.0, 1.0), (1.0, 2.0), (-2.0, 1.0)):
            for angle in (0.0, math.pi / 2.0):
                push = pushed(*v_p, x_c, -1.0, mu_c, support, angle)

                assert_touching(push, *v_p, x_c, -1.0)
                assert_balanced(support, push, x_c, -1.0, mu_c)


@checked
@given(
    st.lists(st.tuples(coordinates, loads), min_size=2, max_size=8),
    angles,
    directions,
    coordinates,
    distances,
    mu_cs,
)
def test_a_support_on_a_line_is_as_good_as_any(standing, angle, beta, x_c, l, mu_c):
    support = resting_on([(x, 0.0, load) for x, load in standing])
    support = turned(support, angle)
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support)

    assert_touching(push, *v_p, x_c, -l)
    assert_balanced(support, push, x_c, -l, mu_c)


@checked
@given(feet, directions, coordinates, distances, mu_cs, loads)
def test_a_support_point_may_lie_at_the_contact(standing, beta, x_c, l, mu_c, load):
    # The contact is where one of the points is, after the centre has become the origin.
    support = resting_on(standing + [(x_c, -l, load)])
    v_p = math.cos(beta), math.sin(beta)
    x_c, y_c = float(support[0, -1]), float(support[1, -1])

    push = pushed(*v_p, x_c, y_c, mu_c, support)

    assert_touching(push, *v_p, x_c, y_c)
    assert_balanced(support, push, x_c, y_c, mu_c)


@checked
@given(feet, directions, coordinates, distances, mu_cs, st.floats(1e-7, 1e-2))
def test_one_point_may_bear_almost_everything(standing, beta, x_c, l, mu_c, light):
    support = resting_on([(x, y, light * load) for x, y, load in standing] + [(0.1, 0.2, 1.0)])
    v_p = math.cos(beta), math.sin(beta)

    push = pushed(*v_p, x_c, -l, mu_c, support)

    assert_touching(push, *v_p, x_c, -l)
    # The heavy one moves less the heavier it is, and its friction is the finer to tell.
    assert_balanced(support, push, x_c, -l, mu_c)


@pytest.mark.parametrize('l', [0.5, 1.0, 3.0, 40451.73585196668])
@pytest.mark.parametrize('push', [(0.0768, 0.997), (-0.318, 0.948), (-0.493, 0.87), (0.2, 0.98)])
def test_on_a_line_across_the_force_the_contact_never_slips_to_the_other_side(push, l):
    # Footnote 1: the object may turn or not. Straight before the centre and without friction only
    # rounding tells the force that it takes to stick from the normal.
    random = np.random.default_rng(9)
    for _ in range(200):
        n = int(random.integers(2, 12))
        x, weights = random.uniform(-1.0, 1.0, n), random.uniform(0.3, 2.0, n)
        x = np.append(x, -x)
        line = l * np.vstack([x, np.zeros_like(x)])
        support = np.vstack([line, np.append(weights, weights)])

        assert_touching(pushed(*push, 0.0, -l, 0.0, support), *push, 0.0, -l)


@pytest.mark.parametrize('light', [1e-8, 1e-10])
def test_one_point_may_bear_all_but_a_trace(light):
    # A c far below the contact's distance: the motion at the contact is as exact as any.
    random = np.random.default_rng(10)
    for _ in range(100):
        n = int(random.integers(3, 9))
        support = supported(
            random.normal(size=(n, 2)), np.append(light * random.uniform(0.3, 2.0, n - 1), 1.0)
        )
        beta, x_c, l = random.uniform(0.3, 2.8), random.normal(), abs(random.normal()) + 0.1
        v_p = math.cos(beta), math.sin(beta)

        push = pushed(*v_p, x_c, -l, math.inf, support)

        assert_touching(push, *v_p, x_c, -l)
        if push[4] == STICK:
            # The heavy point's friction takes most of the moment: where it passes 0 is the root.
            u = push[0] - push[2] * -l, push[1] + push[2] * x_c
            step = 1e-6 * abs(push[2])
            lower, upper = (
                friction_sum(about_contact(*u, push[2] + s * step, x_c, -l), support, x_c, -l)[2]
                for s in (-1.0, 1.0)
            )
            assert lower <= 0.0 <= upper


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=200)
@given(
    st.lists(
        st.tuples(
            st.floats(-10.0, 10.0),
            st.floats(-10.0, 10.0),
            st.sampled_from([0.0, 1e-9, 1.0]) | st.floats(0.0, 10.0),
        ),
        min_size=2,
        max_size=12,
    ),
    st.floats(-10.0, 10.0),
    st.floats(1e-6, 10.0),
    speeds,
    speeds,
    st.sampled_from([0.0, 1e-300, 1e-9, 1.0, 1e9, 1e300, math.inf]) | st.floats(0.0, 10.0),
    angles,
)
def test_every_valid_push_gives_a_finite_motion(standing, x_c, l, v_px, v_py, mu_c, angle):
    assume(sum(foot[2] for foot in standing) > 1e-6)
    support = supported([foot[:2] for foot in standing], [foot[2] for foot in standing])
    assume(lever(support) > 1e-6)

    push = pushed(v_px, v_py, x_c, -l, mu_c, support, angle)

    assert push[4] in (FREE, STICK, SLIP_LEFT, SLIP_RIGHT)
    assert_touching(push, v_px, v_py, x_c, -l)


def run_apart(code):
    """Run in a process of its own: compiled code that never returns cannot be interrupted."""
    command = [sys.executable, '-W', 'ignore', '-c', code]
    return subprocess.run(command, timeout=60, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_a_number_that_is_none_moves_nothing():
    ended = run_apart("""
import math
import numpy as np
from tactile_push.mechanics import FREE, exact_pushed_twist
support = np.array([[1.0, -1.0, 0.0], [0.5, 0.5, -1.0], [1.0, 1.0, 1.0]])
for place in range(4):
    for bad in (math.nan, math.inf):
        numbers = [0.3, 1.0, 0.5, -1.0]
        numbers[place] = bad
        print(place, bad, flush=True)
        push = exact_pushed_twist(*numbers, 0.8, 0.6, 1.0, 1.0, 0.0, support)
        assert push[4] == FREE or not np.isfinite(push[:4]).all(), push
""")

    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.slow
def test_a_velocity_too_small_to_square_ends_in_a_motion():
    ended = run_apart("""
import numpy as np
from tactile_push.mechanics import exact_pushed_twist
support = np.array([[1.0, -1.0, 0.0], [0.5, 0.5, -1.0], [1.0, 1.0, 1.0]])
for speed in (1e-150, 1e-163, 1e-200, 1e-268, 2e-311):
    for cone in ((0.8, 0.6), (0.0, 1.0), (1.0, 0.0)):
        print(speed, cone, flush=True)
        push = exact_pushed_twist(0.3 * speed, speed, 0.5, -1.0, *cone, 1.0, 1.0, 0.0, support)
        assert np.isfinite(push[:4]).all(), push
""")

    assert ended.returncode == 0, ended.stdout + ended.stderr
