# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.strategies import frictions, loaded_polygons
from tactile_push.mechanics import (
    FREE,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    Body,
    Finger,
    Outline,
    Pose,
    clearance,
    contact,
    friction_cone,
    move_finger,
    push,
    tangent_angle,
)
from tactile_push.mechanics.contact import piece_at, reach
from tactile_push.mechanics.push import approach, push_rates

checked = settings(derandomize=True, deadline=None, max_examples=50)
few = settings(derandomize=True, deadline=None, max_examples=15)
FINGER, SPEED = 0.0135, 0.005
BLOCK = Outline.rectangle(0.05, 0.0475)
BLOCK_C, BLOCK_L = 0.0187, 0.02375
RADIUS, DISK_C = 0.0285, 0.019
DISK = Outline.circle(RADIUS)
A, B = 0.04, 0.025
ELLIPSE = Outline.ellipse(A, B)
CORNERS = BLOCK.points(1.0)
# How exactly a push of up to a few centimetres is known, where each step is good to 1e-7.
ANGLE, PLACE = 2e-6, 1e-7

betas = st.floats(0.1, math.pi - 0.1)  # push direction relative to the tangent
shares = st.floats(0.0, 1.0, exclude_max=True)  # of the way around the object
lengths = st.floats(1e-4, 0.01)
ratios = st.floats(0.004, 0.04)
mu_cs = frictions(3.0)
angles = st.floats(-4.0, 4.0)


def bodies():
    """Return a strategy for polygons with a support below their corners, balanced at the origin."""
    return loaded_polygons(most_corners=6, least_stretch=0.4, least_load=0.2).map(
        lambda body: (body[0], np.ascontiguousarray(np.vstack([0.8 * body[0].T, body[1]])))
    )


polygons = bodies().map(lambda body: Outline.polygon(body[0]))
outlines = st.sampled_from([BLOCK, DISK, ELLIPSE]) | polygons


def ratio(support):
    return float(support[2] @ np.hypot(support[0], support[1]) / support[2].sum())


def at_contact(outline, sigma, angle=0.0, r=FINGER):
    # Where the object lies when the finger at the origin touches it at sigma.
    path = outline.path(r)
    _, _, d, l = contact(sigma, piece_at(sigma, path), path, r)
    x, y = reach(angle + tangent_angle(sigma, path), d, l, r)
    return -x, -y


def heading(outline, sigma, beta, angle=0.0, r=FINGER):
    # A push of unit speed at the angle beta from the contact's tangent.
    phi = angle + tangent_angle(sigma, outline.path(r)) + beta
    return math.cos(phi), math.sin(phi)


def pushed(outline, sigma, beta, length, mu_c=math.inf, c=BLOCK_C, support=None, r=FINGER):
    # A push of an object at angle 0 by its length, at the angle beta from the contact's tangent.
    v_x, v_y = (SPEED * v for v in heading(outline, sigma, beta, r=r))
    return push(
        0.0, sigma, v_x, v_y, length / SPEED, outline.path(r), c, support, *friction_cone(mu_c), r
    )


def moved(outline, state, finger, velocity, duration, mu_c, c, support=None, r=FINGER, spin=0.0):
    body, end = Body(outline.path(r), c, support), Finger(*friction_cone(mu_c), r)
    pose, *rest = move_finger(
        Pose(*state[:3]), *state[3:5], *finger, *velocity, duration, body, end, spin
    )
    return (*pose, *rest)


def nearest_on_polygon(corners):
    corners = [(float(x), float(y)) for x, y in corners]
    edges = [
        (a_x, a_y, b_x - a_x, b_y - a_y)
        for (a_x, a_y), (b_x, b_y) in zip(corners, corners[1:] + corners[:1], strict=True)
    ]

    def nearest(x, y):
        best, found = math.inf, (0.0, 0.0)
        for a_x, a_y, e_x, e_y in edges:
            share = ((x - a_x) * e_x + (y - a_y) * e_y) / (e_x * e_x + e_y * e_y)
            share = min(max(share, 0.0), 1.0)
            q_x, q_y = a_x + share * e_x, a_y + share * e_y
            square = (x - q_x) ** 2 + (y - q_y) ** 2
            if square < best:
                best, found = square, (q_x, q_y)
        return found

    return nearest


def nearest_on_circle(radius):
    return lambda x, y: (radius * x / math.hypot(x, y), radius * y / math.hypot(x, y))


def nearest_on_ellipse(a, b):
    def nearest(x, y):
        t = math.atan2(a * y, b * x)
        for _ in range(8):  # Newton's method for the least distance
            sin, cos = math.sin(t), math.cos(t)
            slope = x * a * sin - y * b * cos - (a * a - b * b) * sin * cos
            t -= slope / (x * a * cos + y * b * sin - (a * a - b * b) * (cos * cos - sin * sin))
        return a * math.cos(t), b * math.sin(t)

    return nearest


def twist_by_the_paper(v_p, x_c, normal, mu_c, c):
    # (9) to (15) in the axes of the support. The mode by trial: the force that sticks if Coulomb
    # allows it, else the edge of the cone that opposes the slipping that it leads to.
    (v_px, v_py), (x, y), (n_x, n_y) = v_p, x_c, normal
    t_x, t_y = n_y, -n_x
    square = c * c + x * x + y * y
    v_x = ((c * c + x * x) * v_px + x * y * v_py) / square
    v_y = (x * y * v_px + (c * c + y * y) * v_py) / square
    across, ahead = v_x * t_x + v_y * t_y, v_x * n_x + v_y * n_y  # of the force, (4) and (5)
    if ahead >= 0.0 and (math.isinf(mu_c) or abs(across) <= mu_c * ahead):
        return v_x, v_y, (x * v_y - y * v_x) / (c * c)
    advance = v_px * n_x + v_py * n_y
    if advance <= 0.0:
        return None
    for side in (-1.0, 1.0):
        weight = (0.0, side) if math.isinf(mu_c) else (1.0, side * mu_c)
        f_x, f_y = weight[0] * n_x + weight[1] * t_x, weight[0] * n_y + weight[1] * t_y
        omega = (x * f_y - y * f_x) / (c * c)
        v_bx, v_by = f_x - omega * y, f_y + omega * x
        if v_bx * n_x + v_by * n_y > 0.0:
            kappa = advance / (v_bx * n_x + v_by * n_y)
            slip = (v_px - kappa * v_bx) * t_x + (v_py - kappa * v_by) * t_y
            if side * slip >= 0.0:
                return kappa * f_x, kappa * f_y, kappa * omega
    raise AssertionError('neither edge of the cone fits')


def friction_of(u_x, u_y, omega, x_c, y_c, points):
    # Force and moment about the contact of support points (x, y, load), relative to the centre.
    f_x = f_y = m = 0.0
    for x, y, load in points:
        v_x, v_y = u_x - omega * (y - y_c), u_y + omega * (x - x_c)
        share = load / max(math.hypot(v_x, v_y), 1e-300)
        f_x, f_y = f_x + share * v_x, f_y + share * v_y
        m += share * ((x - x_c) * v_y - (y - y_c) * v_x)
    return f_x, f_y, m


def bisected(function, lower, upper):
    for _ in range(52):
        middle = (lower + upper) / 2.0
        if function(middle) < 0.0:
            lower = middle
        else:
            upper = middle
    return (lower + upper) / 2.0


