# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.strategies import corners_on_ellipses
from tactile_push.mechanics import (
    FREE,
    MODES,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    Outline,
    Slider,
    Support,
)
from tactile_push.simulation import Rig, RigConfig, paper_block, paper_disk
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.servo import Servo
from tactile_push.tactile import PlanarFinger, contact_of_reading

PROPERTY = settings(derandomize=True, deadline=None, max_examples=40)
V_Y = 0.005
R = 0.0135
BLOCK_L = 0.02375
C_UNIFORM = 0.0187
DISK_RADIUS = 0.0285
DISK_C = 0.019  # 2 R / 3: the mean distance from the centre, support uniform
PENETRATION = 1e-9
BLOCK = np.array([(-5.0, -4.75), (5.0, -4.75), (5.0, 4.75), (-5.0, 4.75)]) / 200.0


def runge_kutta(rates, state, duration, steps=2000):
    """Integrate by the classical method of order 4."""
    h = duration / steps
    for _ in range(steps):
        a = rates(state)
        b = rates([x + h / 2 * k for x, k in zip(state, a, strict=True)])
        c = rates([x + h / 2 * k for x, k in zip(state, b, strict=True)])
        d = rates([x + h * k for x, k in zip(state, c, strict=True)])
        state = [
            x + h / 6 * (p + 2 * q + 2 * r + s)
            for x, p, q, r, s in zip(state, a, b, c, d, strict=True)
        ]
    return state


def sticking_edge(v_x, v_y, l=BLOCK_L, c=C_UNIFORM):
    """Return the rates of (theta, d, x, y of the CM) by (9)-(11) and (16), in the fixed frame."""

    def rates(state):
        theta, d, _, _ = state
        t_x, t_y, n_x, n_y = math.cos(theta), math.sin(theta), -math.sin(theta), math.cos(theta)
        x_c, y_c = d * t_x - l * n_x, d * t_y - l * n_y
        square = c**2 + x_c**2 + y_c**2
        x_dot = ((c**2 + x_c**2) * v_x + x_c * y_c * v_y) / square
        y_dot = (x_c * y_c * v_x + (c**2 + y_c**2) * v_y) / square
        omega = (x_c * y_dot - y_c * x_dot) / c**2
        return [omega, -omega * R, x_dot, y_dot]

    return rates


def frictionless_edge(v_x, v_y, l, c):
    """Return the rates of (theta, d, x, y of the CM) under a force along the normal.

    With f = n the moment is d, so by (4), (5) v = v_n n and omega = v_n d / c^2; the contact
    advances with the finger along the normal, v_n + omega d = v_p . n.
    """

    def rates(state):
        theta, d, _, _ = state
        along = v_x * math.cos(theta) + v_y * math.sin(theta)
        v_n = (v_y * math.cos(theta) - v_x * math.sin(theta)) / (1.0 + d**2 / c**2)
        omega = v_n * d / c**2
        slip = along - omega * l
        return [omega, slip - omega * R, -v_n * math.sin(theta), v_n * math.cos(theta)]

    return rates


def center_of(theta, d, finger_x, finger_y, l):
    """Return the CM: r n from the finger to the contact, and from there -(d t - l n)."""
    return (
        finger_x - (R + l) * math.sin(theta) - d * math.cos(theta),
        finger_y + (R + l) * math.cos(theta) - d * math.sin(theta),
    )


def rectangle(width, height):
    return np.array([(-width, -height), (width, -height), (width, height), (-width, height)]) / 2.0


def on_belt(corners, pose):
    """Return corners given in the object's frame where they lie on the belt."""
    cos, sin = math.cos(pose.angle), math.sin(pose.angle)
    return corners @ np.array([(cos, sin), (-sin, cos)]) + (pose.x, pose.y)


def nearest(corners, pose, x, y):
    """Return the distance of the finger's disk at (x, y) to a polygon and the unit normal there.

    The distance to every edge by plane geometry; negative where the disk's centre is inside. The
    normal points from the disk into the object.
    """
    start = on_belt(corners, pose)
    edge = np.roll(start, -1, axis=0) - start
    to_finger = np.array((x, y)) - start
    share = np.clip((edge * to_finger).sum(axis=1) / (edge**2).sum(axis=1), 0.0, 1.0)
    away = to_finger - share[:, None] * edge
    distance = np.hypot(away[:, 0], away[:, 1])
    inside = np.all(edge[:, 0] * to_finger[:, 1] - edge[:, 1] * to_finger[:, 0] > 0.0)
    i = int(np.argmin(distance))
    return (-distance[i] if inside else distance[i]) - R, -away[i] / distance[i]


def polygon_gap(corners, rig):
    return nearest(corners, rig.object_pose, rig.finger_x, rig.finger_y)[0]


def config_of(corners, theta=0.0, share=0.5, mu_c=math.inf, c=C_UNIFORM, exact=False):
    """Put the finger at a share of a polygon's first edge; return the corners about the CM, too.

    The support of an exact limit surface is halfway between the origin and the corners.
    """
    points = None
    if exact:
        centre = corners.mean(axis=0) / 2.0
        support, corners = corners / 2.0 - centre, corners - centre
        c = np.hypot(*support.T).mean()
        points = np.vstack([support.T, np.ones(len(support))])
    along = (corners[1] - corners[0]) / math.hypot(*(corners[1] - corners[0]))
    first, last = along @ corners[0], along @ corners[1]
    slider = Slider(Outline.polygon(corners), c, points)
    return RigConfig(slider, mu_c, theta, first + share * (last - first)), corners


def block_config(theta=0.0, d=0.0, mu_c=math.inf, width=0.05, l=BLOCK_L, c=C_UNIFORM):
    return RigConfig(Slider(Outline.rectangle(width, 2.0 * l), c), mu_c, theta, d)


@given(theta=st.floats(-1.5, 1.5), d=st.floats(-0.025, 0.025))
@PROPERTY
def test_rig_starts_as_configured_and_in_contact(theta, d):
    rig = Rig(paper_block(theta, d))
    assert (rig.theta, rig.d, rig.gap) == pytest.approx((theta, d, 0.0), abs=1e-15)
    assert rig.touching
    assert (rig.finger_x, rig.finger_y) == (0.0, 0.0)
    assert rig.finger_pose.psi == pytest.approx(math.pi / 2.0)
    assert rig.object_pose.angle == theta
    assert (rig.object_pose.x, rig.object_pose.y) == pytest.approx(
        center_of(theta, d, 0.0, 0.0, BLOCK_L), abs=1e-15
    )
    assert polygon_gap(BLOCK, rig) == pytest.approx(0.0, abs=1e-15)
    assert rig.mode == FREE
    assert rig.mode_name == 'free'
    assert not rig.at_workspace_limit


