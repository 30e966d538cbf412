# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A rig as a node, in place of the hardware: finger velocity in, sensor bytes out."""

import math
import time
from abc import abstractmethod
from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar, cast

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock as NodeClock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64MultiArray
from visualization_msgs.msg import MarkerArray

from tactile_push.interface import (
    CLOCK,
    COMMAND,
    CONTACT,
    GEOMETRY_STATE,
    JOINT_STATES,
    JOINT_VELOCITIES,
    MARKERS,
    PLACE_RELEASE,
    PLACE_STATE,
    SERVO_COMMANDS,
    SERVO_STATE,
    TOPICS,
    TRUE_POSE,
    TRUE_STATE,
    WRIST_JOINT,
)
from tactile_push.nodes.ros.compiling import compiling
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.markers import rig_markers
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.parameters import ConfigurationError, declare
from tactile_push.nodes.ros.plant_sensor import PlantSensor
from tactile_push.nodes.ros.qos import FRESHEST, PUBLISHED
from tactile_push.parameters.sim_plant import SimPlantParameters, faults, faults_on
from tactile_push.pipeline import by_name
from tactile_push.pipeline.messages import joint_state_fields, pose_fields
from tactile_push.simulation import JointRig, Rig
from tactile_push.simulation.commanded import (
    NOT_FINITE,
    OBEYED,
    CommandedJoints,
    CommandedVelocity,
)
from tactile_push.simulation.pace import Pace
from tactile_push.simulation.truth import true_values

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig
    from tactile_push.simulation.mujoco_rig import MujocoRig

P = TypeVar('P', bound=SimPlantParameters)

MARKER_RATE = 10.0  # [Hz]; fluent enough to the eye
REPEAT_PERIOD = 0.01  # of time and reading while time stands still [s]; late by no more; picked
LOOK_PERIOD = 1.0  # at who commands [s]; as often as diagnostics report it
JOINTS = (*TOPICS[JOINT_STATES].field_names, WRIST_JOINT)
LONGEST_STEP = 0.1  # a late timer moves the real-time rig no further at once [s]: a control period