def twist_on_points(v_p, x_c, normal, angle, mu_c, points):
    # The same on the exact limit surface, by bisections. A force at the contact has no moment
    # about it: that gives omega. When the contact slips, the velocity there has the direction
    # whose force lies on the edge of the cone.
    (v_px, v_py), (x, y), (n_x, n_y) = v_p, x_c, normal
    t_x, t_y = n_y, -n_x
    cos, sin = math.cos(angle), math.sin(angle)
    points = [(cos * p_x - sin * p_y, sin * p_x + cos * p_y, load) for p_x, p_y, load in points]

    def turning(u_x, u_y):
        limit = math.hypot(u_x, u_y) / 1e-4
        return bisected(lambda w: friction_of(u_x, u_y, w, x, y, points)[2], -limit, limit)

    omega = turning(v_px, v_py)
    f_x, f_y, _ = friction_of(v_px, v_py, omega, x, y, points)
    across, ahead = f_x * t_x + f_y * t_y, f_x * n_x + f_y * n_y
    advance = v_px * n_x + v_py * n_y
    if ahead >= 0.0 and (math.isinf(mu_c) or abs(across) <= mu_c * ahead):
        u_x, u_y = v_px, v_py
    elif advance <= 0.0:
        return None
    else:
        side = math.copysign(1.0, across)
        bend = side * (math.pi / 2.0 if math.isinf(mu_c) else math.atan(mu_c))
        edge = math.atan2(n_y, n_x) - bend

        def off_edge(turn):
            u_x, u_y = math.cos(edge + turn), math.sin(edge + turn)
            f_x, f_y, _ = friction_of(u_x, u_y, turning(u_x, u_y), x, y, points)
            return math.cos(edge) * f_y - math.sin(edge) * f_x

        direction = edge + bisected(off_edge, -math.pi / 2.0, math.pi / 2.0)
        u_x, u_y = math.cos(direction), math.sin(direction)
        kappa = advance / (u_x * n_x + u_y * n_y)
        u_x, u_y = kappa * u_x, kappa * u_y
        assert side * ((v_px - u_x) * t_x + (v_py - u_y) * t_y) >= 0.0
        omega = turning(u_x, u_y)
    return u_x + omega * y, u_y - omega * x, omega


def simulated(nearest, pose, velocity, length, twist, steps):
    # The finger starts at the origin. The object's pose is integrated by Runge and Kutta's method
    # in many steps; at each instant the contact is the point of the outline nearest to the finger.
    v_x, v_y = velocity
    left = False

    def rates(x, y, angle, travelled):
        nonlocal left
        cos, sin = math.cos(angle), math.sin(angle)
        p_x, p_y = v_x * travelled - x, v_y * travelled - y
        q_x, q_y = nearest(cos * p_x + sin * p_y, cos * p_y - sin * p_x)
        x_c, y_c = cos * q_x - sin * q_y, sin * q_x + cos * q_y
        n_x, n_y = x_c - p_x, y_c - p_y
        away = math.hypot(n_x, n_y)
        motion = twist(velocity, (x_c, y_c), (n_x / away, n_y / away), angle)
        if motion is None:
            left = True
        return (0.0, 0.0, 0.0) if left else motion

    def after(pose, rate, h):
        return tuple(value + h * change for value, change in zip(pose, rate, strict=True))

    h = length / steps
    for i in range(steps):
        k1 = rates(*pose, i * h)
        k2 = rates(*after(pose, k1, h / 2.0), (i + 0.5) * h)
        k3 = rates(*after(pose, k2, h / 2.0), (i + 0.5) * h)
        k4 = rates(*after(pose, k3, h), (i + 1) * h)
        k = [(a + 2.0 * b + 2.0 * c + d) / 6.0 for a, b, c, d in zip(k1, k2, k3, k4, strict=True)]
        pose = after(pose, k, h)
    return pose, left


def both_ways(outline, nearest, sigma, beta, length, mu_c, c, steps=600, angle=0.4, spin=0.0):
    pose = (*at_contact(outline, sigma, angle), angle)
    velocity = heading(outline, sigma, beta, angle)
    state = moved(outline, (*pose, sigma, True), (0.0, 0.0), velocity, length, mu_c, c, spin=spin)

    def twist(v_p, x_c, normal, _):
        # The finger's material at the contact, at r n from the disk's centre: v + spin z x r n.
        (v_x, v_y), (n_x, n_y) = v_p, normal
        v_p = v_x - spin * FINGER * n_y, v_y + spin * FINGER * n_x
        return twist_by_the_paper(v_p, x_c, normal, mu_c, c)

    expected, left = simulated(nearest, pose, velocity, length, twist, steps)
    return state, expected, left


def turned_after(angle, rate, time):
    # u' = -rate cos(u) has the solution tan(u/2 + pi/4) = tan(u0/2 + pi/4) exp(-rate t).
    start = angle / 2.0 + math.pi / 4.0
    end = math.atan2(math.sin(start) * math.exp(-rate * time), math.cos(start))
    return 2.0 * end - math.pi / 2.0


def time_to_turn(angle, angle_end, rate):
    # The same, solved for the time.
    start, end = (math.tan(u / 2.0 + math.pi / 4.0) for u in (angle, angle_end))
    return math.log(start / end) / rate


def law_18_on_the_papers_block(periods):
    # kp = 0.05, kd = 5, theta_d = -10 degrees; the belt's 5 mm/s, 10 Hz, phi within 33 to 147.
    path = BLOCK.path(FINGER)
    theta, sigma, phi = math.radians(20.0), 0.025 - 0.006, math.pi / 2.0
    history = [(theta, phi, sigma - 0.025)]
    for _ in range(periods):
        before = theta
        theta, sigma, elapsed, mode = push(
            theta, sigma, SPEED / math.tan(phi), SPEED, 0.1, path, BLOCK_C, None,
            *friction_cone(math.inf), FINGER,
        )  # fmt: skip
        assert elapsed == 0.1
        assert mode != FREE
        phi += 0.05 * (theta + math.radians(10.0)) + 5.0 * (theta - before)
        phi = min(max(phi, math.radians(33.0)), math.radians(147.0))
        history.append((theta, phi, sigma - 0.025))
    return np.array(history).T


@pytest.mark.parametrize(
    ('d', 'mu_c', 'expected'),
    [
        # l = c = r = 1, the finger at speed 2 along the normal: omega = 2 / 3 sticking at d = 1,
        # and the contact rolls at -r omega by (16).
        (1.0, math.inf, (2.0 / 3.0, -2.0 / 3.0, STICK)),
        (-1.0, math.inf, (-2.0 / 3.0, 2.0 / 3.0, STICK)),
        # Without friction omega = 1 and v_slip = -1: -1 - 1.
        (1.0, 0.0, (1.0, -2.0, SLIP_LEFT)),
        (-1.0, 0.0, (-1.0, 2.0, SLIP_RIGHT)),
        (0.0, math.inf, (0.0, 0.0, STICK)),
        (0.0, 0.0, (0.0, 0.0, STICK)),
    ],
)
def test_rates_on_an_edge_as_computed_by_hand(d, mu_c, expected):
    path = Outline.rectangle(4.0, 2.0).path(1.0)

    rates = push_rates(
        0.0, 2.0 + d, 0, 0.0, 2.0, Body(path, 1.0, None), Finger(*friction_cone(mu_c), 1.0)
    )

    assert rates[2] == expected[2]
    assert rates[:2] == pytest.approx(expected[:2], rel=0, abs=1e-14)


def test_rates_on_a_disk_as_computed_by_hand():
    # R = c = r = v = 1, pushed at 45 degrees from the tangent, sticking: omega = cos / 2 by
    # v_x = (c^2 + 0) v_px / (c^2 + R^2), omega = R v_x / c^2. The disk's centre is carried along by
    # the object, so that its way relative to it is -r omega.
    omega = math.sqrt(0.5) / 2.0
    path = Outline.circle(1.0).path(1.0)
    v = math.sqrt(0.5)

    rates = push_rates(
        0.0, 0.0, 0, v, v, Body(path, 1.0, None), Finger(*friction_cone(math.inf), 1.0)
    )

    assert rates[2] == STICK
    assert rates[:2] == pytest.approx((omega, -omega), rel=1e-14)


@checked
@given(outlines, shares, betas, mu_cs, ratios, st.floats(-0.3, 0.3))
def test_the_rates_are_those_of_the_paper_in_the_axes_of_the_support(
    outline, share, beta, mu_c, c, turn
):
    path = outline.path(FINGER)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)
    x, y = at_contact(outline, sigma)
    tau = tangent_angle(sigma, path)
    normal = (-math.sin(tau), math.cos(tau))
    x_c = (FINGER * normal[0] - x, FINGER * normal[1] - y)
    cos, sin = math.cos(turn), math.sin(turn)

    # The finger's velocity is given in axes from which the object has turned since.
    omega, sigma_dot, mode = push_rates(
        turn, sigma, 0, cos * v_x - sin * v_y, sin * v_x + cos * v_y, Body(path, c, None),
        Finger(*friction_cone(mu_c), FINGER),
    )  # fmt: skip

    expected = twist_by_the_paper((v_x, v_y), x_c, normal, mu_c, c)
    assert mode != FREE
    assert omega == pytest.approx(expected[2], rel=1e-9, abs=1e-9)
    # The disk's centre relative to the object, along the tangent.
    slip_x, slip_y = v_x - expected[0] - omega * y, v_y - expected[1] + omega * x
    assert sigma_dot == pytest.approx(slip_x * math.cos(tau) + slip_y * math.sin(tau), abs=1e-10)