def test_paper_block_is_the_one_of_the_paper():
    config = paper_block()
    assert config.slider.outline.points(0.001) == pytest.approx(BLOCK)
    assert (config.slider.c, config.slider.points, config.mu_c) == (0.0187, None, math.inf)
    assert math.degrees(config.theta) == pytest.approx(20.0)
    assert (config.d, config.belt_speed, config.radius) == (-0.006, 0.005, 0.0135)


def test_paper_disk_is_the_one_of_the_paper():
    config = paper_disk()
    rim = config.slider.outline.points(0.0001)
    assert np.hypot(*rim.T) == pytest.approx(np.full(len(rim), 0.0285))
    assert config.slider.outline.length == pytest.approx(2.0 * math.pi * 0.0285)
    # Uniform support in a circle: the mean distance from the centre, 2/3 of the radius.
    assert config.slider.c == pytest.approx(2.0 / 3.0 * 0.0285)
    assert (config.mu_c, config.d) == (math.inf, 0.0)


@pytest.mark.parametrize('mount_angle', [0.0, 0.5, math.pi / 2.0, 3.0, -2.0])
def test_pole_starts_along_the_belt_whatever_the_mount_angle(mount_angle):
    slider = Slider(Outline.rectangle(0.05, 0.0475), C_UNIFORM)
    config = RigConfig(slider, 1.0, 0.2, 0.0, finger=PlanarFinger(0.06, 0.08, mount_angle))
    rig = Rig(config)
    assert math.cos(rig.finger_pose.psi) == pytest.approx(0.0, abs=1e-9)
    assert math.sin(rig.finger_pose.psi) == pytest.approx(1.0)
    assert rig.reading().in_contact


@given(
    theta=st.floats(-0.5, 0.5),
    v_x=st.floats(-0.01, 0.01),
    mu_c=st.sampled_from([0.0, 0.3, math.inf]),
    disk=st.booleans(),
)
@PROPERTY
def test_reading_gives_theta_through_the_pole_angle(theta, v_x, mu_c, disk):
    config = paper_disk(theta, mu_c) if disk else paper_block(theta, 0.0, mu_c=mu_c)
    rig = Rig(dataclasses.replace(config, tip_turns=True))
    psi_before = rig.finger_pose.psi
    for _ in range(5):
        rig.step(v_x, 0.1)
        if not rig.touching:
            assert not rig.reading().in_contact
            return
        reading = rig.reading()
        contact = contact_of_reading(reading, rig.finger_pose.psi, R, 1e-9)
        assert contact.theta == pytest.approx(rig.theta, abs=1e-12)
        # The contact point of the disk touches the object.
        x, y = rig.finger_x + contact.x, rig.finger_y + contact.y
        to_center = math.hypot(rig.object_pose.x - x, rig.object_pose.y - y)
        distance = DISK_RADIUS if disk else math.hypot(BLOCK_L, rig.d)
        assert to_center == pytest.approx(distance, abs=1e-9)
    if abs(v_x) > 0.001:
        # The finger turns as it moves, so theta does not follow from the reading alone.
        assert abs(rig.finger_pose.psi - psi_before) > 1e-4


@given(
    theta=st.floats(-0.35, 0.35),
    d=st.floats(-0.01, 0.01),
    v_x=st.floats(-0.002, 0.002),
    point=st.sampled_from(['centre', 'pole', 'contact']),
)
@PROPERTY
def test_contact_that_sticks_to_a_turning_tip_rolls_as_far_as_both_turn(theta, d, v_x, point):
    rig = Rig(dataclasses.replace(paper_block(theta, d), tip_turns=True, commanded_point=point))
    kept = rig.d + R * (rig.theta - rig.psi)
    for _ in range(4):
        rig.step(v_x, 0.25)
        assert rig.mode == STICK
        assert rig.d + R * (rig.theta - rig.psi) == pytest.approx(kept, abs=1e-9)


def test_wrist_holds_the_tip_straight():
    rig = Rig(paper_block())
    rig.step(0.004, 0.5)
    proximal, distal, wrist = rig.joints
    assert rig.config.finger.forward(proximal, distal).x == pytest.approx(rig.finger_pose.x)
    turned = rig.config.finger.mount_angle + proximal + distal + wrist
    assert turned == pytest.approx(math.pi / 2.0) == rig.psi


@pytest.mark.parametrize(('point', 'error'), [('centre', 1e-7), ('pole', 1e-7), ('contact', 1e-6)])
def test_even_parts_of_a_turn_are_as_good_as_twenty_times_as_many(point, error):
    # While the contact is commanded, theta counts as constant over such a part: r cos(theta) dpsi
    # is then off by r sin(theta) dtheta dpsi / 2, some 5e-8 m in each of a dozen parts.
    config = dataclasses.replace(block_config(0.2, -0.004, 0.3), commanded_point=point)
    coarse, fine = Rig(config), Rig(config)
    for v_x in (0.004, 0.008, -0.008, -0.002):
        coarse.step(v_x, 0.2)
        for _ in range(80):
            fine.step(v_x, 0.0025)
    assert coarse.theta == pytest.approx(fine.theta, abs=20.0 * error)
    assert coarse.d == pytest.approx(fine.d, abs=error)
    assert coarse.finger_x == pytest.approx(fine.finger_x, abs=error)


@pytest.mark.parametrize('v_x', [math.inf, 1e6])
def test_command_beyond_all_reach_ends_at_the_end_of_the_reach(v_x):
    rig = Rig(block_config())
    rig.step(v_x, 0.1)
    assert rig.at_workspace_limit
    assert math.isfinite(rig.psi)
    assert math.isfinite(rig.theta)


def test_joints_carry_the_disk_where_the_finger_is():
    rig = Rig(block_config())
    before = rig.finger_pose
    rig.step(0.004, 0.5)
    after = rig.config.finger.forward(*rig.joints)
    assert after.x - before.x == pytest.approx(0.002, abs=1e-12)
    assert after.y == pytest.approx(before.y, abs=1e-12)
    assert rig.finger_x == pytest.approx(0.002, abs=1e-12)
    assert rig.finger_y == pytest.approx(0.0025, abs=1e-12)  # on the belt, at v_y
    assert after.psi == pytest.approx(rig.psi, abs=1e-12)


@pytest.mark.parametrize('v_x', [0.0, 0.002, -0.001])
@pytest.mark.parametrize(('theta', 'd'), [(20.0, -0.006), (-10.0, 0.004), (0.0, -0.005)])
def test_sticking_block_moves_as_the_equations_say(v_x, theta, d):
    rig = Rig(paper_block(math.radians(theta), d))
    rig.step(v_x, 2.0)
    center = center_of(math.radians(theta), d, 0.0, 0.0, BLOCK_L)
    theta_end, d_end, x, y = runge_kutta(
        sticking_edge(v_x, V_Y), [math.radians(theta), d, *center], 2.0
    )
    assert rig.mode == STICK
    assert rig.theta == pytest.approx(theta_end, abs=1e-7)
    assert rig.d == pytest.approx(d_end, abs=1e-8)
    assert (rig.object_pose.x, rig.object_pose.y) == pytest.approx((x, y), abs=1e-8)
    assert rig.object_pose.angle == pytest.approx(theta_end, abs=1e-7)
    assert abs(theta_end - math.radians(theta)) > 0.002


