# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The joint servo with a finger whose joints do as they are told, or do not."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import (
    ANOTHER_COMMAND,
    AWAITING_COMMAND,
    COMMAND_SILENT,
    DOES_NOT_FOLLOW,
    FINGER_UNKNOWN,
    FOLLOWING,
    IMPLAUSIBLE_COMMAND,
    INACTIVE,
    JOINT_LIMIT,
    SERVO_STATES,
    SERVO_STOP_REASONS,
    STOPPED,
    WORKSPACE_LIMIT,
    JointBounds,
    JointServo,
    ServoLimits,
    servo_values,
)
from tactile_push.tactile import LinearAxis, PlanarFinger

PROPERTY = settings(derandomize=True, deadline=None, max_examples=100)
FINGER = PlanarFinger(0.06, 0.08, math.pi / 2.0)
BOUNDS = JointBounds((-3.0, -3.0), (3.0, 3.0), (2.0, 2.0))
RECTANGLE = (math.pi / 2.0, -math.pi / 2.0)  # the disk at (-6, 8) cm
PERIOD = 0.02


class Drive:
    """Joints that go as fast as they are asked to, unless told to disobey."""

    def __init__(self, servo, joints=RECTANGLE, obey=lambda rates: rates):
        self.servo, self.joints, self.obey = servo, list(joints), obey
        self.time, self.steps, self.rates = 0.0, [], (0.0,) * len(joints)

    def run(self, v_x, seconds, *, joint_states=True):
        """Let time pass with a command, or without one if it is None; return the last step."""
        for _ in range(round(seconds / PERIOD)):
            if joint_states:
                self.servo.locate(self.joints, self.time, self.time)
            if v_x is not None:
                self.servo.command(v_x, self.time)
            self.steps.append(self.servo.step(self.time))
            self.rates = self.steps[-1].rates or self.rates  # a drive keeps the last ones
            self.joints = [
                joint + rate * PERIOD
                for joint, rate in zip(self.joints, self.obey(self.rates), strict=True)
            ]
            self.time += PERIOD
        return self.steps[-1]

    @property
    def place(self):
        return FINGER.centre(self.joints)


@pytest.fixture
def servo():
    servo = JointServo(FINGER, BOUNDS)
    servo.activate(0.0)
    return servo


def said(step):
    return step.state, step.stop_reason


def test_disk_follows_the_command_and_keeps_its_line(servo):
    drive = Drive(servo)
    drive.run(0.0077, 5.0)
    x, y = drive.place
    assert x == pytest.approx(-0.06 + 5.0 * 0.0077, abs=2e-4)
    assert y == pytest.approx(0.08, abs=1e-5)
    drive.run(-0.0077, 5.0)
    assert drive.place == pytest.approx((-0.06, 0.08), abs=3e-5)
    assert {said(step) for step in drive.steps} == {(FOLLOWING, '')}
    assert drive.steps[-1].share == 1.0


def test_disk_goes_back_to_its_line_at_the_rate_of_the_gain(servo):
    drive = Drive(servo)
    drive.run(1e-6, 0.1)
    drive.joints = list(FINGER.inverse(-0.06, 0.0790))
    servo._stamp = -math.inf  # nobody watched how it came there
    drive.run(1e-6, 0.2)
    # By Euler's method, (1 - 5/s 0.02 s)^10 of the millimetre.
    assert drive.place == pytest.approx((-0.06, 0.08 - 1e-3 * 0.9**10), abs=1e-6)


def test_a_command_of_0_is_0_for_every_joint_wherever_the_disk_is(servo):
    drive = Drive(servo)
    drive.run(0.005, 0.1)
    drive.joints = list(FINGER.inverse(-0.06, 0.0795))
    step = drive.run(0.0, PERIOD)
    assert said(step) == (FOLLOWING, '')
    assert step.rates == (0.0, 0.0)


def test_before_the_first_command_it_rests_and_knows_no_line(servo):
    drive = Drive(servo)
    drive.rates = (0.1, 0.1)  # as another servo left them
    drive.run(None, 0.5)
    drive.joints = list(FINGER.inverse(0.0, 0.09))  # somebody else moves the finger
    step = drive.run(None, 0.1)
    assert {said(step) for step in drive.steps} == {(AWAITING_COMMAND, '')}
    assert {step.rates for step in drive.steps} == {(0.0, 0.0)}
    assert math.isnan(step.line)
    assert drive.run(0.001, 0.1).line == pytest.approx(0.09)
    assert drive.run(0.001, 1.0).stop_reason == ''


