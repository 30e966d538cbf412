# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.strategies import convex_polygons
from tactile_push.mechanics import Outline, Pose, clearance, contact, tangent_angle

checked = settings(derandomize=True, deadline=None, max_examples=60)
FINGER = 0.0135
angles = st.floats(-7.0, 7.0)
radii = st.floats(1e-4, 0.05)
TRIANGLE = np.array([(-0.02, -0.01), (0.03, -0.015), (0.0, 0.03)])
KITE = np.array([(0.0, -0.03), (0.02, 0.0), (0.0, 0.01), (-0.02, 0.0)])
BLOCK = np.array([(-0.025, -0.02375), (0.025, -0.02375), (0.025, 0.02375), (-0.025, 0.02375)])
every_polygon = pytest.mark.parametrize(
    'corners', [TRIANGLE, KITE, BLOCK], ids=['triangle', 'kite', 'block']
)
ELLIPSES = [(0.05, 0.03), (0.02, 0.05), (0.03, 0.03), (0.05, 0.005), (0.1, 0.02)]


def regular(count, step=1, radius=0.03):
    around = np.arange(count) * step * 2.0 * math.pi / count
    return radius * np.stack([np.cos(around), np.sin(around)], axis=1)


def on_ellipse(a, b, count, first=0.1):
    parameter = first + np.arange(count) * 2.0 * math.pi / count
    return np.stack([a * np.cos(parameter), b * np.sin(parameter)], axis=1)


def off_ellipse(points, a, b):
    # The greatest distance of points that are close to the ellipse F = 0: |F| / |grad F|.
    x, y = points.T
    f = (x / a) ** 2 + (y / b) ** 2 - 1.0
    return np.abs(f / np.hypot(2.0 * x / a**2, 2.0 * y / b**2)).max()


def circumference(a, b):
    # The trapezoidal rule converges exponentially on periodic functions.
    u = np.arange(20_000) * 2.0 * math.pi / 20_000
    return 2.0 * math.pi * np.hypot(a * np.cos(u), b * np.sin(u)).mean()


