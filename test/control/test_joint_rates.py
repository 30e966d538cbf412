# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Joint velocities against the finger's kinematics, and against every bound."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import (
    JOINT_LIMIT,
    NO_REASON,
    SINGULAR_POSE,
    WORKSPACE_LIMIT,
    JointBounds,
    check_workspace,
    disk_velocity,
    joint_rates,
)
from tactile_push.tactile import LinearAxis, PlanarFinger

PROPERTY = settings(derandomize=True, deadline=None, max_examples=100)
FINGER = PlanarFinger(0.06, 0.08, math.pi / 2.0)
WIDE = JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0), -1.0, 1.0)
RECTANGLE = (math.pi / 2.0, -math.pi / 2.0)  # knuckle to the left, pole straight ahead
speeds = st.floats(-0.02, 0.02)


@given(proximal=st.floats(-2.9, 2.9), distal=st.floats(-2.7, -0.4), v_x=speeds, v_y=speeds)
@PROPERTY
def test_disk_moves_as_asked(proximal, distal, v_x, v_y):
    found = joint_rates(FINGER, WIDE, (proximal, distal), v_x, v_y)
    assert (found.share, found.limit) == (1.0, NO_REASON)
    h = 1e-6
    after = FINGER.forward(proximal + found.rates[0] * h, distal + found.rates[1] * h)
    before = FINGER.forward(proximal, distal)
    assert (after.x - before.x) / h == pytest.approx(v_x, abs=1e-6)
    assert (after.y - before.y) / h == pytest.approx(v_y, abs=1e-6)
    velocity = disk_velocity(FINGER.levers((proximal, distal)), found.rates)
    assert velocity == pytest.approx((v_x, v_y), abs=1e-12)


def test_at_the_rectangle_the_second_joint_alone_moves_the_disk_across():
    # 8 mm/s at 8 cm; the first joint would only move the knuckle along the belt.
    assert joint_rates(FINGER, WIDE, RECTANGLE, 0.008, 0.0).rates == pytest.approx((0.0, -0.1))


@pytest.mark.parametrize(('v_x', 'v_y'), [(0.02, 0.0), (-0.02, 0.01), (0.003, -0.02)])
def test_both_joints_are_slowed_down_alike_so_that_the_direction_stays(v_x, v_y):
    slow = replace(WIDE, joint_speed=(0.02, 0.05))
    found = joint_rates(FINGER, slow, (1.2, -1.0), v_x, v_y)
    assert 0.0 < found.share < 1.0
    assert found.limit == NO_REASON
    assert abs(found.rates[0]) <= 0.02
    assert abs(found.rates[1]) <= 0.05
    assert math.isclose(abs(found.rates[0]), 0.02) or math.isclose(abs(found.rates[1]), 0.05)
    slowed = disk_velocity(FINGER.levers((1.2, -1.0)), found.rates)
    assert slowed == pytest.approx((found.share * v_x, found.share * v_y), abs=1e-12)


@pytest.mark.parametrize(
    ('joint', 'lower', 'upper', 'outward'),
    # At the rectangle a positive v_x turns the second joint clockwise; v_y the first one, by
    # v_y / -6 cm, and the second one back by as much.
    [
        (1, -math.pi / 2.0 - 1e-3, 3.0, (0.01, 0.0)),
        (1, -3.0, -math.pi / 2.0 + 1e-3, (-0.01, 0.0)),
        (0, math.pi / 2.0 - 1e-3, 3.0, (0.0, 0.01)),
        (0, -3.0, math.pi / 2.0 + 1e-3, (0.0, -0.01)),
    ],
)
def test_joint_at_its_limit_moves_inward_only(joint, lower, upper, outward):
    lowest, highest = [-3.0, -3.0], [3.0, 3.0]
    lowest[joint], highest[joint] = lower, upper
    bounds = replace(WIDE, joint_min=tuple(lowest), joint_max=tuple(highest))
    found = joint_rates(FINGER, bounds, RECTANGLE, *outward)
    assert found == ((0.0, 0.0), 0.0, JOINT_LIMIT)
    back = joint_rates(FINGER, bounds, RECTANGLE, *(-v for v in outward))
    assert back.limit == NO_REASON
    assert back.share == 1.0


def test_a_slower_joint_may_come_nearer_to_its_limit():
    # 5 mm/s at 8 cm: 3 mrad in the time that is looked ahead.
    bounds = replace(WIDE, joint_min=(-3.0, -math.pi / 2.0 - 4e-3))
    assert joint_rates(FINGER, bounds, RECTANGLE, 0.005, 0.0).limit == NO_REASON
    assert joint_rates(FINGER, bounds, RECTANGLE, 0.010, 0.0).limit == JOINT_LIMIT


def test_disk_at_the_end_of_its_workspace_moves_inward_only():
    at_the_left, at_the_right = (
        (replace(WIDE, workspace_min=-0.0601), -0.005),
        (
            replace(WIDE, workspace_max=-0.0599),
            0.005,
        ),
    )
    for bounds, outward in (at_the_left, at_the_right):
        assert joint_rates(FINGER, bounds, RECTANGLE, outward, 0.0).limit == WORKSPACE_LIMIT
        assert joint_rates(FINGER, bounds, RECTANGLE, -outward, 0.0).limit == NO_REASON


