# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo against the exact surface, and against statics and kinematics."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tactile_push.control import PushLaw, finger_velocity
from tactile_push.mechanics import MODES, Outline, Slider, Support
from tactile_push.simulation import (
    Belt,
    Faults,
    Rig,
    RigConfig,
    Servo,
    UnevenFriction,
    Workspace,
)
from tactile_push.simulation.mujoco_model import GRAVITY, MujocoPhysics

pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
from tactile_push.simulation.mujoco_rig import MujocoRig

BLOCK = Outline.rectangle(0.05, 0.0475)
CORNERS = Support.corners(BLOCK)
# A push that does not tilt the object.
PHYSICS = MujocoPhysics(CORNERS, 0.3, 1.0, 0.05, 0.0)
FIGURE_8 = math.radians(20.0), -0.006
STEP = 0.1


def config(mu_c=0.5, outline=BLOCK, support=CORNERS, start=FIGURE_8, tilt=0.0, **tip):
    """Return a rig whose tip is held straight by a wrist, unless something else is said."""
    slider = Slider.on(outline, support, exact=True, tilt=tilt)
    return RigConfig(slider, mu_c, *start, **{'tip_turns': False, **tip})


def pushed(rig, steps, v_x=0.0):
    for _ in range(steps):
        rig.step(v_x, STEP)
    return rig


def controlled(rig, steps):
    """Return theta and d under the paper's law, without noise."""
    law, history = PushLaw(0.05, 5.0, math.radians(-10.0)), []
    for _ in range(steps):
        rig.step(finger_velocity(law.update(rig.theta), 0.005), STEP)
        history.append((math.degrees(rig.theta), 1e3 * rig.d))
    assert rig.touching
    return np.array(history)


@pytest.mark.slow
@pytest.mark.parametrize(
    ('outline', 'support', 'mu_c', 'height'),
    [
        (BLOCK, CORNERS, 0.1, 0.0),
        (BLOCK, Support.uniform(BLOCK, 9), math.inf, 0.016),
        (Outline.circle(0.0285), Support.rim(Outline.circle(0.0285), 9), 0.3, 0.016),
    ],
    ids=['corners, slipping', 'uniform, sticking, above the belt', 'disk, above the belt'],
)
def test_with_a_straight_tip_it_moves_as_on_the_exact_surface(outline, support, mu_c, height):
    start = FIGURE_8[0], None if len(outline.pieces) == 1 else FIGURE_8[1]
    rig = config(mu_c, outline, support, start, tilt=0.3 * height)
    physics = replace(PHYSICS, support=support, push_height=height)
    apart = controlled(MujocoRig(rig, physics), 400) - controlled(Rig(rig), 400)
    theta, d = np.abs(apart).T
    assert theta.max() < 0.3  # [deg]
    assert d.max() < 0.3  # [mm]


def test_a_contact_that_sticks_to_a_turning_tip_rolls_by_the_difference_of_the_turns():
    rig = MujocoRig(config(mu_c=2.0, tip_turns=True), PHYSICS)
    rolled = [rig.d + 0.0135 * (rig.theta - rig.psi)]
    psi = rig.psi
    for _ in range(40):
        rig.step(0.003, STEP)
        assert rig.mode_name == 'stick'
        rolled.append(rig.d + 0.0135 * (rig.theta - rig.psi))
    assert abs(rig.psi - psi) > 0.1
    # It gives a little as the push begins. The turn of the tip alone moves d by 2 mm.
    assert np.ptp(rolled) < 2e-5


def test_a_push_above_the_belt_moves_the_centre_of_pressure_forward():
    rig = pushed(MujocoRig(config(start=(0.0, 0.0)), replace(PHYSICS, push_height=0.016)), 10)
    data, model = rig._data, rig._model
    loads, places = [], []
    for contact in data.contact:
        if model.geom(contact.geom1).name == 'belt':
            loads.append(data.efc_force[contact.efc_address])
            places.append(contact.pos[1] - data.xipos[rig._object, 1])
    weight = 1.0 * GRAVITY
    assert sum(loads) == pytest.approx(weight, rel=0.02)  # the tip carries hardly any
    forward = np.dot(loads, places) / sum(loads)
    # Pushed straight ahead against mu_s m g, h f / (m g) is h mu_s.
    assert forward == pytest.approx(0.016 * 0.3, rel=0.1)
    assert rig.normal_force == pytest.approx(0.3 * weight, rel=0.02)


