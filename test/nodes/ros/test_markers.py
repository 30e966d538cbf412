# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from collections import Counter

import numpy as np
import pytest

pytest.importorskip('visualization_msgs')

from builtin_interfaces.msg import Time
from visualization_msgs.msg import Marker

from tactile_push.mechanics import Outline, Slider
from tactile_push.nodes.ros.markers import estimate_markers, rig_markers
from tactile_push.parameters import ActiveSensingParameters
from tactile_push.parameters.active_sensing import make_sensing
from tactile_push.simulation import Rig, RigConfig, paper_block, paper_disk

STAMP = Time(sec=12, nanosec=345)
THETA = math.radians(20.0)
R, L, D = 0.0135, 0.02375, -0.006
NORMAL = (-math.sin(THETA), math.cos(THETA))
TANGENT = (math.cos(THETA), math.sin(THETA))
RAYS = ('contact_normal', 'friction_cone', 'push_ray')


def by_namespace(rig):
    """Return the markers of a rig by their namespace."""
    markers = rig_markers(rig, STAMP).markers
    result = {marker.ns: marker for marker in markers}
    assert len(result) == len(markers)
    return result


def direction(start, end):
    """Return length and angle [degrees] of an arrow."""
    x, y = end.x - start.x, end.y - start.y
    return math.hypot(x, y), math.degrees(math.atan2(y, x))


@pytest.fixture
def lost():
    """Return a rig whose finger has left the object."""
    rig = Rig(paper_block())
    rig.step(0.01, 0.1, belt_running=False)
    assert not rig.touching
    return rig


def test_every_marker_is_in_the_finger_disk_frame_at_the_stamp():
    for marker in by_namespace(Rig(paper_block())).values():
        assert marker.header.frame_id == 'finger_disk'
        assert (marker.header.stamp.sec, marker.header.stamp.nanosec) == (12, 345)


@pytest.mark.parametrize('config', [paper_block(), paper_disk(), paper_block(mu_c=0.0)])
def test_every_marker_can_be_shown(config):
    for marker in by_namespace(Rig(config)).values():
        q = marker.pose.orientation
        assert math.hypot(q.x, q.y, q.z, q.w) == pytest.approx(1.0)
        assert marker.color.a > 0.0
        assert marker.action == Marker.ADD
        assert marker.scale.x > 0.0
        if marker.type == Marker.ARROW:
            assert len(marker.points) == 2
            assert marker.scale.y > 0.0
        elif marker.type == Marker.LINE_LIST:
            assert len(marker.points) == 4
        else:
            assert marker.scale.y > 0.0
            assert marker.scale.z > 0.0


def test_a_lifted_finger_hovers_over_the_object():
    rig = Rig(paper_block())
    down = by_namespace(rig)
    rig.lift()
    lifted = by_namespace(rig)
    top = max(point.z for point in lifted['object'].points)
    height, size = lifted['finger'].pose.position.z, lifted['finger'].scale.z
    assert height - size / 2.0 > top > down['finger'].pose.position.z
    assert {lifted[name].action for name in RAYS} == {Marker.DELETE}


def test_things_shown_are_those_of_the_interface():
    assert set(by_namespace(Rig(paper_block()))) == {'belt', 'object', 'finger', *RAYS}


def triangles_of(marker):
    """Return the triangles of a marker in its own frame, shape (N, 3, 3)."""
    assert marker.type == Marker.TRIANGLE_LIST
    assert (marker.scale.x, marker.scale.y, marker.scale.z) == (1.0, 1.0, 1.0)
    assert len(marker.points) % 3 == 0
    return np.array([(p.x, p.y, p.z) for p in marker.points]).reshape(-1, 3, 3)


def sides_and_top(triangles):
    """Return the triangles of the sides, and those of the top."""
    top = triangles[:, :, 2].min(axis=1) > 0.0
    return triangles[~top], triangles[top]


