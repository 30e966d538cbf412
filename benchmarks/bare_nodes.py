# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The bare rclpy nodes that `bench_nodes.py` measures the package's nodes against.

Each has the topics, message types, rates, timers and services of the node whose name it has, and
does nothing but forward: one number from the device goes the whole way to the command. This is
what a hop costs in rclpy whatever the node does.
"""

import math
import socket
import sys
import threading
import time

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from visualization_msgs.msg import MarkerArray

STATE_FIELDS = 14  # of push_controller/state
TRUTH_FIELDS = 7  # of ground_truth/state
DIAGNOSTIC_VALUES = 10
DIAGNOSTIC_LOOKS = 10  # a second, of which the last one reports


class Reporter:
    """The timer and the publisher of a node's diagnostics."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._looks = 0
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', 10)
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(1.0 / DIAGNOSTIC_LOOKS, self._on_timer, clock=steady_clock)

    def _on_timer(self) -> None:
        self._looks += 1
        if self._looks % DIAGNOSTIC_LOOKS:
            return
        values = [KeyValue(key=f'value {i}', value=str(i)) for i in range(DIAGNOSTIC_VALUES)]
        message = DiagnosticArray(status=[DiagnosticStatus(name='bare', values=values)])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)


class BareDriver(LifecycleNode):
    """Device bytes in, `tactile` out."""

    def __init__(self) -> None:
        super().__init__('sensor_driver')
        host, port = self.declare_parameter('device', '').value.split(':')
        self._publisher = self.create_publisher(JointState, 'tactile', 10)
        self._reporter = Reporter(self)
        self._address = host, int(port)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        while True:
            try:
                device = socket.create_connection(self._address)
                break
            except ConnectionRefusedError:
                time.sleep(0.1)
        for line in device.makefile('rb'):
            message = JointState()
            message.header.stamp = self.get_clock().now().to_msg()
            message.name = ['azimuth', 'elevation', 'normal_force']
            message.position = [0.0, float(line.split(b',')[4]), math.nan]
            message.velocity = [math.nan, math.nan, math.nan]
            message.effort = [math.nan, math.nan, 1.5]
            self._publisher.publish(message)


class BareGeometry(Node):
    """`tactile` and `joint_states` in, `contact` out."""

    def __init__(self) -> None:
        super().__init__('contact_geometry')
        every = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._publisher = self.create_publisher(PoseStamped, 'contact', 10)
        self.create_subscription(JointState, 'joint_states', lambda message: None, every)
        self.create_subscription(JointState, 'tactile', self._on_tactile, every)
        self._reporter = Reporter(self)

    def _on_tactile(self, message: JointState) -> None:
        pose = PoseStamped()
        pose.header.stamp = message.header.stamp
        pose.header.frame_id = 'finger_disk'
        pose.pose.position.x = message.position[1]
        self._publisher.publish(pose)


class BareController(LifecycleNode):
    """`contact` in, `finger/cmd_vel` and `push_controller/state` out.

    As the real one, it hears `joint_states` and its own command too.
    """

    def __init__(self) -> None:
        super().__init__('push_controller')
        rate = self.declare_parameter('control_rate', 10.0).value
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._value = math.nan
        self._command = self.create_publisher(TwistStamped, 'finger/cmd_vel', 10)
        self._state = self.create_publisher(JointState, 'push_controller/state', 10)
        self.create_subscription(JointState, 'joint_states', lambda message: None, newest)
        self.create_subscription(PoseStamped, 'contact', self._on_contact, newest)
        for qos in (10, newest):
            self.create_subscription(TwistStamped, 'finger/cmd_vel', lambda message: None, qos)
        self.create_service(Trigger, 'push_controller/resume', lambda request, response: response)
        self.create_guard_condition(lambda: None)
        self.create_timer(1.0 / rate, self._on_timer)
        self._reporter = Reporter(self)

    def _on_contact(self, message: PoseStamped) -> None:
        self._value = message.pose.position.x

    def _on_timer(self) -> None:
        stamp = self.get_clock().now().to_msg()
        command = TwistStamped()
        command.header.stamp = stamp
        command.header.frame_id = 'finger_base'
        command.twist.linear.x = self._value
        self._command.publish(command)
        state = JointState(
            name=['theta', *(f'field {i}' for i in range(1, STATE_FIELDS))],
            position=[self._value] * STATE_FIELDS,
        )
        state.header.stamp = stamp
        self._state.publish(state)


class BarePlant(Node):
    """`finger/cmd_vel` in, device bytes, `joint_states` and `ground_truth/*` out."""

    def __init__(self) -> None:
        super().__init__('sim_plant')
        host, port = self.declare_parameter('device', '').value.split(':')
        rate = self.declare_parameter('sensor_rate', 50.0).value
        self._joints = self.create_publisher(JointState, 'joint_states', 10)
        self._pose = self.create_publisher(PoseStamped, 'ground_truth/object_pose', 10)
        self._truth = self.create_publisher(JointState, 'ground_truth/state', 10)
        self._markers = self.create_publisher(MarkerArray, 'markers', 10)
        self.create_subscription(TwistStamped, 'finger/cmd_vel', lambda message: None, 10)
        self._reporter = Reporter(self)
        self._device, _ = socket.create_server((host, int(port))).accept()
        self._device.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(1.0 / rate, self._on_timer, clock=steady_clock)

    def _on_timer(self) -> None:
        stamp = self.get_clock().now().to_msg()
        joints = JointState(name=['proximal_joint', 'distal_joint'], position=[0.0, 0.0])
        joints.header.stamp = stamp
        self._joints.publish(joints)
        self._device.sendall(b'$PTACT,7,A,0.0000,70.0000,1.500*15\r\n')
        pose = PoseStamped()
        pose.header.stamp = stamp
        pose.header.frame_id = 'finger_disk'
        self._pose.publish(pose)
        truth = JointState(
            name=[f'field {i}' for i in range(TRUTH_FIELDS)], position=[0.0] * TRUTH_FIELDS
        )
        truth.header.stamp = stamp
        self._truth.publish(truth)


NODES = {
    'sensor_driver': BareDriver,
    'contact_geometry': BareGeometry,
    'push_controller': BareController,
    'sim_plant': BarePlant,
}


def main() -> None:
    """Run the node that the first argument names."""
    rclpy.init(args=sys.argv)
    try:
        rclpy.spin(NODES[sys.argv[1]]())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