@pytest.mark.parametrize('d', [-0.02, -0.006, 0.0, 0.015])
@pytest.mark.parametrize('beta', [1.2, math.pi / 2.0, 1.9])
def test_a_sticking_edge_under_a_point_follows_the_closed_form(d, beta):
    # A finger without radius: d stays. With reach and gamma, distance and direction of the contact
    # from the centre of mass: omega = v reach cos(beta - gamma) / (c^2 + reach^2) by (9) to (11),
    # where beta, the push's direction seen from the object, falls as the object turns.
    duration, point = 0.8, 1e-12
    away, gamma = math.hypot(BLOCK_L, d), math.atan2(d, BLOCK_L)
    turned = turned_after(beta - gamma, SPEED * away / (BLOCK_C**2 + away**2), duration)

    angle, sigma, elapsed, mode = pushed(BLOCK, 0.025 + d, beta, SPEED * duration, r=point)

    assert (elapsed, mode) == (duration, STICK)
    assert sigma == pytest.approx(0.025 + d, rel=0, abs=2.0 * point)
    assert angle == pytest.approx(beta - gamma - turned, rel=0, abs=1e-8)


@pytest.mark.parametrize('beta', [0.4, 1.2, 1.9, 2.6])
@pytest.mark.parametrize('sigma', [0.001, -0.1, 1.0])
def test_a_disk_that_sticks_follows_the_closed_form(beta, sigma):
    # beta falls as the contact goes around, at theta' = omega / (1 + r / R), where
    # omega = R v cos(beta) / (c^2 + R^2).
    duration = 2.0
    rate = SPEED * RADIUS**2 / ((DISK_C**2 + RADIUS**2) * (RADIUS + FINGER))
    theta = beta - turned_after(beta, rate, duration)

    angle, sigma_end, elapsed, mode = pushed(DISK, sigma, beta, SPEED * duration, c=DISK_C)

    assert (elapsed, mode) == (duration, STICK)
    # What is left of omega after theta' is -sigma' / (R + r).
    assert angle == pytest.approx(theta * (1.0 + FINGER / RADIUS), rel=0, abs=1e-7)
    assert sigma_end - sigma == pytest.approx(
        -theta * FINGER / RADIUS * (RADIUS + FINGER), rel=0, abs=1e-9
    )


@pytest.mark.parametrize('side', [-1.0, 1.0])
@pytest.mark.parametrize('aside', [0.1, 0.5, 1.2])
def test_a_disk_that_turned_out_of_the_way_is_free_when_the_closed_form_says(aside, side):
    # The finger moves along the tangent when beta is 0 or 180 degrees, 90 degrees aside.
    rate = SPEED * RADIUS**2 / ((DISK_C**2 + RADIUS**2) * (RADIUS + FINGER))
    expected = time_to_turn(aside, 0.0, rate)
    beta = math.pi / 2.0 + side * (math.pi / 2.0 - aside)

    angle, sigma, elapsed, mode = pushed(DISK, 0.0, beta, 10.0 * SPEED * expected, c=DISK_C)

    assert mode == FREE
    assert elapsed == pytest.approx(expected, rel=0, abs=3e-7 / rate)
    assert angle + sigma / (RADIUS + FINGER) == pytest.approx(-side * aside, rel=0, abs=2e-7)
    assert angle == pytest.approx(-side * aside * (1.0 + FINGER / RADIUS), rel=0, abs=2e-7)


@pytest.mark.parametrize('side', [-1.0, 1.0])
@pytest.mark.parametrize('aside', [0.1, 0.5, 1.2])
def test_a_finger_that_slides_around_a_disk_is_free_when_the_closed_form_says(aside, side):
    # Without friction the disk does not turn and slips aside, theta' = v cos(beta) / (R + r):
    # again beta' = -K cos(beta).
    rate = SPEED / (RADIUS + FINGER)
    expected = time_to_turn(aside, 0.0, rate)
    beta = math.pi / 2.0 + side * (math.pi / 2.0 - aside)

    angle, sigma, elapsed, mode = pushed(DISK, 0.0, beta, 10.0 * SPEED * expected, 0.0, DISK_C)

    assert mode == FREE
    assert elapsed == pytest.approx(expected, rel=0, abs=3e-7 / rate)
    assert angle == pytest.approx(0.0, abs=1e-15)
    assert sigma == pytest.approx(-side * aside * (RADIUS + FINGER), rel=0, abs=1e-8)


@pytest.mark.parametrize(
    ('sigma', 'beta', 'mu_c', 'c', 'length'),
    [
        (0.019, math.pi / 2.0, math.inf, 0.0187, 0.005),  # sticks
        (0.031, 1.2, 0.7, 0.0345, 0.01),  # slips to the right
        (0.045, 1.8, 0.2, 0.0067, 0.008),  # slips to the left
        (0.04, 1.3, 0.0, 0.0187, 0.01),  # without friction
        (0.025, 2.6, 1.0, 0.0187, 0.01),  # slips, then sticks
        (0.005, -0.15, math.inf, 0.0187, 0.001),  # pulls, for a while (fig. 3)
        (0.005, 0.1, math.inf, 0.0187, 0.004),  # a push that turns the edge out of its way
        (0.0499, 1.2, 0.3, 0.0187, 0.02),  # across the corner, onto the next edge
        (0.045, 0.4, 0.1, 0.03, 0.03),  # likewise, and away
        (0.002, 1.6, 0.5, 0.01, 0.03),
        (0.06, 1.5, math.inf, 0.0187, 0.01),  # rolls around the corner
        (0.06, 1.5, 0.1, 0.0187, 0.01),  # slips around the corner
        (0.06, 1.9, 0.0, 0.0187, 0.01),
        (0.0700, 1.57, 0.0, 0.0187, 0.002),  # from the corner onto the edge
        (0.0715, 1.57, 0.4, 0.0187, 0.006),  # from the edge onto the corner
        (0.2600, 1.9, 0.8, 0.0187, 0.02),  # over the start of the path
        (0.0002, 1.9, 0.0, 0.0187, 0.004),
    ],
)
def test_a_block_moves_as_simulated_in_the_plane(sigma, beta, mu_c, c, length):
    state, expected, left = both_ways(
        BLOCK, nearest_on_polygon(CORNERS), sigma, beta, length, mu_c, c, steps=4000
    )

    assert state[2] == pytest.approx(expected[2], rel=0, abs=ANGLE)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=PLACE)
    assert state[4] != left


@pytest.mark.parametrize('mu_c', [0.0, 0.2, math.inf])
@pytest.mark.parametrize('beta', [0.5, 1.4, 2.0])
@pytest.mark.parametrize('share', [0.0, 0.3])
def test_a_disk_moves_as_simulated_in_the_plane(mu_c, beta, share):
    sigma = share * DISK.path(FINGER)[-1, 0]

    state, expected, left = both_ways(
        DISK, nearest_on_circle(RADIUS), sigma, beta, 0.02, mu_c, DISK_C
    )

    assert state[2] == pytest.approx(expected[2], rel=0, abs=ANGLE)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=PLACE)
    assert state[4] != left


@pytest.mark.parametrize('mu_c', [0.0, 0.2, math.inf])
@pytest.mark.parametrize('beta', [0.5, 1.4, 2.0])
@pytest.mark.parametrize('share', [0.07, 0.3, 0.9])
def test_an_ellipse_moves_as_simulated_in_the_plane(mu_c, beta, share):
    # Its chain of arcs is the ellipse up to some nanometres, and 1e-4 in the tangent, which
    # is off to either side in turns.
    sigma = share * ELLIPSE.path(FINGER)[-1, 0]

    state, expected, left = both_ways(
        ELLIPSE, nearest_on_ellipse(A, B), sigma, beta, 0.015, mu_c, 0.02
    )

    assert state[2] == pytest.approx(expected[2], rel=0, abs=2e-5)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=5e-7)
    assert state[4] != left


