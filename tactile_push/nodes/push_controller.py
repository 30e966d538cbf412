# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the control law on contacts and commands the finger."""

import math
import sys
import time
from collections import Counter, deque

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.timer import Timer
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from tactile_push.control import (
    FINGER_UNKNOWN,
    HELD,
    NOTHING_TO_DO,
    PUSHING,
    STOPPED,
    WAITING,
    Tick,
)
from tactile_push.control.placing.stages import FAILURES, NO_GOAL
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    JOINT_STATES,
    PLACE,
    PLACE_RELEASE,
    PLACE_STATE,
    PUSH,
    RESUME,
)
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.placing import PlaceTopics
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import EVERYBODY, SENSOR_DATA
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    check_fit,
    choose_law,
    make_control,
    make_finger,
    take_values,
)
from tactile_push.pipeline import Control, edge_angle
from tactile_push.pipeline.stamps import stamp_of

STANDSTILL = 1.0  # without a tick for so long after a period, time stands still [s]; picked
NO_LIMIT = 'use_joint_states: false does without, and keeps no limit of the workspace'
REMEMBERED = 32  # own commands that may still be on their way back here: 3 s of the paper's rate


class PushController(ManagedNode):
    """Managed node: `contact` in, `finger/cmd_vel` and `push_controller/state` out.

    It also subscribes to `joint_states`, to keep the finger in its workspace, and to
    `finger/cmd_vel`, to notice that somebody else commands the finger. Laws with goals add the
    topics of `PlaceTopics`.
    """

    NAME = 'push_controller'

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, PushControllerParameters, self._take_parameters, check_fit)
        with refusing():
            self._control = make_control(self._settings)
        self._time = NodeTime(self)
        finger, joint_names = make_finger(self._settings), self._settings.joint_names
        self._steps = Control(self._control, finger, joint_names, self._time.seconds)
        self._timer: Timer | None = None
        self._told_growth = False
        self._tick: Tick | None = None
        self._ticked_at = -math.inf  # on the steady clock [s]
        self._sent: deque[tuple[int, int, float, float]] = deque(maxlen=REMEMBERED)
        self._counted: Counter[str] = Counter()
        self._clock_jumped = self.create_guard_condition(self._after_clock_jump)
        self._due: Time | None = None  # of a tick that waits for contacts to be heard
        self._contacts_before = 0  # heard until this node last looked whether more have arrived
        self._heard_all = self.create_guard_condition(self._after_hearing)
        self._place = PlaceTopics(self, self._heard_all.trigger)
        longest = Duration(seconds=self._control.period * (self._settings.max_ticks_lost + 1))
        jump = JumpThreshold(min_forward=longest, min_backward=Duration(nanoseconds=-1))
        self._jump_handle = self.get_clock().create_jump_callback(
            jump, post_callback=self._on_clock_jump
        )
        self.create_service(Trigger, RESUME, self._on_resume)
        self._diagnostics = Diagnostics(self, self._health, self._counts)
        if self._settings.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics."""
        self._outputs = {
            COMMAND: self.make_publisher(TwistStamped, COMMAND),
            CONTROLLER_STATE: self.make_publisher(JointState, CONTROLLER_STATE),
        }
        if self._settings.use_joint_states:
            self.make_subscription(JointState, JOINT_STATES, self._on_joint_states, SENSOR_DATA)
        self.make_subscription(PoseStamped, CONTACT, self._on_contact, SENSOR_DATA)
        for qos in EVERYBODY:
            self.make_subscription(TwistStamped, COMMAND, self._on_command, qos)
        self._make_topics_of_goals()
        return TransitionCallbackReturn.SUCCESS

    def _make_topics_of_goals(self) -> None:
        """Make the topics that the law takes beside those of all laws, unless they are there."""
        law = self._settings.law
        if law != PUSH and PLACE_STATE not in self._outputs:
            self._outputs[PLACE_STATE] = self._place.make()
        if law == PLACE and PLACE_RELEASE not in self._outputs:
            self._outputs[PLACE_RELEASE] = self._place.make_release()

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start the law."""
        self._choose_law()
        result = super().on_activate(state)
        self._control.activate(self._time.now())
        self._steady = math.nan  # when it ticked last, by a clock that cannot be set [s]
        self._start_timer()
        return result

    def _choose_law(self) -> None:
        """Begin anew with the law that is asked for; what it needs is made and compiled."""
        p, seconds = self._settings, self._time.seconds
        self._make_topics_of_goals()
        if p.law != PUSH:
            from tactile_push.nodes.ros.compiling import compiling  # which loads the compiler

            with compiling(self, self._diagnostics):
                choose_law(self._steps, p, seconds)
        else:
            choose_law(self._steps, p, seconds)
        self._place.serve(self._steps.placing)

    def destroy_node(self) -> None:
        """Stop the finger and end."""
        self._jump_handle.unregister()
        super().destroy_node()

    def _take_parameters(self, settings: PushControllerParameters) -> None:
        self._settings = settings
        take_values(self._control, settings)

    def _start_timer(self) -> None:
        """Start to tick, on a clock that nobody can set unless time is simulated."""
        simulated = self.get_clock().ros_time_is_active
        clock = self.get_clock() if simulated else Clock(clock_type=ClockType.STEADY_TIME)
        on_timer = self._on_simulated_timer if simulated else self._on_tick
        self._timer = self.create_timer(self._control.period, on_timer, clock=clock)

    def _on_clock_jump(self, jump: TimeJump) -> None:
        self._control.notice_clock_jump(self._time.now())
        self._clock_jumped.trigger()  # while the clock calls, its timers cannot be changed

    def _after_clock_jump(self) -> None:
        """Stop at once: a timer of a clock that went back would not tick for as long."""
        if self._timer is not None:
            self.destroy_timer(self._timer)
            self._start_timer()
            self._on_tick()

    def _on_simulated_timer(self) -> None:
        """Tick once all contacts that have arrived are heard.

        The clock tells of its last time only, so it may pass several contacts at once, and the
        executor hears one of them a turn. On a loaded machine the law would fall behind the plant.
        """
        self._due = self.get_clock().now().to_msg()
        self._contacts_before = self._counted['contacts']
        self._contacts_at_most = self._contacts_before + SENSOR_DATA.depth
        self._heard_all.trigger()

    def _after_hearing(self) -> None:
        """Tick if the executor's last turn brought no contact, and no estimate is on its way."""
        contacts = self._counted['contacts']
        if self._due is None or self._timer is None:
            return
        if self._contacts_before < contacts < self._contacts_at_most:
            self._contacts_before = contacts
            self._heard_all.trigger()
        elif not self._place.waits():
            self._on_tick(self._due)

    def _on_contact(self, message: PoseStamped) -> None:
        frame, turn = message.header.frame_id, message.pose.orientation
        theta = edge_angle(frame, turn.x, turn.y, turn.z, turn.w)
        if not self._steps.contact(stamp_of(message), theta):
            self._counted['implausible contacts'] += 1
        self._counted['contacts'] += 1

    def _on_joint_states(self, message: JointState) -> None:
        stamp = stamp_of(message)
        self._counted[self._steps.joint_states(stamp, message.name, message.position)] += 1

    def _on_command(self, message: TwistStamped) -> None:
        velocity = message.twist.linear
        if (*stamp_of(message), velocity.x, velocity.y) not in self._sent:
            self._counted['commands of another node'] += 1
            self._control.notice_another_command()

    def _on_resume(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before = 'inactive' if self._tick is None else _words(self._tick)
        response.success = self._control.resume()
        response.message = before if not response.success else f'was {before}'
        return response

    def _on_tick(self, due: Time | None = None) -> None:
        self._due = None
        self._place.before_tick()
        clock = self.get_clock()
        if clock.ros_time_is_active:
            stamp, elapsed = due or clock.now().to_msg(), math.nan
        else:
            stamp, steady = self._time.now_and_steady()
            elapsed, self._steady = steady - self._steady, steady
        self._tick = self._steps.tick((stamp.sec, stamp.nanosec), elapsed)
        self._ticked_at = time.monotonic()
        self._publish(stamp, self._tick)
        # Which take their time; the finger has its command by now.
        self._tell_growth(self._tick)
        self._place.after_tick(stamp)
        self._diagnostics.update()

    def _tell_growth(self, tick: Tick) -> None:
        """Say once, when the finger first pushes, if its drift will grow."""
        e_fold = self._steps.outlook.e_fold
        if self._told_growth or tick.state != PUSHING or math.isnan(e_fold):
            return
        self._told_growth = True
        if e_fold < math.inf:
            self.get_logger().info(
                f'the tip turns by {self._steps.turning:.1f} rad for each metre across the belt: '
                f'the drift of a straight edge that translates grows by e in {e_fold:.0f} s '
                f'(edge_distance {self._settings.edge_distance:g} m)'
            )
        if self._settings.steadying_max > 0.0 and not self._steps.steadies:
            self.get_logger().warning(
                'steadying_max: no trim steadies an object whose centre of mass is so near to the '
                f'edge (edge_distance {self._settings.edge_distance:g} m)'
            )

    def _publish(self, stamp: Time, tick: Tick) -> None:
        if tick.v_x is not None:
            self._sent.append((stamp.sec, stamp.nanosec, tick.v_x, tick.v_y))
        for topic, fields in self._steps.outputs((stamp.sec, stamp.nanosec), tick):
            publish(self._outputs[topic], fields)

    def _stop(self) -> None:
        """Publish a last zero command and state, and wait until the finger has the command."""
        if self._timer is None:
            return
        self.destroy_timer(self._timer)
        self._timer = None
        self._counted = self._counts()
        self._tick = None
        self._place.serve(None)
        self._publish(self.get_clock().now().to_msg(), self._steps.deactivate())
        self._outputs[COMMAND].wait_for_all_acked(Duration(seconds=0.1))

    def _counts(self) -> Counter[str]:
        counts = self._counted.copy()
        if self._tick is not None:  # which counts since activation
            counts.update({'ticks': self._tick.ticks, 'ticks lost': self._tick.ticks_lost})
        return counts

    def _health(self) -> Health:
        if self._timer is None:
            return Health(OK, 'inactive')
        tick = self._tick
        if tick is None:
            return Health(WARN, 'active, no tick yet')
        outlook = self._steps.outlook
        values: dict[str, object] = {
            'theta [rad]': tick.theta,
            'theta_desired [rad]': self._control.law.aim,
            'trim [rad]': tick.trim,
            'phi [rad]': tick.phi,
            'v_x [m/s]': tick.v_x,
            'v_y [m/s]': tick.v_y,
            'since last contact [s]': tick.silence,
            'finger x [m]': tick.finger_x,
            'drift grows by e in [s]': outlook.e_fold,
            'drift [m/s]': outlook.drift,
            'workspace lasts [s]': outlook.lasts,
            'phi saturated': tick.saturated,
            'velocity limited': tick.limited,
        }
        placing = self._steps.placing
        if placing is not None:
            values |= placing.told
            if tick.stop_reason == NOTHING_TO_DO:
                level = ERROR if placing.stage in FAILURES else OK
                return Health(level, f'{tick.stop_reason}: {placing.stage}', values)
        trouble = ''
        if tick.state == WAITING or tick.stop_reason == FINGER_UNKNOWN:
            trouble = self._steps.trouble
        if tick.state == STOPPED:
            hint = f': {trouble}; {NO_LIMIT}' if trouble else ''
            return Health(ERROR, _words(tick) + hint, values)
        if time.monotonic() - self._ticked_at > STANDSTILL + self._control.period:
            return Health(WARN, f'{_words(tick)}, but time stands still', values)
        others = self.count_publishers(COMMAND) - 1
        values[f'other publishers of {COMMAND}'] = others
        if outlook.soon:
            words = f'{_words(tick)}, but drifts to the end of the workspace'
            return Health(WARN, words, values)
        if trouble:
            return Health(WARN, f'{_words(tick)}, but {trouble}', values)
        rates = self._diagnostics.rates
        lately = rates['ticks lost'] + rates['commands of another node']
        at_bounds = placing is None and (tick.saturated or tick.limited)  # else as planned
        if placing is not None and placing.stage == NO_GOAL:
            return Health(OK, 'waiting for a goal', values)
        if placing is not None and placing.doubt:
            return Health(WARN, f'{_words(tick)}, but {placing.doubt}', values)
        if tick.state == WAITING or at_bounds or lately or others > 0:
            return Health(WARN, _words(tick), values)
        return Health(OK, _words(tick), values)


def _words(tick: Tick) -> str:
    if tick.state != STOPPED:
        return tick.state
    hint = ', until resumed' if tick.stop_reason in HELD else ''
    return f'{tick.state}: {tick.stop_reason}{hint}'


def main() -> int:
    """Run the node as a process."""
    return run(PushController)


if __name__ == '__main__':
    sys.exit(main())
