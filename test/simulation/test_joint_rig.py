# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig that takes joint velocities, alone and closed by the servo and the law."""

import math
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from tactile_push.control import JointBounds, JointServo, PushControl, PushLaw, settle_step
from tactile_push.simulation import (
    Belt,
    Faults,
    JointRig,
    Rig,
    Servo,
    Workspace,
    control_periods,
    experiment,
    paper_block,
    paper_disk,
    servoed,
)

BOUNDS = JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0))
STEPS = 260


def rig_of(config, faults=None):
    return JointRig(replace(config, tip_turns=True), faults or Faults())


def test_joints_turn_as_they_are_told_and_carry_the_disk():
    rig = rig_of(paper_block())
    finger, before = rig.config.finger, rig.joints
    rig.drive((0.05, -0.2), 0.5)
    after = before[0] + 0.025, before[1] - 0.1
    assert rig.joints == pytest.approx(after, abs=1e-9)
    pose, home = finger.forward(*after), finger.forward(*before)
    assert (rig.finger_pose.x, rig.finger_pose.y) == pytest.approx((pose.x, pose.y), abs=1e-12)
    assert rig.psi - math.pi / 2.0 == pytest.approx(-0.075, abs=1e-12)
    # The belt goes on under a finger that leaves its line.
    assert rig.belt_travel == pytest.approx(0.0025, abs=1e-12)
    assert rig.finger_y == pytest.approx(0.0025 + pose.y - home.y, abs=1e-12)
    assert rig.finger_x == pytest.approx(pose.x - home.x, abs=1e-12)


def test_velocity_across_the_belt_is_that_of_the_joints():
    rig = rig_of(paper_block())
    rig.drive((0.0, -0.1), 1e-4)
    assert rig.v_x == pytest.approx(0.008, rel=1e-4)  # 0.1 rad/s at 8 cm
    rig.drive((0.0, 0.0), 1e-4)
    assert rig.v_x == 0.0


@pytest.mark.parametrize('config', [paper_block(0.1, 0.003, mu_c=0.4), paper_disk(0.2, 0.3)])
def test_along_the_line_it_moves_the_object_as_the_rig_that_is_commanded_across(config):
    # Very short steps, in each of which the joints keep the disk on its line.
    across, by_joints = Rig(replace(config, tip_turns=True)), rig_of(config)
    move = servoed(by_joints, JointServo(by_joints.config.finger, BOUNDS))
    for v_x in (0.004, -0.006):
        for _ in range(400):
            across.step(v_x, 0.0025)
            move(v_x, 0.0025, True)
    assert by_joints.theta == pytest.approx(across.theta, abs=1e-3)
    assert by_joints.d == pytest.approx(across.d, abs=1e-5)
    assert by_joints.finger_x == pytest.approx(across.finger_x, abs=1e-5)
    assert by_joints.finger_y == pytest.approx(across.finger_y, abs=1e-5)


@pytest.mark.parametrize('rates', [(0.03, -0.1), (-0.2, 0.3), (0.0, 0.0)])
def test_one_step_is_as_good_as_twenty(rates):
    whole, pieces = rig_of(paper_block(mu_c=0.3)), rig_of(paper_block(mu_c=0.3))
    whole.drive(rates, 0.2)
    for _ in range(20):
        pieces.drive(rates, 0.01)
    assert whole.theta == pytest.approx(pieces.theta, abs=1e-4)
    assert whole.d == pytest.approx(pieces.d, abs=1e-6)
    assert whole.joints == pytest.approx(pieces.joints, abs=1e-9)


def test_a_finger_that_goes_back_faster_than_the_belt_leaves_the_object():
    rig = rig_of(paper_block(0.0, 0.0))
    rig.drive((0.3, 0.0), 0.5)  # of the knuckle at -6 cm: 18 mm/s back, and 24 mm/s to the left
    assert not rig.touching
    assert not rig.reading().in_contact


