# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The simulated rig in place of the hardware: finger velocity in, sensor bytes out."""

import math
import sys
import time

from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock as NodeClock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.nodes.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.markers import rig_markers
from tactile_push.nodes.parameters import ConfigurationError, Parameter, declare
from tactile_push.nodes.process import run
from tactile_push.simulation import Rig, RigConfig, serve
from tactile_push.simulation.pace import Pace
from tactile_push.tactile import PlanarFinger, Sentence, encode, quaternion_of_yaw

FRESHEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
MARKER_RATE = 10.0  # [Hz]
REPEAT_PERIOD = 0.01  # of time and reading while the time stands still [s]
LONGEST_STEP = 0.1  # what a delayed timer may add to the real-time rig at once [s]


class SimPlant(Node):
    """Node: belt, object, finger and sensor."""

    NAME = 'sim_plant'
    PARAMETERS = (
        Parameter(
            'device',
            'socket://127.0.0.1:54320',
            '',
            'where the sensor_driver will find the sensor: socket://host:port to listen on, or '
            'an absolute path for a pseudo terminal',
            read_only=True,
        ),
        Parameter(
            'object', 'block', '', 'what is pushed', choices=('block', 'disk'), read_only=True
        ),
        Parameter('edge_length', 0.05, 'm', 'pushed edge of the block', 1e-3, 1.0, read_only=True),
        Parameter(
            'edge_to_cm',
            0.02375,
            'm',
            'distance l from the pushed edge of the block to its centre of mass, half its depth',
            1e-3,
            1.0,
            read_only=True,
        ),
        Parameter('disk_radius', 0.0285, 'm', 'radius of the disk', 1e-3, 1.0, read_only=True),
        Parameter(
            'c',
            0.0,
            'm',
            'm_max / f_max of the support of the object; 0 for a uniform support',
            0.0,
            1.0,
            read_only=True,
        ),
        Parameter(
            'mu_c',
            math.inf,
            '',
            'friction between finger and object, .inf too',
            0.0,
            read_only=True,
        ),
        Parameter(
            'theta_initial',
            0.3490658503988659,
            'rad',
            'angle of the edge at the start',
            -1.5,
            1.5,
            read_only=True,
        ),
        Parameter(
            'd_initial',
            -0.006,
            'm',
            'contact along the edge of the block at the start',
            -0.5,
            0.5,
            read_only=True,
        ),
        Parameter('belt_speed', 0.005, 'm/s', 'speed of the belt', 1e-5, 1.0, read_only=True),
        Parameter(
            'finger_radius',
            0.0135,
            'm',
            "effective radius of the finger's disk",
            1e-4,
            1.0,
            read_only=True,
        ),
        Parameter(
            'proximal_length',
            0.06,
            'm',
            'distance between the moving joints of the finger',
            1e-3,
            1.0,
            read_only=True,
        ),
        Parameter(
            'distal_length',
            0.08,
            'm',
            'distance from the last joint to the centre of the disk',
            1e-3,
            1.0,
            read_only=True,
        ),
        Parameter(
            'mount_angle',
            1.5707963267948966,
            'rad',
            'angle of the finger at joint angles zero',
            -6.3,
            6.3,
            read_only=True,
        ),
        Parameter('sensor_rate', 50.0, 'Hz', 'readings a second', 1.0, 1000.0, read_only=True),
        Parameter(
            'command_timeout',
            0.5,
            's',
            'without a command for so long the finger stops',
            0.01,
            10.0,
            read_only=True,
        ),
        Parameter(
            'publish_clock',
            False,
            '',
            'own the time: publish /clock and let it wait for contacts and commands',
            read_only=True,
        ),
        Parameter(
            'real_time_factor',
            1.0,
            's/s',
            'how fast the time passes at the most; other than 1 only with publish_clock',
            0.01,
            100.0,
            read_only=True,
        ),
        Parameter(
            'control_rate',
            10.0,
            'Hz',
            'commands a second that the published time waits for',
            0.1,
            200.0,
            read_only=True,
        ),
    )

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS)
        if p.real_time_factor != 1.0 and not p.publish_clock:
            raise ConfigurationError(
                'parameter real_time_factor: expected 1.0 unless publish_clock is true, '
                f'got {p.real_time_factor}'
            )
        try:
            config = self._rig_config()
        except ValueError as error:
            raise ConfigurationError(str(error)) from None
        self._rig = Rig(config)
        Rig(config).step(0.0, 1.0)  # compiles the mechanics before time begins
        try:
            self._device = serve(p.device)
        except ValueError as error:
            raise ConfigurationError(f'parameter device: {error}') from None
        except OSError as error:
            raise ConfigurationError(f'parameter device: {error.strerror}') from None
        self._period = 1.0 / p.sensor_rate
        self._pace = Pace(p.real_time_factor, 1.0 / p.control_rate, p.command_timeout)
        self._steps = 0
        self._sequence = 0
        self._time = 0.0
        self._last_wall = time.monotonic()
        self._last_clock = self._last_wall
        self._v_x = 0.0
        self._last_command: float | None = None
        self._create_topics()
        self._diagnostics = Diagnostics(self, self._health)
        self.create_timer(
            self._period / p.real_time_factor,
            self._on_timer,
            clock=NodeClock(clock_type=ClockType.STEADY_TIME),
        )

    def destroy_node(self) -> None:
        """Stop serving the device and end."""
        self._device.close()
        super().destroy_node()

    def _rig_config(self) -> RigConfig:
        p = self._settings
        if p.object == 'block':
            outline = Outline.rectangle(p.edge_length, 2.0 * p.edge_to_cm)
            d = p.d_initial
        else:
            outline = Outline.circle(p.disk_radius)
            d = 0.0
        return RigConfig(
            Slider(outline, p.c or Support.uniform(outline).c),
            p.mu_c,
            p.theta_initial,
            d,
            p.belt_speed,
            p.finger_radius,
            PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle),
        )

    def _create_topics(self) -> None:
        self._joint_states = self.create_publisher(JointState, 'joint_states', 10)
        self._object_pose = self.create_publisher(PoseStamped, 'ground_truth/object_pose', 10)
        self._state = self.create_publisher(JointState, 'ground_truth/state', 10)
        self._markers = self.create_publisher(MarkerArray, 'markers', 10)
        self._clock_publisher = None
        if self._settings.publish_clock:
            self._clock_publisher = self.create_publisher(Clock, '/clock', 10)
            self.create_subscription(PoseStamped, 'contact', self._on_contact, FRESHEST)
        self.create_subscription(TwistStamped, 'finger/cmd_vel', self._on_command, 10)

    def _on_command(self, message: TwistStamped) -> None:
        v_x = message.twist.linear.x
        if not math.isfinite(v_x):
            self.get_logger().error('finger/cmd_vel: not a finite velocity, ignored', once=True)
            return
        self._v_x = v_x
        self._last_command = self._time
        stamp = Time.from_msg(message.header.stamp).nanoseconds * 1e-9
        self._pace.command(stamp, self._time)
        self._on_timer()

    def _on_contact(self, message: PoseStamped) -> None:
        self._pace.contact(Time.from_msg(message.header.stamp).nanoseconds * 1e-9)
        self._on_timer()

    def _on_timer(self) -> None:
        wall = time.monotonic()
        if self._clock_publisher is None:
            step = min(wall - self._last_wall, LONGEST_STEP)
            self._last_wall = wall
            self._step(step)
            return
        was_commanded = self._pace.commanded
        if self._pace.may_reach(self._time + self._period, self._period, wall):
            if was_commanded and not self._pace.commanded:
                self._v_x = 0.0  # the command is overdue
            self._last_clock = wall
            self._step(self._period)
        elif wall - self._last_clock > REPEAT_PERIOD:
            # Time may stand still because a message was lost or a reading got an old stamp.
            self._last_clock = wall
            self._publish_clock()
            self._send_reading()

    def _step(self, step: float) -> None:
        """Move belt, object and finger, and tell of it."""
        if self._last_command is None:
            self._rig.step(0.0, step, belt_running=False)
        else:
            if self._time - self._last_command >= self._settings.command_timeout:
                self._v_x = 0.0
            self._rig.step(self._v_x, step)
        self._time += step
        self._steps += 1
        self._publish_clock()
        stamp = self._stamp()
        self._publish_joint_states(stamp)
        self._send_reading()
        self._publish_truth(stamp)
        every = max(1, round(self._settings.sensor_rate / MARKER_RATE))
        if self._steps % every == 0 and self._markers.get_subscription_count():
            self._markers.publish(rig_markers(self._rig, stamp))

    def _send_reading(self) -> None:
        reading = self._rig.reading()
        self._device.send(encode(Sentence(self._sequence, reading)))
        self._sequence += 1
        if reading.in_contact:
            self._pace.reading(self._time)

    def _stamp(self) -> Time:
        if self._clock_publisher is None:
            return self.get_clock().now()
        return Time(nanoseconds=round(self._time * 1e9), clock_type=ClockType.ROS_TIME)

    def _publish_clock(self) -> None:
        if self._clock_publisher is not None:
            self._clock_publisher.publish(Clock(clock=self._stamp().to_msg()))

    def _publish_joint_states(self, stamp: Time) -> None:
        message = JointState(name=['proximal_joint', 'distal_joint'], position=self._rig.joints)
        message.header.stamp = stamp.to_msg()
        self._joint_states.publish(message)

    def _publish_truth(self, stamp: Time) -> None:
        rig = self._rig
        in_disk = rig.object_in_finger_disk
        pose = PoseStamped()
        pose.header.stamp = stamp.to_msg()
        pose.header.frame_id = 'finger_disk'
        pose.pose.position.x, pose.pose.position.y = in_disk.x, in_disk.y
        orientation = pose.pose.orientation
        orientation.z, orientation.w = quaternion_of_yaw(in_disk.angle)
        self._object_pose.publish(pose)
        fields = {
            'theta': rig.theta if rig.touching else math.nan,
            'd': rig.d if rig.touching else math.nan,
            'phi': rig.phi,
            'mode': float(rig.mode),
            'v_x': self._v_x,
            'finger_x': rig.finger_x,
            'belt_travel': rig.finger_y,
        }
        state = JointState(name=list(fields), position=list(fields.values()))
        state.header.stamp = stamp.to_msg()
        self._state.publish(state)

    def _health(self) -> Health:
        rig = self._rig
        values = {
            'time [s]': round(self._time, 3),
            'readings sent': self._sequence,
            'contact': rig.mode_name if rig.touching else 'none',
            'finger x [m]': rig.finger_x,
            'v_x [m/s]': self._v_x,
        }
        if self._last_command is None:
            return Health(OK, 'belt stands, waiting for the first command', values)
        if self._time - self._last_command >= self._settings.command_timeout:
            return Health(ERROR, 'no command, finger stopped', values)
        if rig.at_workspace_limit:
            return Health(ERROR, 'finger at its workspace limit', values)
        if not rig.touching:
            return Health(WARN, 'finger does not touch the object', values)
        return Health(OK, 'pushing', values)


def main() -> int:
    """Run the node as a process."""
    return run(SimPlant)


if __name__ == '__main__':
    sys.exit(main())
