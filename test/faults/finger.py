# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One finger with its belt, sensor and nodes, and what they say."""

import math
import signal
import time
from collections.abc import Callable
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, WrenchStamped
from lifecycle_msgs.msg import State
from rcl_interfaces.msg import ParameterType, ParameterValue
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Bool, Float64MultiArray
from std_srvs.srv import Trigger

from tactile_push.control import PUSHING, SERVO_STOP_REASONS, STOP_REASONS, TICKS_LOST
from tactile_push.control.placing import STAGES
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTACT_GEOMETRY,
    FINGER_SERVO,
    IMAGE,
    JOINT_STATES,
    JOINT_VELOCITIES,
    PLACE,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    PUSH,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SERVO_COMMANDS,
    SERVO_STATE,
    SIM_PLANT,
    WRENCH,
)
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS
from tactile_push.testing import NodeProcesses, Rig, field

from .messages import stamp_of
from .observer import FaultObserver
from .promise import BrokenPromiseError, Setup
from .proxy import DeviceProxy, free_port
from .relay import Relay

# What can be spoiled on its way.
RELAYED = {JOINT_STATES: JointState, WRENCH: WrenchStamped, IMAGE: Image}
DESIRED = math.radians(10.0)  # to both sides in turn, so that the finger stays where it can
ASIDE = 0.02  # of goals, to both sides in turn [m]
MOVING = 5e-5  # [m/s]
MOST_THETA = math.radians(25.0)
MOST_D = 0.01  # [m]
HOLD = 0.3  # for so long a stopped finger has to stay stopped before it counts [s]


def goal(x: float, theta: float = 0.0, frame: str = 'finger_base') -> PoseStamped:
    """Return a goal across the belt [m] with an angle of the edge [rad]."""
    message = PoseStamped()
    message.header.frame_id = frame
    message.pose.position.x = x
    turn = message.pose.orientation
    turn.z, turn.w = math.sin(theta / 2.0), math.cos(theta / 2.0)
    return message


