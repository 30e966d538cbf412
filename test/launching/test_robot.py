# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's description, with MuJoCo's reader of URDF for what it means."""

import math
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from tactile_push.interface import FINGER_BASE, FINGER_DISK, FINGERTIP
from tactile_push.launching import FingerArguments, robot_description
from tactile_push.parameters import config_file
from tactile_push.tactile import PlanarFinger, Reading, contact_of_reading

xacro = pytest.importorskip('xacro', reason='pip install xacro')
mujoco = pytest.importorskip('mujoco', reason='pip install mujoco')

# MuJoCo gives every body a mass and leaves those in place that do not move.
COMPILER = '<mujoco><compiler fusestatic="false" boundmass="1" boundinertia="1"/></mujoco>'
UP = (0.0, 0.0, 1.0)


def described(**machine):
    return robot_description(FingerArguments(**machine).machine)


class Model:
    """A description as MuJoCo understands it."""

    def __init__(self, text):
        self.model = mujoco.MjModel.from_xml_string(
            re.sub(r'(<robot [^>]*>)', rf'\1{COMPILER}', text)
        )
        if not self.model.neq:
            pytest.skip(
                'this version of MuJoCo reads no mimic joints; pip install --upgrade mujoco'
            )
        self.data = mujoco.MjData(self.model)

    def frames(self, *angles):
        """Return origin and axes of the links, by name, at angles of the joints that move."""
        model, data = self.model, self.data
        mimics = {model.eq_obj1id[i]: i for i in range(model.neq)}
        moving = (joint for joint in range(model.njnt) if joint not in mimics)
        for joint, angle in zip(moving, angles, strict=True):
            data.qpos[model.jnt_qposadr[joint]] = angle
        for joint, i in mimics.items():
            offset, multiplier = model.eq_data[i][:2]
            other = data.qpos[model.jnt_qposadr[model.eq_obj2id[i]]]
            data.qpos[model.jnt_qposadr[joint]] = offset + multiplier * other
        mujoco.mj_kinematics(model, data)
        return {
            model.body(i).name: (data.xpos[i].copy(), data.xmat[i].reshape(3, 3).T.copy())
            for i in range(model.nbody)
        }


def test_frames_are_where_the_finger_is():
    rng = np.random.default_rng(5)
    for _ in range(10):
        a, b, mount = rng.uniform(0.02, 0.5), rng.uniform(0.02, 0.5), rng.uniform(-3.0, 3.0)
        model = Model(described(proximal_length=a, distal_length=b, mount_angle=mount))
        for proximal, distal in rng.uniform(-3.1, 3.1, (20, 2)):
            frames = model.frames(proximal, distal)
            pose = PlanarFinger(a, b, mount).forward(proximal, distal)
            pole = (math.cos(pose.psi), math.sin(pose.psi), 0.0)
            left = (-math.sin(pose.psi), math.cos(pose.psi), 0.0)
            origin, axes = frames[FINGERTIP]
            np.testing.assert_allclose(origin, (pose.x, pose.y, 0.0), atol=1e-9)
            np.testing.assert_allclose(axes, (left, UP, pole), atol=1e-9)
            origin, axes = frames[FINGER_DISK]
            np.testing.assert_allclose(origin, (pose.x, pose.y, 0.0), atol=1e-9)
            np.testing.assert_allclose(axes, np.eye(3), atol=1e-9)


@pytest.mark.parametrize(('azimuth', 'degrees'), [(0.0, 70.0), (math.pi, 70.0), (0.0, 15.0)])
def test_azimuth_and_elevation_are_angles_of_the_fingertips_frame(azimuth, degrees):
    elevation = math.radians(degrees)
    _, axes = Model(described()).frames(0.3, -0.7)[FINGERTIP]
    across = math.cos(elevation)
    u = (across * math.cos(azimuth), across * math.sin(azimuth), math.sin(elevation)) @ axes
    psi = math.pi / 2.0 + 0.3 - 0.7
    theta = contact_of_reading(Reading(azimuth, elevation), psi, 0.0135, 0.2).theta
    np.testing.assert_allclose(u, (-math.sin(theta), math.cos(theta), 0.0), atol=1e-9)


def test_wrist_turns_the_tip_and_not_the_disk():
    frames = Model(described(joint_names=['a', 'b', 'wrist'])).frames(0.4, -0.9, 0.5)
    pose = PlanarFinger(0.06, 0.08, math.pi / 2.0).forward(0.4, -0.9)
    for frame, axes in ((FINGERTIP, ((-1, 0, 0), UP, (0, 1, 0))), (FINGER_DISK, np.eye(3))):
        np.testing.assert_allclose(frames[frame][0], (pose.x, pose.y, 0.0), atol=1e-9)
        np.testing.assert_allclose(frames[frame][1], axes, atol=1e-9)


def test_file_alone_describes_the_usual_finger():
    alone = xacro.process_file(str(config_file('finger.urdf.xacro', 'urdf')))
    assert alone.documentElement.toxml() == described()


def test_links_are_one_tree_from_the_base_and_joints_have_what_their_types_need():
    robot = ElementTree.fromstring(described(joint_names=['a', 'b', 'wrist']))
    links = [link.get('name') for link in robot.findall('link')]
    joints = {joint.get('name'): joint for joint in robot.findall('joint')}
    assert len(joints) == len(robot.findall('joint'))
    assert {FINGER_BASE, FINGERTIP, FINGER_DISK} <= set(links)
    parents = {j.find('child').get('link'): j.find('parent').get('link') for j in joints.values()}
    assert len(parents) == len(joints)
    assert sorted([FINGER_BASE, *parents]) == sorted(links)
    for link in links:
        for _ in links:
            link = parents.get(link, link)
        assert link == FINGER_BASE
    for joint in joints.values():
        needed = {'revolute': ['limit'], 'continuous': [], 'fixed': []}[joint.get('type')]
        assert [name for name in needed if joint.find(name) is None] == []
        mimic = joint.find('mimic')
        assert mimic is None or mimic.get('joint') in joints


def test_limits_are_those_of_the_machine():
    text = described(joint_min=[-1.0, -2.0], joint_max=[1.5, 0.5], joint_speed=[3.0, 4.0])
    robot = ElementTree.fromstring(text)
    limits = {joint.get('name'): joint.find('limit') for joint in robot.findall('joint')}
    found = {
        name: tuple(float(limit.get(key)) for key in ('lower', 'upper', 'velocity'))
        for name, limit in limits.items()
        if limit is not None
    }
    assert found == {
        'proximal_joint': (-1.0, 1.5, 3.0),
        'distal_joint': (-2.0, 0.5, 4.0),
        'along_proximal_link_joint': (-0.5, 2.0, 4.0),
        'finger_disk_joint': (-1.5, 1.0, 3.0),
    }