def stadium(radius, straight, arc_points, straight_points):
    # Two half circles, joined by straight lines with points on them.
    turn = np.linspace(-math.pi / 2.0, math.pi / 2.0, arc_points + 1)
    right = np.stack([straight / 2.0 + radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    share = np.linspace(0.0, 1.0, straight_points + 2)[1:-1, np.newaxis]
    top = (1.0 - share) * right[-1] - share * right[0]
    return np.concatenate([right, top, -right, -top])


def off_outline(outline, points):
    r = 1e-3
    path = outline.path(r)
    return max(abs(clearance(Pose(0.0, 0.0, 0.0), x, y, path, r)[1] + r) for x, y in points)


def ends_of_first_edge(outline):
    x, y, tau, length, turn = outline.pieces[0]
    assert turn == 0.0
    return np.array([(x, y), (x + length * math.cos(tau), y + length * math.sin(tau))])


def same_up_to_order(points, others):
    order, others_order = (sorted(map(tuple, np.round(p, 12))) for p in (points, others))
    return order == others_order


@every_polygon
def test_a_polygon_has_its_corners_counterclockwise_and_starts_with_the_first_edge(corners):
    outline = Outline.polygon(corners)

    assert outline.points(1.0) == pytest.approx(corners, rel=0, abs=1e-17)
    assert ends_of_first_edge(outline) == pytest.approx(corners[:2], rel=0, abs=1e-17)


@every_polygon
def test_a_polygon_given_clockwise_is_the_same_and_keeps_its_first_edge(corners):
    outline = Outline.polygon(corners[::-1])

    # From the last corner to the last but one: the same edge is walked in the other direction.
    assert same_up_to_order(outline.points(1.0), corners)
    assert ends_of_first_edge(outline) == pytest.approx(corners[[-2, -1]], rel=0, abs=1e-16)
    assert (outline.pieces[:, 4] >= 0.0).all()


@checked
@given(convex_polygons(), st.booleans())
def test_a_polygons_pieces_are_its_edges_and_the_angles_between_them(corners, clockwise):
    outline = Outline.polygon(corners[::-1] if clockwise else corners)

    edges = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    cosines = (edges * np.roll(edges, -1, axis=0)).sum(axis=1) / lengths / np.roll(lengths, -1)
    assert outline.length == pytest.approx(lengths.sum(), rel=1e-14)
    edge_rows, corner_rows = outline.pieces[::2], outline.pieces[1::2]
    assert sorted(edge_rows[:, 3]) == pytest.approx(sorted(lengths), rel=1e-12)
    assert (edge_rows[:, 4] == 0.0).all()
    assert (corner_rows[:, 3] == 0.0).all()
    assert sorted(np.cos(corner_rows[:, 4])) == pytest.approx(sorted(cosines), rel=0, abs=1e-12)
    assert corner_rows[:, 4].sum() == pytest.approx(2.0 * math.pi, rel=1e-14)
    # The object lies on the left: each edge's end is where its length along tau leads.
    along = np.stack([np.cos(edge_rows[:, 2]), np.sin(edge_rows[:, 2])], axis=1)
    ends = edge_rows[:, :2] + edge_rows[:, 3:4] * along
    assert ends == pytest.approx(np.roll(edge_rows[:, :2], -1, axis=0), rel=0, abs=1e-15)
    assert corner_rows[:, :2] == pytest.approx(ends, rel=0, abs=1e-15)


@every_polygon
@pytest.mark.parametrize('turn', [1, 2])
def test_corners_on_straight_lines_are_left_out(corners, turn):
    # Two more on every edge; the list starts with a true corner.
    share = np.array([0.0, 0.3, 0.8])[:, np.newaxis]
    more = np.concatenate(
        [
            (1.0 - share) * a + share * b
            for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)
        ]
    )
    more = np.roll(more, 3 * turn, axis=0)

    outline = Outline.polygon(more)

    assert len(outline.pieces) == 2 * len(corners)
    assert outline.points(1.0) == pytest.approx(np.roll(corners, turn, axis=0), rel=0, abs=1e-16)


@every_polygon
@pytest.mark.parametrize('clockwise', [False, True])
def test_the_first_edge_stays_the_first_if_its_first_corner_is_left_out(corners, clockwise):
    # The middle of the last edge comes first: the first edge is what is left of this one.
    first, last = corners[0], corners[-1]
    more = np.array([(first + last) / 2.0, *corners])
    if clockwise:
        more = np.array([(first + last) / 2.0, *corners[::-1]])

    outline = Outline.polygon(more)

    assert ends_of_first_edge(outline) == pytest.approx(np.array([last, first]), rel=0, abs=1e-16)


def test_a_rectangle_is_a_polygon_that_starts_below():
    outline = Outline.rectangle(0.05, 0.0475)

    assert outline.points(1.0) == pytest.approx(BLOCK, rel=0, abs=1e-17)
    assert outline.pieces[0] == pytest.approx((-0.025, -0.02375, 0.0, 0.05, 0.0), rel=1e-15)
    assert outline.length == pytest.approx(0.195, rel=1e-15)


def test_whole_numbers_make_a_polygon():
    outline = Outline.polygon([(0, 0), (3, 0), (0, 4)])

    assert outline.length == 12.0


@pytest.mark.parametrize('count', [3, 4, 100, 3000])
@pytest.mark.parametrize('size', [1e-6, 1e-2, 1e3])
def test_a_regular_polygon_of_any_size_keeps_its_corners(count, size):
    outline = Outline.polygon(regular(count, radius=size))

    assert len(outline.points(1.0)) == count
    assert outline.length == pytest.approx(
        2.0 * count * size * math.sin(math.pi / count), rel=1e-12
    )


def test_a_circle_is_one_arc_from_its_lowest_point():
    outline = Outline.circle(0.03)

    assert outline.pieces == pytest.approx(
        np.array([(0.0, -0.03, 0.0, 2.0 * math.pi * 0.03, 2.0 * math.pi)]), rel=1e-15
    )
    points = outline.points(1e-3)
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(0.03, rel=1e-14)
    assert points[0] == pytest.approx((0.0, -0.03), rel=1e-15)


@pytest.mark.parametrize('spacing', [1e-4, 1e-3, 0.03])
@pytest.mark.parametrize(
    'outline', [Outline.circle(0.03), Outline.ellipse(0.05, 0.02)], ids=['circle', 'ellipse']
)
def test_points_on_arcs_are_no_further_apart_than_asked(outline, spacing):
    points = outline.points(spacing)

    chords = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    assert chords.min() > 0.0
    assert chords.max() <= spacing
    # Counterclockwise: the area enclosed is positive.
    after = np.roll(points, -1, axis=0)
    assert (points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]).sum() > 0.0


