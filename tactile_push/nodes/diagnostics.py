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
"""What a node says of itself on /diagnostics: once a second, and at once on a change of level."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


@dataclass(frozen=True)
class Health:
    """A node's health at one moment.

    Parameters
    ----------
    level : bytes
        `OK`, `WARN` or `ERROR`.
    message : str
        The state in a few words.
    values : mapping of str to object, optional
        Details.
    """

    level: bytes
    message: str
    values: Mapping[str, object] = field(default_factory=dict)


class Diagnostics:
    """Publishes a node's health.

    Parameters
    ----------
    node : Node
        The node.
    health : callable
        Gives its present health.
    """

    def __init__(self, node: Node, health: Callable[[], Health]) -> None:
        self._node = node
        self._health = health
        self._level: bytes | None = None
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', 10)
        node.create_timer(1.0, self.publish, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def update(self) -> None:
        """Publish at once if the level is another than last time."""
        if self._health().level != self._level:
            self.publish()

    def publish(self) -> None:
        """Publish the present health."""
        health = self._health()
        self._level = health.level
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.status = [
            DiagnosticStatus(
                level=health.level,
                name=self._node.get_fully_qualified_name().lstrip('/'),
                message=health.message,
                hardware_id='tactile_push',
                values=[
                    KeyValue(key=key, value=str(value)) for key, value in health.values.items()
                ],
            )
        ]
        self._publisher.publish(message)