def test_a_stop_does_not_move_the_line_and_an_activation_does(servo):
    drive = Drive(servo)
    drive.run(0.005, 0.1)
    drive.run(None, 1.0)
    drive.joints = list(FINGER.inverse(-0.06, 0.0795))  # pushed away by half a millimetre
    assert drive.run(0.005, 0.1).line == pytest.approx(0.08)
    servo.activate(drive.time)
    drive.joints = list(FINGER.inverse(-0.06, 0.0795))
    assert drive.run(0.005, 0.1).line == pytest.approx(0.0795)


def test_it_stops_exactly_when_the_command_is_older_than_its_timeout(servo):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    commanded = drive.time - PERIOD
    servo.locate(drive.joints, drive.time, commanded + 0.5)
    assert said(servo.step(commanded + 0.5)) == (FOLLOWING, '')
    step = servo.step(commanded + 0.500001)
    assert said(step) == (STOPPED, COMMAND_SILENT)
    assert step.rates == (0.0, 0.0)
    servo.command(0.005, commanded + 0.6)
    assert said(servo.step(commanded + 0.6)) == (FOLLOWING, '')


def test_it_stops_exactly_when_joint_states_are_older_than_their_timeout(servo):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    located = drive.time - PERIOD
    servo.command(0.005, located + 0.2)
    assert said(servo.step(located + 0.2)) == (FOLLOWING, '')
    step = servo.step(located + 0.200001)
    assert said(step) == (STOPPED, FINGER_UNKNOWN)
    assert step.rates == (0.0, 0.0)
    assert drive.run(0.005, 0.1).state == FOLLOWING


def test_a_command_without_joint_states_is_not_followed(servo):
    step = Drive(servo).run(0.005, 1.0, joint_states=False)
    assert said(step) == (STOPPED, FINGER_UNKNOWN)
    assert step.rates == (0.0, 0.0)


@pytest.mark.parametrize('v_x', [math.nan, math.inf, -math.inf])
def test_a_command_that_is_no_velocity_stops_it_until_there_is_one(servo, v_x):
    drive = Drive(servo)
    drive.run(0.005, 0.5)
    assert not servo.command(v_x, drive.time)
    assert said(drive.run(None, 0.1)) == (STOPPED, IMPLAUSIBLE_COMMAND)
    assert drive.steps[-1].rates == (0.0, 0.0)
    assert servo.command(0.005, drive.time)
    assert said(drive.run(None, 0.1)) == (FOLLOWING, '')


def test_a_command_that_is_too_fast_is_slowed_down_and_told(servo):
    drive = Drive(servo)
    step = drive.run(0.1, 1.0)  # five times as fast as it may be
    assert step.share == pytest.approx(0.2)
    assert drive.place[0] == pytest.approx(-0.06 + 0.02, abs=5e-4)


def test_at_the_end_of_its_workspace_it_moves_inward_only(servo):
    servo.bounds = replace(BOUNDS, workspace_max=-0.05)
    drive = Drive(servo)
    assert said(drive.run(0.01, 3.0)) == (STOPPED, WORKSPACE_LIMIT)
    assert -0.0508 < drive.place[0] <= -0.05
    assert said(drive.run(-0.01, 1.0)) == (FOLLOWING, '')
    assert drive.place[0] == pytest.approx(-0.06, abs=1e-3)


def test_at_a_joint_limit_it_stands_on_its_line_and_moves_inward_only(servo):
    servo.bounds = replace(BOUNDS, joint_min=(-3.0, -1.7))
    drive = Drive(servo)
    assert said(drive.run(0.01, 5.0)) == (STOPPED, JOINT_LIMIT)
    assert -1.7 <= drive.joints[1] < -1.69
    assert drive.place[1] == pytest.approx(0.08, abs=1e-4)
    assert said(drive.run(-0.01, 0.5)) == (FOLLOWING, '')