def test_the_finger_goes_as_commanded_along_a_straight_line():
    rig = MujocoRig(config(tip_turns=True), PHYSICS)
    pushed(rig, 20, 0.004)
    assert rig.v_x == pytest.approx(0.004, rel=0.01)
    assert rig.finger_x == pytest.approx(0.008, rel=0.01)
    assert rig.finger_y == pytest.approx(2.0 * 0.005, rel=0.01)
    assert rig.phi == pytest.approx(math.atan2(0.005, 0.004), abs=0.01)
    # The joints are those of a finger that is there.
    pose = rig.config.finger.forward(*rig.joints[:2])
    home = rig.config.finger.forward(math.pi - rig.config.finger.mount_angle, -math.pi / 2.0)
    assert (pose.x - home.x, pose.y - home.y) == pytest.approx((rig.finger_x, 0.0), abs=2e-5)


@pytest.mark.parametrize('point', ['centre', 'pole', 'contact'])
def test_the_commanded_point_is_the_one_that_follows(point):
    rig = MujocoRig(config(tip_turns=True, commanded_point=point), PHYSICS)
    pushed(rig, 5, 0.004)
    before, way = rig.finger_pose, 0.0
    for _ in range(100):
        rig.step(0.004, 0.01)
        now = rig.finger_pose
        # Of the disk at the angle a, x moves with the centre less r sin(a) for each turn of it.
        a = {'centre': 0.0, 'pole': now.psi, 'contact': rig.theta + math.pi / 2.0}[point]
        way += now.x - before.x - 0.0135 * math.sin(a) * (now.psi - before.psi)
        before = now
    assert way == pytest.approx(0.004, rel=0.01)
    assert rig.v_x == pytest.approx(0.004, rel=0.01)
    assert rig.finger_pose.y == pytest.approx(0.08, abs=2e-5)


def test_a_wrist_holds_the_tip_straight():
    rig = pushed(MujocoRig(config(), PHYSICS), 20, 0.004)
    assert len(rig.joints) == 3
    assert rig.psi == pytest.approx(math.pi / 2.0, abs=1e-4)
    assert rig.psi == pytest.approx(math.pi / 2.0 + sum(rig.joints), abs=1e-9)
    assert len(MujocoRig(config(tip_turns=True), PHYSICS).joints) == 2


def test_it_starts_where_the_package_s_own_rig_starts():
    own, rig = Rig(config()), MujocoRig(config(), PHYSICS)
    assert rig.touching
    assert rig.theta == pytest.approx(own.theta, abs=1e-4)
    assert rig.d == pytest.approx(own.d, abs=1e-5)
    assert rig.sigma == pytest.approx(own.sigma, abs=1e-5)
    assert tuple(rig.object_in_finger_disk) == pytest.approx(own.object_in_finger_disk, abs=1e-5)
    assert abs(rig.gap) < 1e-5
    reading, same = rig.reading(), own.reading()
    assert reading.azimuth == same.azimuth
    assert reading.elevation == pytest.approx(same.elevation, abs=1e-4)


def test_at_rest_nothing_moves():
    rig = MujocoRig(config(), PHYSICS)
    before = rig.object_pose
    for _ in range(10):
        rig.step(0.0, STEP, belt_running=False)
    assert tuple(rig.object_pose) == pytest.approx(tuple(before), abs=1e-6)
    assert rig.touching
    assert rig.v_y == 0.0


def test_the_side_to_which_a_contact_slips():
    for v_x, mode in ((0.006, 'slip_right'), (-0.006, 'slip_left')):
        rig = MujocoRig(config(mu_c=0.05, start=(0.0, 0.0)), PHYSICS)
        assert pushed(rig, 5, v_x).mode_name == mode
        own = Rig(rig.config)
        assert pushed(own, 5, v_x).mode_name == mode