def area(triangles):
    """Return the sum of the areas, as vectors that stand on the triangles."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return np.cross(edges[:, 0], edges[:, 1]).sum(axis=0) / 2.0


TRIANGLE = [(-0.02, -0.01), (0.03, -0.01), (-0.01, 0.02)]
OBJECTS = {
    'block': paper_block(),
    'disk': paper_disk(),
    'triangle': RigConfig(Slider(Outline.polygon(TRIANGLE), 0.01), 1.0, 0.2, 0.0),
    'ellipse': RigConfig(Slider(Outline.ellipse(0.03, 0.02), 0.01), 1.0, 0.2, 0.0),
}
AREAS = {
    'block': 0.05 * 0.0475,
    'disk': math.pi * 0.0285**2,
    'triangle': 0.05 * 0.03 / 2.0,
    'ellipse': math.pi * 0.03 * 0.02,
}
LENGTHS = {
    'block': 2.0 * (0.05 + 0.0475),
    'disk': 2.0 * math.pi * 0.0285,
    'triangle': 0.05 + math.hypot(0.04, 0.03) + math.hypot(0.01, 0.03),
    'ellipse': 0.158654395893,  # 4 a E(sqrt(1 - b^2 / a^2))
}


@pytest.mark.parametrize('name', OBJECTS)
def test_object_is_the_prism_of_its_outline_on_the_belt(name):
    triangles = triangles_of(by_namespace(Rig(OBJECTS[name]))['object'])
    sides, top = sides_and_top(triangles)
    assert triangles[:, :, 2].min() == 0.0
    height = triangles[:, :, 2].max()
    assert 0.005 < height < 0.05
    # The top, seen from above, and as high sides all around it: curves lose a little by chords.
    assert area(top) == pytest.approx((0.0, 0.0, AREAS[name]), rel=2e-3, abs=1e-12)
    around = sum(np.linalg.norm(area(side[np.newaxis])) for side in sides) / height
    assert around == pytest.approx(LENGTHS[name], rel=1e-3)
    if name in ('block', 'triangle'):
        assert area(top)[2] == pytest.approx(AREAS[name], rel=1e-12)
        assert around == pytest.approx(LENGTHS[name], rel=1e-12)


@pytest.mark.parametrize('name', OBJECTS)
def test_object_shows_its_outside(name):
    # Counterclockwise seen from outside: sides away from the centre, the top up.
    sides, top = sides_and_top(triangles_of(by_namespace(Rig(OBJECTS[name]))['object']))
    for side in sides:
        outward = area(side[np.newaxis])
        assert outward[2] == 0.0
        assert outward @ side.mean(axis=0) > 0.0
    for triangle in top:
        assert area(triangle[np.newaxis])[2] >= 0.0


@pytest.mark.parametrize('name', OBJECTS)
def test_object_has_no_gap_between_its_triangles(name):
    # Each edge belongs to two triangles, in opposite directions, but on the belt, where there is
    # no bottom.
    edges = Counter()
    for triangle in triangles_of(by_namespace(Rig(OBJECTS[name]))['object']).tolist():
        corners = [tuple(corner) for corner in triangle]
        if len(set(corners)) < 3:
            continue  # the fan of the top starts and ends with nothing
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            edges[start, end] += 1
    assert max(edges.values()) == 1
    for start, end in edges:
        assert (end, start) in edges or start[2] == end[2] == 0.0


def footprint(marker):
    """Return the points of the object's marker on the belt, seen from the finger's centre."""
    turn = 2.0 * math.atan2(marker.pose.orientation.z, marker.pose.orientation.w)
    low = triangles_of(marker).reshape(-1, 3)
    low = low[low[:, 2] == 0.0][:, :2]
    x = marker.pose.position.x + low[:, 0] * math.cos(turn) - low[:, 1] * math.sin(turn)
    y = marker.pose.position.y + low[:, 0] * math.sin(turn) + low[:, 1] * math.cos(turn)
    return np.stack([x, y], axis=1)


def test_block_lies_where_it_touches_the_finger():
    block = by_namespace(Rig(paper_block()))['object']
    x = (R + L) * NORMAL[0] - D * TANGENT[0]
    y = (R + L) * NORMAL[1] - D * TANGENT[1]
    assert (block.pose.position.x, block.pose.position.y) == pytest.approx((x, y))
    assert block.pose.position.z == 0.0
    assert block.pose.orientation.z == pytest.approx(math.sin(THETA / 2.0))
    assert block.pose.orientation.w == pytest.approx(math.cos(THETA / 2.0))
    # Its nearest edge lies r from the finger's centre, along the normal.
    along = footprint(block) @ np.array(NORMAL)
    assert along.min() == pytest.approx(R)
    assert along.max() == pytest.approx(R + 0.0475)


def test_disk_lies_where_it_touches_the_finger():
    disk = by_namespace(Rig(paper_disk()))['object']
    assert (disk.pose.position.x, disk.pose.position.y) == pytest.approx(
        ((R + 0.0285) * NORMAL[0], (R + 0.0285) * NORMAL[1])
    )
    assert np.hypot(*footprint(disk).T).min() == pytest.approx(R, abs=1e-4)


def test_finger_is_a_sphere_of_its_radius_at_the_origin():
    rig = Rig(paper_block())
    rig.step(0.003, 0.5)
    finger = by_namespace(rig)['finger']
    assert finger.type == Marker.SPHERE
    assert (finger.pose.position.x, finger.pose.position.y) == (0.0, 0.0)
    assert (finger.scale.x, finger.scale.y, finger.scale.z) == pytest.approx((2.0 * R,) * 3)


def test_belt_lies_under_everything():
    belt = by_namespace(Rig(paper_block()))['belt']
    assert belt.pose.position.z + belt.scale.z / 2.0 == pytest.approx(0.0)


def test_rays_leave_the_contact():
    for name, marker in by_namespace(Rig(paper_block())).items():
        if name in RAYS:
            starts = marker.points[::2]
            for start in starts:
                assert (start.x, start.y) == pytest.approx((R * NORMAL[0], R * NORMAL[1]))


def test_normal_points_into_the_object():
    arrow = by_namespace(Rig(paper_block()))['contact_normal']
    length, angle = direction(*arrow.points)
    assert length > 0.01
    assert angle == pytest.approx(110.0)


@pytest.mark.parametrize(('mu_c', 'alpha'), [(0.0, 0.0), (1.0, 45.0), (math.sqrt(3.0), 60.0)])
def test_friction_cone_opens_by_alpha_to_both_sides(mu_c, alpha):
    cone = by_namespace(Rig(paper_block(mu_c=mu_c)))['friction_cone']
    assert cone.type == Marker.LINE_LIST
    angles = sorted(
        (direction(*cone.points[:2])[1], direction(*cone.points[2:])[1]),
    )
    assert angles == pytest.approx([110.0 - alpha, 110.0 + alpha])


def test_push_ray_points_where_the_finger_goes_on_the_belt():
    rig = Rig(paper_block())
    assert direction(*by_namespace(rig)['push_ray'].points)[1] == pytest.approx(90.0)
    rig.step(0.005, 0.01)  # as fast across the belt as the belt runs
    assert direction(*by_namespace(rig)['push_ray'].points)[1] == pytest.approx(45.0)


def test_rays_are_taken_away_without_contact(lost):
    markers = by_namespace(lost)
    for name in RAYS:
        assert markers[name].action == Marker.DELETE
    for name in ('belt', 'object', 'finger'):
        assert markers[name].action == Marker.ADD


def test_object_moves_back_from_a_finger_that_left_it(lost):
    before = by_namespace(Rig(paper_block()))['object'].pose.position
    after = by_namespace(lost)['object'].pose.position
    assert (after.x - before.x, after.y - before.y) == pytest.approx((-0.001, 0.0), abs=1e-12)


def estimated(**known):
    """Return what is drawn after a contact at THETA, by namespace, and the estimate."""
    p = ActiveSensingParameters(**known)
    estimate = make_sensing(p).tick(0.0, THETA, 0.0, 0.0)
    markers = estimate_markers(estimate, p, STAMP).markers
    return {marker.ns: marker for marker in markers}, estimate


def test_estimated_outline_lies_at_the_pose_and_closes():
    markers, estimate = estimated(edge=0)
    assert list(markers) == ['outline', 'likely', 'possible']
    outline = markers['outline']
    assert outline.header.frame_id == 'finger_disk'
    assert (outline.pose.position.x, outline.pose.position.y) == tuple(estimate.pose[:2])
    assert 2.0 * math.atan2(
        outline.pose.orientation.z, outline.pose.orientation.w
    ) == pytest.approx(estimate.pose[2])
    assert [(point.x, point.y) for point in outline.points] == [
        *((x, y) for x, y in ((-0.025, -L), (0.025, -L), (0.025, L), (-0.025, L))),
        (-0.025, -L),
    ]


def test_centre_of_mass_is_drawn_along_the_intervals_of_d():
    markers, estimate = estimated(edge=0)
    for name, ends in (
        ('likely', (estimate.d.lower, estimate.d.upper)),
        ('possible', (estimate.d.least, estimate.d.most)),
    ):
        for point, d in zip(markers[name].points, ends, strict=True):
            along = point.x * TANGENT[0] + point.y * TANGENT[1]
            off = point.x * NORMAL[0] + point.y * NORMAL[1]
            assert along == pytest.approx(-d, abs=1e-3)
            assert off == pytest.approx(R + L, abs=1e-3)


def test_centre_of_mass_of_a_disk_is_drawn_in_its_middle():
    markers, estimate = estimated(disk_radius=0.0285)
    outline, likely = markers['outline'], markers['likely']
    for point in outline.points:
        assert math.hypot(point.x, point.y) == pytest.approx(0.0285)
    for point in likely.points:
        assert (point.x, point.y) == pytest.approx(tuple(estimate.pose[:2]), abs=1e-3)


def test_nothing_known_clears_the_drawing():
    markers = estimate_markers(None, ActiveSensingParameters(), STAMP).markers
    assert [marker.ns for marker in markers] == ['outline', 'likely', 'possible']
    assert all(marker.action == Marker.DELETE for marker in markers)
