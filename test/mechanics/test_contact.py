# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.strategies import convex_polygons
from tactile_push.mechanics import Outline, Pose, clearance, contact, tangent_angle
from tactile_push.mechanics.contact import piece_at, reach, rotated

checked = settings(derandomize=True, deadline=None, max_examples=60)
FINGER = 0.0135
positions = st.floats(-0.3, 0.3)
angles = st.floats(-7.0, 7.0)
radii = st.floats(1e-4, 0.05)
turns = st.floats(-3.0, 3.0)


def walked(corners, r, sigma):
    # Contact point, tangent's angle and the disk's centre after the way sigma of that centre,
    # edge by edge and corner by corner.
    edges = np.roll(corners, -1, axis=0) - corners
    taus = [math.atan2(y, x) for x, y in edges]
    bends = [(after - tau) % (2.0 * math.pi) for tau, after in itertools.pairwise(taus + taus[:1])]
    around = np.hypot(edges[:, 0], edges[:, 1]).sum() + 2.0 * math.pi * r
    sigma %= around
    for corner, edge, tau, bend in zip(corners, edges, taus, bends, strict=True):
        length = math.hypot(*edge)
        if sigma <= length:
            point = corner + sigma / length * edge
            break
        sigma -= length
        point = corner + edge
        if sigma <= bend * r:
            tau += sigma / r
            break
        sigma -= bend * r
        tau += bend
    return point, tau, point + r * np.array([math.sin(tau), -math.cos(tau)])


def distance_to_polygon(corners, x, y):
    # Exact, negative inside.
    edges, offsets = np.roll(corners, -1, axis=0) - corners, np.array([x, y]) - corners
    share = (offsets * edges).sum(axis=1) / (edges * edges).sum(axis=1)
    gaps = offsets - np.clip(share, 0.0, 1.0)[:, np.newaxis] * edges
    nearest = np.hypot(gaps[:, 0], gaps[:, 1]).min()
    inside = (edges[:, 0] * offsets[:, 1] - edges[:, 1] * offsets[:, 0] >= 0.0).all()
    return -nearest if inside else nearest


def sampled(a, b, count=10_000):
    u = np.arange(count) * 2.0 * math.pi / count
    return np.stack([a * np.sin(u), -b * np.cos(u)], axis=1)


def on_path(sigma, path, r):
    # The disk's centre in the object's frame, from the contact that the path gives.
    t_x, t_y, d, l = contact(sigma, piece_at(sigma, path), path, r)
    return np.array([d * t_x + (l + r) * t_y, d * t_y - (l + r) * t_x])


def hardly_bent():
    # Two half circles of radius 20 mm; the lines between them swell by a nanometre.
    turn = np.linspace(-math.pi / 2.0, math.pi / 2.0, 21)
    right = np.stack([0.025 + 0.02 * np.cos(turn), 0.02 * np.sin(turn)], axis=1)
    x = np.linspace(0.02, -0.02, 9)
    top = np.stack([x, 0.02 + 1e-9 * (1.0 - (x / 0.025) ** 2)], axis=1)
    return np.concatenate([right, top, -right, -top])


OUTLINES = {
    'triangle': Outline.polygon([(-0.02, -0.01), (0.03, -0.015), (0.0, 0.03)]),
    'rectangle': Outline.rectangle(0.05, 0.0475),
    'circle': Outline.circle(0.0285),
    'ellipse': Outline.ellipse(0.05, 0.02),
    'hardly bent': Outline.smooth(hardly_bent()),
    'ellipse with its origin aside': Outline.ellipse(0.03, 0.04).about(0.01, -0.02),
}
every_outline = pytest.mark.parametrize('outline', OUTLINES.values(), ids=OUTLINES.keys())


