# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Kinematics of the planar finger against hand-drawn examples and its own inverse (V.A)."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.tactile import FingerPose, OutOfReachError, PlanarFinger
from tactile_push.tactile.planar_finger import pole_angle

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
FINGER = PlanarFinger(0.06, 0.08, math.pi / 2.0)

fingers = st.builds(
    PlanarFinger, st.floats(0.01, 0.2), st.floats(0.01, 0.2), st.floats(-math.pi, math.pi)
)


def degrees(*angles):
    return tuple(math.degrees(angle) for angle in angles)


def test_straight_finger_points_along_its_mount_angle():
    pose = FINGER.forward(0.0, 0.0)
    assert (pose.x, pose.y) == pytest.approx((0.0, 0.14), abs=1e-15)
    assert math.degrees(pose.psi) == pytest.approx(90.0)


def test_knuckle_at_the_left_and_tip_straight_ahead():
    # First link along -x, second along +y: the corner of a 6 x 8 cm rectangle.
    pose = FINGER.forward(math.pi / 2.0, -math.pi / 2.0)
    assert (pose.x, pose.y) == pytest.approx((-0.06, 0.08), abs=1e-15)
    assert math.degrees(pose.psi) == pytest.approx(90.0)


def test_joints_turn_counterclockwise():
    pose = PlanarFinger(0.06, 0.08, 0.0).forward(math.radians(30.0), math.radians(60.0))
    assert (pose.x, pose.y) == pytest.approx((0.06 * math.cos(math.pi / 6.0), 0.03 + 0.08))
    assert math.degrees(pose.psi) == pytest.approx(90.0)


def test_inverse_of_the_rectangle_bends_the_second_joint_clockwise():
    assert degrees(*FINGER.inverse(-0.06, 0.08)) == pytest.approx((90.0, -90.0))


def test_inverse_at_ten_centimetres_straight_ahead():
    # Sides 6, 8 and 10: a right angle at the knuckle, and atan(8 / 6) at the first joint.
    proximal, distal = FINGER.inverse(0.0, 0.1)
    assert math.degrees(distal) == pytest.approx(-90.0)
    assert proximal == pytest.approx(math.atan2(0.08, 0.06))


@given(finger=fingers, proximal=st.floats(-3.1, 3.1), distal=st.floats(-3.1, -0.05))
@PROPERTY
def test_inverse_of_forward_gives_the_joint_angles(finger, proximal, distal):
    pose = finger.forward(proximal, distal)
    assert pose.psi == pytest.approx(finger.mount_angle + proximal + distal)
    if math.hypot(pose.x, pose.y) < 1e-3:
        return  # the whole circle of first joint angles leads there
    back = finger.inverse(pose.x, pose.y)
    assert back[1] == pytest.approx(distal, abs=1e-6)
    assert math.remainder(back[0] - proximal, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-5)


@given(finger=fingers, reach=st.floats(0.001, 0.999), direction=st.floats(-math.pi, math.pi))
@PROPERTY
def test_forward_of_inverse_is_the_place_everywhere_in_reach(finger, reach, direction):
    shortest = abs(finger.proximal_length - finger.distal_length)
    longest = finger.proximal_length + finger.distal_length
    distance = shortest + reach * (longest - shortest)
    x, y = distance * math.cos(direction), distance * math.sin(direction)
    proximal, distal = finger.inverse(x, y)
    assert -math.pi <= distal <= 0.0
    assert -math.pi <= proximal <= math.pi
    pose = finger.forward(proximal, distal)
    assert (pose.x, pose.y) == pytest.approx((x, y), abs=1e-9)


@given(finger=fingers, reach=st.floats(0.01, 0.99), direction=st.floats(-math.pi, math.pi))
@PROPERTY
def test_knuckle_lies_to_the_left_of_the_way_to_the_tip(finger, reach, direction):
    shortest = abs(finger.proximal_length - finger.distal_length)
    longest = finger.proximal_length + finger.distal_length
    distance = shortest + reach * (longest - shortest)
    x, y = distance * math.cos(direction), distance * math.sin(direction)
    knuckle = finger.mount_angle + finger.inverse(x, y)[0]
    assert x * math.sin(knuckle) - y * math.cos(knuckle) > 0.0


@given(
    finger=fingers,
    excess=st.floats(0.0001, 10.0),
    direction=st.floats(-math.pi, math.pi),
)
@PROPERTY
def test_place_beyond_the_longest_reach_is_refused(finger, excess, direction):
    distance = finger.proximal_length + finger.distal_length + excess
    with pytest.raises(OutOfReachError):
        finger.inverse(distance * math.cos(direction), distance * math.sin(direction))


def test_place_too_near_is_refused_and_the_message_gives_the_reach():
    with pytest.raises(OutOfReachError, match=r'0\.0200 to 0\.1400 m .* \(0\.0100, 0\.0000\) m'):
        FINGER.inverse(0.01, 0.0)


@pytest.mark.parametrize(('x', 'y'), [(math.nan, 0.1), (0.1, math.nan), (math.inf, 0.0)])
def test_place_that_is_no_place_is_refused(x, y):
    with pytest.raises(OutOfReachError):
        FINGER.inverse(x, y)


