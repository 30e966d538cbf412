# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What messages mean to the servo: commands and joint states of all kinds."""

import math

import pytest

from tactile_push.control import FOLLOWING, JointBounds, JointServo
from tactile_push.interface import SERVO_COMMANDS, SERVO_STATE, TOPICS
from tactile_push.pipeline import Moment, Servo
from tactile_push.tactile import PlanarFinger

NAMES = ('proximal_joint', 'distal_joint')
RECTANGLE = (math.pi / 2.0, -math.pi / 2.0)
NOW = Moment(100.0, 7.0)


@pytest.fixture
def steps():
    """Return a servo that is active and has heard nothing."""
    finger = PlanarFinger(0.06, 0.08, math.pi / 2.0)
    servo = JointServo(finger, JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0)))
    servo.activate(NOW.steady)
    return Servo(servo, NAMES, lambda sec, nanosec: sec + nanosec * 1e-9)


def follows(steps, now=NOW):
    return steps.servo.step(now.steady).state == FOLLOWING


def test_a_command_and_joint_states_become_velocities(steps):
    assert steps.joint_states((100, 0), NAMES, RECTANGLE, NOW) == 'joint states'
    assert steps.command((99, 900_000_000), 'finger_base', 0.008, NOW) == 'commands'
    outputs = dict(steps.outputs((100, 10_000_000), steps.servo.step(NOW.steady)))
    # 8 mm/s at 8 cm, by the second joint alone.
    assert outputs[SERVO_COMMANDS]['data'] == pytest.approx([0.0, -0.1], abs=1e-15)
    state = outputs[SERVO_STATE]
    assert tuple(state['name']) == TOPICS[SERVO_STATE].field_names
    assert state['header']['stamp'] == {'sec': 100, 'nanosec': 10_000_000}
    values = dict(zip(state['name'], state['position'], strict=True))
    assert values['command_age'] == pytest.approx(0.11)
    assert values['joint_age'] == pytest.approx(0.01)
    assert values['v_x'] == 0.008


def test_an_inactive_servo_gives_no_velocities(steps):
    steps.servo.deactivate()
    topics = [topic for topic, _ in steps.outputs((100, 0), steps.servo.step(NOW.steady))]
    assert topics == [SERVO_STATE]


@pytest.mark.parametrize(
    ('frame', 'v_x', 'kind'),
    [
        ('', 0.001, 'commands'),
        ('left/finger_base', 0.001, 'commands'),
        ('base_link', 0.001, 'implausible commands'),
        ('finger_base', math.nan, 'implausible commands'),
        ('finger_base', -math.inf, 'implausible commands'),
    ],
)
def test_a_command_in_another_frame_or_of_no_number_stops_the_joints(steps, frame, v_x, kind):
    steps.joint_states((100, 0), NAMES, RECTANGLE, NOW)
    steps.command((100, 0), '', 0.001, NOW)
    assert follows(steps)
    assert steps.command((100, 0), frame, v_x, NOW) == kind
    assert follows(steps) == (kind == 'commands')


@pytest.mark.parametrize('age', [0.51, -0.51, 3600.0])
def test_a_command_of_another_time_does_not_count(steps, age):
    steps.joint_states((100, 0), NAMES, RECTANGLE, NOW)
    later = Moment(100.0 + age, 7.0)
    assert steps.command((100, 0), '', 0.001, later) == 'commands of another time'
    assert not follows(steps)
    words = f'stamped {abs(age):.1f} s {"ago" if age > 0.0 else "ahead"}'
    assert steps.trouble == f'finger/cmd_vel: {words}'
    assert steps.command((100, 0), '', 0.001, NOW) == 'commands'
    assert steps.trouble == ''
    assert follows(steps)


def test_a_command_without_a_stamp_counts_from_when_it_arrives(steps):
    steps.joint_states((100, 0), NAMES, RECTANGLE, NOW)
    assert steps.command((0, 0), '', 0.001, NOW) == 'commands'
    assert follows(steps)


@pytest.mark.parametrize('age', [0.21, -0.21, 3600.0])
def test_joint_states_of_another_time_do_not_count(steps, age):
    later = Moment(100.0 + age, 7.0)
    assert steps.joint_states((100, 0), NAMES, RECTANGLE, later) == 'joint states of another time'
    assert steps.trouble.startswith(f'joint_states: stamped {abs(age):.1f} s')
    steps.command((0, 0), '', 0.001, later)
    assert not follows(steps)


@pytest.mark.parametrize(
    ('names', 'positions', 'kind', 'trouble'),
    [
        (('wheel', 'distal_joint'), RECTANGLE, 'joint states of other joints', 'proximal_joint'),
        ((*NAMES, NAMES[1]), (1.0, -1.0, -1.0), 'joint states of other joints', 'more than once'),
        (NAMES, (0.1,), 'joint states of other joints', 'distal_joint has no position'),
        (NAMES, (0.1, math.nan), 'joint states refused', 'distal_joint is nan'),
        (NAMES, (1e7, 0.1), 'joint states refused', 'proximal_joint is 1'),
    ],
)
def test_joint_states_of_no_use_are_counted_and_told(steps, names, positions, kind, trouble):
    assert steps.joint_states((100, 0), names, positions, NOW) == kind
    assert trouble in steps.trouble
    steps.command((100, 0), '', 0.001, NOW)
    assert not follows(steps)


def test_joint_states_that_come_twice_or_late_do_no_harm(steps):
    steps.command((100, 0), '', 0.0, NOW)
    assert steps.joint_states((100, 0), NAMES, RECTANGLE, NOW) == 'joint states'
    for stamp in ((100, 0), (99, 990_000_000)):
        assert steps.joint_states(stamp, NAMES, (1.0, -1.0), NOW) == 'joint states not newer'
    assert steps.servo.step(NOW.steady).x == pytest.approx(-0.06)
    assert follows(steps)


def test_after_a_clock_was_set_back_joint_states_count_again(steps):
    steps.joint_states((100, 0), NAMES, RECTANGLE, NOW)
    back = Moment(50.0, 7.02)
    assert steps.joint_states((50, 0), NAMES, RECTANGLE, back) == 'joint states'
    steps.command((50, 0), '', 0.001, back)
    assert follows(steps, back)


def test_a_command_along_the_belt_stops_the_joints_which_keep_a_line(steps):
    steps.joint_states((100, 0), NAMES, RECTANGLE, NOW)
    assert steps.command((100, 0), '', 0.001, NOW, 0.0) == 'commands'
    assert follows(steps)
    assert steps.command((100, 0), '', 0.001, NOW, -0.001) == 'implausible commands'
    assert not follows(steps)