@pytest.mark.parametrize(('v_x', 'mode'), [(0.003, SLIP_RIGHT), (-0.003, SLIP_LEFT)])
def test_frictionless_block_slips_as_the_equations_say(v_x, mode):
    l, c, theta, d = 0.02, 0.015, 0.1, 0.003
    rig = Rig(block_config(theta, d, 0.0, l=l, c=c))
    rig.step(v_x, 1.5)
    center = center_of(theta, d, 0.0, 0.0, l)
    theta_end, d_end, x, y = runge_kutta(
        frictionless_edge(v_x, V_Y, l, c), [theta, d, *center], 1.5
    )
    assert rig.mode == mode
    assert (rig.theta, rig.d) == pytest.approx((theta_end, d_end), abs=1e-7)
    assert (rig.object_pose.x, rig.object_pose.y) == pytest.approx((x, y), abs=1e-8)


def test_push_through_the_centre_of_mass_translates_the_block():
    rig = Rig(paper_block(0.0, 0.0))
    start = rig.object_pose
    rig.step(0.0, 1.0)
    assert (rig.theta, rig.d) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert rig.object_pose.x == pytest.approx(start.x, abs=1e-12)
    assert rig.object_pose.y - start.y == pytest.approx(0.005, abs=1e-12)


def test_contact_left_of_the_centre_turns_the_block_clockwise():
    rig = Rig(paper_block(0.0, -0.005))
    rig.step(0.0, 1.0)
    assert rig.theta < -0.01
    rig = Rig(paper_block(0.0, 0.005))
    rig.step(0.0, 1.0)
    assert rig.theta > 0.01


@pytest.mark.parametrize(
    'config',
    [
        paper_block(),
        paper_block(mu_c=0.2),
        paper_block(0.1, 0.004, mu_c=0.0),
        paper_disk(),
        paper_disk(mu_c=0.1),
    ],
    ids=['stick', 'slip', 'frictionless', 'disk', 'slipping disk'],
)
@pytest.mark.parametrize('v_x', [0.0, 0.004, -0.004])
def test_one_step_is_as_good_as_twenty(config, v_x):
    whole, pieces = Rig(config), Rig(config)
    whole.step(v_x, 1.0)
    for _ in range(20):
        pieces.step(v_x, 0.05)
    assert whole.theta != config.theta or whole.d != config.d
    assert whole.theta == pytest.approx(pieces.theta, abs=1e-7)
    assert whole.d == pytest.approx(pieces.d, abs=1e-7)
    assert whole.object_pose.x == pytest.approx(pieces.object_pose.x, abs=1e-7)
    assert whole.object_pose.y == pytest.approx(pieces.object_pose.y, abs=1e-7)
    assert whole.object_pose.angle == pytest.approx(pieces.object_pose.angle, abs=1e-7)
    assert whole.mode == pieces.mode


def test_finger_at_rest_pushes_straight_ahead_while_the_belt_runs():
    rig = Rig(paper_block())
    start = rig.object_pose
    rig.step(0.0, 0.2)
    assert math.degrees(rig.phi) == pytest.approx(90.0)
    assert rig.finger_x == 0.0
    assert rig.finger_y == pytest.approx(0.001)
    assert rig.object_pose.y > start.y + 0.0001
    assert rig.touching


@pytest.mark.parametrize('slower', [1e-3, 1e3, 1e-130, 1e130])
@pytest.mark.parametrize('exact', [False, True])
@pytest.mark.parametrize('mu_c', [0.0, 0.2, math.inf])
def test_motion_depends_on_the_way_alone_and_not_on_the_time_it_takes(slower, exact, mu_c):
    config, _ = config_of(BLOCK, 0.1, 0.3, mu_c, exact=exact)
    rig, other = Rig(config), Rig(dataclasses.replace(config, belt_speed=V_Y / slower))
    for v_x in (0.003, -0.004, 0.0):
        rig.step(v_x, 1.0)
        other.step(v_x / slower, slower)
        assert other.mode == rig.mode
        assert (other.theta, other.d) == pytest.approx((rig.theta, rig.d), abs=1e-9)


@pytest.mark.parametrize('v_x', [0.003, -0.002, 0.0])
def test_push_angle_is_that_of_the_finger_on_the_belt(v_x):
    rig = Rig(paper_block())
    rig.step(v_x, 0.01)
    # v_x = v_y / tan(phi)
    assert V_Y / math.tan(rig.phi) == pytest.approx(v_x, abs=1e-12)


@pytest.mark.parametrize('config', [paper_block(), paper_disk()])
def test_nothing_moves_while_belt_and_finger_rest(config):
    rig = Rig(config)
    before = rig.object_pose
    rig.step(0.0, 10.0, belt_running=False)
    assert rig.object_pose == before
    assert (rig.finger_x, rig.finger_y) == (0.0, 0.0)
    assert (rig.theta, rig.d) == pytest.approx((config.theta, config.d), abs=1e-15)
    assert rig.mode == FREE
    assert rig.touching
    assert rig.reading().in_contact


def test_nothing_moves_in_no_time():
    rig = Rig(paper_block())
    before = rig.object_pose
    rig.step(0.004, 0.0)
    assert rig.object_pose == before
    assert (rig.finger_x, rig.finger_y) == (0.0, 0.0)
    assert (rig.theta, rig.d) == pytest.approx((rig.config.theta, rig.config.d), abs=1e-15)
    assert rig.touching


def test_finger_pushes_sideways_while_the_belt_rests():
    # The edge is turned counterclockwise, so its normal has a part along -x.
    rig = Rig(paper_block(math.radians(40.0), 0.0))
    start = rig.object_pose
    rig.step(-0.01, 0.1, belt_running=False)
    assert rig.finger_y == 0.0
    assert rig.object_pose.x < start.x - 1e-5
    assert rig.mode != FREE


