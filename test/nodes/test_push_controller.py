# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The controller's node: contacts in, commands and control periods out."""

import math

import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from lifecycle_msgs.msg import State
from rclpy.parameter import Parameter as RosParameter
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from support.node_bench import declared_topics
from tactile_push.control import (
    ANOTHER_COMMAND,
    FINGER_UNKNOWN,
    PUSHING,
    STATES,
    STOP_REASONS,
    STOPPED,
    WAITING,
    slow_mode,
)
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    JOINT_STATES,
    PLACE,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    PUSH_CONTROLLER,
    SENSING_STATE,
    TOPICS,
)
from tactile_push.nodes.push_controller import PushController
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.pipeline.messages import joint_state_fields, pose_fields
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.tactile.planar_finger import USUAL_FINGER
from tactile_push.testing import field

# However late a loaded machine lets it run, the node shall not stop for it here.
PATIENT = {'max_ticks_lost': 100, 'contact_timeout': 10.0, 'joint_state_timeout': 10.0}
RATE = {'control_rate': 50.0, **PATIENT}


def feel(bench, publisher, theta):
    """Return what publishes a contact that was felt just now."""

    def publish():
        stamp = bench.peer.get_clock().now().to_msg()
        fields = pose_fields((stamp.sec, stamp.nanosec), 0.0, 0.0135, theta)
        publisher.publish(filled(PoseStamped(), fields))

    return publish


def told(bench, name):
    """Return the state or the reason to stop that the node told of last."""
    codes = {'state': STATES, 'stop_reason': STOP_REASONS}[name]
    heard = bench.heard[CONTROLLER_STATE]
    return codes[int(bench.values(CONTROLLER_STATE)[name])] if heard else ''


def test_topics_are_those_of_the_interface(bench):
    bench.start(PushController, law=PLACE)
    bench.until(lambda: bench.topics() == declared_topics(PUSH_CONTROLLER))


def test_the_law_that_places_alone_needs_its_topics(bench):
    bench.start(PushController)
    of_placing = {PLACE_GOAL, PLACE_STATE, PLACE_RELEASE, SENSING_STATE}
    others = tuple(topics - of_placing for topics in declared_topics(PUSH_CONTROLLER))
    bench.until(lambda: bench.topics() == others)


def test_without_autostart_it_waits_for_its_manager(bench):
    node = bench.start(PushController, autostart=False)
    assert node._state_machine.current_state[0] == State.PRIMARY_STATE_UNCONFIGURED
    assert bench.topics() == (set(), set())
    assert bench.health == (OK, 'inactive')


def test_contacts_become_commands_by_the_law(bench):
    bench.start(PushController, **RATE, kp=0.1, kd=0.0, theta_desired=0.0, max_acceleration=100.0)
    bench.hear(JointState, CONTROLLER_STATE)
    bench.hear(TwistStamped, COMMAND)
    contacts = bench.publisher(PoseStamped, CONTACT)
    bench.until(lambda: told(bench, 'state') == WAITING)
    assert bench.heard[COMMAND] == []  # whoever moves the finger before a contact, it is not this

    bench.until(
        lambda: bench.heard[COMMAND] and bench.heard[COMMAND][-1].twist.linear.x < -0.0005,
        feel(bench, contacts, 0.3),
    )
    periods = {
        stamp_of(message): dict(zip(message.name, message.position, strict=True))
        for message in bench.heard[CONTROLLER_STATE]
    }
    for command in bench.heard[COMMAND]:
        if stamp_of(command) not in periods:
            continue  # its period is on its way
        values = periods[stamp_of(command)]
        assert command.header.frame_id == 'finger_base'
        assert tuple(values) == TOPICS[CONTROLLER_STATE].field_names
        assert values['theta'] == pytest.approx(0.3)
        assert STATES[int(values['state'])] == PUSHING
        # Each new contact turns the push angle by kp theta: a multiple of 0.03 from straight ahead.
        turns = (values['phi'] - math.pi / 2.0) / 0.03
        assert turns == pytest.approx(round(turns), abs=1e-9)
        assert command.twist.linear.x == pytest.approx(0.005 / math.tan(values['phi']), abs=1e-12)


