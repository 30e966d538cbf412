# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of laws with goals: goals and estimates in, the word to let go at its moment."""

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.publisher import Publisher
from rclpy.time import Time as NodeTime
from rclpy.timer import Timer
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

from tactile_push.control.placing import ENDS
from tactile_push.control.placing.stages import REGRASPING, RELEASED
from tactile_push.interface import CANCEL, PLACE_GOAL, PLACE_RELEASE, PLACE_STATE, SENSING_STATE
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.pipeline.stamps import stamp_of

if TYPE_CHECKING:
    from tactile_push.pipeline.believing import Believing

# For so long of wall time simulated time waits for an estimate [s]: shorter than the plant waits
# for a command, and longer than active_sensing takes on a busy machine; picked.
ESTIMATE_PATIENCE = 0.2
INACTIVE = 'inactive'
FINE = {RELEASED, REGRASPING}  # stages that are told without a warning
TOLD = ENDS | FINE


class PlaceTopics:
    """Tells `Believing` what goals and estimates arrive, and the finger when to let go.

    Parameters
    ----------
    node : ManagedNode
        The controller's node.
    arrived : callable
        Called when an estimate has arrived that simulated time may wait for.
    """

    def __init__(self, node: ManagedNode, arrived: Callable[[], object]) -> None:
        self._node = node
        self._arrived = arrived
        self._placing: Believing | None = None
        self._release: Publisher | None = None
        self._timer: Timer | None = None  # until the moment to let go
        self._waiting: Timer | None = None  # for an estimate, no longer than its patience
        self._since = math.nan  # it waits, by a clock that cannot be set [s]
        self._answers = True  # active_sensing
        self._stage = self._doubt = ''
        node.create_service(Trigger, CANCEL, self._on_cancel)

    def make(self) -> Publisher:
        """Take goals and estimates, until the node is cleaned up; return who says of goals."""
        self._node.make_subscription(PoseStamped, PLACE_GOAL, self._on_goal, PUBLISHED)
        self._node.make_subscription(JointState, SENSING_STATE, self._on_estimate, PUBLISHED)
        return self._node.make_publisher(JointState, PLACE_STATE)

    def make_release(self) -> Publisher:
        """Return who says when to let go, until the node is cleaned up."""
        self._release = self._node.make_publisher(Bool, PLACE_RELEASE)
        return self._release

    def serve(self, placing: 'Believing | None') -> None:
        """Let somebody else take goals; None for nobody, as while the node is inactive."""
        self._placing = placing
        self._answers = True
        self._stage = self._doubt = ''
        self._end_timers()

    def waits(self) -> bool:
        """Return whether simulated time should wait for an estimate that is on its way."""
        placing = self._placing
        if placing is None or not (self._answers and placing.awaits_estimate):
            self._end_waiting()
            return False
        now = time.monotonic()
        if self._waiting is None:
            steady = Clock(clock_type=ClockType.STEADY_TIME)
            self._since = now
            self._waiting = self._node.create_timer(ESTIMATE_PATIENCE, self._arrived, clock=steady)
        self._answers = now - self._since < ESTIMATE_PATIENCE
        if not self._answers:
            self._end_waiting()
        return self._answers

    def before_tick(self) -> None:
        """Let go at once if that was to happen before this tick."""
        self._end_waiting()
        if self._timer is not None:
            self._let_go()

    def after_tick(self, stamp: Time) -> None:
        """Wait for the moment to let go, if it is in this period, and say what has changed."""
        placing = self._placing
        if placing is None:
            return
        if math.isfinite(placing.let_go_in):
            due = NodeTime.from_msg(stamp).nanoseconds + round(1e9 * placing.let_go_in)
            clock = self._node.get_clock()
            left = (due - clock.now().nanoseconds) * 1e-9
            self._timer = self._node.create_timer(max(left, 0.0), self._let_go, clock=clock)
        placing.look_ahead()
        self._tell(placing)

    def stop(self) -> None:
        """Let nothing go any more."""
        self._end_timers()

    def _on_goal(self, message: PoseStamped) -> None:
        turn = message.pose.orientation
        rotation = (turn.x, turn.y, turn.z, turn.w)
        frame, x = message.header.frame_id, message.pose.position.x
        refusal = INACTIVE
        if self._placing is not None:
            refusal = self._placing.goal(frame, x, rotation)
        said = f'x {x:g} m, theta {math.degrees(yaw_of_quaternion(*rotation)):.1f} degrees'
        logger = self._node.get_logger()
        if refusal:
            logger.warning(f'{PLACE_GOAL}: refused ({said}): {refusal}')
            return
        self._forget_release()
        logger.info(f'{PLACE_GOAL}: {said}')

    def _on_estimate(self, message: JointState) -> None:
        if self._placing is None:
            return
        self._placing.sensed(stamp_of(message), message.name, message.position)
        self._answers = True
        if self._waiting is not None:
            self._arrived()

    def _on_cancel(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        stage = INACTIVE if self._placing is None else self._placing.stage
        response.success = self._placing is not None and self._placing.cancel()
        response.message = f'was {stage}' if response.success else stage
        if response.success:
            self._forget_release()
        return response

    def _let_go(self) -> None:
        """Say that the object is to be let go, if that still holds."""
        self._forget_release()
        if self._placing is not None and self._placing.release():
            assert self._release is not None
            self._release.publish(Bool(data=True))

    def _tell(self, placing: 'Believing') -> None:
        """Say once what has become of the goal, and what is doubtful about it."""
        logger, doubt = self._node.get_logger(), placing.doubt
        if doubt and doubt != self._doubt:
            logger.warning(f'{PLACE_GOAL}: {doubt}')
        if placing.stage != self._stage and placing.stage in TOLD:
            # In two lines of code: rclpy raises an error where one logs at two levels.
            if placing.stage in FINE:
                logger.info(f'{PLACE_GOAL}: {placing.stage}')
            else:
                logger.warning(f'{PLACE_GOAL}: {placing.stage}')
        self._doubt, self._stage = doubt, placing.stage

    def _forget_release(self) -> None:
        if self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None

    def _end_waiting(self) -> None:
        if self._waiting is not None:
            self._node.destroy_timer(self._waiting)
            self._waiting = None

    def _end_timers(self) -> None:
        self._forget_release()
        self._end_waiting()