@pytest.mark.slow
@checked
@given(bodies(), shares, betas, lengths, mu_cs, ratios)
def test_any_polygon_moves_as_simulated_in_the_plane(body, share, beta, length, mu_c, c):
    outline = Outline.polygon(body[0])
    sigma = share * outline.path(FINGER)[-1, 0]

    state, expected, _ = both_ways(
        outline, nearest_on_polygon(body[0]), sigma, beta, length, mu_c, c
    )

    assert state[2] == pytest.approx(expected[2], rel=0, abs=ANGLE)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=PLACE)


@pytest.mark.parametrize(
    ('sigma', 'beta', 'mu_c'),
    [
        (0.018, 1.4, math.inf),
        (0.035, 2.0, math.inf),
        (0.06, 1.5, math.inf),  # a corner
        (0.018, 1.4, 0.1),
        (0.035, 2.0, 0.3),
        (0.02, 1.8, 0.0),
    ],
)
def test_a_block_on_support_points_moves_as_simulated_in_the_plane(sigma, beta, mu_c):
    # Three points; their centre of friction is the origin.
    points = [(-0.02, -0.015, 1.0), (0.02, -0.015, 1.0), (0.0, 0.01, 3.0)]
    support = np.array(points).T.copy()
    pose = (*at_contact(BLOCK, sigma), 0.0)
    velocity = heading(BLOCK, sigma, beta)

    state = moved(
        BLOCK, (*pose, sigma, True), (0.0, 0.0), velocity, 0.002, mu_c, ratio(support), support
    )

    expected, _ = simulated(
        nearest_on_polygon(CORNERS),
        pose,
        velocity,
        0.002,
        lambda *contact: twist_on_points(*contact, mu_c, points),
        12,
    )
    assert state[2] == pytest.approx(expected[2], rel=0, abs=ANGLE)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=PLACE)


@checked
@given(bodies(), shares, st.floats(-math.pi, math.pi), st.floats(1e-4, 0.05), mu_cs, ratios)
def test_the_disk_touches_or_is_away_and_never_inside(body, share, beta, length, mu_c, c):
    outline = Outline.polygon(body[0])
    path = outline.path(FINGER)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)
    state = (*at_contact(outline, sigma), 0.0, sigma, True)
    for piece in range(5):
        finger = piece * length * v_x, piece * length * v_y
        before = state

        state = moved(outline, before, finger, (v_x, v_y), length, mu_c, c)

        x_f, y_f = finger[0] + length * v_x, finger[1] + length * v_y
        nearest, gap = clearance(Pose(*state[:3]), x_f, y_f, path, FINGER)
        if state[4]:
            assert gap == pytest.approx(0.0, abs=1e-12)
            assert math.remainder(state[3] - nearest, path[-1, 0]) == pytest.approx(0.0, abs=1e-9)
        else:
            assert gap > 0.0
            assert state[5] == FREE
        if not before[4]:  # straight on, away from a convex object
            assert state[:3] == before[:3]
            assert not state[4]


@few
@given(bodies(), shares, st.floats(-math.pi, math.pi), lengths, mu_cs)
def test_the_disk_touches_or_is_away_on_support_points_too(body, share, beta, length, mu_c):
    corners, support = body
    outline = Outline.polygon(corners)
    path = outline.path(FINGER)
    sigma = share * path[-1, 0]
    velocity = heading(outline, sigma, beta)
    state = (*at_contact(outline, sigma), 0.0, sigma, True)

    state = moved(outline, state, (0.0, 0.0), velocity, length, mu_c, ratio(support), support)

    finger = length * velocity[0], length * velocity[1]
    _, gap = clearance(Pose(*state[:3]), *finger, path, FINGER)
    if state[4]:
        assert gap == pytest.approx(0.0, abs=1e-12)
    else:
        assert gap > 0.0


def test_every_kind_of_end_occurs():
    # The two properties above are about all of these.
    ends = set()
    for sigma in (0.005, 0.04, 0.06):
        for beta in (-1.0, 0.3, 1.5, 2.8):
            for mu_c in (0.0, 0.5, math.inf):
                ends.add(pushed(BLOCK, sigma, beta, 0.002, mu_c)[3])
    assert ends == {FREE, STICK, SLIP_LEFT, SLIP_RIGHT}


@pytest.mark.parametrize('outline', [BLOCK, DISK], ids=['block', 'disk'])
@pytest.mark.parametrize('mu_c', [0.0, 0.5, math.inf])
@pytest.mark.parametrize('beta', [-2.0, -1e-9, math.pi + 1e-9, 4.0])
def test_a_finger_that_moves_away_pushes_nothing(outline, mu_c, beta):
    # In front of the centre of mass no motion cone reaches behind the edge: no pulling.
    sigma = 0.025 if outline is BLOCK else 0.0
    velocity = heading(outline, sigma, beta)

    end = push(
        0.3, sigma, *heading(outline, sigma, beta, 0.3), 0.01, outline.path(FINGER), BLOCK_C, None,
        *friction_cone(mu_c), FINGER,
    )  # fmt: skip

    assert end == (0.3, sigma, 0.0, FREE)
    start = (*at_contact(outline, sigma), 0.0, sigma, True)
    state = moved(outline, start, (0.0, 0.0), velocity, 0.01, mu_c, BLOCK_C)
    assert state[:3] == start[:3]
    assert not state[4]


@pytest.mark.parametrize(('speed', 'duration'), [(0.0, 0.1), (0.005, 0.0), (0.0, 0.0)])
@pytest.mark.parametrize('support', [None, 'corners'])
def test_a_push_without_a_way_changes_nothing(speed, duration, support):
    if support:
        support = np.ascontiguousarray(np.vstack([CORNERS.T, np.ones(4)]))
    path, cone = BLOCK.path(FINGER), friction_cone(0.5)

    angle, sigma, _, mode = push(
        0.3, 0.029, 0.0, speed, duration, path, BLOCK_C, support, *cone, FINGER
    )

    assert (angle, sigma) == (0.3, 0.029)
    assert mode == (FREE if speed == 0.0 else STICK)
    start = (*at_contact(BLOCK, 0.029, 0.3), 0.3, 0.029, True)
    state = moved(BLOCK, start, (0.0, 0.0), (0.0, speed), duration, 0.5, BLOCK_C, support)
    assert state[:3] == start[:3]
    assert state[3] == pytest.approx(0.029, rel=0, abs=1e-15)
    assert state[4]


@checked
@given(outlines, shares, betas, lengths, mu_cs, ratios)
def test_64_pieces_of_a_push_end_where_the_push_ends(outline, share, beta, length, mu_c, c):
    sigma = share * outline.path(FINGER)[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)
    start = (*at_contact(outline, sigma), 0.0, sigma, True)

    whole = moved(outline, start, (0.0, 0.0), (v_x, v_y), length, mu_c, c)

    state = start
    for i in range(64):
        finger = i / 64.0 * length * v_x, i / 64.0 * length * v_y
        state = moved(outline, state, finger, (v_x, v_y), length / 64.0, mu_c, c)
    assert state[:2] == pytest.approx(whole[:2], rel=0, abs=PLACE)
    assert state[2] == pytest.approx(whole[2], rel=0, abs=ANGLE)
    assert state[4] == whole[4]