class Finger(Rig):
    """The rig of one finger, whose device and joint states the tool can spoil.

    Parameters
    ----------
    namespace : str
        Namespace of its nodes, '' for the root.
    setup : Setup
        What is special about the rig.
    nodes : NodeProcesses
        Starts them.
    observer : FaultObserver
        Hears them.

    Attributes
    ----------
    proxy : DeviceProxy
        The device that the driver reads.
    relay : Relay
        What the topic passes through that the setup asks for.
    chain : tuple of str
        Its nodes.
    foreign : set of (int, int)
        Stamps of the messages that the tool itself has published.
    diagnostics, joint_states, velocities, servo_states, place_states, releases : Heard
        What was heard so far.
    """

    observer: FaultObserver

    def __init__(
        self, namespace: str, setup: Setup, nodes: NodeProcesses, observer: FaultObserver
    ) -> None:
        port = free_port()
        super().__init__(nodes, observer, f'socket://127.0.0.1:{port}', namespace)
        self._setup = setup
        self.proxy = DeviceProxy(port)
        self._sensor = SENSOR_KINDS[setup.sensor]
        self.chain = (SIM_PLANT, self._sensor.node, CONTACT_GEOMETRY, PUSH_CONTROLLER)
        if setup.servo:
            self.chain += (FINGER_SERVO,)
        if setup.law != PUSH:
            self.chain += (ACTIVE_SENSING,)
        if setup.relay:
            self.relay = Relay(observer, RELAYED[setup.relay], self.name(setup.relay))
        self.foreign: set[tuple[int, int]] = set()
        self._desired = -DESIRED
        self.diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
        self.velocities = observer.hear(Float64MultiArray, self.name(SERVO_COMMANDS))
        self.joint_states = observer.hear(JointState, self.name(JOINT_STATES))
        self.servo_states = observer.hear(JointState, self.name(SERVO_STATE))
        self.place_states = observer.hear(JointState, self.name(PLACE_STATE))
        self.releases = observer.hear(Bool, self.name(PLACE_RELEASE))

    def begin(self, node: str, **more: Any) -> None:
        """Start one of its nodes, with more parameters."""
        parameters: dict[str, Any] = {'use_sim_time': True} if self._setup.own_clock else {}
        arguments: tuple[str, ...] = ()
        if node == self._sensor.node:
            parameters |= self._sensor.parameters
        if node == SIM_PLANT:
            parameters |= self._sensor.plant
            # Balanced, so that an object that is not controlled for a while stays in reach.
            parameters |= {'theta_initial': 0.0, 'd_initial': 0.0}
            parameters |= dict(self._setup.plant)
            if self._setup.servo:
                parameters['commands'] = JOINT_VELOCITIES
            if self._setup.relay:
                arguments = ('-r', f'{self._setup.relay}:={self.relay.source}')
        elif node == SENSOR_DRIVER:
            parameters['device'] = self.proxy.url
        elif node == PUSH_CONTROLLER:
            parameters['autostart'] = False
            parameters['law'] = self._setup.law
            parameters |= dict(self._setup.controller)
        elif node == ACTIVE_SENSING:
            parameters |= dict(self._setup.sensing)
        parameters |= more
        self.start_node(node, parameters, arguments)

    @property
    def is_numbered(self) -> bool:
        """Whether each reading carries the number under which the device has sent it."""
        return self._sensor.node == SENSOR_DRIVER

    def activate(self) -> None:
        """Activate the controller once there are contacts and its commands will be heard here."""
        self._desired = -DESIRED  # as the configuration has it
        observer, controller = self.observer, self.name('push_controller')
        observer.wait_for(lambda: self.contacts, f'contacts of {self.name("finger")}')
        before = observer.publishers(self.name('finger/cmd_vel'))
        observer.reach_state(controller, State.PRIMARY_STATE_INACTIVE)
        observer.wait_for(
            lambda: observer.publishers(self.name('finger/cmd_vel')) - before,
            f'{controller} to be heard',
        )
        observer.reach_state(controller, State.PRIMARY_STATE_ACTIVE)

    def signal(self, node: str, number: signal.Signals) -> float:
        """Send a signal to a node and give the moment [s]."""
        at = time.monotonic()
        self.nodes.running[self.process(node)].send_signal(number)
        return at

    def kill(self, node: str) -> float:
        """Kill a node, as a crash would, and give the moment [s]."""
        at = self.signal(node, signal.SIGKILL)
        self.nodes.running.pop(self.process(node)).wait()
        return at

    def ended(self, node: str, patience: float = 5.0) -> int:
        """Wait for the end of a node and give its exit status."""
        process = self.nodes.running.pop(self.process(node))
        self.observer.wait_for(lambda: process.poll() is not None, f'{node} to end', patience)
        return int(process.returncode)

    def turn(self) -> None:
        """Ask for the other angle or place, so that the finger has to move."""
        self._desired = -self._desired
        if self._setup.law == PLACE:
            start = field(self.truth[0], 'object_x')
            self.give_goal(goal(start + math.copysign(ASIDE, self._desired)))
        else:
            self.ask_for(self._desired)

    def give_goal(self, message: PoseStamped) -> None:
        """Publish a goal, and wait until it is taken or refused."""
        before = self._goals_heard
        self.publish(PLACE_GOAL, message)
        self.observer.wait_for(lambda: self._goals_heard > before, 'an answer to the goal')

    @property
    def _goals_heard(self) -> float:
        """Goals that the controller has taken or refused, by its last word."""
        said = self.observer.wait_for(lambda: self.place_states, 'a state of the goal')
        return field(said[-1], 'goals') + field(said[-1], 'refused')

    @property
    def stage(self) -> str:
        """What becomes of the goal, one of `STAGES`; '' before the first word."""
        return STAGES[int(field(self.place_states[-1], 'stage'))] if self.place_states else ''

    def expect_stage(self, stage: str, patience: float = 2.0) -> None:
        """Wait for the controller to say what has become of the goal."""
        try:
            self.observer.wait_for(lambda: self.stage == stage, f'stage {stage}', patience)
        except BrokenPromiseError as error:
            raise BrokenPromiseError(f'{error}, it is {self.stage}') from None

    def ask_for(self, theta: float) -> None:
        """Ask for an angle of the edge [rad]."""
        value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=theta)
        answer = self.observer.set_parameter(self.name('push_controller'), 'theta_desired', value)
        if not answer.successful:
            raise BrokenPromiseError(f'theta_desired was refused: {answer.reason}')

    def push(self, patience: float = 5.0) -> None:
        """Wait until the finger moves, to the side to which it has to turn the object.

        A controller that rests because the machine was too busy for it is resumed.
        """
        self.turn()
        moving = self._moving_from_now_on()
        try:
            self.observer.wait_for(
                lambda: moving() or self.reason == TICKS_LOST,
                f'{self.name("finger")} to move',
                patience,
            )
        except BrokenPromiseError as error:
            said = self.reason or self.state or 'nothing'
            raise BrokenPromiseError(f'{error}; the controller said {said}') from None
        if not moving():
            self.resume()

    def is_in_the_middle(self) -> bool:
        """Return whether the object lies so that the finger can go on for long."""
        last = self.truth[-1]
        return abs(field(last, 'theta')) < MOST_THETA and abs(field(last, 'd')) < MOST_D

    def wait_until_moving(self, patience: float = 5.0) -> float:
        """Wait until the law acts and the finger moves, and give the moment [s]."""
        moving = self._moving_from_now_on()
        self.observer.wait_for(moving, f'{self.name("finger")} to move', patience)
        return self.truth.times[-1]

    def _moving_from_now_on(self) -> Callable[[], bool]:
        """Return what tells whether the law has acted and the finger has moved since now."""
        seen = len(self.truth)

        def moving() -> bool:
            last = [field(m, 'v_x') for m in self.truth[seen:][-5:]]
            return self.state == PUSHING and len(last) == 5 and min(map(abs, last)) > MOVING

        return moving

    def stopped(
        self, since: float, patience: float = 3.0, *, hold: float = HOLD, command: bool = False
    ) -> float:
        """Wait until the finger stands and stays so for `hold`, and give how long it took [s].

        `command` looks at what is commanded, for when there is no plant any more.
        """

        def first_of_last_zeros() -> float | None:
            first = None
            for at, v_x in reversed(list(self._velocities(command))):
                if v_x != 0.0 or at < since:
                    break
                first = at
            return first

        def stands() -> bool:
            first = first_of_last_zeros()
            return first is not None and time.monotonic() - first >= hold

        self.observer.wait_for(stands, f'{self.name("finger")} to stop', patience)
        first = first_of_last_zeros()
        assert first is not None
        return first - since

    def _velocities(self, command: bool) -> list[tuple[float, float]]:
        if command:
            heard = [(at, m.twist.linear) for at, m in self.commands.timed(-100)]
            return [(at, math.hypot(velocity.x, velocity.y)) for at, velocity in heard]
        return [(at, field(m, 'v_x')) for at, m in self.truth.timed(-500)]

    def reasons_since(self, at: float) -> set[str]:
        """Return all reasons that the controller gave after a moment, '' for none."""
        return {STOP_REASONS[int(field(m, 'stop_reason'))] for m in self.states.since(at)}

    def expect_servo(self, reason: str, patience: float = 2.0) -> None:
        """Wait for the servo to say why the joints stand."""

        def says() -> bool:
            code = int(field(self.servo_states[-1], 'stop_reason'))
            return SERVO_STOP_REASONS[code] == reason

        self.observer.wait_for(says, f'the servo to say {reason}', patience)

    def joints(self) -> tuple[float, float]:
        """Return where the joints are now [rad]."""
        heard = self.observer.wait_for(lambda: self.joint_states, 'joint states')
        return field(heard[-1], 'proximal_joint'), field(heard[-1], 'distal_joint')

    def expect_reason(self, *reasons: str) -> None:
        """Wait for the controller to say why it has stopped."""
        self.observer.wait_for(
            lambda: self.reason in reasons,
            f'reason {" or ".join(reasons)}, it was {self.reason}',
            1.0,
        )

    def expect_rest(self, reason: str, seconds: float = 0.6) -> None:
        """Watch that the controller does not resume on its own, though contacts come again."""
        said = len(self.commands)
        self.observer.spin(seconds)
        moving = [
            h for h in self.commands[said:] if (h.twist.linear.x, h.twist.linear.y) != (0.0, 0.0)
        ]
        if moving or self.reason != reason:
            raise BrokenPromiseError(f'resumed on its own from {reason}')

    def resume(self) -> None:
        """Call the service that lets a stopped controller go on, and wait until it does."""
        answer = self.observer.call(
            Trigger, self.name('push_controller/resume'), Trigger.Request(), patience=3.0
        )
        if not answer.success:
            raise BrokenPromiseError(f'resume: {answer.message}')
        self.wait_until_moving()

    def rest_or_push(self) -> None:
        """Wait until the controller pushes, or has stopped and says why."""
        self.observer.wait_for(
            lambda: self.state == PUSHING or self.reason in STOP_REASONS[1:],
            f'the controller to push or to say why not, it is {self.state}',
            5.0,
        )

    def status(self, node: str) -> Any:
        """Return the last diagnostic status of a node, None if it has said nothing."""
        name = self.name(node).lstrip('/')
        for heard in reversed(self.diagnostics):
            for status in heard.status:
                if status.name == name:
                    return status
        return None

    def expect_level(self, node: str, level: bytes, patience: float = 2.0) -> None:
        """Wait for a node to report a level."""

        def has_level() -> bool:
            status = self.status(node)
            return status is not None and status.level == level

        self.observer.wait_for(has_level, f'{node} to report level {level[0]}', patience)

    def count(self, node: str, name: str) -> int:
        """Return a count of a node's diagnostics, 0 if it does not come up."""
        status = self.status(node)
        values = {v.key: v.value for v in status.values} if status is not None else {}
        return int(values.get(name, 0))

    def publish(self, topic: str, message: Any) -> float:
        """Publish what is no node's message on one of its topics, and give the moment [s]."""
        self.foreign.add(stamp_of(message))
        return self.observer.publish(self.name(topic), message)

    def close(self) -> None:
        """Take the device away."""
        self.proxy.close()