@pytest.mark.parametrize(('a', 'b'), ELLIPSES)
def test_an_ellipse_is_one_within_a_micrometre(a, b):
    outline = Outline.ellipse(a, b)

    assert off_ellipse(outline.points(1e-5), a, b) < 1e-6
    assert outline.length == pytest.approx(circumference(a, b), rel=1e-6)
    assert outline.pieces[0, :3] == pytest.approx((0.0, -b, 0.0), rel=0, abs=1e-16)


@pytest.mark.parametrize(('a', 'b'), ELLIPSES)
def test_an_ellipse_has_the_tangents_of_one(a, b):
    path = Outline.ellipse(a, b).path(FINGER)

    for sigma in np.linspace(0.0, path[-1, 0], 2000):
        t_x, t_y, d, l = contact(sigma, 0, path, FINGER)
        x, y = d * t_x + l * t_y, d * t_y - l * t_x
        # The gradient (x / a^2, y / b^2) has the direction of -n = (t_y, -t_x).
        across = t_x * x / a**2 + t_y * y / b**2
        assert across / math.hypot(x / a**2, y / b**2) == pytest.approx(0.0, abs=2e-3)


@pytest.mark.parametrize(('a', 'b'), ELLIPSES)
def test_an_ellipse_joins_its_arcs_without_corners(a, b):
    pieces = Outline.ellipse(a, b).pieces
    x, y, tau, length, turn = pieces.T

    assert (length > 0.0).all()
    assert (turn > 0.0).all()
    assert turn.sum() == pytest.approx(2.0 * math.pi, rel=1e-13)
    assert np.append(tau, tau[0] + 2.0 * math.pi)[1:] == pytest.approx(tau + turn, rel=0, abs=1e-12)
    radius = length / turn
    end_x = x + radius * (np.sin(tau + turn) - np.sin(tau))
    end_y = y - radius * (np.cos(tau + turn) - np.cos(tau))
    assert end_x == pytest.approx(np.roll(x, -1), rel=0, abs=1e-13)
    assert end_y == pytest.approx(np.roll(y, -1), rel=0, abs=1e-13)


@pytest.mark.parametrize('clockwise', [False, True])
@pytest.mark.parametrize(('a', 'b'), [(0.05, 0.03), (0.05, 0.02), (0.02, 0.04)])
def test_the_error_of_a_smooth_outline_falls_with_the_third_power(a, b, clockwise):
    errors = [
        off_ellipse(Outline.smooth(points[::-1] if clockwise else points).points(1e-5), a, b)
        for points in (on_ellipse(a, b, count) for count in (48, 96, 192, 384))
    ]

    powers = np.log2(np.divide(errors[:-1], errors[1:]))
    assert powers == pytest.approx(3.0, abs=0.2)
    assert errors[-1] < 1e-7


@pytest.mark.parametrize('count', [3, 4, 7, 100])
def test_a_smooth_outline_of_points_on_a_circle_is_the_circle(count):
    points = Outline.smooth(regular(count)).points(1e-4)

    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(0.03, rel=1e-14)


@checked
@given(convex_polygons(), st.booleans())
def test_a_smooth_outline_passes_through_its_points_and_starts_at_the_first(points, clockwise):
    if clockwise:
        points = points[::-1]

    outline = Outline.smooth(points)

    assert off_outline(outline, points) < 1e-15 + 1e-13 * outline.length
    assert (outline.pieces[:, 4] > 0.0).all()
    assert outline.pieces[:, 4].sum() == pytest.approx(2.0 * math.pi, rel=1e-12)
    if not clockwise:
        assert outline.pieces[0, :2] == pytest.approx(points[0], rel=0, abs=1e-17)