@pytest.mark.parametrize(
    ('sigma', 'beta', 'mu_c', 'c', 'length'),
    [
        (0.04997, 1.57, 0.0, 0.0187, 0.0009),  # onto a corner
        (0.04997, 1.57, 0.0, 0.0187, 0.003),
        (0.0712, 1.57, 0.0, 0.0187, 0.0009),  # from the corner onto an edge
        (0.0713, 1.57, 0.0, 0.0187, 0.003),
        (0.04, 2.3, 0.3, 0.0067, 0.003),
        (0.02, 2.8, 0.8, 0.0067, 0.01),
        (0.1, 1.9, 0.3, 0.0187, 0.02),
        (0.045, 2.2, math.inf, 0.0067, 0.01),
        (0.07, 1.3, 0.1, 0.01, 0.03),
    ],
)
def test_a_push_is_exact_across_corners_and_from_slipping_to_sticking(sigma, beta, mu_c, c, length):
    whole = pushed(BLOCK, sigma, beta, length, mu_c, c)

    path, cone = BLOCK.path(FINGER), friction_cone(mu_c)
    v_x, v_y = (SPEED * v for v in heading(BLOCK, sigma, beta))
    angle, at, pieces = 0.0, sigma, 500
    for _ in range(pieces):
        angle, at, _, mode = push(
            angle, at, v_x, v_y, length / SPEED / pieces, path, c, None, *cone, FINGER
        )
    assert mode == whole[3]
    assert whole[0] == pytest.approx(angle, rel=0, abs=1e-6)
    assert whole[1] == pytest.approx(at, rel=0, abs=3e-8)


SQUARISH = np.array([(19.94, 28.87), (-41.04, 14.95), (-13.9, -41.4), (35.0, -2.41)]) * 1e-3
TRIPOD = np.array([(-0.02, -0.015), (0.02, -0.015), (0.0, 0.01)])


@pytest.mark.parametrize(
    ('corners', 'points', 'loads', 'sigma', 'beta', 'mu_c', 'length'),
    [
        # A support point almost stands still for a moment, or does so at the start.
        (SQUARISH, 0.8 * SQUARISH, [1.0, 1.0, 1.0, 1.0], 0.0, 1.625, 1.0, 0.002),
        (CORNERS, TRIPOD, [1.0, 1.0, 3.0], 0.06, 1.5, 0.0, 0.002),
        (CORNERS, TRIPOD, [1.0, 1.0, 3.0], 0.018, 1.4, 0.1, 0.0009),
    ],
)
def test_a_push_on_support_points_is_exact_where_one_of_them_nearly_stops(
    corners, points, loads, sigma, beta, mu_c, length
):
    support = np.ascontiguousarray(np.vstack([points.T, loads]))
    outline, c, cone = Outline.polygon(corners), ratio(support), friction_cone(mu_c)

    whole = pushed(outline, sigma, beta, length, mu_c, c, support)

    path, pieces = outline.path(FINGER), 100
    v_x, v_y = (SPEED * v for v in heading(outline, sigma, beta))
    angle, at = 0.0, sigma
    for _ in range(pieces):
        angle, at, _, mode = push(
            angle, at, v_x, v_y, length / SPEED / pieces, path, c, support, *cone, FINGER
        )
    assert mode == whole[3]
    assert whole[0] == pytest.approx(angle, rel=0, abs=1e-6)
    assert whole[1] == pytest.approx(at, rel=0, abs=1e-7)  # 3.3e-6 of the path's radius


@few
@given(bodies(), shares, betas, st.floats(1e-4, 0.003), mu_cs)
def test_pieces_of_a_push_on_support_points_end_where_the_push_ends(
    body, share, beta, length, mu_c
):
    corners, support = body
    outline = Outline.polygon(corners)
    sigma = share * outline.path(FINGER)[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)
    start = (*at_contact(outline, sigma), 0.0, sigma, True)
    c = ratio(support)

    whole = moved(outline, start, (0.0, 0.0), (v_x, v_y), length, mu_c, c, support)

    state = start
    for i in range(8):
        finger = i / 8.0 * length * v_x, i / 8.0 * length * v_y
        state = moved(outline, state, finger, (v_x, v_y), length / 8.0, mu_c, c, support)
    assert state[:2] == pytest.approx(whole[:2], rel=0, abs=PLACE)
    assert state[2] == pytest.approx(whole[2], rel=0, abs=ANGLE)


@checked
@given(outlines, shares, betas, st.floats(1e-4, 0.03), mu_cs, ratios)
def test_a_push_lasts_unless_the_finger_comes_free(outline, share, beta, length, mu_c, c):
    path = outline.path(FINGER)
    sigma = share * path[-1, 0]

    angle, end, elapsed, mode = pushed(outline, sigma, beta, length, mu_c, c)

    assert math.isfinite(angle)
    assert math.isfinite(end)
    ahead = math.sin(beta - angle - tangent_angle(end, path) + tangent_angle(sigma, path))
    if mode == FREE:
        assert 0.0 < elapsed < length / SPEED
        assert ahead <= 1e-7
    else:
        assert elapsed == length / SPEED
        assert ahead > 0.0 or mode == STICK


@few
@given(
    outlines,
    shares,
    st.floats(-math.pi, math.pi),
    st.sampled_from([1e-9, 1e-3, 0.3]),
    st.sampled_from([0.0, 1e-300, 1e-9, 1e9, 1e300, math.inf]),
    st.sampled_from([1e-4, 1e-2, 1.0, 1e6]),
    st.sampled_from([1e-9, 1e-2, 1e6]),
    st.sampled_from([1e-6, 1e-2, 10.0]),
)
def test_extreme_values_give_finite_numbers(outline, share, beta, length, mu_c, c, speed, r):
    path = outline.path(r)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(outline, sigma, beta, r=r)
    start = (*at_contact(outline, sigma, r=r), 0.0, sigma, True)

    state = moved(
        outline, start, (0.0, 0.0), (speed * v_x, speed * v_y), length / speed, mu_c, c, r=r
    )

    assert all(math.isfinite(value) for value in state[:4])
    # Nothing moves further than it is pushed, but for what turns: at most around the finger.
    assert math.dist(state[:2], start[:2]) <= length + 0.2


@few
@given(
    bodies(),
    shares,
    betas,
    st.sampled_from([1e-9, 1e-3]),
    st.sampled_from([0.0, 1e-9, 1e9, math.inf]),
    st.sampled_from([1e-9, 1e6]),
    st.sampled_from([1e-6, 1e-2, 10.0]),
)
def test_extreme_values_on_support_points_give_finite_numbers(
    body, share, beta, length, mu_c, speed, r
):
    corners, support = body
    outline = Outline.polygon(corners)
    path = outline.path(r)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(outline, sigma, beta, r=r)
    start = (*at_contact(outline, sigma, r=r), 0.0, sigma, True)

    state = moved(
        outline, start, (0.0, 0.0), (speed * v_x, speed * v_y), length / speed, mu_c,
        ratio(support), support, r,
    )  # fmt: skip

    assert all(math.isfinite(value) for value in state[:4])
    assert math.dist(state[:2], start[:2]) <= length + 0.2


SWAPPED = {SLIP_LEFT: SLIP_RIGHT, SLIP_RIGHT: SLIP_LEFT, STICK: STICK, FREE: FREE}


def mirrored(body):
    # Walked in the other direction, from the end of the same first edge.
    corners = body[0] * (-1.0, 1.0)
    return np.roll(corners[::-1], 2, axis=0)


@checked
@given(bodies(), shares, betas, lengths, mu_cs, ratios)
def test_mirror_images_mirror(body, share, beta, length, mu_c, c):
    outline = Outline.polygon(body[0])
    first = outline.pieces[0, 3]
    sigma = share * outline.path(FINGER)[-1, 0]

    angle, end, elapsed, mode = pushed(outline, sigma, beta, length, mu_c, c)

    found = pushed(Outline.polygon(mirrored(body)), first - sigma, math.pi - beta, length, mu_c, c)
    assert found[0] == pytest.approx(-angle, rel=0, abs=ANGLE)
    assert found[1] == pytest.approx(first - end, rel=0, abs=PLACE)
    assert found[2] == pytest.approx(elapsed, rel=1e-5)
    if abs(angle) > 1e-6:  # else rounding decides between sticking and slipping
        assert found[3] == SWAPPED[mode]


@few
@given(bodies(), shares, betas, st.floats(1e-4, 0.003), mu_cs)
def test_mirror_images_mirror_on_support_points(body, share, beta, length, mu_c):
    corners, support = body
    outline = Outline.polygon(corners)
    first = outline.pieces[0, 3]
    sigma = share * outline.path(FINGER)[-1, 0]
    c = ratio(support)

    angle, end, _, _ = pushed(outline, sigma, beta, length, mu_c, c, support)

    found = pushed(
        Outline.polygon(mirrored(body)), first - sigma, math.pi - beta, length, mu_c, c,
        support * [[-1.0], [1.0], [1.0]],
    )  # fmt: skip
    assert found[0] == pytest.approx(-angle, rel=0, abs=ANGLE)
    assert found[1] == pytest.approx(first - end, rel=0, abs=PLACE)


