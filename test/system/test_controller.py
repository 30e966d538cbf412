# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""push_controller alone, in real time or on a clock of the test's, against whatever it may hear."""

import itertools
import math
import signal
import time
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import GetState
from rclpy.clock import Clock as NodeClock
from rclpy.clock_type import ClockType
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from tactile_push.control import STATES, STOP_REASONS
from tactile_push.testing import NodeProcesses, Observer, field, seconds

PERIOD, CONTACT_TIMEOUT = 0.1, 0.3


class World:
    """Contacts, joint states and, if asked, the time: what the controller hears."""

    def __init__(self, nodes: NodeProcesses, observer: Observer) -> None:
        self.nodes = nodes
        self.observer = observer
        node = observer.node
        self.theta = 0.2
        self.joints: list[float] | None = None
        self.time: float | None = None  # simulated, if it is a number
        self.step = 0.02  # of simulated time [s]
        self.silent = False
        self._contacts = node.create_publisher(PoseStamped, 'contact', 10)
        self._joint_states = node.create_publisher(JointState, 'joint_states', 10)
        self._clock = node.create_publisher(Clock, '/clock', 10)
        self.commands = observer.hear(TwistStamped, 'finger/cmd_vel')
        self.states = observer.hear(JointState, 'push_controller/state')
        self.diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
        steady = NodeClock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(0.02, self._say, clock=steady)

    def start(self, name: str = 'push_controller', **parameters: Any) -> None:
        """Start the controller and wait until it pushes.

        It loses as many ticks as it may, for a loaded machine lets it run late.
        """
        simulated = {} if self.time is None else {'use_sim_time': True}
        patient = {'max_ticks_lost': 100, **simulated, **parameters}
        self.nodes.start('push_controller', patient, name=name)
        self.wait_for_state('pushing')
        self.observer.wait_for(
            lambda: self.commands and self.commands[-1].twist.linear.x < -1e-4,
            'the finger to be moved',
        )

    def _say(self) -> None:
        if self.time is not None:
            self.time += self.step
            self._clock.publish(Clock(clock=self.now().to_msg()))
        stamp = self.now().to_msg()
        if self.joints is not None:
            message = JointState(name=['proximal_joint', 'distal_joint'], position=self.joints)
            message.header.stamp = stamp
            self._joint_states.publish(message)
        if not self.silent:
            self.contact(self.theta, stamp)

    def now(self) -> Time:
        if self.time is not None:
            return Time(nanoseconds=round(self.time * 1e9), clock_type=ClockType.ROS_TIME)
        return self.observer.node.get_clock().now()

    def contact(self, theta: float, stamp: Any) -> None:
        self.contact_turned(0.0, math.sin(theta / 2.0), math.cos(theta / 2.0), stamp)

    def contact_turned(
        self, x: float, z: float, w: float, stamp: Any, frame: str = 'finger_disk'
    ) -> None:
        message = PoseStamped()
        message.header.stamp = stamp
        message.header.frame_id = frame
        orientation = message.pose.orientation
        orientation.x, orientation.z, orientation.w = x, z, w
        self._contacts.publish(message)

    def words(self) -> str:
        """Give the state that was said last, with its reason."""
        state = STATES[int(field(self.states[-1], 'state'))]
        reason = STOP_REASONS[int(field(self.states[-1], 'stop_reason'))]
        return f'{state}: {reason}' if reason else state

    def wait_for_state(self, words: str) -> None:
        self.observer.wait_for(lambda: self.states and self.words() == words, words)

    def levels(self) -> list[tuple[bytes, str]]:
        return [
            (s.level, s.message)
            for array in self.diagnostics
            for s in array.status
            if s.name == 'push_controller'
        ]

    def resume(self) -> Any:
        return self.observer.call(Trigger, 'push_controller/resume', Trigger.Request())

    def check_that_it_rests(self, ticks: int = 5) -> None:
        """Wait for some more ticks and check that all of them command 0."""
        seen = len(self.commands)
        self.observer.wait_for(lambda: len(self.commands) >= seen + ticks, 'commands')
        assert {message.twist.linear.x for message in self.commands[seen:]} == {0.0}

    def check_that_it_resumes_without_a_kick(self) -> None:
        """Wait until the finger moves again, from rest and no faster than it may."""
        seen = len(self.commands) - 1
        self.observer.wait_for(
            lambda: abs(self.commands[-1].twist.linear.x) > 1e-4, 'the finger to be moved again'
        )
        velocities = [message.twist.linear.x for message in self.commands[seen:]]
        assert velocities[0] == 0.0
        steps = [abs(b - a) for a, b in itertools.pairwise(velocities)]
        assert max(steps) <= 0.05 * PERIOD * (1.0 + 1e-9)


