# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of each message to the controller, and what the controller says."""

import math

import pytest

from tactile_push.control import FINGER_UNKNOWN, INACTIVE, NO_REASON, PUSHING, STATES, WAITING
from tactile_push.control.placing.stages import CANCELLED
from tactile_push.interface import (
    COMMAND,
    CONTROLLER_STATE,
    FINGER_BASE,
    FINGER_DISK,
    PLACE,
    PLACE_RELEASE,
    PLACE_STATE,
)
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    choose_law,
    make_control,
)
from tactile_push.pipeline import Control, edge_angle
from tactile_push.pipeline.named import OTHER_JOINTS, REFUSED, TAKEN
from tactile_push.tactile import PlanarFinger

JOINTS = ['proximal_joint', 'distal_joint']
# With these angles the first link leans by 60 degrees and the second points along +y.
ANGLES = [math.pi / 3.0, math.pi / 6.0]
FINGER_X = 0.03  # 0.06 cos 60 deg [m]


def control_seconds(sec, nanosec):
    return sec + nanosec * 1e-9


@pytest.fixture
def control():
    """Return the step with an active control, on a clock that begins at 0."""
    push = make_control(PushControllerParameters())
    push.activate(0.0)
    finger = PlanarFinger(0.06, 0.04, 0.0)
    return Control(push, finger, JOINTS, control_seconds)


@pytest.mark.parametrize(
    ('theta', 'plausible'),
    [(0.2, True), (-math.pi / 2.0, True), (1.58, False), (math.nan, False), (math.inf, False)],
)
def test_contact_says_whether_a_pushed_edge_can_have_its_angle(control, theta, plausible):
    assert control.contact((1, 0), theta) is plausible


def test_contact_is_as_old_as_its_stamp(control):
    control.contact((1, 500_000_000), 0.2)
    tick = control.tick((1, 600_000_000))
    assert (tick.state, tick.stop_reason, tick.theta) == (PUSHING, NO_REASON, 0.2)
    assert tick.silence == pytest.approx(0.1)


def test_joints_say_where_the_finger_is_across_the_belt(control):
    assert control.joint_states((1, 0), ['other', *JOINTS], [7.0, *ANGLES]) == TAKEN
    tick = control.tick((1, 250_000_000))
    assert tick.finger_x == pytest.approx(FINGER_X)
    assert tick.psi == pytest.approx(math.pi / 2.0)
    assert tick.finger_age == pytest.approx(0.25)


def test_joints_of_another_mechanism_say_nothing(control):
    assert control.joint_states((1, 0), ['other', JOINTS[0]], ANGLES) == OTHER_JOINTS
    assert math.isnan(control.tick((1, 0)).finger_x)