def test_tip_turns_clockwise_as_it_moves_right_so_joint_states_matter():
    psi = [FINGER.forward(*FINGER.inverse(x, 0.08)).psi for x in (-0.09, -0.06, -0.03, 0.0)]
    assert psi[1] == pytest.approx(math.pi / 2.0)
    assert psi[0] - psi[1] > math.radians(10.0)
    assert psi[1] - psi[2] > math.radians(10.0)
    assert psi[2] > psi[3]


@given(finger=fingers, proximal=st.floats(-3.0, 3.0), distal=st.floats(-3.0, 3.0))
@PROPERTY
def test_disk_lies_the_second_link_along_the_pole_from_the_knuckle(finger, proximal, distal):
    pose = finger.forward(proximal, distal)
    knuckle_x = pose.x - finger.distal_length * math.cos(pose.psi)
    knuckle_y = pose.y - finger.distal_length * math.sin(pose.psi)
    assert math.hypot(knuckle_x, knuckle_y) == pytest.approx(finger.proximal_length)


def test_pole_angle_is_the_sum_of_mount_and_joint_angles():
    assert pole_angle(1.5, [0.25, -0.5]) == pytest.approx(1.25)
    assert pole_angle(1.5, []) == 1.5


def test_poses_compare_by_value():
    assert FINGER.forward(0.1, -0.2) == FINGER.forward(0.1, -0.2)
    assert FingerPose(0.0, 0.0, 1.0) != FingerPose(0.0, 0.0, 2.0)


@pytest.mark.parametrize('bad', [0.0, -0.01, math.nan, math.inf])
def test_links_have_positive_finite_lengths(bad):
    with pytest.raises(ValueError, match=r'^proximal_length: .*\[m\]'):
        PlanarFinger(bad, 0.08, 0.0)
    with pytest.raises(ValueError, match=r'^distal_length: .*\[m\]'):
        PlanarFinger(0.06, bad, 0.0)


@pytest.mark.parametrize('bad', [math.nan, math.inf])
def test_mount_angle_is_finite(bad):
    with pytest.raises(ValueError, match=r'^mount_angle: .*\[rad\]'):
        PlanarFinger(0.06, 0.08, bad)


def test_tip_turns_clockwise_on_its_way_from_the_rectangle_to_the_right():
    # The knuckle moves up and down there, so the second link alone moves the disk across: 1/b.
    assert FINGER.turning(math.pi / 2.0, -math.pi / 2.0) == pytest.approx(-1.0 / 0.08)


def test_tip_does_not_turn_where_the_first_link_points_along_the_belt():
    assert FINGER.turning(0.0, -1.0) == pytest.approx(0.0, abs=1e-12)


@given(finger=fingers, proximal=st.floats(-3.1, 3.1), distal=st.floats(-2.9, -0.25))
@PROPERTY
def test_turning_is_the_change_of_the_tip_s_angle_across_the_belt(finger, proximal, distal):
    pose, step = finger.forward(proximal, distal), 1e-6
    try:
        left, right = (
            finger.forward(*finger.inverse(pose.x + side, pose.y)).psi for side in (-step, step)
        )
    except OutOfReachError:
        return
    slope = math.remainder(right - left, 2.0 * math.pi) / (2.0 * step)
    assert finger.turning(proximal, distal) == pytest.approx(slope, rel=1e-3, abs=1e-3)


@pytest.mark.parametrize(('proximal', 'sign'), [(0.3, 1.0), (2.0, -1.0)])
def test_stretched_finger_cannot_move_across_without_turning_ever_faster(proximal, sign):
    finger = PlanarFinger(0.06, 0.08, 0.0)
    assert finger.turning(proximal, 0.0) == sign * math.inf


@given(finger=fingers, proximal=st.floats(-3.0, 3.0), distal=st.floats(-3.0, 3.0))
@PROPERTY
def test_levers_are_the_slopes_of_the_disks_place(finger, proximal, distal):
    h = 1e-6
    for joint, lever in enumerate(finger.levers((proximal, distal))):
        there, back = [proximal, distal], [proximal, distal]
        there[joint] += h
        back[joint] -= h
        ends = zip(finger.centre(there), finger.centre(back), strict=True)
        assert lever == pytest.approx([(end - start) / (2.0 * h) for end, start in ends], abs=1e-9)


def test_levers_of_the_rectangle():
    # The disk is 8 cm ahead of the second joint, and 6 cm left of and 8 cm ahead of the first one.
    first, second = FINGER.levers((math.pi / 2.0, -math.pi / 2.0))
    assert first == pytest.approx((-0.08, -0.06))
    assert second == pytest.approx((-0.08, 0.0), abs=1e-15)


@given(finger=fingers, proximal=st.floats(-3.0, 3.0), distal=st.floats(-3.0, 3.0))
@PROPERTY
def test_manipulability_is_the_area_that_the_levers_span_relative_to_the_largest(
    finger, proximal, distal
):
    (x, y), (distal_x, distal_y) = finger.levers((proximal, distal))
    largest = finger.proximal_length * finger.distal_length
    share = abs(x * distal_y - y * distal_x) / largest
    assert finger.manipulability((proximal, distal)) == pytest.approx(share, abs=1e-12)


def test_a_joint_that_passes_the_end_of_its_range_has_moved_the_shorter_way():
    assert FINGER.moved((3.1, 0.2), (-3.1, 0.1)) == pytest.approx((2.0 * math.pi - 6.2, -0.1))