@pytest.mark.parametrize('config', [paper_block(), paper_disk()])
def test_object_stays_where_it_was_until_the_finger_that_left_it_returns(config):
    rig = Rig(config)
    rig.step(0.001, 0.3)
    pose, theta = rig.object_pose, rig.theta
    # To the right and away from an edge turned by 20 degrees.
    for count in range(1, 6):
        rig.step(0.01, 0.02, belt_running=False)
        assert not rig.touching
        assert rig.mode == FREE
        assert not rig.reading().in_contact
        assert rig.object_pose == pose
        travel = 0.0002 * count
        if len(config.slider.outline.pieces) > 1:  # the block
            assert rig.gap == pytest.approx(travel * math.sin(theta), abs=1e-9)
        else:
            assert 0.0 < rig.gap <= travel
    for _ in range(4):
        rig.step(-0.01, 0.02, belt_running=False)
        assert not rig.touching
        assert rig.object_pose == pose
    # The rest of the way and as much again: it touches and pushes.
    rig.step(-0.01, 0.04, belt_running=False)
    assert rig.touching
    assert rig.reading().in_contact
    assert rig.object_pose.x < pose.x - 1e-6


@pytest.mark.parametrize(
    ('paper', 'theta'),
    [(paper_block, 20.0), (paper_block, -20.0), (paper_disk, 20.0), (paper_disk, -20.0)],
)
def test_gap_closes_at_the_very_place_where_it_opened(paper, theta):
    rig = Rig(paper(math.radians(theta)))
    away = math.copysign(0.01, theta)
    rig.step(away / 3.0, 0.5)
    before = (rig.object_pose, rig.theta, rig.d)
    rig.step(away, 0.1, belt_running=False)
    assert not rig.touching
    rig.step(-away, 0.1, belt_running=False)
    assert rig.touching
    assert rig.object_pose.x == pytest.approx(before[0].x, abs=1e-8)
    assert rig.object_pose.y == pytest.approx(before[0].y, abs=1e-8)
    assert (rig.theta, rig.d) == pytest.approx(before[1:], abs=1e-6)


def test_belt_brings_the_object_back_to_a_finger_that_left_it():
    rig = Rig(paper_block())
    rig.step(0.05, 0.05)
    gap = rig.gap
    assert 1e-4 < gap < math.inf
    pose = rig.object_pose
    # The belt closes the gap at the speed v_y cos(theta).
    closing = gap / (V_Y * math.cos(rig.theta))
    rig.step(0.0, 0.99 * closing)
    assert rig.object_pose == pose
    assert rig.gap == pytest.approx(0.01 * gap, rel=1e-6)
    rig.step(0.0, 0.02 * closing)
    assert rig.touching
    assert rig.object_pose.y > pose.y


def test_contact_behind_the_hemisphere_is_not_read():
    # The finger slides along an edge that hardly turns, and its pole turns clockwise as it goes
    # to the right: away from the normal, until that lies behind the hemisphere.
    theta = math.radians(70.0)
    rig = Rig(block_config(theta, 0.0, 0.0, width=1.0, c=1.0))
    read = []
    for _ in range(24):
        rig.step(V_Y / math.tan(math.radians(72.0)), 1.0)
        assert rig.touching
        from_pole = math.degrees(rig.theta + math.pi / 2.0 - rig.finger_pose.psi)
        assert rig.reading().in_contact == (abs(from_pole) <= 90.0)
        read.append(rig.reading().in_contact)
    assert read[0]
    assert not read[-1]


polygons = corners_on_ellipses(most_corners=7, least_axis=0.008)
paths = st.lists(
    st.tuples(
        st.integers(-60_000, 60_000).map(lambda speed: speed * 1e-6),
        st.floats(0.005, 0.3),
        st.booleans(),
    ),
    min_size=5,
    max_size=40,
)


@given(path=paths, theta=st.floats(-1.0, 1.0), mu_c=st.sampled_from([0.0, 0.2, math.inf]))
@PROPERTY
def test_finger_never_enters_a_disk(path, theta, mu_c):
    rig = Rig(paper_disk(theta, mu_c))
    for v_x, duration, belt_running in path:
        rig.step(v_x, duration, belt_running)
        n_x, n_y = rig.object_pose.x - rig.finger_x, rig.object_pose.y - rig.finger_y
        apart = math.hypot(n_x, n_y) - DISK_RADIUS - R
        assert apart >= -PENETRATION
        assert rig.gap == pytest.approx(apart, abs=1e-12)
        assert apart < PENETRATION if rig.touching else apart > 0.0
        assert (-math.sin(rig.theta), math.cos(rig.theta)) == pytest.approx(
            (n_x / math.hypot(n_x, n_y), n_y / math.hypot(n_x, n_y)), abs=1e-9
        )


@given(
    path=paths,
    corners=polygons,
    theta=st.floats(-1.0, 1.0),
    share=st.floats(0.0, 1.0),
    mu_c=st.sampled_from([0.0, 0.2, 1.0, math.inf]),
    exact=st.booleans(),
)
@PROPERTY
def test_finger_never_enters_a_polygon_and_goes_around_its_corners(
    path, corners, theta, share, mu_c, exact
):
    config, corners = config_of(corners, theta, share, mu_c, exact=exact)
    rig = Rig(config)
    for v_x, duration, belt_running in path:
        rig.step(v_x, duration, belt_running)
        gap, normal = nearest(corners, rig.object_pose, rig.finger_x, rig.finger_y)
        assert gap >= -PENETRATION
        assert rig.gap == pytest.approx(gap, abs=1e-12)
        assert gap < PENETRATION if rig.touching else gap > 0.0
        # Of the nearest point, be it on an edge or a corner: theta has the right normal, d and l
        # lead from it to the centre of mass.
        assert (-math.sin(rig.theta), math.cos(rig.theta)) == pytest.approx(normal, abs=1e-7)
        x = rig.finger_x + (R + gap) * normal[0] - rig.object_pose.x
        y = rig.finger_y + (R + gap) * normal[1] - rig.object_pose.y
        assert rig.d == pytest.approx(x * normal[1] - y * normal[0], abs=1e-8)
        assert rig.reading().in_contact <= rig.touching


def smallest_gap(corners, pose, start, end):
    """Return how near a disk comes to a polygon at rest on a straight way: a convex function."""
    lower, upper = 0.0, 1.0
    for _ in range(60):
        a, b = lower + (upper - lower) / 3.0, upper - (upper - lower) / 3.0
        gap_a = nearest(corners, pose, *(start + a * (end - start)))[0]
        gap_b = nearest(corners, pose, *(start + b * (end - start)))[0]
        lower, upper = (lower, b) if gap_a < gap_b else (a, upper)
    return min(
        nearest(corners, pose, *(start + share * (end - start)))[0] for share in (0.0, lower, 1.0)
    )