@checked
@given(outlines, shares, betas, lengths, mu_cs, ratios, st.floats(-10.0, 10.0))
def test_a_push_turned_as_a_whole_turns(outline, share, beta, length, mu_c, c, turn):
    path, cone = outline.path(FINGER), friction_cone(mu_c)
    sigma = share * path[-1, 0]

    straight = push(
        0.0, sigma, *heading(outline, sigma, beta), length, path, c, None, *cone, FINGER
    )
    turned = push(
        turn, sigma, *heading(outline, sigma, beta, turn), length, path, c, None, *cone, FINGER
    )

    assert turned[0] - turn == pytest.approx(straight[0], rel=0, abs=ANGLE)
    assert turned[1] == pytest.approx(straight[1], rel=0, abs=PLACE)
    assert turned[2] == pytest.approx(straight[2], rel=1e-5)


@checked
@given(bodies(), shares, betas, lengths, mu_cs, st.integers(-10, 10), st.booleans())
def test_a_rig_that_is_larger_in_every_length_moves_alike(
    body, share, beta, length, mu_c, exponent, exact
):
    scale = 2.0**exponent  # which rounds nothing
    corners, support = body
    small, large = Outline.polygon(corners), Outline.polygon(scale * corners)
    path, larger = small.path(FINGER), large.path(scale * FINGER)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(small, sigma, beta)
    c, cone = ratio(support), friction_cone(mu_c)
    length = min(length, 1e-3) if exact else length
    scaled = support * [[scale], [scale], [1.0]] if exact else None

    angle, end, elapsed, mode = push(
        0.0, sigma, v_x, v_y, length, path, c, support if exact else None, *cone, FINGER
    )

    found = push(
        0.0, scale * sigma, scale * v_x, scale * v_y, length, larger, scale * c, scaled, *cone,
        scale * FINGER,
    )  # fmt: skip
    assert found[0] == pytest.approx(angle, rel=0, abs=1e-9)
    assert found[1] / scale == pytest.approx(end, rel=0, abs=1e-11)
    assert found[2] == pytest.approx(elapsed, rel=1e-9)
    assert found[3] == mode


@checked
@given(outlines, shares, betas, lengths, mu_cs, ratios, st.floats(1e-6, 1e6))
def test_the_way_counts_and_the_speed_does_not(outline, share, beta, length, mu_c, c, faster):
    path, cone = outline.path(FINGER), friction_cone(mu_c)
    sigma = share * path[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)

    slow = push(0.0, sigma, v_x, v_y, length, path, c, None, *cone, FINGER)
    fast = push(
        0.0, sigma, faster * v_x, faster * v_y, length / faster, path, c, None, *cone, FINGER
    )

    assert fast[0] == pytest.approx(slow[0], rel=0, abs=ANGLE)
    assert fast[1] == pytest.approx(slow[1], rel=0, abs=PLACE)
    assert fast[2] * faster == pytest.approx(slow[2], rel=1e-5)


@checked
@given(st.floats(0.85, math.pi - 0.85), lengths)
def test_d_is_constant_while_theta_is(beta, length):
    sigma = 0.025 - BLOCK_L / math.tan(beta)  # the ray of pushing passes through the centre of mass

    angle, end, elapsed, mode = pushed(BLOCK, sigma, beta, length)

    # The balance is unstable: rounding grows with the path, by e^(K path), K < 40 / m.
    assert angle == pytest.approx(0.0, abs=1e-14)
    assert end == pytest.approx(sigma, rel=0, abs=1e-15)
    assert (elapsed, mode) == (length / SPEED, STICK)


@checked
@given(st.floats(-0.02, 0.02), st.floats(1.1, math.pi - 1.1), st.floats(1e-4, 0.005), st.booleans())
def test_on_an_edge_that_sticks_the_contact_rolls_by_r_theta(d, beta, length, exact):
    # Within these ranges the push lies well inside the motion cone of 180 degrees, whose edge
    # (1 + l^2 / c^2, l d / c^2) leaves the tangent by at most 28 degrees.
    support = np.ascontiguousarray(np.vstack([0.6 * CORNERS.T, np.ones(4)])) if exact else None
    length = min(length, 1e-3) if exact else length

    angle, end, elapsed, mode = pushed(BLOCK, 0.025 + d, beta, length, support=support)

    assert (elapsed, mode) == (length / SPEED, STICK)
    assert d == pytest.approx(end - 0.025 + FINGER * angle, rel=0, abs=1e-15)


@checked
@given(shares, betas, st.floats(1e-4, 0.03), ratios)
def test_a_disk_without_friction_never_turns(share, beta, length, c):
    sigma = share * DISK.path(FINGER)[-1, 0]

    angle, _, _, _ = pushed(DISK, sigma, beta, length, 0.0, c)

    assert angle == pytest.approx(0.0, abs=1e-14)


def test_a_disk_without_friction_does_not_turn_on_even_support_points():
    around = np.arange(12) * math.pi / 6.0
    support = np.array([0.02 * np.cos(around), 0.02 * np.sin(around), np.ones(12)])

    angle, _, _, mode = pushed(DISK, 0.01, 1.3, 0.005, 0.0, 0.02, support)

    assert mode == SLIP_RIGHT
    assert angle == pytest.approx(0.0, abs=1e-9)


@checked
@given(outlines, shares, betas, lengths, ratios)
def test_huge_friction_is_nearly_infinite_and_tiny_friction_nearly_none(
    outline, share, beta, length, c
):
    sigma = share * outline.path(FINGER)[-1, 0]
    for mu_c, limit in ((1e9, math.inf), (1e-9, 0.0)):
        expected = pushed(outline, sigma, beta, length, limit, c)
        if expected[3] != FREE:
            found = pushed(outline, sigma, beta, length, mu_c, c)

            assert found[0] == pytest.approx(expected[0], rel=0, abs=ANGLE)
            assert found[1] == pytest.approx(expected[1], rel=0, abs=PLACE)


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


@pytest.mark.parametrize('beta', [0.2, 1.0, 2.5])
@pytest.mark.parametrize('gap', [1e-9, 1e-3, 10.0])
def test_a_finger_approaches_an_edge_by_its_velocity_along_the_normal(beta, gap):
    path = BLOCK.path(FINGER)
    expected = gap / (SPEED * math.sin(beta))
    along = SPEED * math.cos(beta) * expected

    elapsed, sigma, touching = approach(
        Pose(0.0, 0.0, 0.0), 0.005 - along, -BLOCK_L - FINGER - gap, SPEED * math.cos(beta),
        SPEED * math.sin(beta), 2.0 * expected, path, FINGER,
    )  # fmt: skip

    assert touching
    assert elapsed == pytest.approx(expected, rel=1e-12, abs=1e-10)
    assert sigma == pytest.approx(0.03, rel=0, abs=1e-11)