@pytest.fixture
def world(nodes: NodeProcesses, observer: Observer) -> World:
    return World(nodes, observer)


@pytest.mark.parametrize(
    'rotation',
    [(0.0, math.nan, 1.0), (0.0, math.inf, 1.0), (0.0, 0.0, 0.0), (0.0, 0.9, 0.4), (0.5, 0.1, 0.9)],
    ids=['nan', 'inf', 'zero', 'faces away', 'leans'],
)
def test_implausible_contact_stops_the_finger_and_plausible_ones_let_it_go_on(
    world: World, rotation: tuple[float, float, float]
):
    # That it is the next tick at which the finger stops is for the tests without a graph, in which
    # nothing lies between a contact and its arrival.
    world.start()
    world.contact_turned(*rotation, world.now().to_msg())
    world.wait_for_state('stopped: implausible contact')
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()


def test_contact_in_another_frame_stops_the_finger(world: World):
    world.start()
    world.contact_turned(0.0, 0.1, 1.0, world.now().to_msg(), frame='finger_base')
    world.wait_for_state('stopped: implausible contact')
    world.wait_for_state('pushing')


def test_silent_contact_stops_the_finger_and_is_reported_at_once(world: World):
    world.start()
    world.silent = True
    world.wait_for_state('stopped: contact silent')
    world.check_that_it_rests()
    world.observer.wait_for(
        lambda: (DiagnosticStatus.ERROR, 'stopped: contact silent') in world.levels(), 'an error'
    )
    world.silent = False
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()


def test_contacts_that_are_old_or_of_the_future_do_not_count(world: World):
    world.start()
    world.silent = True
    world.wait_for_state('stopped: contact silent')
    seen = len(world.states)

    def old_and_future() -> bool:
        for shift in (-1.0, 1.0):
            stamp = Time(nanoseconds=world.now().nanoseconds + round(shift * 1e9)).to_msg()
            world.contact(0.3, stamp)
        return len(world.states) > seen + 5

    world.observer.wait_for(old_and_future, 'ticks')
    assert world.words() == 'stopped: contact silent'
    world.check_that_it_rests()


@pytest.mark.parametrize('reliability', ['RELIABLE', 'BEST_EFFORT'])
def test_another_commander_stops_the_finger_until_it_is_resumed(world: World, reliability: str):
    world.start()
    qos = QoSProfile(depth=10, reliability=ReliabilityPolicy[reliability])
    other = world.observer.node.create_publisher(TwistStamped, 'finger/cmd_vel', qos)
    # The controller hears a reliable one twice, the test itself hears reliable ones only.
    hearing = 3 if reliability == 'RELIABLE' else 1
    world.observer.wait_for(lambda: other.get_subscription_count() >= hearing, 'to be heard')
    command = TwistStamped()
    command.twist.linear.x = 0.003
    other.publish(command)
    if reliability == 'BEST_EFFORT':  # the first one may be lost
        repeat = world.observer.node.create_timer(0.1, lambda: other.publish(command))
    world.wait_for_state('stopped: another command')
    if reliability == 'BEST_EFFORT':
        world.observer.node.destroy_timer(repeat)
    world.observer.wait_for(
        lambda: world.levels()[-1:] == [(b'\x02', 'stopped: another command, until resumed')],
        'an error',
    )
    world.check_that_it_rests(8)
    answer = world.resume()
    assert answer.success
    assert 'another command' in answer.message
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()
    answer = world.resume()
    assert not answer.success
    assert answer.message == 'pushing'


