# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Shows what the nodes say on a page for browsers."""

import json
import os
import sys
import time
from array import array
from functools import partial
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from sensor_msgs.msg import JointState

from tactile_push.interface import (
    CONTROLLER_STATE,
    DIAGNOSTICS,
    JOINT_STATE_TYPE,
    LIVE_PAGE,
    POSE_TYPE,
    SENSING_STATE,
    TOPICS,
    UNCERTAIN_POSE_TYPE,
)
from tactile_push.needs_aiohttp import aiohttp_is_missing
from tactile_push.nodes.ros.diagnostics import OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import FRESHEST, SENSOR_DATA
from tactile_push.parameters import LivePageParameters
from tactile_push.recording.parameter_notes import ParameterNotes
from tactile_push.report.columns import pose, positions
from tactile_push.report.labels import status_label
from tactile_push.report.scene import scene_content
from tactile_push.watching.live import RATE, TAKEN, Live
from tactile_push.watching.page import live_page
from tactile_push.watching.scene import known_scene

TYPES = {
    JOINT_STATE_TYPE: JointState,
    POSE_TYPE: PoseStamped,
    UNCERTAIN_POSE_TYPE: PoseWithCovarianceStamped,
}
FIELDS = {topic: frozenset(TOPICS[topic].field_names) for topic in TAKEN}
EVERY_MESSAGE = (CONTROLLER_STATE, SENSING_STATE)  # of which one may tell of a stop
MOST_TAKEN = 100  # messages of a topic at once, so that nobody can hold up the page; picked
NICENESS = 10  # the machine serves the nodes that push first; picked
PATIENCE = 2.0  # without a word from the nodes for longer it warns [s]; picked


class LivePage(Node):
    """Node: topics in, a page out.

    It takes no part in what it shows: nobody waits for it, and it asks for no message twice.
    """

    NAME = LIVE_PAGE

    def __init__(self) -> None:
        from tactile_push.watching.server import Server  # which needs aiohttp

        super().__init__(self.NAME)
        p = declare(self, LivePageParameters)
        self._began = time.monotonic()
        self._live = Live(p.history)
        with refusing('host, port'):
            self._server = Server(
                *(p.host, p.port),
                *live_page(self.get_namespace()),
                lambda: _written(self._live.hello()),
            )
        self.get_logger().info(f'showing the nodes on {self._server.address}')
        self._told_scene: dict[str, object] = {}
        self._told_events = -1
        polled = Polled()
        for topic in TAKEN:
            kind, qos = TYPES[TOPICS[topic].type_name], FRESHEST
            if topic in EVERY_MESSAGE:
                qos = SENSOR_DATA
            take = partial(self._on_message, topic)
            self.create_subscription(kind, topic, take, qos, callback_group=polled)
        self.create_subscription(
            *(DiagnosticArray, DIAGNOSTICS, self._on_statuses, SENSOR_DATA), callback_group=polled
        )
        self._polled = [one for one in self.subscriptions if one.callback_group is polled]
        self._on_parameters({})
        ParameterNotes(self, self._on_parameters, again=True)
        self._diagnostics = Diagnostics(self, self._health)
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(1.0 / RATE, self._on_frame, clock=steady_clock)

    def destroy_node(self) -> None:
        """Take the page off the network and end."""
        self._server.close()
        super().destroy_node()

    def _now(self) -> float:
        return time.monotonic() - self._began

    def _hear(self) -> None:
        """Take what has come since the last frame."""
        for subscription in self._polled:
            with subscription.handle:
                for _ in range(MOST_TAKEN):
                    taken = subscription.handle.take_message(subscription.msg_type, False)
                    if taken is None:
                        break
                    subscription.callback(taken[0])

    def _on_message(self, topic: str, message: Any) -> None:
        joints = isinstance(message, JointState)
        values = positions(message, FIELDS[topic]) if joints else pose(message)
        self._live.take(self._now(), topic, values)

    def _on_statuses(self, message: DiagnosticArray) -> None:
        own = self.get_fully_qualified_name().lstrip('/')
        statuses = [(one.name, status_label(one)) for one in message.status if one.name != own]
        self._live.take_statuses(self._now(), statuses)

    def _on_parameters(self, parameters: dict[str, dict[str, Any]]) -> None:
        plain = {
            node: {
                name: list(value) if isinstance(value, array) else value
                for name, value in values.items()
            }
            for node, values in parameters.items()
        }
        namespace = self.get_namespace().rstrip('/')
        scene = scene_content(known_scene(plain, namespace))
        if scene != self._told_scene:
            self._told_scene = scene
            self._server.post('scene', _written({'scene': scene}))

    def _on_frame(self) -> None:
        self._hear()
        now = self._now()
        version, events = self._live.events(now)
        if version != self._told_events:
            self._told_events = version
            self._server.post('events', _written(events))
        self._server.post('frame', _written(self._live.frame(now)))

    def _health(self) -> Health:
        values = {'address': self._server.address, 'pages': self._server.pages}
        if self._now() - self._live.heard > PATIENCE:
            return Health(WARN, 'nothing to show', values)
        return Health(OK, 'showing', values)


class Polled(ReentrantCallbackGroup):
    """Keeps the executor from subscriptions from which the node takes messages by itself."""

    def can_execute(self, entity: object) -> bool:
        """Return that the executor has nothing to do."""
        return False


def _written(content: dict[str, object]) -> str:
    return json.dumps(content, allow_nan=False, separators=(',', ':'))


def main() -> int:
    """Run the node as a process, after all those that push."""
    if aiohttp_is_missing(LIVE_PAGE):
        return 2
    os.nice(NICENESS)
    return run(LivePage)


if __name__ == '__main__':
    sys.exit(main())