@pytest.mark.parametrize(
    'obey',
    [
        lambda rates: (0.0, 0.0),
        lambda rates: (rates[0], 0.0),
        lambda rates: (rates[0], -rates[1]),
        lambda rates: (rates[1], rates[0]),
        lambda rates: (rates[0] + 0.1, rates[1]),
    ],
    ids=['stands', 'one stands', 'turns back', 'joints confused', 'drifts'],
)
def test_a_finger_that_does_not_follow_is_stopped_until_it_is_activated_anew(servo, obey):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    drive.obey = obey
    assert said(drive.run(0.005, 1.0)) == (STOPPED, DOES_NOT_FOLLOW)
    assert drive.steps[-1].rates == (0.0, 0.0)
    drive.obey = lambda rates: rates
    assert said(drive.run(0.005, 2.0)) == (STOPPED, DOES_NOT_FOLLOW)
    servo.activate(drive.time)
    assert said(drive.run(0.005, 1.0)) == (FOLLOWING, '')


@pytest.mark.parametrize('v_x', [2e-4, 0.002, 0.0077, 0.02])
def test_a_drive_that_stands_is_noticed_after_the_same_way_however_slow_it_is_to_be(servo, v_x):
    drive = Drive(servo)
    drive.run(v_x, 0.1)
    drive.obey = lambda rates: (0.0, 0.0)
    stood = drive.time
    while drive.run(v_x, PERIOD).state == FOLLOWING:
        assert drive.time - stood < 0.0025 / v_x
    # Of a way s that is not gone at all, 1 cm (1 - exp(-s / 1 cm)) is remembered: 2 mm of it.
    way = 0.01 * math.log(10.0 / 8.0)
    assert (drive.time - stood) * v_x == pytest.approx(way, abs=2.0 * PERIOD * v_x + 1e-6)
    assert said(drive.steps[-1]) == (STOPPED, DOES_NOT_FOLLOW)


@pytest.mark.parametrize(('share', 'state'), [(0.85, FOLLOWING), (0.75, STOPPED)])
def test_a_drive_that_is_a_little_slow_follows_on_a_way_of_any_length(servo, share, state):
    """It is behind by its part of the last centimetre."""
    drive = Drive(servo, obey=lambda rates: tuple(share * rate for rate in rates))
    assert drive.run(0.02, 4.0).state == state


def test_what_moves_a_finger_slowly_at_rest_is_forgotten(servo):
    drive = Drive(servo)
    drive.run(0.0, 0.1)
    drive.obey = lambda rates: (0.01, 0.0)  # 1 mm/s of the disk
    assert said(drive.run(0.0, 10.0)) == (FOLLOWING, '')


def test_a_joint_that_lags_by_a_control_period_follows(servo):
    velocity = [0.0, 0.0]

    def lag(rates):
        for joint in (0, 1):
            velocity[joint] += (rates[joint] - velocity[joint]) * PERIOD / 0.1
        return tuple(velocity)

    drive = Drive(servo, obey=lag)
    for v_x in (0.0077, -0.0077, 0.0, 0.0077):
        assert said(drive.run(v_x, 3.0)) == (FOLLOWING, '')
    # It stays behind by the lag times the change of the velocity, and that is forgotten.
    assert 0.5 * 0.1 * 0.0154 < max(step.deviation for step in drive.steps) < 0.1 * 0.0154
    assert drive.steps[-1].deviation < 0.15 * 0.1 * 0.0077


def test_a_finger_at_rest_that_somebody_moves_does_not_follow(servo):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    drive.run(None, 1.0)
    drive.joints = list(FINGER.inverse(-0.04, 0.08))
    assert said(drive.run(None, 0.1)) == (STOPPED, DOES_NOT_FOLLOW)


def test_what_happens_while_joint_states_are_silent_is_not_compared(servo):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    drive.obey = lambda rates: (0.0, -0.3)
    drive.run(0.005, 0.3, joint_states=False)
    drive.obey = lambda rates: rates
    assert said(drive.run(0.005, 1.0)) == (FOLLOWING, '')


def test_another_command_stops_it_until_it_is_activated_anew(servo):
    drive = Drive(servo)
    drive.run(0.005, 0.1)
    servo.notice_another_command()
    assert said(drive.run(0.005, 0.1)) == (STOPPED, ANOTHER_COMMAND)
    servo.activate(drive.time)
    assert said(drive.run(0.005, 0.1)) == (FOLLOWING, '')


