# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

"""A push above the support, which tilts the pressure: `ExactLimitSurface.tilt` and what uses it."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, reject, settings
from hypothesis import strategies as st

from support.strategies import frictions
from tactile_push.mechanics import (
    FREE,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    ExactLimitSurface,
    Outline,
    Pose,
    Slider,
    Support,
    exact_pushed_twist,
    friction_cone,
)
from tactile_push.mechanics.exact_motion import pushing_force

checked = settings(derandomize=True, deadline=None, max_examples=40)
coordinates = st.floats(-1.0, 1.0)
directions = st.floats(0.3, math.pi - 0.3)
distances = st.floats(0.1, 2.0)
loads = st.floats(0.3, 2.0)
feet = st.lists(st.tuples(coordinates, coordinates, loads), min_size=3, max_size=9)
tripods = st.lists(st.tuples(coordinates, coordinates, loads), min_size=3, max_size=3)
shares = st.floats(0.0, 0.6)  # of the largest tilt; close to it a push may have several motions
mu_cs = frictions()
BLOCK = Outline.rectangle(0.05, 0.0475)
SIDES = {SLIP_LEFT: -1.0, SLIP_RIGHT: 1.0}
SLOW = 1e-3  # of the fastest point: there the direction of friction is uncertain


def resting_on(standing):
    """Return a support that is no line."""
    support = Support.at_points([foot[:2] for foot in standing], [foot[2] for foot in standing])
    offsets = (support.points - support.centre) * np.sqrt(support.loads)[:, np.newaxis]
    assume(np.linalg.svd(offsets, compute_uv=False)[-1] > 0.1)
    return support


def largest_tilt(support):
    """Return by what shift of the centre of friction the first point loses its load.

    Loads w (1 + b x) with the sum and the mean of statics: b from the second moments.
    """
    offsets = support.points - support.centre
    second = np.einsum('i,ij,ik->jk', support.loads, offsets, offsets) / support.loads.sum()
    return min(1.0 / np.linalg.norm(np.linalg.inv(second) @ offset) for offset in offsets)


def tilted_loads(support, shift):
    """Return loads w (1 + a + b x) whose sum is that at rest and whose mean lies shifted."""
    offsets = support.points - support.centre
    basis = np.vstack([np.ones(len(offsets)), offsets.T])
    wanted = support.loads.sum() * np.array([1.0, *shift])
    return support.loads * (np.linalg.solve(basis * support.loads @ basis.T, wanted) @ basis)


def push(points, c, beta, d, l, mu_c):
    cone = friction_cone(mu_c)
    return exact_pushed_twist(math.cos(beta), math.sin(beta), d, -l, *cone, c, 1.0, 0.0, points)


def directions_of(motion, points):
    """Return the directions in which the points move; discard motions that leave one undecided."""
    v_x, v_y, omega = motion[:3]
    velocity = np.array([v_x - omega * points[1], v_y + omega * points[0]])
    speed = np.hypot(*velocity)
    if speed.min() <= SLOW * speed.max():
        reject()
    return velocity / speed


@checked
@given(tripods, shares, directions, coordinates, distances, mu_cs, st.floats(0.05, 1.0))
def test_three_points_are_in_balance_in_space(standing, share, beta, d, l, mu_c, mu_s):
    # The normal forces follow from statics alone: three balances of weight, pushed force at its
    # height and moments about the axes of the ground; what remains are those in the plane.
    support = resting_on(standing)
    tilt = share * largest_tilt(support)
    height, weight = tilt / mu_s, support.f_max / mu_s
    points = ExactLimitSurface(support, tilt).points

    *motion, _, mode = push(points, support.c, beta, d, l, mu_c)

    assume(mode != FREE)
    x, y = points[0], points[1]
    e_x, e_y = directions_of(motion, points)
    statics = [np.ones(3), x - height * mu_s * e_x, y - height * mu_s * e_y]
    normal = np.linalg.solve(statics, [weight, 0.0, 0.0])
    assert (normal > 0.0).all()
    f_x, f_y = mu_s * normal @ e_x, mu_s * normal @ e_y
    moment = mu_s * normal @ ((x - d) * e_y - (y + l) * e_x)
    assert moment == pytest.approx(0.0, abs=1e-7 * support.f_max)
    cos_alpha, sin_alpha = friction_cone(mu_c)
    if mode == STICK:
        assert sin_alpha * f_y - abs(cos_alpha * f_x) >= -1e-7 * support.f_max
    else:
        edge = SIDES[mode] * sin_alpha, cos_alpha
        assert edge[0] * f_y - edge[1] * f_x == pytest.approx(0.0, abs=1e-7 * support.f_max)
        assert edge[0] * f_x + edge[1] * f_y > 0.0


@checked
@given(feet, shares, directions, coordinates, distances, mu_cs)
def test_loads_and_force_agree_as_repeated_pushes_on_fixed_loads_do(
    standing, share, beta, d, l, mu_c
):
    support = resting_on(standing)
    tilt = share * largest_tilt(support)

    motion = push(ExactLimitSurface(support, tilt).points, support.c, beta, d, l, mu_c)

    assume(motion[4] != FREE)
    offsets = (support.points - support.centre).T
    force = np.zeros(2)
    for _ in range(100):
        fixed = np.vstack([offsets, tilted_loads(support, tilt * force / support.f_max)])
        expected = push(fixed, support.c, beta, d, l, mu_c)
        before, force = force, directions_of(expected, fixed) @ fixed[2]
        if np.abs(force - before).max() < 1e-12 * support.f_max:
            break
    else:
        assume(False)  # the repetition swings between sticking and slipping
    assert motion[4] == expected[4]
    assert motion[:4] == pytest.approx(expected[:4], rel=0, abs=1e-6)


@checked
@given(feet, shares, coordinates, coordinates, coordinates, coordinates, coordinates)
def test_the_centre_of_friction_moves_along_the_force(standing, share, u_x, u_y, omega, x_c, y_c):
    support = resting_on(standing)
    tilt = share * largest_tilt(support)
    points = ExactLimitSurface(support, tilt).points
    assume(math.hypot(u_x, u_y) > 0.1)
    v_x, v_y = u_x + omega * y_c, u_y - omega * x_c
    e_x, e_y = directions_of((v_x, v_y, omega), points)

    f_x, f_y, m = pushing_force(u_x, u_y, omega, x_c, y_c, points)[:3]

    shift = tilt / support.f_max * np.array([f_x, f_y])
    load = tilted_loads(support, shift)
    assert (load > 0.0).all()
    assert (f_x, f_y) == pytest.approx((load @ e_x, load @ e_y), rel=0, abs=1e-10)
    arms = (points[0] - x_c) * e_y - (points[1] - y_c) * e_x
    assert m == pytest.approx(load @ arms, rel=0, abs=1e-10)
    wrench = ExactLimitSurface(support, tilt).wrench((v_x, v_y, omega))
    expected = f_x, f_y, load @ (points[0] * e_y - points[1] * e_x)
    assert wrench == pytest.approx(expected, rel=0, abs=1e-10)


@checked
@given(feet, shares, coordinates, coordinates, coordinates, coordinates, coordinates)
def test_the_derivatives_agree_with_differences(standing, share, u_x, u_y, omega, x_c, y_c):
    support = resting_on(standing)
    points = ExactLimitSurface(support, share * largest_tilt(support)).points
    motion = np.array([u_x, u_y, omega])
    assume(math.hypot(u_x, u_y) > 0.1)
    v_x, v_y = u_x + omega * y_c, u_y - omega * x_c
    speed = np.hypot(v_x - omega * points[1], v_y + omega * points[0])
    assume(speed.min() > 0.05)
    assume(share > 0.0)
    expected = np.empty((3, 3))
    for i, offset in enumerate(1e-5 * np.eye(3)):
        ahead, behind = (
            np.array(pushing_force(*(motion + side * offset), x_c, y_c, points)[:3])
            for side in (1.0, -1.0)
        )
        expected[:, i] = (ahead - behind) / 2e-5

    xx, xy, yy, xm, ym, mm, yx, mx, my = pushing_force(*motion, x_c, y_c, points)[3:]

    derivatives = [[xx, xy, xm], [yx, yy, ym], [mx, my, mm]]
    size = 1.0 + np.abs(expected).max()
    assert derivatives == pytest.approx(expected, rel=0, abs=1e-4 * size)


@checked
@given(feet, shares, st.floats(-math.pi, math.pi), distances)
def test_a_push_through_the_centre_of_friction_at_rest_translates(standing, share, angle, far):
    # The centre moves along the force, and so stays on its line.
    support = resting_on(standing)
    points = ExactLimitSurface(support, share * largest_tilt(support)).points
    t = math.cos(angle), math.sin(angle)

    v_x, v_y, omega, v_slip, mode = exact_pushed_twist(
        0.0, 1.0, 0.0, -far, *friction_cone(0.3), support.c, *t, points
    )

    assert mode == STICK
    assert (v_x, v_y, omega, v_slip) == pytest.approx((0.0, 1.0, 0.0, 0.0), rel=0, abs=1e-9)


@checked
@given(feet, shares, coordinates, coordinates, coordinates)
def test_the_twist_of_a_motions_wrench_is_this_motion(standing, share, v_x, v_y, omega):
    support = resting_on(standing)
    surface = ExactLimitSurface(support, share * largest_tilt(support))
    motion = np.array([v_x, v_y, omega])
    x, y = surface.points[:2]
    assume(np.hypot(v_x - omega * y, v_y + omega * x).min() > 0.05)
    wrench = surface.wrench(motion)

    twist = surface.twist(wrench)

    assert twist / np.linalg.norm(twist) == pytest.approx(
        motion / np.linalg.norm(motion), rel=0, abs=1e-6
    )
    assert twist @ wrench == pytest.approx(1.0, rel=1e-9)
    assert surface.level(1.5 * wrench) == pytest.approx(2.25, rel=1e-6)


def test_a_slip_is_longer_by_the_shift_of_the_centre_for_every_radian():
    # To first order a block turns about a centre that lies ahead by the tilt: a frictionless
    # contact then slips by so much more for the turn. The block is small beside the lever of its
    # turn, on four points whose c hardly changes when they tilt.
    support = Support.corners(BLOCK)
    d, l, tilt = 1e-4, 0.02375, 1e-3
    straight, tilted = (
        push(ExactLimitSurface(support, shift).points, support.c, math.pi / 2.0, d, l, 0.0)
        for shift in (0.0, tilt)
    )

    assert straight[4] == tilted[4] == SLIP_RIGHT or straight[4] == tilted[4] == SLIP_LEFT
    # v_ot = omega l of the contact, against which the finger slips.
    assert straight[3] / straight[2] == pytest.approx(-l, rel=1e-3)
    assert tilted[3] / tilted[2] == pytest.approx(-(l + tilt), rel=1e-3)


def test_no_tilt_is_a_push_at_the_support():
    surface = ExactLimitSurface(Support.corners(BLOCK), 0.0)

    assert surface.points.shape == (3, 4)


def test_an_unloaded_point_bears_nothing_however_far_it_is():
    support = Support.at_points([(0, 0), (1, 0), (0, 1), (9, 9)], [1.0, 1.0, 1.0, 0.0])

    points = ExactLimitSurface(support, 0.1).points

    assert (points[2:, 3] == 0.0).all()


def distance_to_sides(corners):
    """Return how far the centroid of a triangle is from its nearest side."""
    centre = corners.mean(axis=0)
    away = []
    for i in range(3):
        a, b = corners[i] - centre, corners[(i + 1) % 3] - centre
        away.append(abs(a[0] * b[1] - a[1] * b[0]) / np.hypot(*(b - a)))
    return min(away)


@checked
@given(st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=3))
def test_three_points_bear_a_tilt_up_to_where_the_object_tips_over(corners):
    support = resting_on([(*corner, 1.0) for corner in corners])
    edge = distance_to_sides(np.array(corners))

    ExactLimitSurface(support, 0.999 * edge)

    with pytest.raises(ValueError, match='^tilt: expected at most .* all points stay on the'):
        ExactLimitSurface(support, 1.001 * edge)


@pytest.mark.parametrize('tilt', [-1e-3, math.nan, math.inf])
def test_a_tilt_that_is_no_length_is_refused(tilt):
    with pytest.raises(ValueError, match=f'^tilt: expected a finite length .* got {tilt}$'):
        ExactLimitSurface(Support.corners(BLOCK), tilt)


def test_a_line_of_points_bears_no_push_above_it():
    support = Support.at_points([(-0.01, 0.01), (0.0, 0.0), (0.02, -0.02)])

    with pytest.raises(ValueError, match='^tilt: expected at most 0 m'):
        ExactLimitSurface(support, 1e-6)


def test_an_ellipsoid_has_no_loads_to_tilt():
    with pytest.raises(ValueError, match='^tilt: expected 0 m for the ellipsoid, got 0.001 m$'):
        Slider.on(BLOCK, Support.corners(BLOCK), tilt=1e-3)


def test_a_long_push_ends_where_small_ones_under_repeated_loads_do():
    # A frictionless block pushed by 1 cm: Euler's method on fixed-point motions, refined twice.
    support, tilt, d, r = Support.corners(BLOCK), 4e-3, 0.01, 0.0135
    slider = Slider.on(BLOCK, support, exact=True, tilt=tilt)
    pose = slider.pushed(Pose(0.0, 0.0, 0.0), (d, -0.02375 - r), (d, -0.01375 - r), 0.0, r)

    def euler(steps):
        angle, along = 0.0, d
        offsets = (support.points - support.centre).T
        force = np.zeros(2)
        for _ in range(steps):
            for _ in range(20):
                fixed = np.vstack([offsets, tilted_loads(support, tilt * force / support.f_max)])
                beta = math.pi / 2.0 - angle
                motion = push(fixed, support.c, beta, along, 0.02375, 0.0)
                force = directions_of(motion, fixed) @ fixed[2]
            angle += 0.01 / steps * motion[2]
            along += 0.01 / steps * (motion[3] - motion[2] * r)
        return np.array([angle, along])

    coarse, fine = euler(100), euler(200)
    angle, along = 2.0 * fine - coarse
    assert pose.angle == pytest.approx(angle, abs=2e-5)
    # The finger's centre is r beyond the contact; the contact is at `along` on the edge.
    cos, sin = math.cos(angle), math.sin(angle)
    reach = complex(cos, sin) * complex(along, -0.02375 - r)
    assert (pose.x, pose.y) == pytest.approx((d - reach.real, -0.01375 - r - reach.imag), abs=2e-6)