def test_a_wrist_holds_the_tip_straight():
    rig = JointRig(paper_block())
    rig.drive((0.1, -0.2), 0.5)
    assert rig.psi == math.pi / 2.0
    assert sum(rig.joints) + rig.config.finger.mount_angle == pytest.approx(math.pi / 2.0)


def test_a_joint_stands_at_its_stop_and_the_other_goes_on():
    rig = rig_of(paper_block())
    rig.drive((0.1, 2.0), 1.0)
    assert rig.at_workspace_limit
    assert rig.joints[1] == pytest.approx(-0.05)
    assert rig.joints[0] == pytest.approx(math.pi / 2.0 + 0.1)
    rig.drive((0.0, -1.0), 0.1)
    assert not rig.at_workspace_limit
    assert rig.joints[1] == pytest.approx(-0.15)


def test_at_the_end_of_the_workspace_all_joints_stand():
    rig = rig_of(paper_block(), Faults(workspace=Workspace(upper=-0.055)))
    rig.drive((0.0, -0.1), 2.0)
    assert rig.at_workspace_limit
    assert rig.finger_pose.x == pytest.approx(-0.055, abs=1e-9)
    assert rig.v_x == 0.0
    assert rig.belt_travel == pytest.approx(0.01)


def test_each_joint_lags_and_waits_as_the_servo_does():
    rig = rig_of(paper_block(), Faults(servo=Servo(time_constant=0.1, delay=0.2)))
    before = rig.joints[1]
    for _ in range(10):
        rig.drive((0.0, -0.2), 0.05)
    # After the delay of 0.2 s: 0.3 s, less the lag's 0.1 s (1 - e^-3).
    way = 0.2 * (0.3 - 0.1 * -math.expm1(-3.0))
    assert rig.joints[1] - before == pytest.approx(-way, rel=1e-3)


def test_a_delay_of_a_whole_step_holds_nothing_up():
    rig = rig_of(paper_block(), Faults(servo=Servo(delay=0.05)))
    before = rig.joints[1]
    for step in range(100):
        rig.drive((0.0, -0.01 * (step % 2)), 0.05)
    assert rig.time == pytest.approx(5.0)
    # Every other step counts, the last one not yet.
    assert rig.joints[1] - before == pytest.approx(-49 * 0.01 * 0.05, abs=1e-9)


def test_the_belt_runs_as_its_fault_has_it():
    belt = Belt(ripple=0.5, frequency=2.0)
    rig = rig_of(paper_block(), Faults(belt=belt))
    rig.drive((0.0, 0.0), 0.3)
    assert rig.belt_travel == pytest.approx(0.3 * belt.mean_speed(0.005, 0.0, 0.3))
    assert rig.v_y == pytest.approx(belt.speed(0.005, 0.3))
    rig.drive((0.0, 0.0), 0.3, belt_running=False)
    assert rig.v_y == 0.0


@pytest.mark.parametrize(
    ('config', 'theta_desired', 'band'),
    [
        (paper_block(), math.radians(-10.0), math.radians(3.0)),
        (paper_disk(), 0.0, math.radians(1.0)),
    ],
    ids=['block', 'disk'],
)
def test_through_the_servo_both_rigs_settle_as_if_the_finger_were_commanded_across(
    config, theta_desired, band
):
    rig = rig_of(config)
    law = PushLaw(0.05, 5.0, theta_desired)
    move = servoed(rig, JointServo(rig.config.finger, BOUNDS))
    control = PushControl(law, 0.005, 0.1)
    line, theta = rig.finger_pose.y, []
    for tick in islice(control_periods(rig, control, 2, 0, move), STEPS + 1):
        theta.append(tick.theta)
        assert rig.finger_pose.y == pytest.approx(line, abs=1e-4)
    ideal = experiment(rig.config, PushLaw(0.05, 5.0, theta_desired), STEPS)
    assert np.degrees(np.abs(theta - ideal.theta)).max() < 0.5
    settled = settle_step(np.array(theta), theta_desired, band)
    assert settled is not None
    assert settled <= 230
