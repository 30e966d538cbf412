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

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import Disk, Edge, Pose

checked = settings(derandomize=True, deadline=None, max_examples=50)
positions = st.floats(-0.5, 0.5)
angles = st.floats(-3.1, 3.1)
turns = st.floats(-10.0, 10.0)
radii = st.floats(0.001, 0.05)
FINGER = 0.0135


def shifted(finger, theta, along, ahead):
    # Along the tangent (cos, sin) and along the normal (-sin, cos), which points at the object.
    sin, cos = math.sin(theta), math.cos(theta)
    return finger[0] + along * cos - ahead * sin, finger[1] + along * sin + ahead * cos


def close(pose, x, y, angle):
    return (pose.x, pose.y, pose.angle) == pytest.approx((x, y, angle), rel=0, abs=1e-15)


def test_a_contact_right_of_the_middle_of_an_edge_has_a_positive_d():
    # The finger below the block pushes along +y, 6 mm right of the middle, seen from the finger:
    # the contact is the disk's top (0, 13.5 mm), the centre of mass 6 mm left of and 23.75 mm
    # above it.
    pose = Edge(0.05, 0.02375).pose(0.0, 0.006, 0.0, 0.0, 0.0135)

    assert close(pose, -0.006, 0.03725, 0.0)


def test_an_edge_that_stands_upright_as_computed_by_hand():
    # theta = 90 degrees: n = (-1, 0), t = (0, 1). The disk touches at (1 - 0.01, 2). The centre
    # of mass lies 0.02 along n and 0.005 against t from there.
    pose = Edge(0.05, 0.02).pose(math.pi / 2.0, 0.005, 1.0, 2.0, 0.01)

    assert close(pose, 0.97, 1.995, math.pi / 2.0)


def test_an_edge_turned_counterclockwise_as_computed_by_hand():
    # theta = 30 degrees: n = (-1, sqrt 3) / 2, t = (sqrt 3, 1) / 2.
    # (0.03 + 0.02) n - 0.01 t = (-0.025 - 0.005 sqrt 3, 0.025 sqrt 3 - 0.005)
    root = math.sqrt(3.0)

    pose = Edge(0.05, 0.02).pose(math.radians(30.0), 0.01, 0.0, 0.0, 0.03)

    assert close(pose, -0.025 - 0.005 * root, 0.025 * root - 0.005, math.radians(30.0))


def test_a_disk_as_computed_by_hand():
    # theta = 90 degrees: the centre lies 0.01 + 0.02 along n = (-1, 0). The contact has travelled
    # 0.02 along the outline, which is 1 rad of it, so the object itself is at pi/2 - 1.
    pose = Disk(0.02).pose(math.pi / 2.0, 0.02, 1.0, 2.0, 0.01)

    assert close(pose, 0.97, 2.0, math.pi / 2.0 - 1.0)


def test_the_contact_on_a_disk_starts_at_the_point_that_lay_at_theta_0():
    # The object at angle 0, the finger to its left: theta = -90 degrees. That is a quarter of the
    # outline clockwise of the bottom, where theta = 0, hence against the tangent.
    theta, s, gap = Disk(0.02).nearest(Pose(0.0, 0.0, 0.0), -0.05, 0.0, 0.01)

    assert theta == pytest.approx(-math.pi / 2.0, rel=1e-15)
    assert s == pytest.approx(-0.01 * math.pi, rel=1e-15)
    assert gap == pytest.approx(0.02, rel=1e-13)


@checked
@given(turns, st.floats(-0.025, 0.025), positions, positions, radii, radii)
def test_the_pose_of_an_edge_puts_the_contact_on_both_outlines(theta, s, x, y, r, l):
    pose = Edge(0.06, l).pose(theta, s, x, y, r)

    # From the centre of mass, l against the normal and s along the tangent of the turned object.
    contact = shifted((pose.x, pose.y), pose.angle, s, -l)
    assert pose.angle == theta
    assert contact == pytest.approx(shifted((x, y), theta, 0.0, r), rel=0, abs=1e-14)


@checked
@given(turns, st.floats(-0.2, 0.2), positions, positions, radii, radii)
def test_the_pose_of_a_disk_puts_the_same_point_of_it_at_the_contact(theta, s, x, y, r, radius):
    pose = Disk(radius).pose(theta, s, x, y, r)

    # The point at s is the one at the angle s / R from the bottom of the object that is not turned.
    bottom = pose.angle - math.pi / 2.0
    contact = (
        pose.x + radius * math.cos(bottom + s / radius),
        pose.y + radius * math.sin(bottom + s / radius),
    )
    assert contact == pytest.approx(shifted((x, y), theta, 0.0, r), rel=0, abs=1e-13)


@checked
@given(turns, st.floats(-0.025, 0.025), positions, positions, radii, radii)
def test_the_nearest_point_of_an_edge_is_where_the_pose_put_it(theta, s, x, y, r, l):
    edge = Edge(0.06, l)

    assert edge.nearest(edge.pose(theta, s, x, y, r), x, y, r) == pytest.approx(
        (theta, s, 0.0), rel=0, abs=1e-14
    )