@pytest.mark.slow
@given(
    path=paths,
    corners=polygons,
    theta=st.floats(-1.0, 1.0),
    exact=st.booleans(),
)
@settings(PROPERTY, max_examples=20)
def test_object_moves_if_and_only_if_the_finger_meets_it(path, corners, theta, exact):
    # Without friction: a finger that moves away does not pull.
    config, corners = config_of(corners, theta, mu_c=0.0, exact=exact)
    rig = Rig(config)
    for v_x, duration, belt_running in path:
        before, start = rig.object_pose, np.array((rig.finger_x, rig.finger_y))
        rig.step(v_x, duration, belt_running)
        end = np.array((rig.finger_x, rig.finger_y))
        gap = smallest_gap(corners, before, start, end)
        if gap > PENETRATION:
            assert rig.object_pose == before
            assert rig.mode == FREE
        if gap < -PENETRATION:
            assert rig.object_pose != before


@given(
    path=st.lists(st.integers(-30_000, 30_000), min_size=5, max_size=15),
    corners=polygons,
    theta=st.floats(-0.5, 0.5),
    mu_c=st.sampled_from([0.0, 0.3, math.inf]),
)
@settings(PROPERTY, max_examples=20)
def test_theta_and_d_never_jump(path, corners, theta, mu_c):
    # The least radius of the disk's way around the object is R: a way of length s turns theta by
    # s / R if the object rests, and the object by a few times s / c; from one edge to the next,
    # theta would jump by more than 40 degrees, d by several millimetres.
    config, corners = config_of(corners, theta, mu_c=mu_c, c=0.02)
    rig = Rig(config)
    for speed in path:
        v_x = speed * 1e-6
        for _ in range(20):
            theta, d = rig.theta, rig.d
            rig.step(v_x, 0.005)
            way = 0.005 * math.hypot(v_x, V_Y)
            assert abs(rig.theta - theta) < 8.0 * way / R
            assert abs(rig.d - d) < 8.0 * way / R * 0.04


def test_finger_that_rolls_to_the_end_of_the_edge_does_not_enter_the_object():
    rig = Rig(block_config(0.0, 0.009, width=0.02))
    corner = 0
    for count in range(42):
        rig.step(0.02 if count < 12 else -0.02, 0.02)
        gap, normal = nearest(rectangle(0.02, 0.0475), rig.object_pose, rig.finger_x, rig.finger_y)
        assert gap >= -PENETRATION
        assert gap < PENETRATION if rig.touching else gap > 0.0
        in_object = math.atan2(normal[1], normal[0]) - rig.object_pose.angle - math.pi / 2.0
        corner += 0.01 < in_object % (math.pi / 2.0) < math.pi / 2.0 - 0.01
    assert corner > 5


def test_frictionless_finger_goes_around_a_corner_from_one_edge_to_the_next():
    # To the left and around, always 60 degrees to the left of the normal; the block hardly turns.
    rig = Rig(block_config(0.0, -0.02, mu_c=0.0, c=100.0))
    thetas = []
    for _ in range(300):
        rig.step(V_Y / math.tan(rig.theta + math.radians(150.0)), 0.02)
        assert rig.touching
        assert abs(polygon_gap(BLOCK, rig)) < 1e-12
        assert rig.mode == SLIP_LEFT
        thetas.append(rig.theta)
        contact = np.array((rig.finger_x, rig.finger_y)) + R * np.array(
            (-math.sin(rig.theta), math.cos(rig.theta))
        )
        turned = rig.theta - rig.object_pose.angle
        if turned < -1e-6 and turned > -math.pi / 2.0 + 1e-6:  # on the corner
            assert contact == pytest.approx(on_belt(BLOCK, rig.object_pose)[0], abs=1e-12)
            assert math.hypot(rig.d, math.hypot(0.025, BLOCK_L)) > 0.0
    assert np.all(np.diff(thetas) <= 1e-3)
    assert np.sum((np.array(thetas) < -0.1) & (np.array(thetas) > -1.4)) > 20
    # Along the left side of the block, which is pushed to the right.
    assert rig.theta == pytest.approx(rig.object_pose.angle - math.pi / 2.0, abs=1e-12)
    assert -0.02375 < rig.d < 0.02375
    assert rig.object_pose.x > 0.02


def test_block_turns_about_a_corner_that_sticks_to_the_finger():
    # The finger does not turn, so neither does the normal while the corner sticks to it: theta
    # stays, and (9)-(11) hold with x_c at the corner of the turning block.
    v_x = -0.02
    rig = Rig(dataclasses.replace(block_config(0.0, 0.025), tip_turns=False))
    center = center_of(0.0, 0.025, 0.0, 0.0, BLOCK_L)

    def rates(state):
        angle, _, _ = state
        x_c = 0.025 * math.cos(angle) + BLOCK_L * math.sin(angle)
        y_c = 0.025 * math.sin(angle) - BLOCK_L * math.cos(angle)
        square = C_UNIFORM**2 + x_c**2 + y_c**2
        x_dot = ((C_UNIFORM**2 + x_c**2) * v_x + x_c * y_c * V_Y) / square
        y_dot = (x_c * y_c * v_x + (C_UNIFORM**2 + y_c**2) * V_Y) / square
        return [(x_c * y_dot - y_c * x_dot) / C_UNIFORM**2, x_dot, y_dot]

    angle, x, y = runge_kutta(rates, [0.0, *center], 0.5)
    rig.step(v_x, 0.5)
    assert angle < -0.05
    assert rig.mode == STICK
    assert rig.theta == pytest.approx(0.0, abs=1e-12)
    assert rig.object_pose.angle == pytest.approx(angle, abs=1e-7)
    assert (rig.object_pose.x, rig.object_pose.y) == pytest.approx((x, y), abs=1e-8)
    assert rig.d == pytest.approx(-x, abs=1e-2)
    assert abs(polygon_gap(BLOCK, rig)) < 1e-12


def test_finger_that_slips_around_a_corner_has_no_contact():
    # Straight ahead of a face turned clockwise a frictionless finger slips to the left.
    corners = rectangle(0.004, 0.0475)
    rig = Rig(block_config(math.radians(-30.0), 0.0, 0.0, width=0.004))
    for _ in range(300):
        rig.step(0.0, 0.02)
        if not rig.touching:
            break
        assert rig.mode == SLIP_LEFT
    assert not rig.touching
    assert 0.0 < rig.gap == pytest.approx(polygon_gap(corners, rig), abs=1e-12)
    assert rig.mode == FREE
    assert not rig.reading().in_contact
    pose, gap = rig.object_pose, rig.gap
    for _ in range(20):
        rig.step(0.0, 0.02)
        assert rig.object_pose == pose
        assert rig.gap > gap
        assert not rig.reading().in_contact
        gap = rig.gap