def test_a_finger_that_leaves_feels_nothing():
    rig = MujocoRig(config(), PHYSICS)
    pushed(rig, 5)
    rig.faults = Faults(belt=Belt(stopped=True))
    pushed(rig, 30, 0.01)
    assert not rig.touching
    assert MODES[rig.mode] == 'free'
    assert math.isnan(rig.reading().azimuth)
    assert rig.gap > 1e-3


def test_a_lifted_finger_leaves_the_object_as_it_lies():
    rig = pushed(MujocoRig(config(), PHYSICS), 5)
    placed, theta, ahead = rig.object_pose, rig.theta, rig.object_in_finger_disk.y
    rig.lift()
    assert not rig.touching
    # Across where the object lies, and back.
    pushed(rig, 3, 0.05)
    pushed(rig, 3, -0.05)
    assert not rig.touching
    assert math.isnan(rig.reading().azimuth)
    # It comes to rest within V_Y / RATE, the friction of MuJoCo being viscous at such velocities.
    assert tuple(rig.object_pose)[:2] == pytest.approx(tuple(placed)[:2], abs=2e-5)
    assert rig.object_pose.angle == pytest.approx(placed.angle, abs=1e-4)
    assert rig.theta - theta == pytest.approx(rig.object_pose.angle - placed.angle)
    assert rig.object_in_finger_disk.y == pytest.approx(ahead - 0.003, abs=1e-4)


def test_a_slow_lift_pushes_the_object_on_until_it_is_free():
    slow = MujocoRig(config(), PHYSICS, Faults(servo=Servo(lift_delay=0.15)))
    quick = MujocoRig(config(), PHYSICS)
    for rig in (slow, quick):
        pushed(rig, 5)
    slow.lift()
    slow.step(0.004, 0.1)
    assert (slow.lifted, slow.touching) == (False, True)
    slow.step(0.004, 0.1)
    assert (slow.lifted, slow.touching) == (True, False)
    quick.step(0.004, 0.15)
    assert tuple(slow.object_pose)[:2] == pytest.approx(tuple(quick.object_pose)[:2], abs=2e-5)
    assert slow.theta == pytest.approx(quick.theta, abs=1e-3)


def test_the_next_object_comes_as_the_first_one_did():
    rig = MujocoRig(config(), PHYSICS)
    first = rig.object_in_finger_disk
    pushed(rig, 5, 0.004)
    rig.put_down()  # which it is
    assert rig.theta != pytest.approx(FIGURE_8[0], abs=1e-4)
    rig.lift()
    pushed(rig, 2, 0.004)
    finger = rig.finger_x
    rig.put_down()
    assert rig.finger_x == finger
    assert rig.touching
    assert tuple(rig.object_in_finger_disk) == pytest.approx(tuple(first), abs=1e-6)
    assert rig.theta == pytest.approx(FIGURE_8[0], abs=1e-4)
    own = Rig(rig.config)
    assert pushed(rig, 5).theta == pytest.approx(pushed(own, 5).theta, abs=math.radians(0.1))


def test_the_reading_has_the_force():
    rig = pushed(MujocoRig(config(), PHYSICS), 10)
    assert rig.reading().normal_force == rig.normal_force > 1.0


def test_the_force_carries_the_object_against_the_friction_of_the_belt():
    rig = pushed(MujocoRig(config(start=(0.0, 0.0)), PHYSICS), 20)
    weight = PHYSICS.mass * 9.81
    # The finger is pushed up a little, too, and carries some of the weight.
    assert math.hypot(*rig.contact_force) == pytest.approx(PHYSICS.mu_s * weight, rel=0.03)
    across = -rig.contact_force[0] * math.sin(rig.theta) + rig.contact_force[1] * math.cos(
        rig.theta
    )
    assert across == pytest.approx(rig.normal_force, rel=1e-6)