class PlantNode(Node, Generic[P]):
    """Node: belt, object, finger and sensor of a rig that a subclass makes."""

    NAME: str
    PARAMETERS: type[P]

    @staticmethod
    @abstractmethod
    def rig_maker(p: P) -> 'Callable[[], Rig | MujocoRig]':
        """Return what makes the rig and compiles what it needs; ValueError if there is no rig."""

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS, self._take_parameters, faults)
        if p.real_time_factor != 1.0 and not p.publish_clock:
            raise ConfigurationError(
                'parameter real_time_factor: expected 1.0 unless publish_clock is true, '
                f'got {p.real_time_factor}'
            )
        try:
            make_rig = self.rig_maker(p)
            self._counts: Counter[str] = Counter({'readings sent': 0, 'commands': 0})
            self._sensor = PlantSensor(self, p, self._counts)
        except ValueError as error:
            raise ConfigurationError(str(error)) from None
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counts)
        with compiling(self, self._diagnostics):  # which a refusal above need not wait for
            self._rig = make_rig()
        self._period = 1.0 / p.sensor_rate
        self._pace = Pace(
            p.real_time_factor, 1.0 / p.control_rate, p.command_timeout, p.contact_lag
        )
        self._steps = 0
        self._time = 0.0
        self._gone = 0.0  # of a step, where time had to stop on its way [s]
        self._last_wall = time.monotonic()
        self._last_clock = self._last_wall
        self._commanders = 0
        self._joint_states = self.create_publisher(JointState, JOINT_STATES, PUBLISHED)
        self._object_pose = self.create_publisher(PoseStamped, TRUE_POSE, PUBLISHED)
        self._state = self.create_publisher(JointState, TRUE_STATE, PUBLISHED)
        self._markers = self.create_publisher(MarkerArray, MARKERS, 10)
        self._clock_publisher = None
        if p.publish_clock:
            self._clock_publisher = self.create_publisher(Clock, CLOCK, 10)
            self.create_subscription(PoseStamped, CONTACT, self._on_contact, FRESHEST)
            self.create_subscription(JointState, GEOMETRY_STATE, self._on_judged_reading, FRESHEST)
            self.create_subscription(JointState, PLACE_STATE, self._on_place_state, 10)
        self.create_subscription(Bool, PLACE_RELEASE, self._on_release, 10)
        self._hear_commands(p)
        steady_clock = NodeClock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(self._period / p.real_time_factor, self._on_timer, clock=steady_clock)
        self.create_timer(LOOK_PERIOD, self._count_commanders, clock=steady_clock)

    def _hear_commands(self, p: P) -> None:
        """Subscribe to what moves the finger, and to what time has to wait for."""
        self._commanded: CommandedVelocity | CommandedJoints
        self._topic = SERVO_COMMANDS if p.commands == JOINT_VELOCITIES else COMMAND
        if p.commands != JOINT_VELOCITIES:
            self._commanded = CommandedVelocity(self._rig, p.command_timeout)
            self.create_subscription(TwistStamped, COMMAND, self._on_command, 10)
            return
        self._commanded = CommandedJoints(cast('JointRig | MujocoJointRig', self._rig))
        self.create_subscription(Float64MultiArray, SERVO_COMMANDS, self._on_velocities, 10)
        if p.publish_clock:
            self.create_subscription(TwistStamped, COMMAND, self._on_servo_s_command, 10)
            self.create_subscription(JointState, SERVO_STATE, self._on_servo_state, 10)

    def destroy_node(self) -> None:
        """Stop serving the device and end."""
        self._sensor.close()
        super().destroy_node()

    def _take_parameters(self, settings: P) -> None:
        self._settings = settings
        self._rig.faults = faults(settings)
        self._sensor.err(self._rig.faults.sensor)

    def _count_commanders(self) -> None:
        self._commanders = self.count_publishers(self._topic)

    def _on_command(self, message: TwistStamped) -> None:
        assert isinstance(self._commanded, CommandedVelocity)
        fastest, velocity = self._settings.max_speed, message.twist.linear
        kind = self._commanded.take(velocity.x, velocity.y, fastest, self._now())
        if kind != NOT_FINITE:
            self._pace.command(_seconds(message), self._time)
        self._count_command(kind)
        if self._clock_publisher is None:
            self._step(self._real_time())
        else:
            self._on_timer()

    def _on_velocities(self, message: Float64MultiArray) -> None:
        assert isinstance(self._commanded, CommandedJoints)
        if self._clock_publisher is None:
            # Nothing is published, or the servo would answer that at once, and so on for ever.
            self._move(self._real_time())
        self._count_command(self._commanded.take(message.data, self._settings.max_speed))
        if self._clock_publisher is not None:
            self._on_timer()

    def _on_servo_s_command(self, message: TwistStamped) -> None:
        """Let time wait for the servo's answer to a command; the belt starts with the first."""
        assert isinstance(self._commanded, CommandedJoints)
        self._commanded.started = True
        self._pace.command(_seconds(message), self._time)
        self._on_timer()

    def _on_servo_state(self, message: JointState) -> None:
        values, now = by_name(message.name, message.position), _seconds(message)
        ages = (values.get(name, math.nan) for name in ('joint_age', 'command_age'))
        self._pace.answer(*(now - age for age in ages))
        self._on_timer()

    def _count_command(self, kind: str) -> None:
        self._counts[OBEYED] += 1
        if kind != OBEYED:
            self._counts[kind] += 1

    def _on_contact(self, message: PoseStamped) -> None:
        self._pace.contact(_seconds(message))
        self._sensor.heard()  # the reading has become it, even if with an old stamp
        self._on_timer()

    def _on_judged_reading(self, message: JointState) -> None:
        """Take note of a reading that was refused, as one whose stamp was that of the last."""
        if by_name(message.name, message.position).get('refusal', 0.0) != 0.0:
            self._sensor.heard()

    def _on_place_state(self, message: JointState) -> None:
        let_go_in = by_name(message.name, message.position).get('let_go_in', math.nan)
        self._pace.decision(_seconds(message), let_go_in)
        self._on_timer()

    def _on_release(self, message: Bool) -> None:
        """Lift the finger off the object, or put it down at the next one."""
        if self._clock_publisher is None:
            self._move(self._real_time())
        if message.data:
            self._rig.lift()
            self._pace.released()
        else:
            self._rig.put_down()
        if self._clock_publisher is not None:
            self._on_timer()

    def _on_timer(self) -> None:
        if self._clock_publisher is None:
            self._step(self._real_time())
            self._read()
            return
        wall = time.monotonic()
        was_commanded = self._pace.commanded
        whole = self._time + self._period - self._gone
        reached = self._pace.stop_before(self._time, whole)
        if self._pace.may_reach(reached, self._period, wall):
            if was_commanded and not self._pace.commanded:
                self._commanded.expire()
            self._last_clock = wall
            if reached < whole:
                self._gone += reached - self._time
                self._move(reached - self._time)
                self._publish_clock()
            else:
                self._step(self._period - self._gone)
                self._gone = 0.0
                self._read()
        elif wall - self._last_clock > REPEAT_PERIOD:
            # Time may stand still because a message was lost or a reading got an old stamp.
            self._last_clock = wall
            self._publish_clock()
            if self._pace.contact_overdue:
                self._sensor.repeat()

    def _now(self) -> float:
        """Return the time by which a command ages, which goes on while the rig is held up."""
        return time.monotonic() if self._clock_publisher is None else self._time

    def _real_time(self) -> float:
        """Return by how much the rig has to move: the time since the last call, within bounds."""
        wall = time.monotonic()
        elapsed, self._last_wall = wall - self._last_wall, wall
        return min(elapsed, LONGEST_STEP)

    def _move(self, step: float) -> None:
        """Move belt, object and finger; a sensor of force begins with the object pressed to it."""
        presses = self._sensor.feels_force and self._rig.is_loose
        self._commanded.move(step, self._now(), presses)
        self._time += step

    def _step(self, step: float) -> None:
        """Move belt, object and finger, and publish where they are."""
        self._move(step)
        self._steps += 1
        if self._clock_publisher is not None:
            # To the nanosecond: a sum would drift away from the timers that follow the clock.
            self._time = self._steps * self._period
        self._publish_clock()
        stamp = self._stamp()
        joints = dict(zip(JOINTS, self._rig.joints, strict=False))
        publish(self._joint_states, joint_state_fields((stamp.sec, stamp.nanosec), joints))
        self._publish_truth(stamp)
        every = max(1, round(self._settings.sensor_rate / MARKER_RATE))
        if self._steps % every == 0 and self._markers.get_subscription_count():
            self._markers.publish(rig_markers(self._rig, stamp))

    def _read(self) -> None:
        """Read the sensor and send what it says."""
        if self._sensor.read(self._rig, self._time, self._stamp()):
            self._pace.reading(self._time)

    def _stamp(self) -> Time:
        if self._clock_publisher is None:
            return self.get_clock().now().to_msg()
        sec, nanosec = divmod(round(self._time * 1e9), 10**9)
        return Time(sec=sec, nanosec=nanosec)

    def _publish_clock(self) -> None:
        if self._clock_publisher is not None:
            self._clock_publisher.publish(Clock(clock=self._stamp()))

    def _publish_truth(self, stamp: Time) -> None:
        rig = self._rig
        in_disk = rig.object_in_finger_disk
        at = (stamp.sec, stamp.nanosec)
        publish(self._object_pose, pose_fields(at, in_disk.x, in_disk.y, in_disk.angle))
        fields = true_values(rig, self._commanded.v_x)
        publish(self._state, joint_state_fields(at, fields))

    def _health(self) -> Health:
        rig, faulty = self._rig, ', '.join(faults_on(self._settings))
        level, message = self._judgement()
        if faulty:
            level = max(level, WARN)
            message = f'{message}, with {faulty}'
        values = {
            'time [s]': round(self._time, 3),
            'contact': rig.mode_name if rig.touching else 'none',
            'finger x [m]': rig.finger_x,
            'v_x [m/s]': rig.v_x,
            'v_x commanded [m/s]': self._commanded.v_x,
            'belt speed [m/s]': rig.v_y,
            'faults': faulty or 'none',
            f'publishers of {self._topic}': self._commanders,
        }
        return Health(level, message, values)

    def _judgement(self) -> tuple[bytes, str]:
        if self._commanded.overdue(self._now()):
            return ERROR, 'no command, finger stopped'
        if self._commanded.started and self._rig.at_workspace_limit:
            return ERROR, 'finger at its workspace limit'
        if self._commanders > 1:
            return WARN, f'several publishers of {self._topic}'
        if not self._commanded.started:
            return OK, 'belt stands, waiting for the first command'
        if self._rig.lifted:
            return OK, 'finger lifted'
        if not self._rig.touching:
            return WARN, 'finger does not touch the object'
        return OK, 'pushing'


def _seconds(message: PoseStamped | TwistStamped | JointState) -> float:
    stamp = message.header.stamp  # rclpy's Time takes no negative ones
    return stamp.sec + stamp.nanosec * 1e-9