def test_push_ends_where_the_finger_leaves_however_long_the_step():
    config = block_config(math.radians(10.0), -0.0015, 0.0, width=0.004, l=0.02)
    fine, coarse, one = Rig(config), Rig(config), Rig(config)
    for _ in range(4500):
        fine.step(-0.003, 0.001)
    assert not fine.touching
    for _ in range(45):
        coarse.step(-0.003, 0.1)
    one.step(-0.003, 4.5)
    for rig in (coarse, one):
        assert rig.object_pose.x == pytest.approx(fine.object_pose.x, abs=1e-6)
        assert rig.object_pose.y == pytest.approx(fine.object_pose.y, abs=1e-6)
        assert rig.object_pose.angle == pytest.approx(fine.object_pose.angle, abs=1e-6)
        assert rig.gap == pytest.approx(fine.gap, abs=1e-6)


def test_fast_finger_does_not_tunnel_through_a_thin_object():
    # A plate of 1 mm, 20 mm ahead of the finger, and a step of 60 mm.
    rig = Rig(block_config(0.0, 0.0, l=0.0005, c=0.01))
    rig.step(0.06, 1.0, belt_running=False)  # past its end
    assert not rig.touching
    pose = rig.object_pose
    rig.step(-0.001, 1.0)
    assert rig.object_pose == pose
    rig = Rig(block_config(0.0, 0.0, l=0.0005, c=0.01))
    rig.object_pose = pose._replace(x=0.0, y=0.02 + R + 0.0005)
    rig.touching = False
    rig.step(0.0, 12.0)
    assert rig.touching
    assert rig.object_pose.y == pytest.approx(0.06 + R + 0.0005, abs=1e-12)


@pytest.mark.parametrize('mu_c', [0.0, 0.5, math.inf])
def test_contact_lost_around_the_corner_is_found_again_on_the_next_edge(mu_c):
    # Off the block to the left, along with the belt beside it, then back to the right.
    rig = Rig(block_config(0.0, -0.02, mu_c))
    for _ in range(100):
        rig.step(-0.05, 0.02, belt_running=rig.touching)
        if rig.finger_x < -0.05:
            break
    assert not rig.touching
    pose = rig.object_pose
    rig.step(0.0, 6.0)
    assert rig.object_pose == pose
    assert not rig.touching
    gap = polygon_gap(BLOCK, rig)
    for _ in range(400):
        rig.step(0.01, 0.02)
        assert polygon_gap(BLOCK, rig) >= -PENETRATION
        if rig.touching:
            break
        assert rig.object_pose == pose
    assert gap > 0.005
    assert rig.touching
    turned = rig.theta - rig.object_pose.angle
    assert (math.cos(turned), math.sin(turned)) == pytest.approx((0.0, -1.0), abs=1e-9)
    rig.step(0.01, 0.2)
    assert rig.object_pose.x > pose.x + 1e-4


def mirrored(config):
    corners = config.slider.outline.points(1.0) * (-1.0, 1.0)
    first = np.roll(corners[::-1], 2, axis=0)  # the first edge stays the first
    slider = Slider(Outline.polygon(first), config.slider.c)
    return RigConfig(slider, config.mu_c, -config.theta, -config.d, tip_turns=False)


@given(
    path=paths,
    corners=polygons,
    theta=st.floats(-1.0, 1.0),
    share=st.floats(0.0, 1.0),
    mu_c=st.sampled_from([0.0, 0.2, math.inf]),
)
@PROPERTY
def test_mirrored_motions_of_the_finger_have_mirrored_effects(path, corners, theta, share, mu_c):
    config = dataclasses.replace(config_of(corners, theta, share, mu_c)[0], tip_turns=False)
    rig, mirror = Rig(config), Rig(mirrored(config))
    for v_x, duration, belt_running in path:
        if abs(rig.finger_x + v_x * duration) > 0.05:  # the finger's reach is no mirror image
            continue
        rig.step(v_x, duration, belt_running)
        mirror.step(-v_x, duration, belt_running)
        assert mirror.touching == rig.touching
        assert (
            MODES[mirror.mode]
            == {
                'free': 'free',
                'stick': 'stick',
                'slip_left': 'slip_right',
                'slip_right': 'slip_left',
            }[MODES[rig.mode]]
        )
        assert mirror.object_pose.x == pytest.approx(-rig.object_pose.x, abs=1e-6)
        assert mirror.object_pose.y == pytest.approx(rig.object_pose.y, abs=1e-6)
        assert mirror.object_pose.angle == pytest.approx(-rig.object_pose.angle, abs=1e-5)


@pytest.mark.parametrize(
    'outline',
    [Outline.circle(0.02), Outline.ellipse(0.03, 0.02)],
    ids=['circle', 'ellipse'],
)
def test_finger_follows_curved_outlines(outline):
    # The gap to 200,000 points of the curve itself.
    t = np.linspace(0.0, 2.0 * math.pi, 200_001)
    a, b = (0.02, 0.02) if len(outline.pieces) == 1 else (0.03, 0.02)
    curve = np.stack([a * np.cos(t), b * np.sin(t)], axis=1)
    rig = Rig(RigConfig(Slider(outline, 0.013), 0.3, 0.3, 0.0))
    for v_x in (0.01, 0.01, -0.02, -0.02, -0.02, 0.03, 0.03, 0.03):
        rig.step(v_x, 0.3)
        pose = rig.object_pose
        points = on_belt(curve, pose)
        gap = np.hypot(points[:, 0] - rig.finger_x, points[:, 1] - rig.finger_y).min() - R
        assert gap == pytest.approx(rig.gap, abs=1e-7)
        assert gap > -1e-7


@pytest.mark.parametrize('exact', [False, True])
def test_support_of_the_slider_is_the_one_that_slides(exact):
    # Four points under the corners: about the CM they turn less easily than c = 1.87 cm.
    outline = Outline.rectangle(0.05, 0.0475)
    slider = Slider.on(outline, Support.corners(outline), exact=exact)
    rig = Rig(RigConfig(slider, math.inf, 0.0, -0.005))
    paper = Rig(paper_block(0.0, -0.005))
    rig.step(0.0, 2.0)
    paper.step(0.0, 2.0)
    assert paper.theta < rig.theta < -0.01


def test_workspace_limit_stops_the_finger_and_says_so():
    rig = Rig(paper_block())
    reach = math.sqrt(0.14**2 - 0.08**2) + 0.06  # from the start, 8 cm ahead and 6 to the left
    for _ in range(200):
        rig.step(0.02, 0.05, belt_running=False)
        assert rig.finger_x <= reach
        if rig.at_workspace_limit:
            break
    assert rig.at_workspace_limit
    assert rig.finger_x == pytest.approx(reach, abs=0.0011)
    stopped = rig.finger_x
    rig.step(0.02, 0.05)
    assert rig.finger_x == stopped
    assert math.degrees(rig.phi) == pytest.approx(90.0)
    rig.step(-0.02, 0.05)
    assert not rig.at_workspace_limit
    assert rig.finger_x == pytest.approx(stopped - 0.001)