@checked
@given(angles, st.floats(-0.2, 0.2), positions, positions, radii, radii)
def test_the_nearest_point_of_a_disk_is_where_the_pose_put_it(theta, s, x, y, r, radius):
    disk = Disk(radius)

    found = disk.nearest(disk.pose(theta, s, x, y, r), x, y, r)

    assert found == pytest.approx((theta, s, 0.0), rel=0, abs=1e-12)


@checked
@given(turns, st.floats(-0.01, 0.01), st.floats(-0.01, 0.01), st.floats(0.0, 0.1))
def test_a_finger_moved_along_and_off_an_edge(theta, s, along, back):
    edge = Edge(0.05, 0.02375)
    pose = edge.pose(theta, s, 0.3, -0.2, FINGER)
    finger = shifted((0.3, -0.2), theta, along, -back)

    assert edge.nearest(pose, *finger, FINGER) == pytest.approx(
        (theta, s + along, back), rel=0, abs=1e-14
    )


@checked
@given(angles, angles, st.floats(0.0, 0.1))
def test_a_finger_moved_around_and_off_a_disk(angle, bearing, back):
    reach = 0.0285 + FINGER + back
    finger = 0.1 + reach * math.sin(bearing), 0.2 - reach * math.cos(bearing)

    theta, s, gap = Disk(0.0285).nearest(Pose(0.1, 0.2, angle), *finger, FINGER)

    # Seen from the object the finger stands at bearing - 90 degrees, so the normal, which points
    # back, is at bearing + 90 degrees.
    assert theta == pytest.approx(bearing, rel=0, abs=1e-13)
    assert s == pytest.approx(0.0285 * (bearing - angle), rel=0, abs=1e-14)
    assert gap == pytest.approx(back, rel=0, abs=1e-14)


def test_a_finger_that_overlaps_a_disk_has_a_negative_gap():
    assert Disk(0.03).nearest(Pose(0.0, 0.0, 0.0), 0.0, -0.035, 0.01)[2] == pytest.approx(-0.005)


@pytest.mark.parametrize('theta', [0.0, 0.5, -2.0])
@pytest.mark.parametrize('side', [-1.0, 1.0])
def test_beside_an_edge_there_is_nothing_to_touch(theta, side):
    edge = Edge(0.05, 0.02375)
    pose = edge.pose(theta, 0.0, 0.0, 0.0, FINGER)

    inside, outside = (
        edge.nearest(pose, *shifted((0.0, 0.0), theta, side * along, -0.001), FINGER)[2]
        for along in (0.02499, 0.02501)
    )

    assert inside == pytest.approx(0.001, rel=0, abs=1e-14)
    assert outside == math.inf


@pytest.mark.parametrize('ahead', [0.001, FINGER + 0.001, FINGER + 0.02375, 0.2])
def test_behind_an_edge_there_is_nothing_to_touch(ahead):
    edge = Edge(0.05, 0.02375)
    pose = edge.pose(0.4, 0.0, 0.0, 0.0, FINGER)

    assert edge.nearest(pose, *shifted((0.0, 0.0), 0.4, 0.0, ahead), FINGER)[2] == math.inf


def test_rounding_does_not_end_a_contact():
    edge = Edge(0.05, 0.02375)
    pose = edge.pose(0.4, 0.0, 0.0, 0.0, FINGER)

    _, _, gap = edge.nearest(pose, *shifted((0.0, 0.0), 0.4, 0.0, 1e-9), FINGER)

    assert gap == pytest.approx(-1e-9, rel=1e-4)


def test_an_edge_ends_and_a_disk_does_not():
    edge = Edge(0.05, 0.02)

    assert [edge.bears(s) for s in (-0.0251, -0.025, 0.0, 0.025, 0.0251)] == [
        False,
        True,
        True,
        True,
        False,
    ]
    assert all(Disk(0.02).bears(s) for s in (-1.0, 0.0, 1.0))


def test_an_edge_is_flat_and_s_is_the_papers_d():
    edge = Edge(0.05, 0.02)

    assert (edge.l, edge.curvature) == (0.02, 0.0)
    assert [edge.d(s) for s in (-0.01, 0.0, 0.02)] == [-0.01, 0.0, 0.02]


def test_a_disk_is_curved_and_has_its_centre_of_mass_on_every_normal():
    disk = Disk(0.02)

    assert (disk.l, disk.curvature) == (0.02, 50.0)
    assert [disk.d(s) for s in (-0.01, 0.0, 0.02)] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize('length', [0.0, -0.01, math.nan, math.inf])
def test_lengths_that_are_none_are_refused(length):
    with pytest.raises(ValueError, match='length:'):
        Edge(length, 0.02)
    with pytest.raises(ValueError, match='l:'):
        Edge(0.05, length)
    with pytest.raises(ValueError, match='radius:'):
        Disk(length)