def test_a_command_of_another_node_stops_it_until_it_is_resumed(bench):
    node = bench.start(PushController, **RATE)
    bench.hear(JointState, CONTROLLER_STATE)
    contacts = bench.publisher(PoseStamped, CONTACT)
    touch = feel(bench, contacts, 0.1)
    bench.until(lambda: told(bench, 'state') == PUSHING, touch)
    bench.publisher(TwistStamped, COMMAND).publish(TwistStamped())
    bench.until(lambda: told(bench, 'state') == STOPPED, touch)
    assert told(bench, 'stop_reason') == ANOTHER_COMMAND
    assert bench.health == (ERROR, 'stopped: another command, until resumed')
    answer = node._on_resume(Trigger.Request(), Trigger.Response())
    assert answer.success
    assert answer.message == 'was stopped: another command, until resumed'


def test_an_inactive_controller_is_not_resumed(bench):
    node = bench.start(PushController, autostart=False)
    answer = node._on_resume(Trigger.Request(), Trigger.Response())
    assert (answer.success, answer.message) == (False, 'inactive')


def test_a_gain_changes_while_it_runs_and_a_bound_on_phi_does_not(bench):
    node = bench.start(PushController)
    gain, bound = node.set_parameters(
        [RosParameter('kp', value=0.2), RosParameter('phi_min', value=0.5)]
    )
    assert (gain.successful, bound.successful) == (True, False)
    assert node._control.law.kp == 0.2


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'joint_names': ['one']}, 'parameter joint_names: expected two or three different names'),
        ({'workspace_min': 0.2}, 'parameter workspace_min: expected less than workspace_max'),
        ({'kp': -0.1}, 'parameter kp: expected'),
        ({'control_rate': 1}, 'parameter control_rate: expected'),
        ({'law': 'pull'}, 'parameter law: expected one of push, place'),
        ({'law': 'place', 'steadying_max': 0.1}, 'parameter steadying_max: expected 0 with law'),
        ({'belt_length': 0.0}, 'parameter belt_length: expected'),
    ],
)
def test_a_control_that_is_none_is_refused(bench, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(PushController, **parameters)
    assert str(refused.value).startswith(refusal)


def at(bench, publisher, x):
    """Return what publishes the joint states of the usual finger at x [m], straight across."""
    joints = dict(zip(TOPICS[JOINT_STATES].field_names, USUAL_FINGER.inverse(x, 0.08), strict=True))

    def publish():
        stamp = bench.peer.get_clock().now().to_msg()
        fields = joint_state_fields((stamp.sec, stamp.nanosec), joints)
        publisher.publish(filled(JointState(), fields))

    return publish


def test_a_tip_that_makes_the_drift_grow_is_told_once_and_no_warning(bench):
    node = bench.start(PushController, **RATE, theta_desired=0.0)
    said = []
    node.get_logger().info = said.append
    bench.hear(JointState, CONTROLLER_STATE)
    touch = feel(bench, bench.publisher(PoseStamped, CONTACT), 0.0)
    place = at(bench, bench.publisher(JointState, JOINT_STATES), -0.06)

    def meanwhile():
        place()
        touch()

    def known():
        return bench.heard[CONTROLLER_STATE] and bench.values(CONTROLLER_STATE)['ticks'] > 20

    bench.until(known, meanwhile)
    bench.until(lambda: bench.health == (OK, 'pushing'), meanwhile)
    # The tip turns by -1/80 mm there, and l is that of the paper's block: see docs/theory.md.
    (line,) = said
    assert 'by -12.5 rad' in line
    assert 'by e in 33 s' in line


def test_steadying_that_cannot_hold_the_object_is_warned_of(bench):
    short = {'steadying_max': 0.2, 'edge_distance': 0.015}
    node = bench.start(PushController, **RATE, theta_desired=0.0, **short)
    warned = []
    node.get_logger().warning = warned.append
    touch = feel(bench, bench.publisher(PoseStamped, CONTACT), 0.0)
    place = at(bench, bench.publisher(JointState, JOINT_STATES), -0.06)
    bench.until(lambda: warned, lambda: (place(), touch()))
    assert warned[0].startswith('steadying_max: ')
    assert 'edge_distance 0.015 m' in warned[0]


def test_a_finger_that_is_soon_at_the_end_of_its_workspace_is_a_warning(bench, monkeypatch):
    monkeypatch.setattr(slow_mode, 'AVERAGED', 0.1)
    bench.start(PushController, **RATE, theta_desired=0.0, workspace_min=-0.0602)
    bench.hear(JointState, CONTROLLER_STATE)
    touch = feel(bench, bench.publisher(PoseStamped, CONTACT), 0.0)
    publisher = bench.publisher(JointState, JOINT_STATES)
    places = (-0.06 - 1e-6 * k for k in range(190))

    def meanwhile():
        at(bench, publisher, next(places, -0.06019))()
        touch()

    bench.until(lambda: bench.health[0] == WARN and 'drifts' in bench.health[1], meanwhile)
    assert bench.health[1] == 'pushing, but drifts to the end of the workspace'


def test_an_angle_that_could_be_trimmed_too_far_is_refused_while_it_runs(bench):
    node = bench.start(PushController, theta_desired=1.2)
    (result,) = node.set_parameters([RosParameter('steadying_max', value=0.4)])
    assert not result.successful
    assert result.reason.startswith('theta_desired: expected -1.1 to 1.1 rad')
    assert node._control.steadying.bound == 0.0
    (result,) = node.set_parameters([RosParameter('steadying_max', value=0.2)])
    assert result.successful
    assert node._control.steadying.bound == 0.2


WRONG_NAMES = {'joint_names': ['proximal_joint', 'distal_jiont']}
MISSING = (
    'joint_names: expected proximal_joint, distal_jiont in joint_states, '
    'got no distal_jiont, but proximal_joint, distal_joint'
)


def test_joint_names_that_never_come_are_told_before_the_first_contact_and_stop_the_finger(bench):
    bench.start(PushController, **{**RATE, **WRONG_NAMES, 'joint_state_timeout': 0.5})
    bench.hear(JointState, CONTROLLER_STATE)
    place = at(bench, bench.publisher(JointState, JOINT_STATES), 0.0)
    bench.until(lambda: MISSING in bench.health[1], place)
    assert bench.health == (WARN, f'waiting for contact, but {MISSING}')
    touch = feel(bench, bench.publisher(PoseStamped, CONTACT), 0.1)
    bench.until(lambda: told(bench, 'state') == STOPPED, lambda: (place(), touch()))
    assert told(bench, 'stop_reason') == FINGER_UNKNOWN
    level, words = bench.health
    assert level == ERROR
    assert words.startswith(f'stopped: finger position unknown: {MISSING}; use_joint_states: false')


def test_who_says_that_no_limit_is_wanted_pushes_whatever_the_joints_are_called(bench):
    bench.start(PushController, **RATE, **WRONG_NAMES, use_joint_states=False)
    bench.hear(JointState, CONTROLLER_STATE)
    touch = feel(bench, bench.publisher(PoseStamped, CONTACT), 0.1)
    assert JOINT_STATES not in bench.topics()[0]
    bench.until(lambda: told(bench, 'state') == PUSHING, touch)
    pushed = len(bench.heard[CONTROLLER_STATE])
    bench.until(lambda: len(bench.heard[CONTROLLER_STATE]) > pushed + 25, touch)
    reasons = {int(field(m, 'stop_reason')) for m in bench.heard[CONTROLLER_STATE]}
    assert STOP_REASONS.index(FINGER_UNKNOWN) not in reasons
    bench.until(lambda: bench.health == (OK, 'pushing'), touch)
