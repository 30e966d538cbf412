# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo that takes joint velocities."""

import math
from dataclasses import replace

import pytest

pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")

from tactile_push.control import JointBounds, JointServo
from tactile_push.parameters import MujocoPlantParameters
from tactile_push.parameters.mujoco_plant import mujoco_config
from tactile_push.simulation import Faults, Servo, Workspace, servoed
from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig
from tactile_push.simulation.mujoco_rig import MujocoRig

CONFIG, PHYSICS = mujoco_config(MujocoPlantParameters(mu_c=0.5, support='corners'))
BOUNDS = JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0))


def test_joints_turn_as_they_are_told():
    rig = MujocoJointRig(CONFIG, PHYSICS)
    before = rig.joints
    rig.drive((0.05, -0.1), 0.2)
    assert rig.joints == pytest.approx((before[0] + 0.01, before[1] - 0.02), abs=3e-4)
    assert rig.belt_travel == pytest.approx(0.001, rel=0.01)
    pose = CONFIG.finger.forward(*rig.joints)
    assert (rig.finger_pose.x, rig.finger_pose.y) == pytest.approx((pose.x, pose.y))


def test_through_the_servo_it_moves_as_the_rig_that_is_commanded_across():
    across, by_joints = MujocoRig(CONFIG, PHYSICS), MujocoJointRig(CONFIG, PHYSICS)
    move = servoed(by_joints, JointServo(CONFIG.finger, BOUNDS))
    for _ in range(50):
        across.step(0.004, 0.02)
        move(0.004, 0.02, True)
    assert by_joints.theta == pytest.approx(across.theta, abs=math.radians(0.1))
    assert by_joints.finger_x == pytest.approx(across.finger_x, abs=5e-5)
    assert by_joints.finger_y == pytest.approx(across.finger_y, abs=5e-5)


def test_a_wrist_holds_the_tip_straight():
    rig = MujocoJointRig(replace(CONFIG, tip_turns=False), PHYSICS)
    rig.drive((0.05, -0.2), 0.2)
    assert rig.psi == pytest.approx(math.pi / 2.0, abs=1e-3)


def test_each_joint_lags_and_waits_as_the_servo_does():
    faults = Faults(servo=Servo(time_constant=0.1, delay=0.1))
    rig = MujocoJointRig(CONFIG, PHYSICS, faults)
    before = rig.joints[1]
    rig.drive((0.0, -0.2), 0.3)
    way = 0.2 * (0.2 - 0.1 * -math.expm1(-2.0))
    assert rig.joints[1] - before == pytest.approx(-way, rel=0.03)


def test_at_the_end_of_the_workspace_all_joints_stand():
    rig = MujocoJointRig(CONFIG, PHYSICS, Faults(workspace=Workspace(upper=-0.059)))
    rig.drive((0.0, -0.1), 0.3)
    assert rig.at_workspace_limit
    assert rig.finger_pose.x == pytest.approx(-0.059, abs=1e-4)
    rig.drive((0.0, 0.1), 0.1)
    assert not rig.at_workspace_limit


def test_a_joint_stands_at_its_stop():
    rig = MujocoJointRig(CONFIG, PHYSICS)
    rig.drive((0.0, 8.0), 0.3)
    assert rig.at_workspace_limit
    assert rig.joints[1] == pytest.approx(-0.05, abs=0.02)
