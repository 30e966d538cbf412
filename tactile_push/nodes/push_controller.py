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
"""Runs the control law on contacts and commands the finger."""

import sys

from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rclpy.timer import Timer
from sensor_msgs.msg import JointState

from tactile_push.control import PUSHING, STATES, PushControl, PushLaw, Tick
from tactile_push.nodes.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.parameters import Parameter, declare
from tactile_push.nodes.process import autostart, run
from tactile_push.tactile import yaw_of_quaternion


class PushController(LifecycleNode):
    """Managed node: `contact` in, `finger/cmd_vel` and `push_controller/state` out."""

    NAME = 'push_controller'
    PARAMETERS = (
        Parameter('kp', 0.05, 'rad/rad', 'proportional gain of the law (18)', 0.0, 100.0),
        Parameter('kd', 5.0, 'rad/rad', 'derivative gain of the law (18)', 0.0, 1000.0),
        Parameter(
            'theta_desired', -0.17453292519943295, 'rad', 'desired angle of the edge', -1.5, 1.5
        ),
        Parameter(
            'phi_min', 0.5759586531581288, 'rad', 'smallest push angle', 0.1, 1.57, read_only=True
        ),
        Parameter(
            'phi_max', 2.5656340004316647, 'rad', 'largest push angle', 1.58, 3.04, read_only=True
        ),
        Parameter('belt_speed', 0.005, 'm/s', 'speed of the belt', 1e-5, 1.0, read_only=True),
        Parameter('control_rate', 10.0, 'Hz', 'rate of the law', 0.1, 200.0, read_only=True),
        Parameter(
            'contact_timeout', 0.3, 's', 'without contact for so long the finger stops', 0.01, 10.0
        ),
        Parameter(
            'autostart', True, '', 'configure and activate without a manager', read_only=True
        ),
    )

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, self.PARAMETERS, self._take_parameters)
        self._law = PushLaw(p.kp, p.kd, p.theta_desired, p.phi_min, p.phi_max)
        period = 1.0 / p.control_rate
        self._control = PushControl(self._law, p.belt_speed, period, p.contact_timeout)
        self._timer: Timer | None = None
        self._tick: Tick | None = None
        self._diagnostics = Diagnostics(self, self._health)
        if p.autostart:
            autostart(self)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics."""
        self._command = self.create_lifecycle_publisher(TwistStamped, 'finger/cmd_vel', 10)
        self._state = self.create_lifecycle_publisher(JointState, 'push_controller/state', 10)
        self._contact = self.create_subscription(
            PoseStamped,
            'contact',
            self._on_contact,
            QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT),
        )
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start the law."""
        result = super().on_activate(state)
        self._control.activate(self._now())
        self._timer = self.create_timer(self._control.period, self._on_tick)
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop the law and the finger."""
        self._stop()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove the topics."""
        self.destroy_lifecycle_publisher(self._command)
        self.destroy_lifecycle_publisher(self._state)
        self.destroy_subscription(self._contact)
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop the law and the finger for good."""
        self._stop()
        return TransitionCallbackReturn.SUCCESS

    def destroy_node(self) -> None:
        """Stop the finger and end."""
        self._stop()
        super().destroy_node()

    def _take_parameters(self) -> None:
        p = self._settings
        self._law.kp, self._law.kd, self._law.theta_desired = p.kp, p.kd, p.theta_desired
        self._control.contact_timeout = p.contact_timeout

    def _now(self) -> float:
        return self.get_clock().now().nanoseconds * 1e-9

    def _on_contact(self, message: PoseStamped) -> None:
        orientation = message.pose.orientation
        stamp = Time.from_msg(message.header.stamp).nanoseconds * 1e-9
        self._control.feel(yaw_of_quaternion(orientation.z, orientation.w), stamp)

    def _on_tick(self) -> None:
        now = self.get_clock().now()
        self._tick = self._control.tick(now.nanoseconds * 1e-9)
        if self._tick.v_x is not None:
            self._publish_command(now, self._tick.v_x)
        self._publish_state(now, self._tick)
        self._diagnostics.update()

    def _publish_command(self, now: Time, v_x: float) -> None:
        command = TwistStamped()
        command.header.stamp = now.to_msg()
        command.header.frame_id = 'finger_base'
        command.twist.linear.x = v_x
        self._command.publish(command)

    def _publish_state(self, now: Time, tick: Tick) -> None:
        fields = {
            'theta': tick.theta,
            'theta_desired': self._law.theta_desired,
            'phi': tick.phi,
            'v_x': float('nan') if tick.v_x is None else tick.v_x,
            'kp': self._law.kp,
            'kd': self._law.kd,
            'silence': tick.silence,
            'saturated': float(tick.saturated),
            'state': float(STATES.index(tick.state)),
            'ticks': float(tick.ticks),
            'ticks_lost': float(tick.ticks_lost),
        }
        message = JointState(name=list(fields), position=list(fields.values()))
        message.header.stamp = now.to_msg()
        self._state.publish(message)

    def _stop(self) -> None:
        """Send a last zero command and wait until the finger has it."""
        if self._timer is None:
            return
        self.destroy_timer(self._timer)
        self._timer = None
        self._tick = None
        self._publish_command(self.get_clock().now(), 0.0)
        self._command.wait_for_all_acked(Duration(seconds=0.1))

    def _health(self) -> Health:
        if self._timer is None:
            return Health(OK, 'inactive')
        tick = self._tick
        if tick is None:
            return Health(WARN, 'active, no tick yet')
        values = {
            'theta [rad]': tick.theta,
            'theta_desired [rad]': self._law.theta_desired,
            'phi [rad]': tick.phi,
            'v_x [m/s]': tick.v_x,
            'since last contact [s]': tick.silence,
            'phi saturated': tick.saturated,
            'ticks': tick.ticks,
            'ticks lost': tick.ticks_lost,
        }
        if tick.state != PUSHING:
            overdue = tick.silence > self._control.contact_timeout
            return Health(ERROR if overdue else WARN, tick.state, values)
        if tick.saturated or tick.ticks_lost:
            return Health(WARN, tick.state, values)
        return Health(OK, tick.state, values)


def main() -> int:
    """Run the node as a process."""
    return run(PushController)


if __name__ == '__main__':
    sys.exit(main())