@pytest.mark.parametrize('distal', [-0.15, -math.pi + 0.15, 0.15, math.pi - 0.15])
def test_near_a_singular_pose_the_finger_only_moves_away(distal):
    # Its disk comes nearer to the first joint from stretched, and goes away from it from folded.
    pose = FINGER.forward(0.3, distal)
    away = -1.0 if abs(distal) < 1.0 else 1.0
    radial = [0.002 * away * part / math.hypot(pose.x, pose.y) for part in (pose.x, pose.y)]
    free = joint_rates(FINGER, replace(WIDE, joint_max=(3.0, 3.1)), (0.3, distal), *radial)
    assert free.limit == NO_REASON
    assert any(free.rates)
    stuck = joint_rates(FINGER, WIDE, (0.3, distal), *(-v for v in radial))
    assert stuck == ((0.0, 0.0), 0.0, SINGULAR_POSE)


@pytest.mark.parametrize('distal', [0.0, -1e-300, 1e-320])
def test_a_stretched_finger_stands(distal):
    for v_x, v_y in ((0.01, 0.0), (0.0, -0.01), (0.0, 0.0)):
        found = joint_rates(FINGER, WIDE, (0.0, distal), v_x, v_y)
        assert found.rates == (0.0, 0.0)
    assert joint_rates(FINGER, WIDE, (0.0, distal), 0.01, 0.0).limit == SINGULAR_POSE


@given(
    finger=st.builds(PlanarFinger, *[st.floats(1e-3, 1.0)] * 2, st.floats(-6.3, 6.3)),
    joints=st.tuples(*[st.floats(-1e6, 1e6)] * 2) | st.tuples(*[st.floats(-4.0, 4.0)] * 2),
    v=st.tuples(*[st.floats(-1.0, 1.0)] * 2),
    speed=st.tuples(*[st.floats(1e-3, 100.0)] * 2),
)
@PROPERTY
def test_whatever_comes_no_joint_is_faster_than_it_may_be(finger, joints, v, speed):
    bounds = replace(WIDE, joint_speed=speed)
    found = joint_rates(finger, bounds, joints, *v)
    assert all(abs(rate) <= most for rate, most in zip(found.rates, speed, strict=True))
    assert 0.0 <= found.share <= 1.0
    assert not (found.limit and any(found.rates))
    after = [joint + 0.05 * rate for joint, rate in zip(joints, found.rates, strict=True)]
    for joint, before in zip(after, joints, strict=True):
        assert abs(joint) <= max(3.0, abs(before))


AXIS = JointBounds((-0.2,), (0.3,), (0.05,))


def test_an_axis_follows_within_its_bounds():
    assert joint_rates(LinearAxis(), AXIS, (0.0,), 0.01, 0.0) == ((0.01,), 1.0, NO_REASON)
    assert joint_rates(LinearAxis(), AXIS, (0.0,), -0.1, 0.0) == ((-0.05,), 0.5, NO_REASON)
    assert joint_rates(LinearAxis(), AXIS, (0.11,), 0.01, 0.0).limit == WORKSPACE_LIMIT
    short = replace(AXIS, joint_max=(0.05,))
    assert joint_rates(LinearAxis(), short, (0.05,), 0.01, 0.0).limit == JOINT_LIMIT
    assert joint_rates(LinearAxis(), short, (0.05,), -0.01, 0.0).rates == (-0.01,)


def test_joint_limits_that_leave_a_workspace_are_taken():
    check_workspace(FINGER, WIDE)
    check_workspace(LinearAxis(), AXIS)


@pytest.mark.parametrize(
    ('arm', 'bounds', 'reason'),
    [
        # The second link points within 0.1 rad of where the first one does.
        (
            FINGER,
            replace(WIDE, joint_min=(-3.0, -0.1), joint_max=(3.0, 0.1)),
            'a pose that is not stretched',
        ),
        # Knuckle and disk stay left: -6 cm - 8 cm sin(0.5) at the most.
        (
            FINGER,
            replace(WIDE, joint_min=(1.5, -1.1), joint_max=(1.6, -0.9), workspace_min=-0.05),
            'expected x between -0.05 and 1 m, the workspace, got -0.1',
        ),
        (LinearAxis(), replace(AXIS, joint_min=(0.2,)), 'expected x between -0.11 and 0.11 m'),
    ],
)
def test_joint_limits_that_leave_no_workspace_are_refused(arm, bounds, reason):
    with pytest.raises(ValueError, match=f'^joint_min: .*{reason}'):
        check_workspace(arm, bounds)


@pytest.mark.parametrize(
    ('changes', 'name'),
    [
        ({'joint_min': (3.0, -3.0)}, 'joint_min'),
        ({'joint_min': (math.nan, -3.0)}, 'joint_min'),
        ({'joint_max': (math.inf, 3.0)}, 'joint_min'),
        ({'joint_max': (3.0,)}, 'joint_max'),
        ({'joint_speed': (2.0, 2.0, 2.0)}, 'joint_speed'),
        ({'joint_speed': (2.0, 0.0)}, 'joint_speed'),
        ({'joint_speed': (math.nan, 2.0)}, 'joint_speed'),
        ({'workspace_min': 1.0}, 'workspace_min'),
        ({'workspace_max': math.nan}, 'workspace_min'),
    ],
)
def test_bounds_that_are_none_are_refused_by_name(changes, name):
    with pytest.raises(ValueError, match=f'^{name}: expected '):
        replace(WIDE, **changes)