def test_command_that_is_no_velocity_leaves_the_finger_where_it_is():
    rig = Rig(paper_block())
    rig.step(math.nan, 0.1)
    assert rig.finger_x == 0.0
    assert rig.at_workspace_limit
    assert math.isfinite(rig.theta)
    assert math.isfinite(rig.object_pose.x)


def test_disk_rolls_on_the_finger_without_slipping():
    # (9)-(11) with x_c = (0, -R): omega = R v cos(beta) / (c^2 + R^2). The contact travels
    # s' = -r theta' on the finger and theta' = omega + s' / R, so theta' = omega R / (R + r). With
    # phi = 90 degrees cos(beta) = sin(theta), so tan(theta / 2) grows exponentially.
    theta = math.radians(20.0)
    rig = Rig(paper_disk(theta))
    rig.step(0.0, 3.0)
    rate = DISK_RADIUS**2 * V_Y / ((DISK_RADIUS + R) * (DISK_C**2 + DISK_RADIUS**2))
    expected = 2.0 * math.atan(math.tan(theta / 2.0) * math.exp(3.0 * rate))
    assert rig.mode == STICK
    assert rig.theta == pytest.approx(expected, abs=1e-7)
    turned = (expected - theta) * (DISK_RADIUS + R) / DISK_RADIUS
    assert rig.object_pose.angle - theta == pytest.approx(turned, abs=1e-7)
    assert rig.d == pytest.approx(0.0, abs=1e-15)
    assert rig.object_pose.x == pytest.approx(-(R + DISK_RADIUS) * math.sin(expected), abs=1e-8)


def test_disk_without_friction_does_not_turn():
    theta = math.radians(20.0)
    rig = Rig(paper_disk(theta, mu_c=0.0))
    angle = rig.object_pose.angle
    rig.step(0.0, 3.0)
    # The line of centres turns with the finger's speed across it: theta' = v sin(theta) / (R + r).
    rate = V_Y / (DISK_RADIUS + R)
    expected = 2.0 * math.atan(math.tan(theta / 2.0) * math.exp(3.0 * rate))
    assert rig.theta == pytest.approx(expected, abs=1e-7)
    assert rig.object_pose.angle == pytest.approx(angle, abs=1e-9)
    assert rig.mode in (SLIP_LEFT, SLIP_RIGHT)


def test_object_in_finger_disk_is_relative_to_the_finger():
    rig = Rig(paper_block())
    rig.step(0.003, 0.7)
    pose = rig.object_in_finger_disk
    assert (pose.x, pose.y) == pytest.approx(center_of(rig.theta, rig.d, 0.0, 0.0, BLOCK_L))
    assert pose.angle == rig.theta


@pytest.mark.parametrize(
    ('mu_c', 'alpha'), [(0.0, 0.0), (1.0, 45.0), (math.sqrt(3.0), 60.0), (math.inf, 90.0)]
)
def test_contact_directions_are_normal_cone_and_push(mu_c, alpha):
    rig = Rig(paper_block(math.radians(20.0), mu_c=mu_c))
    rig.step(0.005, 1e-6)
    angles = {
        name: math.degrees(math.atan2(y, x)) % 360.0
        for name, (x, y) in rig.contact_directions.items()
    }
    assert angles == pytest.approx(
        {'normal': 110.0, 'left': 110.0 + alpha, 'right': 110.0 - alpha, 'push': 45.0}, abs=0.01
    )


def test_force_before_the_first_motion_pushes_straight():
    rig = Rig(paper_block(math.radians(20.0)))
    normal = math.radians(110.0)
    expected = [2.7 * math.cos(normal), 2.7 * math.sin(normal)]
    assert rig.contact_force == pytest.approx(expected)


def test_force_that_carries_the_object_straight_on_is_f_max_along_its_way():
    config = dataclasses.replace(paper_block(theta=0.0, d=0.0), f_max=1.8)
    rig = Rig(config)
    rig.step(0.0, 0.5)
    assert rig.contact_force == pytest.approx((0.0, 1.8), abs=1e-9)


SUPPORTS = {
    'ellipsoid': lambda outline: Slider.on(outline, Support.uniform(outline)),
    'exact': lambda outline: Slider.on(outline, Support.corners(outline), exact=True),
}


@pytest.mark.parametrize('support', SUPPORTS)
@pytest.mark.parametrize(('mu_c', 'v_x'), [(0.3, 0.0), (0.1, 0.006), (0.1, -0.006), (2.0, 0.003)])
def test_force_lies_in_the_friction_cone_and_on_its_side_when_slipping(support, mu_c, v_x):
    outline = Outline.rectangle(0.05, 0.0475)
    slider = SUPPORTS[support](outline)
    rig = Rig(RigConfig(slider, mu_c, math.radians(10.0), 0.006, tip_turns=False))
    rig.step(v_x, 0.2)
    rig.step(v_x, 1e-4)  # the force is that of the mean motion of a step
    assert rig.touching
    (f_x, f_y), theta = rig.contact_force, rig.theta
    across, along = (
        -f_x * math.sin(theta) + f_y * math.cos(theta),
        f_x * math.cos(theta) + f_y * math.sin(theta),
    )
    assert across > 0.0
    # The moment about the centre of mass is that of the force at the contact.
    place = rig.object_in_finger_disk
    x, y = (-R * math.sin(theta) - place.x, R * math.cos(theta) - place.y)
    before = rig.object_pose
    rig.step(v_x, 1e-4)
    after = rig.object_pose
    turns = after.angle - before.angle
    moment = x * f_y - y * f_x
    assert moment * turns > 0.0
    if rig.mode == STICK:
        assert abs(along) <= mu_c * across * 1.001
    else:  # the tip that slips to the left along the object drags it there
        assert abs(along) == pytest.approx(mu_c * across, rel=2e-3)
    if support == 'ellipsoid':
        # (4) and (5): v / f = c^2 omega / m, and the force is on the ellipsoid.
        m = 2.7 * slider.c
        assert (f_x**2 + f_y**2) / 2.7**2 + (moment / m) ** 2 == pytest.approx(1.0, rel=2e-3)


def test_force_ends_with_the_contact_and_stays_while_the_belt_stands():
    rig = Rig(paper_block())
    rig.step(0.002, 0.5)
    pushing = rig.contact_force
    rig.step(0.0, 0.5, belt_running=False)
    assert rig.contact_force == pushing
    rig.touching = False
    assert rig.contact_force == (0.0, 0.0)


def test_a_lifted_finger_leaves_the_object_as_it_lies():
    rig = Rig(dataclasses.replace(paper_block(0.2, 0.003), tip_turns=True))
    rig.step(0.002, 1.0)
    placed, theta, psi = rig.object_pose, rig.theta, rig.psi
    rig.lift()
    assert rig.lifted
    assert not rig.reading().in_contact
    assert rig.contact_force == (0.0, 0.0)
    ahead = rig.object_in_finger_disk.y
    rig.step(0.01, 1.0)
    assert rig.object_pose == placed
    assert (rig.theta, MODES[rig.mode]) == (theta, 'free')
    assert rig.finger_x == pytest.approx(0.012)
    assert rig.psi != psi
    # The belt carries it past the finger, which pushes it no more.
    assert rig.object_in_finger_disk.y == pytest.approx(ahead - 0.005)
    rig.step(0.0, 12.0)
    assert rig.object_pose == placed


