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
"""The simulated rig against the paper's equations, written out here and integrated anew (V.A)."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import FREE, SLIP_LEFT, SLIP_RIGHT, STICK, Disk, Edge
from tactile_push.simulation import Rig, RigConfig, paper_block, paper_disk
from tactile_push.tactile import PlanarFinger, contact_of_reading

PROPERTY = settings(derandomize=True, deadline=None, max_examples=40)
V_Y = 0.005
R = 0.0135
BLOCK_L = 0.02375
C_UNIFORM = 0.0187
DISK_RADIUS = 0.0285
DISK_C = 0.019  # 2 R / 3: the mean distance from the centre, support uniform
PENETRATION = 1e-6


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


def clearance(rig):
    """Return the distance of finger and object by plane geometry: how far apart, how far along."""
    outline, pose = rig.config.outline, rig.object_pose
    x, y = rig.finger_x - pose.x, rig.finger_y - pose.y
    if isinstance(outline, Disk):
        return math.hypot(x, y) - outline.radius - R, 0.0
    t_x, t_y = math.cos(pose.angle), math.sin(pose.angle)
    return -(-x * t_y + y * t_x) - outline.l - R, x * t_x + y * t_y


def edge_config(theta=0.0, d=0.0, mu_c=math.inf, length=0.05, l=BLOCK_L, c=C_UNIFORM):
    return RigConfig(Edge(length, l), c, mu_c, theta, d)


@given(theta=st.floats(-1.5, 1.5), d=st.floats(-0.025, 0.025))
@PROPERTY
def test_rig_starts_as_configured_and_in_contact(theta, d):
    rig = Rig(paper_block(theta, d))
    assert (rig.theta, rig.d, rig.gap) == (theta, d, 0.0)
    assert rig.touching
    assert (rig.finger_x, rig.finger_y) == (0.0, 0.0)
    assert rig.finger_pose.psi == pytest.approx(math.pi / 2.0)
    assert rig.object_pose.angle == theta
    assert (rig.object_pose.x, rig.object_pose.y) == pytest.approx(
        center_of(theta, d, 0.0, 0.0, BLOCK_L), abs=1e-15
    )
    assert clearance(rig)[0] == pytest.approx(0.0, abs=1e-15)
    assert rig.mode == FREE
    assert rig.mode_name == 'free'
    assert not rig.at_workspace_limit


def test_paper_block_is_the_one_of_the_paper():
    config = paper_block()
    assert config.outline == Edge(0.05, 0.02375)
    assert (config.c, config.mu_c) == (0.0187, math.inf)
    assert math.degrees(config.theta) == pytest.approx(20.0)
    assert (config.d, config.belt_speed, config.radius) == (-0.006, 0.005, 0.0135)


def test_paper_disk_is_the_one_of_the_paper():
    config = paper_disk()
    assert config.outline == Disk(0.0285)
    # Uniform support in a circle: the mean distance from the centre, 2/3 of the radius.
    assert config.c == pytest.approx(2.0 / 3.0 * 0.0285)
    assert (config.mu_c, config.d) == (math.inf, 0.0)


@pytest.mark.parametrize('mount_angle', [0.0, 0.5, math.pi / 2.0, 3.0, -2.0])
def test_pole_starts_along_the_belt_whatever_the_mount_angle(mount_angle):
    config = RigConfig(
        Edge(0.05, BLOCK_L), C_UNIFORM, 1.0, 0.2, 0.0, finger=PlanarFinger(0.06, 0.08, mount_angle)
    )
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
    rig = Rig(paper_disk(theta, mu_c) if disk else paper_block(theta, 0.0, mu_c=mu_c))
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


def test_joints_carry_the_disk_where_the_finger_is():
    rig = Rig(paper_block())
    before = rig.finger_pose
    rig.step(0.004, 0.5)
    after = rig.config.finger.forward(*rig.joints)
    assert after.x - before.x == pytest.approx(0.002, abs=1e-12)
    assert after.y == pytest.approx(before.y, abs=1e-12)
    assert rig.finger_x == pytest.approx(0.002, abs=1e-12)
    assert rig.finger_y == pytest.approx(0.0025, abs=1e-12)  # on the belt, at v_y
    assert after == rig.finger_pose


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
    rig = Rig(edge_config(theta, d, 0.0, l=l, c=c))
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
    assert (rig.finger_x, rig.finger_y, rig.theta, rig.d) == (0.0, 0.0, config.theta, config.d)
    assert rig.mode == FREE
    assert rig.touching
    assert rig.reading().in_contact


def test_nothing_moves_in_no_time():
    rig = Rig(paper_block())
    before = rig.object_pose
    rig.step(0.004, 0.0)
    assert rig.object_pose == before
    assert (rig.finger_x, rig.finger_y, rig.theta, rig.d) == (
        0.0,
        0.0,
        rig.config.theta,
        rig.config.d,
    )


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
        if isinstance(config.outline, Edge):
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


def test_gap_closes_at_the_very_place_where_it_opened():
    rig = Rig(paper_block())
    before = (rig.object_pose, rig.theta, rig.d)
    rig.step(0.01, 0.1, belt_running=False)
    assert not rig.touching
    rig.step(-0.01, 0.1, belt_running=False)
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
    rig = Rig(edge_config(theta, 0.0, 0.0, length=1.0, c=1.0))
    read = []
    for _ in range(24):
        rig.step(V_Y / math.tan(math.radians(72.0)), 1.0)
        assert rig.touching
        from_pole = math.degrees(rig.theta + math.pi / 2.0 - rig.finger_pose.psi)
        assert rig.reading().in_contact == (abs(from_pole) <= 90.0)
        read.append(rig.reading().in_contact)
    assert read[0]
    assert not read[-1]


steps = st.lists(
    st.tuples(
        st.one_of(st.floats(-0.06, 0.06), st.sampled_from([0.0, 0.03, -0.03])),
        st.floats(0.005, 0.3),
        st.booleans(),
    ),
    min_size=5,
    max_size=40,
)


@given(path=steps, theta=st.floats(-1.0, 1.0), mu_c=st.sampled_from([0.0, 0.2, math.inf]))
@PROPERTY
def test_finger_never_enters_a_disk(path, theta, mu_c):
    rig = Rig(paper_disk(theta, mu_c))
    for v_x, duration, belt_running in path:
        rig.step(v_x, duration, belt_running)
        apart, _ = clearance(rig)
        assert apart >= -PENETRATION
        assert rig.gap == pytest.approx(apart, abs=1e-8)
        n_x, n_y = rig.object_pose.x - rig.finger_x, rig.object_pose.y - rig.finger_y
        assert (-math.sin(rig.theta), math.cos(rig.theta)) == pytest.approx(
            (n_x / math.hypot(n_x, n_y), n_y / math.hypot(n_x, n_y)), abs=1e-6
        )


@given(
    path=steps,
    theta=st.floats(-1.0, 1.0),
    d=st.floats(-0.1, 0.1),
    mu_c=st.sampled_from([0.0, 0.2, math.inf]),
)
@PROPERTY
def test_finger_never_enters_a_long_edge(path, theta, d, mu_c):
    rig = Rig(edge_config(theta, d, mu_c, length=1.0))
    for v_x, duration, belt_running in path:
        before = rig.object_pose
        rig.step(v_x, duration, belt_running)
        apart, along = clearance(rig)
        assert abs(along) < 0.5
        assert apart >= -PENETRATION
        assert rig.gap == pytest.approx(apart, abs=1e-8)
        assert rig.d == pytest.approx(along, abs=1e-8)
        assert rig.theta == rig.object_pose.angle
        if rig.object_pose != before:
            assert rig.mode != FREE or not belt_running or v_x != 0.0


def test_finger_that_slips_off_the_edge_has_no_contact():
    # Straight ahead of a face turned clockwise a frictionless finger slips to the left.
    rig = Rig(edge_config(math.radians(-30.0), 0.0, 0.0, length=0.004))
    for _ in range(100):
        rig.step(0.0, 0.02)
        if not rig.touching:
            break
    assert not rig.touching
    assert rig.gap == math.inf
    assert rig.mode == FREE
    assert not rig.reading().in_contact
    assert abs(clearance(rig)[1]) > 0.002
    pose = rig.object_pose
    for _ in range(20):
        rig.step(0.0, 0.02)
    assert rig.object_pose == pose
    assert not rig.reading().in_contact


def test_push_ends_where_the_edge_ends_however_long_the_step():
    config = edge_config(math.radians(10.0), -0.0015, 0.0, length=0.004, l=0.02)
    fine, coarse = Rig(config), Rig(config)
    for _ in range(1000):
        fine.step(-0.003, 0.001)
    assert not fine.touching
    for _ in range(10):
        coarse.step(-0.003, 0.1)
    assert coarse.object_pose.x == pytest.approx(fine.object_pose.x, abs=1e-5)
    assert coarse.object_pose.y == pytest.approx(fine.object_pose.y, abs=1e-5)


@pytest.mark.xfail(
    strict=True,
    reason='at the end of its edge a sticking object stops and the finger drives on, through it',
)
def test_finger_that_rolls_to_the_end_of_the_edge_does_not_enter_the_object():
    rig = Rig(edge_config(0.0, 0.009, length=0.02))
    for count in range(42):
        rig.step(0.02 if count < 12 else -0.02, 0.02)
        apart, along = clearance(rig)
        assert abs(along) > 0.01 or apart >= -PENETRATION


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
    # Rolling: the contact has gone equal lengths on both outlines.
    assert rig.s == pytest.approx(-R * (expected - theta), abs=1e-8)
    assert rig.d == 0.0
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


GOOD = {'outline': Edge(0.05, BLOCK_L), 'c': 0.0187, 'mu_c': 1.0, 'theta': 0.1, 'd': 0.0}


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('c', 0.0),
        ('c', -0.01),
        ('c', math.nan),
        ('c', math.inf),
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
