# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Conducts an experiment: starts the controller once all is recorded, and ends after N steps.

It may give goals to place objects at, and then ends after the last one.
"""

import sys
import time
from contextlib import ExitStack

from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import JointState

from tactile_push.bags import BagWriter
from tactile_push.interface import (
    CLOCK,
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    LIVE_PAGE,
    PARAMETER_EVENTS,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    RECORDED,
    SENSING_STATE,
    SERVO_COMMANDS,
    SERVO_STATE,
    WRENCH,
)
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.parameters import ConfigurationError, declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.parameters import ExperimentParameters
from tactile_push.parameters.experiment import goals
from tactile_push.pipeline import by_name
from tactile_push.pipeline.goals import GoalsInTurn
from tactile_push.pipeline.messages import place_goal_fields
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.recording.recording import Recording

# Of nodes and laws that not every experiment has.
MORE = (WRENCH, SERVO_COMMANDS, SERVO_STATE, PLACE_GOAL, PLACE_STATE, PLACE_RELEASE)
# Without these recorded from the beginning no experiment starts.
AWAITED = tuple(topic for topic in RECORDED if topic not in (CLOCK, PARAMETER_EVENTS, *MORE))
# That this node sees who hears the controller does not say that the controller sees them, too: on a
# busy machine active_sensing could miss the first control periods. Picked: on one machine nodes
# find each other within it [s].
SETTLED = 1.0
AFTERWARDS = 10  # steps that are recorded after the last goal: how the object lies; picked
LOOK_PERIOD = 0.05  # at the recorder and the answers [s]; short beside the start of a node


class Experiment(Node):
    """Node: manages `push_controller` and records the package's topics in a run.

    It prints the number of steps done, a line at a time, for whoever shows the progress.
    """

    NAME = 'experiment'

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, ExperimentParameters)
        if not self._settings.bag:
            raise ConfigurationError("parameter bag: expected a new folder, got ''")
        with refusing():
            self._goals = GoalsInTurn(goals(self._settings))
        with refusing('bag'):
            writer = BagWriter(self._settings.bag)
        self._recording = Recording(self, RECORDED, writer)
        self._awaited = {self.resolve_topic_name(topic) for topic in AWAITED}
        self._controller = self.create_client(ChangeState, 'push_controller/change_state')
        self._transitions = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]
        self._answer: Future | None = None
        self._steps = 0
        self._last_step = self._settings.steps
        self._ready_at: float | None = None  # from when on, by a clock that cannot be set [s]
        self._gives = False  # whether a goal was given
        if not self._goals.done:
            self._goal = self.create_publisher(PoseStamped, PLACE_GOAL, PUBLISHED)
            self.create_subscription(JointState, PLACE_STATE, self._on_place_state, PUBLISHED)
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(LOOK_PERIOD, self._look, clock=steady_clock)

    def destroy_node(self) -> None:
        """Finish the bag and end."""
        with ExitStack() as stack:
            stack.callback(super().destroy_node)
            self._recording.close()

    def _look(self) -> None:
        if self._answer is not None and self._answer.done():
            self._conclude_transition()
        elif self._transitions:
            self._advance_transition()
        else:
            self._report()

    def _advance_transition(self) -> None:
        activating = self._transitions[0] != Transition.TRANSITION_CONFIGURE
        if activating and not self._settled(self._ready()):
            return
        if self._answer is None and self._controller.service_is_ready():
            request = ChangeState.Request(transition=Transition(id=self._transitions[0]))
            self._answer = self._controller.call_async(request)

    def _conclude_transition(self) -> None:
        assert self._answer is not None
        if not self._answer.result().success:
            self.get_logger().error('push_controller refused to start')
            self.context.shutdown()
        self._answer = None
        self._ready_at = None
        self._transitions.pop(0)

    def _on_place_state(self, message: JointState) -> None:
        heard = map(self._somebody_takes, (PLACE_GOAL, PLACE_RELEASE, SENSING_STATE))
        if self._transitions or not (self._gives or self._settled(all(heard))):
            return
        goal = self._goals.state(by_name(message.name, message.position))
        if goal is not None:
            self._gives = True
            publish(self._goal, place_goal_fields(stamp_of(message), *goal))
        elif self._goals.done:
            self._last_step = min(self._last_step, self._steps + AFTERWARDS)

    def _settled(self, ready: bool) -> bool:
        """Return whether all has been ready for so long that the nodes have found each other."""
        now = time.monotonic()
        if not ready:
            self._ready_at = None
        elif self._ready_at is None:
            self._ready_at = now
        return self._ready_at is not None and now - self._ready_at >= SETTLED

    def _ready(self) -> bool:
        """Return whether all is recorded, and somebody else hears contacts and control periods."""
        contact = self.resolve_topic_name(CONTACT)
        return (
            (self._awaited | self._more()).isdisjoint(self._recording.recorder.missing())
            and self._recording.recorder.counts[contact] > 0
            and self._somebody_takes(CONTACT)
            and self._somebody_takes(CONTROLLER_STATE)
        )

    def _more(self) -> set[str]:
        """Return the topics of nodes that not every experiment has and this one does."""
        return {self.resolve_topic_name(topic) for topic in MORE if self.count_publishers(topic)}

    def _somebody_takes(self, topic: str) -> bool:
        """Return whether somebody hears a topic who does something with it."""
        hearers = self.get_subscriptions_info_by_topic(self.resolve_topic_name(topic))
        return not {hearer.node_name for hearer in hearers} <= {self.get_name(), LIVE_PAGE}

    def _report(self) -> None:
        # What is sensed comes last; on a loaded machine it may lag behind.
        counts = self._recording.recorder.counts
        steps = min(counts[self.resolve_topic_name(topic)] for topic in (COMMAND, SENSING_STATE))
        if steps != self._steps:
            self._steps = steps
            print(steps, flush=True)
        if steps > self._last_step:
            self.context.shutdown()


def main() -> int:
    """Run the node as a process."""
    return run(Experiment)


if __name__ == '__main__':
    sys.exit(main())