def pushing_on(control, times, *messages):
    """Return the ticks of a finger that feels something and gets joint states in each period."""
    ticks = []
    for k in range(times):
        stamp = (1 + k // 10, k % 10 * 100_000_000)
        control.contact(stamp, 0.1)
        for at, names, positions in messages:
            control.joint_states(at or stamp, names, positions)
        ticks.append(control.tick(stamp))
    return ticks


@pytest.mark.parametrize(
    ('messages', 'trouble'),
    [
        ([(None, ['left_proximal_joint', 'left_distal_joint'], ANGLES)], 'left_proximal_joint'),
        ([(None, ['proximal_joint', 'distal_jiont'], ANGLES)], 'got no distal_joint'),
        ([(None, JOINTS[:1], ANGLES[:1]), (None, JOINTS[1:], ANGLES[1:])], 'in one message'),
        ([(None, JOINTS, [])], 'has no position'),
        ([(None, [*JOINTS, *JOINTS], ANGLES * 2)], 'more than once'),
        ([(None, JOINTS, [math.nan, 0.1])], 'proximal_joint is nan'),
        ([((0, 0), JOINTS, ANGLES)], 'stamped 2.1 s ago'),
        ([((10**9, 0), JOINTS, ANGLES)], 's ahead'),
    ],
)
def test_joint_states_that_cannot_be_used_stop_the_finger_after_their_timeout(
    control, messages, trouble
):
    ticks = pushing_on(control, 12, *messages)
    # Until 0.3 s after the first period they may still become of use: the fifth is 0.4 s after it.
    expected = [NO_REASON] * 4 + [FINGER_UNKNOWN] * 8
    if trouble == 'stamped 2.1 s ago':  # the finger's place was known once, too long ago
        expected = [FINGER_UNKNOWN] * 12
    assert [tick.stop_reason for tick in ticks] == expected
    assert [tick.v_x for tick in ticks[4:]] == [0.0] * 8
    assert trouble in control.trouble
    # As soon as they can be used the finger goes on, whatever other mechanisms say meanwhile.
    control.joint_states((2, 200_000_000), JOINTS, ANGLES)
    control.joint_states((2, 200_000_000), ['wheel'], [1.0])
    control.contact((2, 200_000_000), 0.1)
    assert control.tick((2, 200_000_000)).stop_reason == NO_REASON


def test_without_any_joint_states_the_finger_pushes(control):
    ticks = pushing_on(control, 12)
    assert {tick.stop_reason for tick in ticks} == {NO_REASON}
    assert control.trouble == ''


def test_joint_states_of_others_between_those_of_the_finger_do_no_harm(control):
    others = (None, ['wheel'], [1.0])
    ticks = pushing_on(control, 12, others, (None, JOINTS, ANGLES), others)
    assert {tick.stop_reason for tick in ticks} == {NO_REASON}


def test_a_new_start_grants_no_more_time_without_a_place(control):
    lost = (None, ['left_proximal_joint', 'left_distal_joint'], ANGLES)
    pushing_on(control, 12, lost)
    control.push.deactivate()
    control.push.activate(1.0)
    assert pushing_on(control, 2, lost)[-1].stop_reason == FINGER_UNKNOWN


@pytest.mark.parametrize(
    'angles', [[math.inf, 0.0], [0.0, math.nan], [1.7e308, 1.7e308], [0.0, -1e300], [1e7, 0.0]]
)
def test_angles_that_no_joint_has_are_told_and_not_taken(control, angles):
    assert control.joint_states((1, 0), JOINTS, ANGLES) == TAKEN
    assert control.joint_states((2, 0), JOINTS, angles) == REFUSED
    assert control.tick((2, 0)).finger_age == pytest.approx(1.0)
    assert control.trouble.startswith('joint_states: ')


def test_time_since_the_last_tick_is_told_as_it_is_given(control):
    assert math.isnan(control.tick((1, 0)).elapsed)
    assert control.tick((1, 100_000_000), 0.125).elapsed == 0.125


def test_before_the_first_contact_there_is_a_state_and_no_command(control):
    tick = control.tick((1, 0))
    assert tick.state == WAITING
    assert [topic for topic, _ in control.outputs((1, 0), tick)] == [CONTROLLER_STATE]


def test_command_comes_before_the_state_with_the_stamp_of_the_period(control):
    control.contact((1, 0), 0.2)
    tick = control.tick((1, 7))
    (command_topic, command), (state_topic, state) = control.outputs((1, 7), tick)
    assert (command_topic, state_topic) == (COMMAND, CONTROLLER_STATE)
    stamp = {'sec': 1, 'nanosec': 7}
    assert command['header'] == {'stamp': stamp, 'frame_id': FINGER_BASE}
    assert command['twist'] == {'linear': {'x': tick.v_x, 'y': 0.0}}
    assert state['header']['stamp'] == stamp
    values = dict(zip(state['name'], state['position'], strict=True))
    assert (values['theta'], values['v_x']) == (0.2, tick.v_x)
    assert values['state'] == STATES.index(PUSHING)


def test_with_a_law_that_has_goals_its_state_comes_before_the_command():
    p = PushControllerParameters(law=PLACE)
    seconds = control_seconds
    steps = Control(make_control(p), PlanarFinger(0.06, 0.04, 0.0), JOINTS, seconds)
    choose_law(steps, p, seconds)
    steps.push.activate(0.0)
    steps.placing.goal('', 0.0, (0.0, 0.0, 0.0, 1.0))
    steps.contact((1, 0), 0.2)
    tick = steps.tick((1, 7))
    place, down, command, state = steps.outputs((1, 7), tick)
    assert [topic for topic, _ in (place, down, command, state)] == [
        *(PLACE_STATE, PLACE_RELEASE, COMMAND, CONTROLLER_STATE),
    ]
    assert place[1]['header']['stamp'] == state[1]['header']['stamp'] == {'sec': 1, 'nanosec': 7}
    # A drift that is part of a plan leads to no end of the workspace.
    assert not steps.outlook.soon
    assert steps.deactivate().state == INACTIVE
    assert steps.placing.stage == CANCELLED


@pytest.mark.parametrize('frame', ['', FINGER_DISK, f'left/{FINGER_DISK}', f'left_{FINGER_DISK}'])
def test_angle_of_the_edge_is_the_rotation_about_z(frame):
    # Half the angle is 0.15, whatever the length of the quaternion.
    z, w = 3.0 * math.sin(0.15), 3.0 * math.cos(0.15)
    assert edge_angle(frame, 0.0, 0.0, z, w) == pytest.approx(0.3)


@pytest.mark.parametrize(
    ('frame', 'quaternion'),
    [
        ('map', (0.0, 0.0, 0.0, 1.0)),
        (FINGER_BASE, (0.0, 0.0, 0.0, 1.0)),
        (FINGER_DISK, (0.6, 0.0, 0.0, 0.8)),
        (FINGER_DISK, (0.0, 0.0, 0.0, 0.0)),
        (FINGER_DISK, (0.0, 0.0, math.nan, 1.0)),
    ],
)
def test_another_frame_and_another_rotation_tell_of_no_angle(frame, quaternion):
    assert math.isnan(edge_angle(frame, *quaternion))