def test_a_slow_lift_pushes_the_object_on_until_it_is_free():
    config = paper_block(0.2, 0.003)
    slow, quick = Rig(config, Faults(servo=Servo(lift_delay=0.15))), Rig(config)
    for rig in (slow, quick):
        rig.step(0.002, 1.0)
    slow.lift()
    assert not slow.lifted
    slow.step(0.004, 0.1)
    assert (slow.lifted, slow.touching) == (False, True)
    slow.step(0.004, 0.1)
    assert (slow.lifted, slow.touching) == (True, False)
    quick.step(0.004, 0.15)
    assert tuple(slow.object_pose) == pytest.approx(tuple(quick.object_pose), abs=1e-9)
    assert slow.finger_x == pytest.approx(0.0028)
    slow.step(0.004, 1.0)
    assert MODES[slow.mode] == 'free'
    assert tuple(slow.object_pose) == pytest.approx(tuple(quick.object_pose), abs=1e-9)


def test_a_finger_that_is_put_down_before_it_has_let_go_pushes_on():
    rig = Rig(paper_block(0.2, 0.003), Faults(servo=Servo(lift_delay=0.15)))
    rig.lift()
    rig.step(0.002, 0.1)
    rig.put_down()
    rig.step(0.002, 1.0)
    assert (rig.lifted, rig.touching) == (False, True)
    rig.lift()
    rig.step(0.0, 0.15)
    assert rig.lifted


def test_the_next_object_comes_as_the_first_one_did():
    first = Rig(paper_block(0.2, 0.003, mu_c=0.4))
    second = Rig(first.config)
    second.step(0.004, 3.0)
    second.lift()
    second.step(-0.002, 1.0)
    beside = second.finger_x, second.finger_y
    second.put_down()
    assert not second.lifted
    assert (second.theta, second.d) == pytest.approx((0.2, 0.003))
    assert polygon_gap(BLOCK, second) == pytest.approx(0.0, abs=1e-15)
    assert (second.finger_x, second.finger_y) == beside
    assert second.reading() == first.reading()
    assert second.contact_force == pytest.approx(first.contact_force)
    for rig in (first, second):
        rig.step(0.001, 2.0)
    assert tuple(second.object_in_finger_disk) == pytest.approx(tuple(first.object_in_finger_disk))
    assert second.mode == first.mode


def test_a_finger_that_is_down_is_not_put_down():
    rig = Rig(paper_block())
    rig.step(0.001, 1.0)
    lies, slid = rig.object_pose, rig.contact_force
    rig.put_down()
    assert (rig.object_pose, rig.contact_force) == (lies, slid)


GOOD = {
    'slider': Slider(Outline.rectangle(0.05, 0.0475), 0.0187),
    'mu_c': 1.0,
    'theta': 0.1,
    'd': 0.0,
}


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('mu_c', -0.1),
        ('mu_c', math.nan),
        ('theta', math.pi / 2.0),
        ('theta', -2.0),
        ('theta', math.nan),
        ('d', 0.0251),
        ('d', -0.03),
        ('d', math.nan),
        ('belt_speed', 0.0),
        ('belt_speed', -0.005),
        ('belt_speed', math.inf),
        ('radius', 0.0),
        ('radius', math.nan),
    ],
)
def test_number_out_of_its_range_is_refused_by_name_and_value(name, value):
    assert RigConfig(**GOOD).mu_c == 1.0
    with pytest.raises(ValueError, match=f'^{name}: expected .*{value}'):
        RigConfig(**{**GOOD, name: value})


def test_config_takes_every_friction_and_both_ends_of_the_edge():
    for mu_c in (0.0, math.inf):
        assert RigConfig(**{**GOOD, 'mu_c': mu_c}).mu_c == mu_c
    for d in (0.025, -0.025):
        assert RigConfig(**{**GOOD, 'd': d}).d == d


@pytest.mark.parametrize('theta', [-0.5, 0.0, 0.3])
def test_a_finger_that_goes_back_faster_than_the_belt_leaves_the_object_and_meets_it_again(theta):
    rig = Rig(paper_block(theta, 0.01))
    before, pose = rig.object_pose, rig.finger_pose
    rig.step(0.0, 1.0, v_along=-0.02)
    assert not rig.touching
    assert not rig.reading().in_contact
    assert rig.gap == pytest.approx((0.02 - V_Y) * math.cos(theta), abs=1e-9)
    assert (rig.finger_x, rig.along) == pytest.approx((0.0, -0.02))
    rig.step(-0.015, 1.0)
    there = rig.finger_pose
    assert (there.x, there.y) == pytest.approx((pose.x - 0.015, pose.y - 0.02))
    assert rig.object_pose == before  # it lies on the belt
    # The edge comes nearer at the belt's speed, and is farther or nearer aside.
    left = (0.02 - 2.0 * V_Y - 0.015 * math.tan(theta)) / V_Y
    rig.step(0.0, left - 1e-3)
    assert not rig.touching
    rig.step(0.0, 2e-3)
    assert rig.touching
    assert rig.reading().in_contact
    assert rig.d == pytest.approx(0.01 - 0.015 / math.cos(theta), abs=1e-5)
    assert rig.theta == pytest.approx(theta, abs=1e-3)


def test_the_finger_follows_its_command_along_the_belt_with_the_same_lag():
    rig = Rig(paper_block(), Faults(servo=Servo(time_constant=0.1, delay=0.05)))
    rig.step(0.0, 0.35, v_along=-0.02)
    assert rig.v_along == pytest.approx(-0.02 * (1.0 - math.exp(-3.0)))
    assert rig.along == pytest.approx(-0.02 * (0.3 - 0.1 * (1.0 - math.exp(-3.0))))
    assert rig.v_x == 0.0


def test_a_tip_points_where_its_links_bring_it_on_another_line():
    links = PlanarFinger(0.06, 0.08, math.pi / 2.0)
    rig = Rig(RigConfig(paper_block().slider, math.inf, 0.0, 0.0, finger=links))
    rig.step(0.004, 1.0, v_along=-0.02)
    proximal, distal = rig.joints
    assert rig.psi == pytest.approx(math.pi / 2.0 + proximal + distal, abs=1e-12)
    there = links.forward(proximal, distal)
    assert (there.x, there.y) == pytest.approx((-0.06 + 0.004, 0.08 - 0.02))