@checked
@given(st.floats(-1e3, 1e3) | st.floats(-0.3, 0.3), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_a_rotation_is_that_of_sine_and_cosine(angle, x, y):
    cos, sin = math.cos(angle), math.sin(angle)

    found = rotated(x, y, angle)

    assert found == pytest.approx((cos * x - sin * y, sin * x + cos * y), rel=0, abs=1e-15)


def test_small_rotations_are_those_of_sine_and_cosine():
    for angle in np.linspace(-0.3, 0.3, 2001):
        assert rotated(1.0, 0.0, float(angle)) == pytest.approx(
            (math.cos(angle), math.sin(angle)), rel=0, abs=1e-15
        )


def test_no_rotation_changes_nothing():
    assert rotated(0.3, -0.7, 0.0) == (0.3, -0.7)


@every_outline
@pytest.mark.parametrize('r', [1e-4, FINGER, 0.1])
def test_every_position_lies_on_the_last_piece_that_starts_before_it(outline, r):
    path = outline.path(r)
    around = path[-1, 0]

    for sigma in np.linspace(0.0, around, 500, endpoint=False):
        expected = max(row for row in range(len(path) - 1) if path[row, 0] <= sigma)
        assert piece_at(float(sigma), path) == expected


@every_outline
@pytest.mark.parametrize('turn', [-1000, -3, -1, 1, 2, 1000])
def test_a_position_lies_where_it_lay_any_number_of_turns_ago(outline, turn):
    path = outline.path(FINGER)
    around = path[-1, 0]

    for row in range(len(path) - 1):
        middle = (path[row, 0] + path[row + 1, 0]) / 2.0
        sigma = middle + turn * around
        piece = piece_at(sigma, path)
        assert piece == row
        assert contact(sigma, piece, path, FINGER) == pytest.approx(
            contact(middle, row, path, FINGER), rel=0, abs=1e-10
        )
        assert tangent_angle(sigma, path) == pytest.approx(
            tangent_angle(middle, path) + turn * 2.0 * math.pi, rel=1e-12, abs=1e-9
        )


@every_outline
@pytest.mark.parametrize('sigma', [-1e-30, -1e-18, 0.0, 1e-30])
def test_a_position_a_rounding_away_from_the_start_is_the_start(outline, sigma):
    path = outline.path(FINGER)

    assert contact(sigma, piece_at(sigma, path), path, FINGER) == pytest.approx(
        contact(0.0, 0, path, FINGER), rel=0, abs=1e-14
    )


@every_outline
def test_the_path_closes_after_a_turn_of_its_tangent(outline):
    path = outline.path(FINGER)
    around = path[-1, 0]

    end = contact(math.nextafter(around, 0.0), len(path) - 2, path, FINGER)

    assert end == pytest.approx(contact(0.0, 0, path, FINGER), rel=0, abs=1e-13)
    assert path[-1, 3] - path[0, 3] == pytest.approx(2.0 * math.pi, rel=1e-15)
    assert (path[-1, 1:3] == path[0, 1:3]).all()
    assert (path[-1, 4:] == path[0, 4:]).all()


@every_outline
@pytest.mark.parametrize('r', [1e-3, FINGER, 0.1])
def test_the_disks_centre_moves_along_the_tangent_at_unit_speed(outline, r):
    path = outline.path(r)
    h = 1e-5 * path[-1, 0]

    for sigma in np.linspace(-0.5, 1.5, 777) * path[-1, 0]:
        t_x, t_y, _, _ = contact(sigma, piece_at(sigma, path), path, r)
        velocity = (on_path(sigma + h, path, r) - on_path(sigma - h, path, r)) / (2.0 * h)
        # Within h of a corner's arc the tangent turns by h / r.
        assert velocity == pytest.approx((t_x, t_y), rel=0, abs=h / r)
        assert math.hypot(t_x, t_y) == pytest.approx(1.0, rel=1e-15)


@every_outline
@pytest.mark.parametrize('r', [1e-3, FINGER])
def test_tangent_and_contact_have_no_jumps(outline, r):
    path = outline.path(r)

    for row in range(1, len(path)):
        sigma = path[row, 0]
        before = contact(math.nextafter(sigma, 0.0), row - 1, path, r)
        after = contact(sigma, min(row, len(path) - 2), path, r)
        assert after == pytest.approx(before, rel=0, abs=1e-13)


@every_outline
def test_the_tangents_angle_is_that_of_the_tangent_and_never_falls(outline):
    path = outline.path(FINGER)
    sigmas = np.linspace(-1.0, 2.0, 1000, endpoint=False) * path[-1, 0]

    taus = [tangent_angle(float(sigma), path) for sigma in sigmas]

    for sigma, tau in zip(sigmas, taus, strict=True):
        t_x, t_y, _, _ = contact(float(sigma), 0, path, FINGER)
        assert (math.cos(tau), math.sin(tau)) == pytest.approx((t_x, t_y), rel=0, abs=1e-13)
    assert (np.diff(taus) >= -1e-14).all()
    assert np.diff(taus).max() < 0.5


@checked
@given(convex_polygons(), radii, turns)
def test_on_a_polygon_d_and_l_are_the_contacts_projections(corners, r, turn):
    path = Outline.polygon(corners).path(r)
    sigma = turn * path[-1, 0]

    t_x, t_y, d, l = contact(sigma, 0, path, r)

    (x, y), tau, _ = walked(corners, r, sigma)
    cos, sin = math.cos(tau), math.sin(tau)
    assert (t_x, t_y) == pytest.approx((cos, sin), rel=0, abs=1e-9)
    assert d == pytest.approx(x * cos + y * sin, rel=0, abs=1e-12)
    assert l == pytest.approx(x * sin - y * cos, rel=0, abs=1e-12)
    assert on_path(sigma, path, r) == pytest.approx(walked(corners, r, sigma)[2], rel=0, abs=1e-12)


@checked
@given(st.floats(1e-3, 0.1), st.floats(-0.9, 0.9), st.floats(-0.4, 0.4), radii, turns)
def test_on_a_circle_d_and_l_are_the_contacts_projections(radius, x, y, r, turn):
    x, y = x * radius, y * radius
    path = Outline.circle(radius).about(x, y).path(r)
    sigma = turn * path[-1, 0]

    t_x, t_y, d, l = contact(sigma, 0, path, r)

    tau = sigma / (radius + r)  # the tangent's angle is 0 at the lowest point
    cos, sin = math.cos(tau), math.sin(tau)
    point = radius * sin - x, -radius * cos - y
    assert path[-1, 0] == pytest.approx(2.0 * math.pi * (radius + r), rel=1e-15)
    assert (t_x, t_y) == pytest.approx((cos, sin), rel=0, abs=1e-13)
    assert d == pytest.approx(point[0] * cos + point[1] * sin, rel=0, abs=1e-14)
    assert l == pytest.approx(point[0] * sin - point[1] * cos, rel=0, abs=1e-14)


@pytest.mark.parametrize(('a', 'b'), [(0.05, 0.03), (0.02, 0.04), (0.03, 0.03)])
def test_on_an_ellipse_d_and_l_are_the_contacts_projections(a, b):
    path = Outline.ellipse(a, b).path(FINGER)

    for sigma in np.linspace(0.0, path[-1, 0], 500):
        t_x, t_y, d, l = contact(sigma, 0, path, FINGER)
        # Where an ellipse has the normal (-t_y, t_x), into it, it lies (a^2 t_y, -b^2 t_x) / l from
        # its centre, with l^2 = a^2 t_y^2 + b^2 t_x^2.
        height = math.hypot(a * t_y, b * t_x)
        x, y = a * a * t_y / height, -b * b * t_x / height
        assert l == pytest.approx(height, rel=0, abs=1e-6)
        assert d == pytest.approx(x * t_x + y * t_y, rel=0, abs=2e-5)
        assert l == pytest.approx(x * t_y - y * t_x, rel=0, abs=1e-6)


@every_outline
def test_the_piece_that_is_supposed_does_not_matter(outline):
    path = outline.path(FINGER)

    for sigma in (np.arange(50) / 50.0 - 0.3) * path[-1, 0] * 1.7:
        found = contact(sigma, piece_at(sigma, path), path, FINGER)
        for row in range(0, len(path) - 1, max(1, len(path) // 20)):
            assert contact(sigma, row, path, FINGER) == pytest.approx(found, rel=0, abs=1e-14)


def test_a_contact_right_of_the_middle_of_an_edge_has_a_positive_d():
    # The finger below the block pushes along +y, 6 mm right of the middle, seen from the finger.
    path = Outline.rectangle(0.05, 0.0475).path(FINGER)

    assert contact(0.025 + 0.006, 0, path, FINGER) == pytest.approx(
        (1.0, 0.0, 0.006, 0.02375), rel=0, abs=1e-16
    )


def test_around_a_corner_the_contact_stays_and_the_edge_turns():
    # A square of side 2 and a disk of radius 1: a third of the lower right corner's arc, which is
    # pi / 2 long, turns the tangent by 30 degrees. Of the corner (1, -1) the projections are
    # (sqrt(3) - 1) / 2 on t = (sqrt 3, 1) / 2 and -(1 + sqrt(3)) / 2 on n = (-1, sqrt 3) / 2.
    path = Outline.rectangle(2.0, 2.0).path(1.0)
    root = math.sqrt(3.0)

    found = contact(2.0 + math.pi / 6.0, 1, path, 1.0)

    expected = (root / 2.0, 0.5, (root - 1.0) / 2.0, (root + 1.0) / 2.0)
    assert found == pytest.approx(expected, rel=1e-14)


def test_the_finger_reaches_an_edge_from_below():
    # theta = 0: 6 mm to the right, and the finger's radius below the edge.
    assert reach(0.0, 0.006, 0.02375, FINGER) == pytest.approx((0.006, -0.03725), rel=1e-15)


def test_the_finger_reaches_an_edge_that_stands_upright():
    # theta = 90 degrees: n = (-1, 0), t = (0, 1); l and the radius lie against n.
    assert reach(math.pi / 2.0, 0.005, 0.02, 0.01) == pytest.approx((0.03, 0.005), rel=1e-14)


def test_the_finger_reaches_an_edge_turned_counterclockwise():
    # theta = 30 degrees: n = (-1, sqrt 3) / 2, t = (sqrt 3, 1) / 2.
    # 0.01 t - (0.03 + 0.02) n = (0.005 sqrt 3 + 0.025, 0.005 - 0.025 sqrt 3)
    root = math.sqrt(3.0)

    assert reach(math.radians(30.0), 0.01, 0.02, 0.03) == pytest.approx(
        (0.005 * root + 0.025, 0.005 - 0.025 * root), rel=1e-14
    )


@every_outline
def test_a_finger_that_reaches_a_contact_is_nearest_to_it(outline):
    path = outline.path(FINGER)
    x, y, angle = 0.1, -0.2, 2.5
    for sigma in np.linspace(-0.5, 1.5, 801) * path[-1, 0]:
        _, _, d, l = contact(sigma, 0, path, FINGER)
        x_f, y_f = reach(angle + tangent_angle(sigma, path), d, l, FINGER)

        found, gap = clearance(Pose(x, y, angle), x + x_f, y + y_f, path, FINGER)

        assert gap == pytest.approx(0.0, abs=1e-14)
        assert math.remainder(found - sigma, path[-1, 0]) == pytest.approx(0.0, abs=1e-13)


@checked
@given(convex_polygons(), radii, positions, positions, angles, st.floats(0.0, 3.0), angles)
def test_the_clearance_of_a_polygon_is_its_distance_less_the_radius(
    corners, r, x, y, angle, away, bearing
):
    # The finger anywhere, from the centre of mass to beyond the object.
    path = Outline.polygon(corners).path(r)
    p_x, p_y = 0.04 * away * math.cos(bearing), 0.04 * away * math.sin(bearing)
    cos, sin = math.cos(angle), math.sin(angle)
    x_f, y_f = x + cos * p_x - sin * p_y, y + sin * p_x + cos * p_y

    sigma, gap = clearance(Pose(x, y, angle), x_f, y_f, path, r)

    assert gap == pytest.approx(distance_to_polygon(corners, p_x, p_y) - r, rel=0, abs=1e-14)
    centre = walked(corners, r, sigma)[2]
    assert math.dist(centre, (p_x, p_y)) == pytest.approx(abs(gap), rel=0, abs=1e-12)


@pytest.mark.parametrize(('a', 'b'), [(0.05, 0.03), (0.02, 0.04), (0.03, 0.03)])
def test_the_clearance_of_an_ellipse_is_its_distance_less_the_radius(a, b):
    path, samples = Outline.ellipse(a, b).path(FINGER), sampled(a, b)
    random = np.random.default_rng(1992)
    for x, y in random.uniform(-0.1, 0.1, (200, 2)):
        expected = distance_to_polygon(samples, x, y) - FINGER

        sigma, gap = clearance(Pose(0.3, -0.2, math.pi / 2.0), 0.3 - y, -0.2 + x, path, FINGER)

        assert gap == pytest.approx(expected, rel=0, abs=1e-6)
        assert math.dist(on_path(sigma, path, FINGER), (x, y)) == pytest.approx(
            abs(gap), rel=0, abs=1e-12
        )


@checked
@given(angles, angles, st.floats(-0.04, 0.2))
def test_the_clearance_of_a_circle_is_known(angle, bearing, back):
    path = Outline.circle(0.0285).path(FINGER)
    away = 0.0285 + FINGER + back
    x_f, y_f = 0.1 + away * math.sin(bearing), 0.2 - away * math.cos(bearing)

    sigma, gap = clearance(Pose(0.1, 0.2, angle), x_f, y_f, path, FINGER)

    # From the lowest point, where the tangent's angle is 0, around by bearing - angle.
    assert gap == pytest.approx(back, rel=0, abs=1e-14)
    assert 0.0 <= sigma <= path[-1, 0]
    assert math.remainder(sigma / (0.0285 + FINGER) - bearing + angle, 2.0 * math.pi) == (
        pytest.approx(0.0, abs=1e-12)
    )


@pytest.mark.parametrize(
    ('along', 'back'), [(0.0, 0.0), (-0.024, 0.05), (0.02, -0.01), (0.01, 1.0)]
)
def test_the_clearance_before_an_edge_is_that_of_the_edge(along, back):
    path = Outline.rectangle(0.05, 0.0475).path(FINGER)

    sigma, gap = clearance(Pose(0.0, 0.0, 0.0), along, -0.02375 - FINGER - back, path, FINGER)

    assert gap == pytest.approx(back, rel=0, abs=1e-16)
    assert sigma == pytest.approx(0.025 + along, rel=1e-15)


def test_the_clearance_before_a_corner_is_that_of_the_corner():
    # 3 and 4 to the side of and below the corner (1, -1) of a square: 5 away.
    path = Outline.rectangle(2.0, 2.0).path(0.5)

    sigma, gap = clearance(Pose(0.0, 0.0, 0.0), 4.0, -5.0, path, 0.5)

    assert gap == pytest.approx(4.5, rel=1e-15)
    assert sigma == pytest.approx(2.0 + 0.5 * math.atan2(3.0, 4.0), rel=1e-15)


@every_outline
def test_the_clearance_of_a_finger_at_the_centre_of_mass_is_negative(outline):
    _, gap = clearance(Pose(0.1, 0.2, 0.3), 0.1, 0.2, outline.path(FINGER), FINGER)

    assert -0.07 < gap < -FINGER
