# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The servo's node: commands and joint states in, velocities of the joints out."""

import math

import pytest
from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import State
from rclpy.parameter import Parameter as RosParameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from fuzzing.messages import extremes
from support.node_bench import declared_topics
from tactile_push.control import (
    ANOTHER_COMMAND,
    AWAITING_COMMAND,
    COMMAND_SILENT,
    DOES_NOT_FOLLOW,
    FINGER_UNKNOWN,
    FOLLOWING,
    IMPLAUSIBLE_COMMAND,
    INACTIVE,
    SERVO_STATES,
    SERVO_STOP_REASONS,
    STOPPED,
)
from tactile_push.interface import (
    COMMAND,
    FINGER_SERVO,
    JOINT_STATES,
    SERVO_COMMANDS,
    SERVO_STATE,
    TOPICS,
)
from tactile_push.nodes.finger_servo import FingerServo
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.pipeline.messages import command_fields, joint_state_fields
from tactile_push.tactile import PlanarFinger

FINGER = PlanarFinger(0.06, 0.08, math.pi / 2.0)
NAMES = TOPICS[JOINT_STATES].field_names
PERIOD = 0.02  # of joint states and commands [s]
PATIENT = {'command_timeout': 10.0, 'joint_state_timeout': 10.0}  # on a loaded machine, too


class Drive:
    """A velocity controller with joints that obey, and somebody who commands v_x."""

    def __init__(self, bench):
        self.bench = bench
        self.joints = list(FINGER.inverse(-0.06, 0.08))
        self.at, self.v_x = None, 0.0
        self.speaks = self.reports = self.obeys = True
        self.joint_states = bench.publisher(JointState, JOINT_STATES)
        self.commands = bench.publisher(TwistStamped, COMMAND)
        bench.hear(Float64MultiArray, SERVO_COMMANDS)
        bench.hear(JointState, SERVO_STATE)

    def go_on(self):
        """Move the joints, tell where they are, and command, no faster than others can hear it."""
        now = self.bench.peer.get_clock().now()
        passed = 0.0 if self.at is None else (now - self.at).nanoseconds * 1e-9
        if self.at is not None and passed < PERIOD:
            return
        self.at = now
        if self.bench.heard[SERVO_COMMANDS] and self.obeys:
            pairs = zip(self.joints, self.bench.heard[SERVO_COMMANDS][-1].data, strict=True)
            self.joints = [joint + rate * passed for joint, rate in pairs]
        stamp = now.seconds_nanoseconds()
        if self.reports:
            fields = joint_state_fields(stamp, dict(zip(NAMES, self.joints, strict=True)))
            self.joint_states.publish(filled(JointState(), fields))
        if self.speaks:
            self.commands.publish(filled(TwistStamped(), command_fields(stamp, self.v_x)))

    def until(self, *words):
        """Go on until the servo says a state, and perhaps a reason to stand."""
        self.bench.until(lambda: self.said()[: len(words)] == words, self.go_on)

    def said(self):
        if not self.bench.heard[SERVO_STATE]:
            return ()
        values = self.bench.values(SERVO_STATE)
        state, reason = int(values['state']), int(values['stop_reason'])
        return SERVO_STATES[state], SERVO_STOP_REASONS[reason]

    def rests(self):
        """Return whether the last velocities are 0, and the finger has heard so."""
        return not any(self.bench.heard[SERVO_COMMANDS][-1].data)


@pytest.fixture
def drive(bench):
    """Return what starts the servo and a drive for it."""

    def start(**parameters):
        node = bench.start(FingerServo, **{**PATIENT, **parameters})
        return node, Drive(bench)

    return start


def test_topics_are_those_of_the_interface(bench):
    bench.start(FingerServo)
    assert bench.topics() == declared_topics(FINGER_SERVO)


def test_without_autostart_it_waits_for_its_manager(bench):
    node = bench.start(FingerServo, autostart=False)
    assert node._state_machine.current_state[0] == State.PRIMARY_STATE_UNCONFIGURED
    assert bench.topics() == (set(), set())
    assert bench.health == (OK, 'inactive')


def test_joints_move_the_disk_across_the_belt_and_keep_its_line(bench, drive):
    _, finger = drive()
    finger.v_x = 0.008
    bench.until(lambda: finger.said() and FINGER.centre(finger.joints)[0] > -0.058, finger.go_on)
    assert finger.said() == (FOLLOWING, '')
    assert FINGER.centre(finger.joints)[1] == pytest.approx(0.08, abs=2e-4)
    values = bench.values(SERVO_STATE)
    assert tuple(values) == TOPICS[SERVO_STATE].field_names
    assert values['v_x'] == 0.008
    assert values['line'] == pytest.approx(0.08)
    # By the second joint alone, 8 mm/s at 8 cm, while the pole points straight ahead.
    first, second = bench.heard[SERVO_COMMANDS][-1].data
    assert second == pytest.approx(-0.1, abs=0.01)
    assert abs(first) < 0.01
    assert bench.health == (OK, FOLLOWING)