@pytest.mark.parametrize('offset', [-0.99, -0.3, 0.0, 0.8, 0.999])
@pytest.mark.parametrize('speed', [1e-6, 1.0, 1e6])
def test_a_finger_approaches_a_circle_when_the_centres_are_both_radii_apart(offset, speed):
    path, both = DISK.path(FINGER), RADIUS + FINGER
    # From 1 m below, beside the line through the centre.
    expected = (1.0 - both * math.sqrt(1.0 - offset**2)) / speed

    elapsed, sigma, touching = approach(
        Pose(0.2, 0.3, 0.5), 0.2 + offset * both, 0.3 - 1.0, 0.0, speed, 1.0 / speed, path, FINGER
    )

    assert touching
    assert elapsed == pytest.approx(expected, rel=1e-10)
    bearing = math.asin(offset) - 0.5
    assert math.remainder(sigma / both - bearing, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize('offset', [0.1, 0.5, 0.95])
def test_a_finger_approaches_a_corner_when_it_is_a_radius_away(offset):
    path = BLOCK.path(FINGER)
    # To the right of the lower right corner by part of the radius, 0.1 m below it.
    expected = (0.1 - FINGER * math.sqrt(1.0 - offset**2)) / SPEED

    elapsed, sigma, touching = approach(
        Pose(0.0, 0.0, 0.0),
        0.025 + offset * FINGER,
        -BLOCK_L - 0.1,
        0.0,
        SPEED,
        100.0,
        path,
        FINGER,
    )

    assert touching
    assert elapsed == pytest.approx(expected, rel=1e-11)
    assert sigma == pytest.approx(0.05 + FINGER * math.asin(offset), rel=0, abs=1e-9)


@pytest.mark.parametrize('aside', [1e-9, 1e-3, 1.0])
@pytest.mark.parametrize('outline', [BLOCK, DISK], ids=['block', 'disk'])
def test_a_finger_that_passes_by_touches_nothing(outline, aside):
    half = 0.025 if outline is BLOCK else RADIUS

    elapsed, _, touching = approach(
        Pose(0.0, 0.0, 0.0),
        half + FINGER + aside,
        -1.0,
        0.0,
        0.5,
        4.0,
        outline.path(FINGER),
        FINGER,
    )

    assert (elapsed, touching) == (4.0, False)


@pytest.mark.parametrize('aside', [1e-9, 1e-6])
@pytest.mark.parametrize('outline', [BLOCK, DISK], ids=['block', 'disk'])
def test_a_finger_that_grazes_touches(outline, aside):
    # It overlaps by little: the gap closes like a parabola, at a depth s^2 / 2 R.
    half, curved = (0.025, FINGER) if outline is BLOCK else (RADIUS, RADIUS + FINGER)
    height = -BLOCK_L if outline is BLOCK else 0.0

    elapsed, _, touching = approach(
        Pose(0.0, 0.0, 0.0),
        half + FINGER - aside,
        -1.0,
        0.0,
        0.5,
        4.0,
        outline.path(FINGER),
        FINGER,
    )

    assert touching
    before = math.sqrt(2.0 * curved * aside)
    assert -1.0 + 0.5 * elapsed == pytest.approx(height - before, rel=0, abs=1e-4 * before + 1e-9)


@pytest.mark.parametrize(
    ('start', 'velocity', 'duration'),
    [
        (-1.0, (0.0, -0.1), 100.0),
        (-1.0, (0.1, 0.0), 100.0),
        (-1.0, (0.0, 0.0), 100.0),
        (-1.0, (0.0, 0.1), 0.0),
        (-1.0, (0.0, 0.1), 9.0),
    ],
)
def test_a_finger_that_does_not_come_touches_nothing(start, velocity, duration):
    elapsed, _, touching = approach(
        Pose(0.0, 0.0, 0.0), 0.0, start, *velocity, duration, BLOCK.path(FINGER), FINGER
    )

    assert (elapsed, touching) == (duration, False)


@pytest.mark.parametrize('overlap', [0.0, 1e-6, 0.01])
@pytest.mark.parametrize('velocity', [(0.0, 0.1), (0.0, 0.0), (0.0, -0.1)])
def test_a_finger_that_touches_need_not_come(overlap, velocity):
    elapsed, sigma, touching = approach(
        Pose(0.0, 0.0, 0.0), 0.004, -BLOCK_L - FINGER + overlap, *velocity, 1.0, BLOCK.path(FINGER),
        FINGER,
    )  # fmt: skip

    assert (elapsed, touching) == (0.0, True)
    assert sigma == pytest.approx(0.029, rel=1e-14)


@checked
@given(bodies(), angles, angles, st.floats(-0.08, 0.08), st.sampled_from([1e-3, 1.0, 1e5]))
def test_a_finger_meets_any_polygon_at_the_first_time_at_which_it_is_near(
    body, angle, bearing, offset, speed
):
    # From 0.3 m away, past the centre of mass at the offset.
    corners = body[0]
    cos, sin = math.cos(bearing), math.sin(bearing)
    x_f, y_f = -0.3 * cos - offset * sin, -0.3 * sin + offset * cos
    nearest = nearest_on_polygon(corners)

    def distance(travelled):
        p_x, p_y = x_f + travelled * cos, y_f + travelled * sin
        x = math.cos(angle) * p_x + math.sin(angle) * p_y
        y = math.cos(angle) * p_y - math.sin(angle) * p_x
        return math.dist(nearest(x, y), (x, y)) - FINGER

    found, _, touching = approach(
        Pose(0.0, 0.0, angle), x_f, y_f, speed * cos, speed * sin, 0.6 / speed,
        Outline.polygon(corners).path(FINGER), FINGER,
    )  # fmt: skip

    ways = np.linspace(0.0, 0.6, 601)
    inside = next((way for way in ways if distance(way) < 0.0), None)
    if inside is None:
        least = min(distance(way) for way in ways)
        assert not touching or least < 2e-5  # else it grazed between two looks
    else:
        expected = bisected(lambda way: -distance(way), inside - 1e-3, inside)
        assert touching
        assert distance(found * speed) == pytest.approx(0.0, abs=1e-11)
        assert found * speed == pytest.approx(expected, rel=0, abs=1e-6)


@checked
@given(bodies(), angles, angles, st.floats(1.1, 1e3), mu_cs)
def test_a_fast_finger_does_not_tunnel(body, angle, bearing, speed, mu_c):
    # In one motion from far away to far behind the object: it carries the object along or passes.
    outline = Outline.polygon(body[0])
    v_x, v_y = speed * math.cos(bearing), speed * math.sin(bearing)
    start = (0.0, 0.0, angle, 0.0, False)

    state = moved(outline, start, (-0.1 * v_x, -0.1 * v_y), (v_x, v_y), 0.12, mu_c, BLOCK_C)

    assert state[:3] != start[:3]
    _, gap = clearance(Pose(*state[:3]), 0.02 * v_x, 0.02 * v_y, outline.path(FINGER), FINGER)
    assert gap > -1e-12


def test_what_is_not_touched_does_not_move():
    start = (0.123, -0.456, 0.789, 0.0, False)
    for velocity in ((0.01, 0.0), (-0.3, 0.2), (0.0, 0.0)):
        state = moved(BLOCK, start, (0.0, 0.0), velocity, 1.0, math.inf, BLOCK_C)

        assert state[:3] == start[:3]
        assert state[4:] == (False, FREE)
        # Where it is nearest at the end is told.
        nearest, _ = clearance(Pose(*start[:3]), *velocity, BLOCK.path(FINGER), FINGER)
        assert state[3] == nearest


@pytest.mark.parametrize('mu_c', [0.0, 0.4, math.inf])
@pytest.mark.parametrize('support', [None, 'corners'])
def test_contact_is_lost_and_found_again(mu_c, support):
    if support:
        support = np.ascontiguousarray(np.vstack([CORNERS.T, np.ones(4)]))
    state = (*at_contact(BLOCK, 0.03), 0.0, 0.03, True)
    pushed_by = moved(BLOCK, state, (0.0, 0.0), (0.0, SPEED), 0.4, mu_c, BLOCK_C, support)
    assert pushed_by[4]
    finger = (0.0, 0.4 * SPEED)

    away = moved(BLOCK, pushed_by, finger, (0.001, -SPEED), 0.6, mu_c, BLOCK_C, support)
    assert away[:3] == pushed_by[:3]
    assert away[4:] == (False, FREE)

    finger = (finger[0] + 0.6e-3, finger[1] - 0.6 * SPEED)
    back = moved(BLOCK, away, finger, (-0.001, SPEED), 0.5999, mu_c, BLOCK_C, support)
    assert back[:3] == pushed_by[:3]
    assert not back[4]

    # On the way it came, so that it touches where it left and pushes on from there.
    finger = (finger[0] - 0.5999e-3, finger[1] + 0.5999 * SPEED)
    on = moved(BLOCK, back, finger, (-0.001, SPEED), 0.3001, mu_c, BLOCK_C, support)
    direct = moved(
        BLOCK, pushed_by, (0.0, 0.4 * SPEED), (-0.001, SPEED), 0.3, mu_c, BLOCK_C, support
    )
    assert on[4]
    assert on[5] == direct[5]
    assert on[:4] == pytest.approx(direct[:4], rel=0, abs=1e-9)


@checked
@given(outlines, shares, betas, lengths, mu_cs, st.floats(1e-4, 1.0))
def test_approach_and_push_in_one_motion_are_the_two_after_each_other(
    outline, share, beta, length, mu_c, before
):
    sigma = share * outline.path(FINGER)[-1, 0]
    v_x, v_y = heading(outline, sigma, beta)
    x, y = at_contact(outline, sigma)

    both = moved(
        outline, (x, y, 0.0, 0.0, False), (-before * v_x, -before * v_y), (v_x, v_y),
        before + length, mu_c, BLOCK_C,
    )  # fmt: skip

    alone = moved(outline, (x, y, 0.0, sigma, True), (0.0, 0.0), (v_x, v_y), length, mu_c, BLOCK_C)
    assert both[:2] == pytest.approx(alone[:2], rel=0, abs=PLACE)
    assert both[2] == pytest.approx(alone[2], rel=0, abs=ANGLE)
    assert both[4] == alone[4]


@pytest.mark.parametrize('mu_c', [0.0, 0.5])
@pytest.mark.parametrize('way', [-0.02, 0.02])
def test_a_finger_that_slides_along_an_edge_leaves_the_object_where_it_is(mu_c, way):
    # Without a force along the normal there is no friction.
    start = (*at_contact(BLOCK, 0.025), 0.0, 0.025, True)

    state = moved(BLOCK, start, (0.0, 0.0), (way, 0.0), 1.0, mu_c, BLOCK_C)

    assert state[:3] == start[:3]
    assert state[3] == pytest.approx(0.025 + way, rel=0, abs=1e-15)
    assert state[4:] == (True, FREE)


@pytest.mark.parametrize('mu_c', [0.0, 0.5])
def test_a_finger_that_slides_off_the_end_of_an_edge_is_away(mu_c):
    start = (*at_contact(BLOCK, 0.025), 0.0, 0.025, True)

    state = moved(BLOCK, start, (0.0, 0.0), (0.026, 0.0), 1.0, mu_c, BLOCK_C)

    assert state[:3] == start[:3]
    # 1 mm beyond the corner: its disk has sunk away from it by the arc's height.
    assert state[3] == pytest.approx(0.05 + FINGER * math.atan2(0.001, FINGER), rel=1e-12)
    assert state[4:] == (False, FREE)


def test_a_finger_comes_along_an_edge_and_pushes_its_next_one():
    # Two motions around the lower right corner: past it, then to the left against the right edge.
    state = (*at_contact(BLOCK, 0.045), 0.0, 0.045, True)
    x, y = state[:2]

    state = moved(BLOCK, state, (0.0, 0.0), (0.05, 0.0), 1.0, 0.3, BLOCK_C)
    state = moved(BLOCK, state, (0.05, 0.0), (0.0, 0.03725), 1.0, 0.3, BLOCK_C)
    assert state[:3] == (x, y, 0.0)
    gap = 0.05 - x - 0.025 - FINGER
    state = moved(BLOCK, state, (0.05, 0.03725), (-0.05, 0.0), 1.0, 0.3, BLOCK_C)

    # Straight through the centre of mass: the block moves by what is left of the way.
    assert y == pytest.approx(0.03725, rel=1e-14)
    assert state[:3] == pytest.approx((x - 0.05 + gap, y, 0.0), rel=0, abs=1e-9)
    assert state[4:] == (True, STICK)


@pytest.mark.parametrize('spin', [-13.0, 4.0, 40.0])  # [rad] a metre of the finger's way
@pytest.mark.parametrize(
    ('outline', 'nearest', 'sigma', 'beta', 'mu_c'),
    [
        (BLOCK, nearest_on_polygon(CORNERS), 0.018, 1.4, math.inf),
        (BLOCK, nearest_on_polygon(CORNERS), 0.035, 2.0, math.inf),
        (BLOCK, nearest_on_polygon(CORNERS), 0.06, 1.5, math.inf),  # a corner
        (BLOCK, nearest_on_polygon(CORNERS), 0.018, 1.6, 0.3),
        (BLOCK, nearest_on_polygon(CORNERS), 0.03, 1.2, 0.8),
        (DISK, nearest_on_circle(0.0285), 0.01, 1.3, math.inf),
        (DISK, nearest_on_circle(0.0285), 0.01, 2.1, 0.2),
    ],
)
def test_a_turning_disk_pushes_as_simulated_in_the_plane(outline, nearest, sigma, beta, mu_c, spin):
    state, expected, left = both_ways(outline, nearest, sigma, beta, 0.01, mu_c, BLOCK_C, spin=spin)

    assert not left
    assert state[2] == pytest.approx(expected[2], rel=0, abs=ANGLE)
    assert state[:2] == pytest.approx(expected[:2], rel=0, abs=PLACE)


@checked
@given(st.floats(0.01, 0.04), st.floats(0.8, 2.3), st.floats(-40.0, 40.0), ratios)
def test_disk_that_turns_rolls_on_a_sticking_edge(sigma, beta, spin, c):
    # Both surfaces pass the same length: d changes by -r (theta - psi).
    start = (*at_contact(BLOCK, sigma), 0.0, sigma, True)

    velocity = heading(BLOCK, sigma, beta)
    state = moved(BLOCK, start, (0.0, 0.0), velocity, 0.01, math.inf, c, spin=spin)

    if state[5] == STICK and 0.0 < state[3] < 0.05:
        assert state[3] - sigma == pytest.approx(-FINGER * (state[2] - spin * 0.01), abs=1e-12)


@pytest.mark.parametrize('support', [None, 'corners'])
def test_disk_that_turns_one_way_mirrors_the_disk_that_turns_the_other_way(support):
    points = np.ascontiguousarray(np.vstack([CORNERS.T, np.ones(4)])) if support else None
    ends = []
    for side in (1.0, -1.0):
        sigma = 0.025 + side * 0.006
        start = (*at_contact(BLOCK, sigma), 0.0, sigma, True)
        velocity = side * 0.3, 1.0
        x, y, *end = moved(
            BLOCK, start, (0.0, 0.0), velocity, 0.02, 0.4, BLOCK_C, points, spin=side * 20.0
        )
        ends.append((side * x, y, side * end[0], side * (end[1] - 0.025)))
    assert ends[0] == pytest.approx(ends[1], rel=0, abs=1e-8)
    assert ends[0][2] != 0.0


def test_disk_that_turns_with_the_object_keeps_the_contact_where_it_is():
    # As if it were glued on: omega is the spin, found here as the fixed point of the rates.
    path = BLOCK.path(FINGER)
    body, finger = Body(path, BLOCK_C, None), Finger(*friction_cone(math.inf), FINGER)
    spin = 0.0
    for _ in range(60):
        spin, _, _ = push_rates(0.0, 0.035, 0, 0.2, 1.0, body, finger, spin)
    omega, sigma_dot, mode = push_rates(0.0, 0.035, 0, 0.2, 1.0, body, finger, spin)
    assert mode == STICK
    assert omega == pytest.approx(spin, rel=1e-12)
    assert sigma_dot == pytest.approx(0.0, abs=1e-13)
    # Its material moves as the object's does there: v_P of (8), with the disk's centre at r n.
    v_x, v_y, _ = twist_by_the_paper(
        (0.2 - FINGER * spin, 1.0), (0.01, -0.02375), (0.0, 1.0), math.inf, BLOCK_C
    )
    assert 0.2 - FINGER * spin == pytest.approx(v_x + omega * 0.02375, rel=1e-12)
    assert v_y + omega * 0.01 == pytest.approx(1.0, rel=1e-12)


def test_surface_that_passes_decides_on_which_side_the_contact_slips():
    # Straight ahead through the centre of mass: without friction enough, the object follows the
    # surface of the disk, which passes to the left when the disk turns counterclockwise.
    path = BLOCK.path(FINGER)
    body, finger = Body(path, BLOCK_C, None), Finger(*friction_cone(0.1), FINGER)
    modes = [push_rates(0.0, 0.025, 0, 0.0, 1.0, body, finger, s)[2] for s in (40.0, 0.0, -40.0)]
    assert modes == [SLIP_LEFT, STICK, SLIP_RIGHT]
