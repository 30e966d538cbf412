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
"""The rig as RViz shows it, against its geometry worked out by hand."""

import math

import pytest

pytest.importorskip('visualization_msgs')

from rclpy.time import Time
from visualization_msgs.msg import Marker

from tactile_push.nodes.markers import rig_markers
from tactile_push.simulation import Rig, paper_block, paper_disk

STAMP = Time(seconds=12, nanoseconds=345)
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


def test_things_shown_are_those_of_the_interface():
    assert set(by_namespace(Rig(paper_block()))) == {'belt', 'object', 'finger', *RAYS}


def test_block_lies_where_it_touches_the_finger():
    block = by_namespace(Rig(paper_block()))['object']
    assert block.type == Marker.CUBE
    assert (block.scale.x, block.scale.y) == pytest.approx((0.05, 0.0475))
    x = (R + L) * NORMAL[0] - D * TANGENT[0]
    y = (R + L) * NORMAL[1] - D * TANGENT[1]
    assert (block.pose.position.x, block.pose.position.y) == pytest.approx((x, y))
    assert block.pose.orientation.z == pytest.approx(math.sin(THETA / 2.0))
    assert block.pose.orientation.w == pytest.approx(math.cos(THETA / 2.0))
    # It stands on the belt.
    assert block.pose.position.z == pytest.approx(block.scale.z / 2.0)


def test_disk_lies_where_it_touches_the_finger():
    disk = by_namespace(Rig(paper_disk()))['object']
    assert disk.type == Marker.CYLINDER
    assert (disk.scale.x, disk.scale.y) == pytest.approx((0.057, 0.057))
    assert (disk.pose.position.x, disk.pose.position.y) == pytest.approx(
        ((R + 0.0285) * NORMAL[0], (R + 0.0285) * NORMAL[1])
    )


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
