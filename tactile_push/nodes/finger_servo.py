# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Moves a finger across the belt by the velocities of its joints."""

import sys
import time
from collections import Counter, deque

from geometry_msgs.msg import TwistStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.timer import Timer
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from tactile_push.control import (
    COMMAND_SILENT,
    FINGER_UNKNOWN,
    FOLLOWING,
    SERVO_HELD,
    STOPPED,
    ServoStep,
)
from tactile_push.interface import (
    COMMAND,
    FINGER_SERVO,
    JOINT_STATES,
    SERVO_COMMANDS,
    SERVO_STATE,
)
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import EVERYBODY, SENSOR_DATA
from tactile_push.parameters.finger_servo import FingerServoParameters, make_limits, make_servo
from tactile_push.pipeline import Moment, Servo
from tactile_push.pipeline.stamps import stamp_of

REMEMBERED = 200  # own velocities that may still be on their way back here; picked
# Counts that are no fault. A message that came twice or late does no harm.
NO_FAULT = {'commands', 'joint states', 'joint states of other joints', 'joint states not newer'}


class FingerServo(ManagedNode):
    """Managed node: `finger/cmd_vel` and `joint_states` in, velocities of the joints out.

    It answers each command and each joint state at once with velocities, and gives some `rate`
    times a second even if nothing arrives. It also subscribes to the velocities, to notice that
    somebody else commands the joints.
    """

    NAME = FINGER_SERVO

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, FingerServoParameters, self._take_parameters)
        with refusing():
            self._servo = make_servo(p)
        self._time = NodeTime(self)
        self._steps = Servo(self._servo, p.joint_names, self._time.seconds)
        self._timer: Timer | None = None
        self._step: ServoStep | None = None
        self._spoke_at = 0.0  # by the steady clock [s]
        self._counted: Counter[str] = Counter()
        self._sent: deque[tuple[float, ...]] = deque(maxlen=REMEMBERED)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)
        if p.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics."""
        self._outputs = {
            SERVO_COMMANDS: self.make_publisher(Float64MultiArray, SERVO_COMMANDS),
            SERVO_STATE: self.make_publisher(JointState, SERVO_STATE),
        }
        self.make_subscription(TwistStamped, COMMAND, self._on_command, SENSOR_DATA)
        self.make_subscription(JointState, JOINT_STATES, self._on_joint_states, SENSOR_DATA)
        for qos in EVERYBODY:
            self.make_subscription(Float64MultiArray, SERVO_COMMANDS, self._on_velocities, qos)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Take over the joints."""
        result = super().on_activate(state)
        self._servo.activate(self._now().steady)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(1.0 / self._settings.rate, self._on_timer, clock=steady)
        self._act()
        return result

    def _take_parameters(self, settings: FingerServoParameters) -> None:
        self._settings = settings
        self._servo.limits = make_limits(settings)

    def _now(self) -> Moment:
        """Return the present; simulated time stands in for the clock that cannot be set."""
        if self.get_clock().ros_time_is_active:
            now = self._time.now()
            return Moment(now, now)
        stamp, steady = self._time.now_and_steady()
        return Moment(self._time.of(stamp), steady)

    def _on_command(self, message: TwistStamped) -> None:
        frame, velocity, stamp = message.header.frame_id, message.twist.linear, stamp_of(message)
        kind = self._steps.command(stamp, frame, velocity.x, self._now(), velocity.y)
        self._counted[kind] += 1
        self._act()

    def _on_joint_states(self, message: JointState) -> None:
        names, positions = message.name, message.position
        kind = self._steps.joint_states(stamp_of(message), names, positions, self._now())
        self._counted[kind] += 1
        self._act()

    def _on_velocities(self, message: Float64MultiArray) -> None:
        if self._timer is not None and tuple(message.data) not in self._sent:
            self._counted['velocities of another node'] += 1
            self._servo.notice_another_command()
            self._act()

    def _on_timer(self) -> None:
        before = self._step
        self._step = step = self._servo.step(self._now().steady)
        changed = before is None or step.stop_reason != before.stop_reason
        if changed or time.monotonic() - self._spoke_at >= 1.0 / self._settings.rate:
            self._publish(step)

    def _act(self) -> None:
        """Decide on the velocities and publish them, if the node is active."""
        if self._timer is not None:
            self._step = self._servo.step(self._now().steady)
            self._publish(self._step)

    def _publish(self, step: ServoStep) -> None:
        self._spoke_at = time.monotonic()
        if step.rates is not None:
            self._sent.append(step.rates)
        stamp = self.get_clock().now().to_msg()
        for topic, fields in self._steps.outputs((stamp.sec, stamp.nanosec), step):
            publish(self._outputs[topic], fields)

    def _stop(self) -> None:
        """Publish last zeros, and wait until the joints have them."""
        if self._timer is None:
            return
        self.destroy_timer(self._timer)
        self._timer = self._step = None
        rates = self._servo.deactivate()
        self._publish(self._servo.step(self._now().steady)._replace(rates=rates))
        self._outputs[SERVO_COMMANDS].wait_for_all_acked(Duration(seconds=0.1))

    def _health(self) -> Health:
        step = self._step
        if step is None:
            return Health(OK, 'inactive')
        others = self.count_publishers(SERVO_COMMANDS) - 1
        values = {
            'v_x [m/s]': step.v_x,
            'velocities': step.rates,
            'share of v_x': step.share,
            'finger x [m]': step.x,
            'finger y [m]': step.y,
            'line [m]': step.line,
            'deviation [m]': step.deviation,
            f'other publishers of {SERVO_COMMANDS}': others,
        }
        if step.state == STOPPED:
            return Health(ERROR, self._words(step), values)
        if trouble := self._steps.trouble:
            return Health(WARN, f'{step.state}, but {trouble}', values)
        rates = self._diagnostics.rates
        lately = any(rates[name] for name in self._counted.keys() - NO_FAULT)
        if others > 0:
            words = f'{step.state}, but {SERVO_COMMANDS} has another publisher'
            return Health(WARN, words, values)
        if step.share < 1.0:
            words = f'{step.state} at {step.share:.0%} of the commanded velocity'
            return Health(WARN, words, values)
        if lately:
            return Health(WARN, f'{step.state}, some messages refused', values)
        return Health(OK if step.state == FOLLOWING else WARN, step.state, values)

    def _words(self, step: ServoStep) -> str:
        words = f'{step.state}: {step.stop_reason}'
        if step.stop_reason in SERVO_HELD:
            return f'{words}, until activated anew'
        trouble = (
            self._steps.trouble if step.stop_reason in (COMMAND_SILENT, FINGER_UNKNOWN) else ''
        )
        return f'{words}: {trouble}' if trouble else words


def main() -> int:
    """Run the node as a process."""
    return run(FingerServo)


if __name__ == '__main__':
    sys.exit(main())