def test_the_normal_that_is_shown_leads_into_the_object():
    rig = pushed(MujocoRig(config(), PHYSICS), 5)
    normal = -math.sin(rig.theta), math.cos(rig.theta)
    assert rig.contact_directions['normal'] == pytest.approx(normal)


def test_the_belt_s_ripple_is_that_of_the_fault():
    belt = Belt(ripple=0.5, frequency=0.5)
    rig = pushed(MujocoRig(config(), PHYSICS, Faults(belt=belt)), 10)
    assert rig.finger_y == pytest.approx(belt.mean_speed(0.005, 0.0, 1.0), rel=0.01)


def test_a_servo_with_a_delay_and_a_lag_follows_later():
    rig = MujocoRig(config(), PHYSICS, Faults(servo=Servo(time_constant=0.2, delay=0.3)))
    pushed(rig, 3, 0.004)
    assert rig.v_x == pytest.approx(0.0, abs=1e-5)
    pushed(rig, 4, 0.004)
    assert rig.v_x == pytest.approx(0.004 * (1.0 - math.exp(-2.0)), rel=0.02)


def test_it_stops_at_the_end_of_its_workspace():
    rig = MujocoRig(config(), PHYSICS, Faults(workspace=Workspace(upper=-0.058)))
    assert rig.finger_pose.x == pytest.approx(-0.06)
    pushed(rig, 10, 0.004)
    assert rig.at_workspace_limit
    assert rig.finger_x == pytest.approx(0.002, abs=1e-4)
    pushed(rig, 1, -0.004)
    assert not rig.at_workspace_limit


def test_it_stops_at_the_end_of_its_reach():
    rig = MujocoRig(config(start=(0.0, 0.0)), PHYSICS)
    pushed(rig, 100, 0.02)
    assert rig.at_workspace_limit
    reached = math.hypot(rig.finger_pose.x, rig.finger_pose.y)
    assert reached == pytest.approx(0.06 + 0.08, abs=1e-3)
    assert abs(rig.v_x) < 1e-4


def test_uneven_friction_goes_with_the_place_on_the_edge():
    friction = UnevenFriction(ripple=0.5, length=0.004)
    rig = MujocoRig(config(mu_c=0.2), PHYSICS, Faults(friction=friction))
    rig.step(0.0, 0.02)
    left, right = (rig.contact_directions[side] for side in ('left', 'right'))
    alpha = (math.atan2(*left[::-1]) - math.atan2(*right[::-1])) / 2.0
    assert math.tan(alpha) == pytest.approx(friction.mu_c(0.2, rig.sigma), rel=0.01)


def test_an_outline_of_arcs_is_refused():
    ellipse = Outline.ellipse(0.05, 0.03)
    with pytest.raises(ValueError, match='outline: expected a polygon or a circle'):
        MujocoRig(config(outline=ellipse, support=Support.rim(ellipse), start=(0.0, None)), PHYSICS)


def test_a_finger_that_goes_back_faster_than_the_belt_touches_elsewhere():
    theta = math.radians(17.0)
    rig = MujocoRig(config(start=(theta, 0.006)), PHYSICS)
    rig.step(0.0, 0.8, v_along=-0.02)
    before, parted = rig.object_pose, (rig.touching, rig.reading().in_contact)
    rig.step(-0.012, 1.0)
    assert parted == (False, False)
    assert tuple(rig.object_pose) == pytest.approx(tuple(before), abs=1e-6)
    assert rig.finger_pose.y == pytest.approx(0.08 - 0.016, abs=1e-4)
    waited = 0
    while not rig.touching and waited < 20:
        rig.step(0.0, STEP)
        waited += 1
    # It has gone back by 16 mm, the edge is nearer by 12 mm tan(theta), and the belt brings 5 mm/s.
    expected = (0.016 - 0.012 * math.tan(theta)) / 0.005 - 1.8
    assert STEP * waited == pytest.approx(expected, abs=STEP)
    assert rig.d == pytest.approx(0.006 - 0.012 / math.cos(theta), abs=2e-4)
    assert rig.theta == pytest.approx(theta, abs=math.radians(1.0))