def test_inactive_it_commands_nothing_but_a_last_zero(servo):
    drive = Drive(servo)
    assert JointServo(FINGER, BOUNDS).step(0.0).rates is None
    drive.run(0.005, 0.1)
    assert servo.deactivate() == (0.0, 0.0)
    assert servo.state == INACTIVE
    assert drive.run(0.005, 0.1).rates is None


def test_simulated_time_that_is_set_back_makes_everything_unknown(servo):
    drive = Drive(servo)
    drive.run(0.005, 1.0)
    assert said(servo.step(0.5)) == (STOPPED, FINGER_UNKNOWN)
    drive.time = 0.5
    assert said(drive.run(0.005, 0.1)) == (FOLLOWING, '')


def test_an_axis_follows():
    servo = JointServo(LinearAxis(), JointBounds((-0.2,), (0.2,), (0.05,)))
    servo.activate(0.0)
    drive = Drive(servo, joints=(0.01,))
    step = drive.run(0.005, 1.0)
    assert drive.joints == pytest.approx([0.015])
    assert (step.x, step.y, step.line) == pytest.approx((0.0149, 0.0, 0.0))
    drive.obey = lambda rates: (0.0,)
    assert said(drive.run(0.005, 1.0)) == (STOPPED, DOES_NOT_FOLLOW)


wild = st.floats() | st.floats(-1.0, 1.0)
events = st.lists(
    st.tuples(st.just('command'), wild)
    | st.tuples(st.just('locate'), st.tuples(*[st.floats(-1e6, 1e6)] * 2))
    | st.tuples(st.just('locate'), st.tuples(*[st.floats(-3.5, 3.5)] * 2))
    | st.tuples(st.just('other'), st.none())
    | st.tuples(st.just('wait'), st.floats(-0.1, 1.0)),
    max_size=30,
)


@given(events=events, speed=st.tuples(*[st.floats(1e-3, 10.0)] * 2))
@PROPERTY
def test_whatever_comes_the_joints_are_within_their_speeds_and_rest_unless_it_follows(
    events, speed
):
    servo = JointServo(FINGER, replace(BOUNDS, joint_speed=speed))
    servo.activate(0.0)
    now = stamp = 0.0
    for event, value in events:
        if event == 'command':
            servo.command(value, now)
        elif event == 'locate':
            stamp += PERIOD
            servo.locate(value, stamp, now)
        elif event == 'other':
            servo.notice_another_command()
        else:
            now += value
        step = servo.step(now)
        assert all(abs(rate) <= most for rate, most in zip(step.rates, speed, strict=True))
        assert step.state == FOLLOWING or step.rates == (0.0, 0.0)
        assert (step.state == STOPPED) == bool(step.stop_reason)


def test_joint_limits_without_a_workspace_are_refused():
    with pytest.raises(ValueError, match='^joint_min: expected'):
        JointServo(FINGER, replace(BOUNDS, joint_min=(-3.0, -0.1), joint_max=(3.0, 0.1)))


@pytest.mark.parametrize('name', list(vars(ServoLimits())))
@pytest.mark.parametrize('value', [0.0, -1.0, math.nan, math.inf])
def test_limits_are_positive(name, value):
    with pytest.raises(ValueError, match=f'^{name}: expected a positive number'):
        ServoLimits(**{name: value})


def test_values_say_what_was_decided(servo):
    drive = Drive(servo)
    values = servo_values(drive.run(0.008, PERIOD))
    assert values['first_velocity'] == pytest.approx(0.0, abs=1e-12)
    assert values['second_velocity'] == pytest.approx(-0.1)
    assert (values['v_x'], values['share']) == (0.008, 1.0)
    assert (values['finger_x'], values['finger_y']) == pytest.approx((-0.06, 0.08))
    assert (values['line'], values['deviation']) == pytest.approx((0.08, 0.0))
    assert SERVO_STATES[int(values['state'])] == FOLLOWING
    assert SERVO_STOP_REASONS[int(values['stop_reason'])] == ''
    axis = JointServo(LinearAxis(), JointBounds((-0.2,), (0.2,), (0.05,)))
    axis.activate(0.0)
    one = servo_values(Drive(axis, joints=(0.0,)).run(0.005, PERIOD))
    assert one['first_velocity'] == 0.005
    assert math.isnan(one['second_velocity'])