@checked
@given(convex_polygons())
def test_a_smooth_outline_has_the_tangents_of_circles_through_three_points(points):
    outline = Outline.smooth(points)

    for i, (x, y) in enumerate(points):
        # The centre of the circle: as far from the neighbours as from the point.
        around = np.array([points[i - 1], points[(i + 1) % len(points)]]) - (x, y)
        centre = np.linalg.solve(2.0 * around, (around**2).sum(axis=1))
        starts = np.hypot(*(outline.pieces[:, :2] - (x, y)).T)
        tau = outline.pieces[np.argmin(starts), 2]
        assert (math.cos(tau), math.sin(tau)) == pytest.approx(
            (centre[1] / math.hypot(*centre), -centre[0] / math.hypot(*centre)), rel=0, abs=1e-9
        )


@pytest.mark.parametrize('straight_points', [0, 1, 5])
def test_a_smooth_outline_passes_through_points_on_straight_lines_too(straight_points):
    points = stadium(0.02, 0.05, 20, straight_points)

    assert off_outline(Outline.smooth(points), points) < 1e-12


def test_a_smooth_outline_of_many_points_on_a_stadium_is_the_stadium():
    outline = Outline.smooth(stadium(0.02, 0.05, 50, 50))

    # Where the curvature jumps an error of the second power is left: spacing^2 / 8 R < 1e-5 m.
    x, y = np.abs(outline.points(1e-4)).T
    distance = np.where(x < 0.025, y, np.hypot(x - 0.025, y)) - 0.02
    assert np.abs(distance).max() < 1e-5


@checked
@given(convex_polygons(), st.floats(-0.9, 0.9), st.floats(0.0, 1.0))
def test_an_outline_about_another_point_is_moved(corners, share, along):
    # A point between the first corner and one inside.
    x, y = abs(share) * (corners[0] + along * (corners[1] - corners[0]))

    moved = Outline.polygon(corners).about(x, y)

    assert moved.points(1.0) == pytest.approx(corners - (x, y), rel=0, abs=1e-16)


def test_moved_about_twice_an_outline_moves_by_both():
    outline = Outline.ellipse(0.05, 0.03)

    twice = outline.about(0.01, 0.02).about(-0.01, -0.02)

    assert twice.pieces == pytest.approx(outline.pieces, rel=0, abs=1e-17)


@pytest.mark.parametrize('place', [(0.0251, 0.0), (0.0, -0.0238), (1.0, 1.0), (math.nan, 0.0)])
def test_a_point_outside_is_no_origin(place):
    with pytest.raises(ValueError, match='x, y: .* inside the outline, got') as refused:
        Outline.rectangle(0.05, 0.0475).about(*place)
    assert str(place[0]) in str(refused.value)
    assert str(place[1]) in str(refused.value)


@checked
@given(convex_polygons(), st.lists(st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))))
def test_points_inside_are_left_of_every_edge(corners, points):
    found = Outline.polygon(corners).contains(points) if points else np.array([])

    for (x, y), inside in zip(points, found, strict=True):
        edges, offsets = np.roll(corners, -1, axis=0) - corners, np.array([x, y]) - corners
        left = (edges[:, 0] * offsets[:, 1] - edges[:, 1] * offsets[:, 0]) / np.hypot(*edges.T)
        if abs(left.min()) > 1e-12:
            assert inside == (left.min() > 0.0)


def test_points_on_the_outline_are_inside_with_a_slack():
    outline = Outline.circle(0.03)
    points = regular(50) * np.array([0.99999, 1.0, 1.00001, 1.0001, 2.0])[:, np.newaxis, np.newaxis]

    for on, inside in zip(points, [True, True, True, False, False], strict=True):
        assert (outline.contains(on, 1e-6) == inside).all()


def test_no_point_is_inside_that_is_not_a_number():
    assert not Outline.circle(0.03).contains([(math.nan, 0.0), (0.0, math.inf)]).any()