def test_two_controllers_notice_one_another_and_both_rest(world: World, observer: Observer):
    world.start()
    second = observer.hear(JointState, 'second/state')
    world.nodes.start(
        'push_controller',
        name='second',
        arguments=('-r', '__node:=second', '-r', 'push_controller/state:=second/state'),
    )
    world.wait_for_state('stopped: another command')
    reason = float(STOP_REASONS.index('another command'))
    observer.wait_for(
        lambda: second and field(second[-1], 'stop_reason') == reason, 'the other one to stop too'
    )


def test_controller_that_stood_still_for_too_long_rests_until_it_is_resumed(world: World):
    world.start(max_ticks_lost=3)
    process = world.nodes.running['push_controller']
    process.send_signal(signal.SIGSTOP)
    stopped = time.monotonic()
    world.observer.wait_for(lambda: time.monotonic() - stopped > 1.0, 'ten periods')
    process.send_signal(signal.SIGCONT)
    world.wait_for_state('stopped: ticks lost')
    assert 8.0 <= field(world.states[-1], 'ticks_lost') < 100.0
    world.check_that_it_rests()
    assert world.resume().success
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()


@pytest.mark.parametrize('jump', [-5.0, 100.0])
def test_clock_that_jumps_stops_the_finger_at_once_until_it_is_resumed(world: World, jump: float):
    world.time = 50.0
    world.start()
    world.time += jump
    jumped = world.time
    world.wait_for_state('stopped: clock jumped')
    # Not after the five seconds for which a timer of a clock that went back stands still.
    assert jumped <= seconds(world.states[-1]) < jumped + 4.0
    world.check_that_it_rests()
    assert world.resume().success
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()


def test_tick_of_simulated_time_hears_every_contact_that_has_arrived(world: World):
    world.time = 5.0
    world.start()
    controller = world.nodes.running['push_controller']
    controller.send_signal(signal.SIGSTOP)
    behind = world.time + 0.22
    world.observer.wait_for(lambda: world.time > behind, 'contacts to wait')
    step, world.step = world.step, 0.0
    world.silent = True
    seen = len(world.states)
    controller.send_signal(signal.SIGCONT)
    world.observer.wait_for(lambda: len(world.states) > seen, 'a tick')
    # The tick may come before the last messages. A contact arrives right after its time.
    assert field(world.states[seen], 'silence') < step + 1e-6


def test_time_that_stands_still_is_a_warning(world: World):
    world.time = 50.0
    world.start()
    pushing = (DiagnosticStatus.OK, 'pushing')
    world.observer.wait_for(lambda: world.levels()[-1:] == [pushing], 'pushing')
    world.step = 0.0
    words = 'pushing, but time stands still'
    world.observer.wait_for(lambda: world.levels()[-1:] == [(DiagnosticStatus.WARN, words)], words)
    world.step = 0.02
    world.observer.wait_for(lambda: world.levels()[-1:] == [pushing], 'pushing')


def test_finger_at_its_workspace_limit_moves_inward_only(world: World):
    world.joints = [math.pi / 2.0, -math.pi / 2.0]  # at x = -0.06
    world.start()
    assert field(world.states[-1], 'finger_x') == pytest.approx(-0.06)
    # The first link at right angles to the second: x = -0.06 - 0.08 sin(41 deg) = -0.1125.
    world.joints = [math.pi / 2.0, math.radians(-90.0 + 41.0)]
    world.wait_for_state('stopped: workspace limit')
    assert field(world.states[-1], 'finger_x') == pytest.approx(-0.11248, abs=1e-5)
    world.check_that_it_rests()
    world.theta = -0.3  # theta_desired = -10 degrees lies to the other side now: inward
    world.wait_for_state('pushing')
    world.observer.wait_for(lambda: world.commands[-1].twist.linear.x > 1e-4, 'inward motion')