def test_before_the_first_command_it_sends_zeros_for_who_has_other_velocities_in_force(
    bench, drive
):
    _, finger = drive()
    finger.speaks = False
    bench.until(lambda: len(bench.heard[SERVO_COMMANDS]) > 3)  # and without joint states
    assert finger.said() == (AWAITING_COMMAND, '')
    assert {tuple(m.data) for m in bench.heard[SERVO_COMMANDS]} == {(0.0, 0.0)}
    assert bench.health == (WARN, AWAITING_COMMAND)


@pytest.mark.parametrize(
    ('silent', 'timeout', 'reason'),
    [
        ('speaks', 'command_timeout', COMMAND_SILENT),
        ('reports', 'joint_state_timeout', FINGER_UNKNOWN),
    ],
)
def test_silence_stops_it_within_a_period_and_it_goes_on_by_itself(
    bench, drive, silent, timeout, reason
):
    node, finger = drive()
    finger.v_x = 0.004
    finger.until(FOLLOWING)
    (answer,) = node.set_parameters([RosParameter(timeout, value=0.3)])
    assert answer.successful
    setattr(finger, silent, False)
    finger.until(STOPPED, reason)
    bench.until(finger.rests)
    level, words = bench.health
    assert level == ERROR
    assert words.startswith(f'stopped: {reason}')  # a late message is told, too
    setattr(finger, silent, True)
    finger.until(FOLLOWING)


def test_it_stops_though_nothing_arrives_at_all(bench, drive):
    _, finger = drive(command_timeout=0.3)
    finger.until(FOLLOWING)
    bench.until(lambda: finger.said()[0] == STOPPED)
    bench.until(finger.rests)


def test_joint_states_of_other_names_stop_it_and_are_told(bench, drive):
    _, finger = drive(joint_names=['proximal_joint', 'knuckle'])
    finger.until(STOPPED, FINGER_UNKNOWN)
    level, words = bench.health
    assert level == ERROR
    assert 'got no knuckle, but proximal_joint, distal_joint' in words


def test_a_command_that_is_no_number_stops_it(bench, drive):
    _, finger = drive()
    finger.v_x = math.nan
    finger.until(STOPPED, IMPLAUSIBLE_COMMAND)
    bench.until(finger.rests)
    finger.v_x = 0.001
    finger.until(FOLLOWING)


def test_a_controller_that_does_not_follow_stops_it_until_it_is_activated_anew(bench, drive):
    node, finger = drive()
    finger.v_x = 0.01
    finger.until(FOLLOWING)
    finger.obeys = False
    finger.until(STOPPED, DOES_NOT_FOLLOW)
    bench.until(finger.rests)
    assert bench.health == (ERROR, 'stopped: finger does not follow, until activated anew')
    finger.obeys = True
    node.trigger_deactivate()
    node.trigger_activate()
    finger.until(FOLLOWING)


def test_another_commander_stops_it_until_it_is_activated_anew(bench, drive):
    _, finger = drive()
    finger.until(FOLLOWING)
    other = bench.publisher(Float64MultiArray, SERVO_COMMANDS)
    bench.until(lambda: other.get_subscription_count() > 2)  # the servo's two, and the peer's
    assert bench.health[0] == WARN
    other.publish(Float64MultiArray(data=[0.01, 0.0]))  # so slow that the finger follows
    finger.until(STOPPED, ANOTHER_COMMAND)
    bench.until(finger.rests)


def test_a_slowed_command_is_a_warning(bench, drive):
    _, finger = drive(max_speed=0.005)
    finger.v_x = 0.01
    finger.until(FOLLOWING)
    assert bench.health == (WARN, 'following at 50% of the commanded velocity')


def test_deactivated_it_sends_last_zeros_and_falls_silent(bench, drive):
    node, finger = drive()
    finger.v_x = 0.008
    finger.until(FOLLOWING)
    node.trigger_deactivate()
    bench.until(lambda: finger.said() == (INACTIVE, ''))
    bench.until(finger.rests)
    said, taken = len(bench.heard[SERVO_COMMANDS]), node._counted['joint states']
    bench.until(lambda: node._counted['joint states'] > taken + 5, finger.go_on)
    assert len(bench.heard[SERVO_COMMANDS]) == said
    node.trigger_activate()
    finger.until(FOLLOWING)


def test_messages_at_their_extremes_give_no_velocity_that_is_not_finite_or_too_fast(bench, drive):
    node, finger = drive()
    finger.v_x = 0.005
    finger.until(FOLLOWING)
    stamp = bench.peer.get_clock().now().seconds_nanoseconds()
    joints = joint_state_fields(stamp, dict(zip(NAMES, finger.joints, strict=True)))
    command = filled(TwistStamped(), command_fields(stamp, 0.005))
    for publisher, valid in (
        (finger.commands, command),
        (finger.joint_states, filled(JointState(), joints)),
    ):
        for _, message in extremes(valid):
            finger.go_on()
            publisher.publish(message)
            heard = sum(node._counted.values())
            bench.until(lambda heard=heard: sum(node._counted.values()) > heard)
    heard = [rate for message in bench.heard[SERVO_COMMANDS] for rate in message.data]
    assert all(abs(rate) <= 2.0 for rate in heard)
    assert node._counted['implausible commands'] >= 3


def test_joints_that_are_none_are_refused(bench):
    with pytest.raises(ConfigurationError, match='^parameter joint_min: expected a pose'):
        bench.start(FingerServo, joint_min=[-3.0, -0.1], joint_max=[3.0, 0.1])
