# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math

import pytest

from support.bag_making import encode, joint_state, write_bag
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.control import STATES
from tactile_push.identification.bag_pushes import GAP, pushes_in_bag
from tactile_push.identification.predicting import Physics, errors_of, residuals
from tactile_push.identification.records import CUT, Pushes
from tactile_push.interface import PARAMETERS_NOTE, POSE_TYPE
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import ObjectFile, Rig, RigConfig

STATE, JOINTS = 'sensor_msgs/msg/JointState', '/joint_states'
PUSHING = float(STATES.index('pushing'))
BLOCK = Outline.rectangle(0.05, 0.0475)
SUPPORT, MU_C, BELT = Support.spread(BLOCK, 1.4, 40), 0.3, 0.004
STEP, STEPS = 0.05, 160  # [s]; 32 mm of belt
KNOWN = ObjectFile(BLOCK)


@pytest.fixture(scope='module')
def run():
    """Return what a rig with a turning tip does: time, finger in its base, psi, object's pose."""
    slider = Slider.on(BLOCK, SUPPORT, exact=True)
    rig = Rig(RigConfig(slider, MU_C, 0.2, -0.004, belt_speed=BELT))
    rows = []
    for k in range(STEPS):
        pose, finger = rig.object_in_finger_disk, rig.finger_pose
        rows.append((k * STEP, finger.x, finger.y, rig.psi, *pose, rig.joints))
        rig.step(0.0015 * math.sin(0.08 * k), STEP)
    return rows


@pytest.fixture
def write(run, tmp_path):
    """Return a function that writes a bag of the run."""

    def written(
        frame='finger_disk',
        topic='/ground_truth/object_pose',
        pushing=lambda t: True,
        lost=(),
        fingers=('',),
    ):
        poses, states, joints = [], [], []
        for t, f_x, f_y, psi, x, y, angle, angles in run:
            stamp = round(1e9 * (t + 1.0))
            if frame == 'finger_base':
                x, y = x + f_x, y + f_y
            sec, nanosec = divmod(stamp, 10**9)
            header = {'stamp': {'sec': sec, 'nanosec': nanosec}, 'frame_id': frame}
            turned = {'z': math.sin(angle / 2.0), 'w': math.cos(angle / 2.0)}
            pose = {'position': {'x': x, 'y': y}, 'orientation': turned}
            if round(t / STEP) not in lost:
                poses.append((stamp, encode(POSE_TYPE, header=header, pose=pose)))
            state = PUSHING if pushing(t) else 0.0
            told = {'finger_x': f_x, 'finger_age': 0.02, 'psi': psi, 'state': state}
            states.append((stamp, joint_state(stamp + 20_000_000, **told)))
            names = dict(zip(('proximal_joint', 'distal_joint'), angles, strict=False))
            joints.append((stamp, joint_state(stamp, **names)))
        topics = {
            topic: (POSE_TYPE, poses),
            JOINTS: (STATE, joints),
            **{f'{finger}/push_controller/state': (STATE, states) for finger in fingers},
        }
        notes = {
            f'{finger}/push_controller'.removeprefix('/'): {'belt_speed': BELT}
            for finger in fingers[-1:]  # the others have the usual one
        }
        with BagWriter(tmp_path / 'bag') as bag:
            bag.note(PARAMETERS_NOTE, json.dumps(notes))
            for name, (kind, messages) in topics.items():
                bag.add_topic(name, kind)
                for stamp, data in messages:
                    bag.write(name, data, stamp, stamp)
        return tmp_path / 'bag'

    return written


def found(bag, topic=None):
    with BagReader(bag) as reader:
        return pushes_in_bag(reader, KNOWN, topic)


@pytest.mark.parametrize('frame', ['finger_disk', 'finger_base'])
def test_a_run_becomes_pushes_that_the_true_numbers_predict(write, frame):
    pushes = found(write(frame))

    assert len(pushes.pushes) == 6  # of 5 mm and a little, from 32 mm
    assert all(CUT <= math.dist(push.way[0], push.way[-1]) < 1.3 * CUT for push in pushes.pushes)
    errors = errors_of(residuals(pushes, Physics(SUPPORT, MU_C)))
    assert errors.position.max() < 4e-5  # parts of the way are taken for straight and even
    assert errors.angle.max() < 2e-3
    assert max(abs(push.end.angle - push.begin.angle) for push in pushes.pushes) > 0.02


def test_the_turn_of_the_tip_counts(write):
    pushes = found(write())

    assert max(abs(push.turn) for push in pushes.pushes) > 0.01
    straight = [push._replace(turn=0.0) for push in pushes.pushes]
    without = residuals(Pushes(BLOCK, tuple(straight)), Physics(SUPPORT, MU_C))
    assert errors_of(without).position.max() > 1e-4


def test_stretches_without_a_push_or_without_poses_are_left_out(write):
    half = STEPS * STEP / 2.0
    lost = range(60, 61 + math.ceil(GAP / STEP))

    pushes = found(write(pushing=lambda t: t < half, lost=lost))

    assert len(pushes.pushes) == 2  # from 16 mm, of which 2 mm are lost in the second half of them


def test_of_two_fingers_the_topic_names_one(write):
    topic, fingers = '/right/ground_truth/object_pose', ('/left', '/right')
    bag = write(topic=topic, fingers=fingers)

    pushes = found(bag, topic)

    assert errors_of(residuals(pushes, Physics(SUPPORT, MU_C))).position.max() < 4e-5
    for other in (None, '/mocap/block'):
        with pytest.raises(ValueError, match='expected poses in the namespace of a finger, /left'):
            found(bag, other)


def test_poses_of_another_topic_are_those_of_a_camera(write):
    pushes = found(write('finger_base', '/mocap/block'), '/mocap/block')

    assert errors_of(residuals(pushes, Physics(SUPPORT, MU_C))).position.max() < 4e-5


@pytest.mark.parametrize(
    ('how', 'topic', 'said'),
    [
        ({}, '/mocap/block', 'expected poses of the object on /mocap/block, got none'),
        ({'topic': '/mocap/block'}, None, 'poses of the object on /ground_truth/object_pose, got'),
        ({}, '/joint_states', 'expected poses of the object on /joint_states, got none'),
        ({'frame': 'map'}, None, "in finger_disk or finger_base, got 'map'"),
    ],
)
def test_a_bag_without_such_poses_is_refused(write, how, topic, said):
    with pytest.raises(ValueError, match='bag: ') as error:
        found(write(**how), topic)
    assert said in str(error.value)
    assert '\n' not in str(error.value)


def test_a_bag_without_a_controller_is_refused(tmp_path):
    with pytest.raises(BagError, match='expected messages on push_controller/state'):
        found(write_bag(tmp_path / 'bag', {'/x': (STATE, [(1, joint_state(1, a=1.0))])}))