@every_polygon
@pytest.mark.parametrize('r', [1e-4, FINGER, 0.1])
def test_the_path_around_a_polygon_is_longer_by_the_disks_circumference(corners, r):
    outline = Outline.polygon(corners)

    assert outline.path(r)[-1, 0] == pytest.approx(outline.length + 2.0 * math.pi * r, rel=1e-14)


@pytest.mark.parametrize(('a', 'b'), ELLIPSES)
def test_the_path_around_an_ellipse_is_longer_by_the_disks_circumference(a, b):
    path = Outline.ellipse(a, b).path(FINGER)

    expected = circumference(a, b) + 2.0 * math.pi * FINGER
    assert path[-1, 0] == pytest.approx(expected, rel=1e-6)


@checked
@given(convex_polygons(), radii, st.floats(0.0, 1.0, exclude_max=True), st.integers(-2, 2))
def test_a_contact_on_a_polygon_is_found_by_its_tangent_and_d(corners, r, share, turn):
    outline = Outline.polygon(corners)
    path = outline.path(r)
    expected = share * path[-1, 0]
    tau = tangent_angle(expected, path) + turn * 2.0 * math.pi
    _, _, d, _ = contact(expected, 0, path, r)

    sigma = outline.sigma(r, tau, d)

    assert math.remainder(sigma - expected, path[-1, 0]) == pytest.approx(0.0, abs=1e-9)


@checked
@given(st.floats(0.0, 1.0, exclude_max=True), st.integers(-2, 2), st.booleans())
def test_a_contact_on_an_ellipse_is_found_by_its_tangent(share, turn, by_d):
    outline = Outline.ellipse(0.05, 0.03).about(0.01, 0.01)
    path = outline.path(FINGER)
    expected = share * path[-1, 0]
    tau = tangent_angle(expected, path) + turn * 2.0 * math.pi
    _, _, d, _ = contact(expected, 0, path, FINGER)

    sigma = outline.sigma(FINGER, tau, d if by_d else None)

    assert math.remainder(sigma - expected, path[-1, 0]) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize('edge', [0, 1, 2, 3])
def test_every_edge_of_a_block_is_found_by_its_angle(edge):
    # Edges of 50 and 47.5 mm, between them the disk turns by 90 degrees.
    lengths = [0.05, 0.0475, 0.05, 0.0475]
    start = sum(lengths[:edge]) + edge * math.pi / 2.0 * FINGER
    outline = Outline.rectangle(0.05, 0.0475)

    for d in (-0.02, 0.0, 0.006, 0.02):
        assert outline.sigma(FINGER, edge * math.pi / 2.0, d) == pytest.approx(
            start + lengths[edge] / 2.0 + d, rel=1e-13
        )


@pytest.mark.parametrize('edge', [0, 1, 2, 3])
def test_without_a_d_the_contact_is_the_edges_nearest_to_the_centre_of_mass(edge):
    lengths = [0.05, 0.0475, 0.05, 0.0475]
    start = sum(lengths[:edge]) + edge * math.pi / 2.0 * FINGER

    sigma = Outline.rectangle(0.05, 0.0475).sigma(FINGER, edge * math.pi / 2.0)

    assert sigma == pytest.approx(start + lengths[edge] / 2.0, rel=1e-13)


def test_without_a_tangent_the_contact_is_on_the_first_edge():
    block = Outline.rectangle(0.05, 0.0475)

    assert block.sigma(FINGER) == pytest.approx(0.025, rel=1e-15)
    assert block.sigma(FINGER, d=-0.006) == pytest.approx(0.019, rel=1e-14)
    assert Outline.circle(0.03).sigma(FINGER) == 0.0


def test_where_no_point_of_an_edge_is_before_the_centre_of_mass_its_end_is_the_nearest():
    # The first edge lies wholly to the left, d from -30 to -10 mm.
    outline = Outline.polygon([(-0.03, -0.01), (-0.01, -0.01), (0.05, 0.03), (-0.03, 0.03)])

    assert outline.sigma(FINGER) == pytest.approx(0.02, rel=1e-14)