@pytest.mark.parametrize('lost', [None, [math.nan, 0.0], [math.inf, 0.0], [0.1]])
def test_finger_that_is_not_known_to_be_anywhere_any_more_stops(world: World, lost: Any):
    world.joints = [math.pi / 2.0, -math.pi / 2.0]
    world.start()
    world.observer.wait_for(lambda: not math.isnan(field(world.states[-1], 'finger_x')), 'finger')
    known, world.joints = world.joints, lost
    world.wait_for_state('stopped: finger position unknown')
    world.check_that_it_rests()
    world.joints = known
    world.wait_for_state('pushing')
    world.check_that_it_resumes_without_a_kick()


def test_inactive_is_said_on_the_state_topic_and_in_diagnostics(world: World):
    world.start()
    assert world.observer.change_state('push_controller', Transition.TRANSITION_DEACTIVATE)
    world.wait_for_state('inactive')
    assert world.commands[-1].twist.linear.x == 0.0
    world.observer.wait_for(lambda: world.levels()[-1:] == [(b'\x00', 'inactive')], 'inactive')
    assert not world.resume().success


def test_what_is_counted_goes_on_after_a_new_activation(world: World):
    world.start()
    told = (DiagnosticStatus.WARN, 'waiting for contact')
    for _ in range(2):
        world.observer.wait_for(lambda: len(ticks_told(world)) > 1, 'ticks to be told')
        world.diagnostics.clear()
        world.silent = True
        assert world.observer.change_state('push_controller', Transition.TRANSITION_DEACTIVATE)
        before = int(field(world.states[-1], 'ticks'))
        assert world.observer.change_state('push_controller', Transition.TRANSITION_ACTIVATE)
        world.observer.wait_for(lambda: world.levels()[-1:] == [told], 'a new wait')
        assert ticks_told(world)[-1] >= before
        world.silent = False


def ticks_told(world: World) -> list[int]:
    return [
        int(pair.value)
        for array in world.diagnostics
        for status in array.status
        for pair in status.values
        if pair.key == 'ticks'
    ]


CONFIGURE, CLEANUP = Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_CLEANUP
ACTIVATE, DEACTIVATE = Transition.TRANSITION_ACTIVATE, Transition.TRANSITION_DEACTIVATE
UNCONFIGURED, INACTIVE, ACTIVE = 1, 2, 3
ALLOWED = {
    (UNCONFIGURED, CONFIGURE): INACTIVE,
    (INACTIVE, ACTIVATE): ACTIVE,
    (INACTIVE, CLEANUP): UNCONFIGURED,
    (ACTIVE, DEACTIVATE): INACTIVE,
}


def test_transitions_in_every_order_lead_where_the_lifecycle_says(world: World):
    world.nodes.start('push_controller', {'autostart': False})
    transitions = (CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP)
    state = UNCONFIGURED
    # Every transition after every other, from wherever it has led.
    for transition in itertools.chain(*itertools.product(transitions, repeat=2)):
        expected = ALLOWED.get((state, transition))
        assert world.observer.change_state('push_controller', transition) == (expected is not None)
        state = expected or state
        answer = world.observer.call(GetState, 'push_controller/get_state', GetState.Request())
        assert answer.current_state.id == state
    assert world.nodes.running['push_controller'].poll() is None


def test_shut_down_while_pushing_it_rests_and_takes_no_transition_any_more(world: World):
    world.start()
    shutdown = Transition.TRANSITION_ACTIVE_SHUTDOWN
    assert world.observer.change_state('push_controller', shutdown)
    world.wait_for_state('inactive')
    assert world.commands[-1].twist.linear.x == 0.0
    for transition in (CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP, shutdown, 200):
        assert not world.observer.change_state('push_controller', transition)