@pytest.mark.parametrize('d', [-0.0251, 0.0251, math.nan, math.inf])
def test_a_contact_beyond_the_edge_is_refused(d):
    with pytest.raises(ValueError, match=f'd: expected a contact .* got {d}'):
        Outline.rectangle(0.05, 0.0475).sigma(FINGER, 0.0, d)


@pytest.mark.parametrize('d', [-0.001, 0.001])
def test_a_contact_off_a_circle_is_refused(d):
    with pytest.raises(ValueError, match=f'd: .* got {d}'):
        Outline.circle(0.03).sigma(FINGER, 0.3, d)


@pytest.mark.parametrize('tau', [math.nan, math.inf])
def test_a_tangent_that_has_no_angle_is_refused(tau):
    with pytest.raises(ValueError, match=f'tau: .* got {tau}'):
        Outline.rectangle(0.05, 0.0475).sigma(FINGER, tau)


@pytest.mark.parametrize('length', [0.0, -0.01, math.nan, math.inf])
@pytest.mark.parametrize(
    ('name', 'make'),
    [
        ('radius', Outline.circle),
        ('width', lambda length: Outline.rectangle(length, 0.02)),
        ('height', lambda length: Outline.rectangle(0.02, length)),
        ('a', lambda length: Outline.ellipse(length, 0.02)),
        ('b', lambda length: Outline.ellipse(0.02, length)),
        ('r', Outline.circle(0.02).path),
        ('r', Outline.circle(0.02).sigma),
    ],
)
def test_lengths_that_are_none_are_refused(length, name, make):
    with pytest.raises(ValueError, match=f'^{name}: expected a positive length .* got {length}$'):
        make(length)


NOT_CONVEX = {
    'dented': [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5)],
    'an arrow': [(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (1.0, 1.0)],
    'a figure of eight': [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)],
    'a pentagram': regular(5, 2),
    'a heptagram': regular(7, 3),
    'a triangle walked twice': np.concatenate([TRIANGLE, TRIANGLE]),
    'out and back': [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0)],
}
NO_POLYGON = {
    'nothing': [],
    'two points': [(0.0, 0.0), (1.0, 0.0)],
    'points in space': [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)],
    'numbers': [0.0, 1.0, 2.0],
    'NaN': [(0.0, 0.0), (1.0, math.nan), (0.0, 1.0)],
    'infinity': [(0.0, 0.0), (math.inf, 0.0), (0.0, 1.0)],
    'a point twice': [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
    'the first point again': [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)],
    'one point': [(0.1, 0.2)] * 4,
}
makers = pytest.mark.parametrize(
    ('name', 'make'), [('vertices', Outline.polygon), ('points', Outline.smooth)]
)


@makers
@pytest.mark.parametrize('clockwise', [False, True])
@pytest.mark.parametrize('points', NOT_CONVEX.values(), ids=NOT_CONVEX.keys())
def test_outlines_that_are_not_convex_or_cross_themselves_are_refused(
    name, make, clockwise, points
):
    if clockwise:
        points = points[::-1]
    with pytest.raises(ValueError, match=f'^{name}: expected a convex outline .* got ') as refused:
        make(points)
    if len(points) <= 8:
        assert str(np.asarray(points)[0].tolist()) in str(refused.value)


@makers
@pytest.mark.parametrize('points', NO_POLYGON.values(), ids=NO_POLYGON.keys())
def test_points_that_make_no_polygon_are_refused(name, make, points):
    with pytest.raises(ValueError, match=f'^{name}: expected ') as refused:
        make(points)
    assert str(np.asarray(points, dtype=float).tolist()) in str(refused.value)


@makers
@checked
@given(angles, st.lists(st.integers(-100, 100), min_size=3, max_size=6, unique=True))
def test_points_on_one_line_are_refused(name, make, angle, places):
    points = [(0.1 + 0.01 * s * math.cos(angle), 0.3 + 0.01 * s * math.sin(angle)) for s in places]

    with pytest.raises(ValueError, match=f'^{name}: '):
        make(points)
