# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Reports a node's health on /diagnostics: once a second, and at once when its level changes."""

import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node

from tactile_push.interface import DIAGNOSTICS

# By REP-107: all is well; something to look at, the work goes on; the work has stopped.
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
PERIOD = 1.0  # between reports [s], as is usual for /diagnostics
LOOKS = 10  # at the level, a report: an error is told within 0.1 s


@dataclass(frozen=True)
class Health:
    """A node's health: `OK`, `WARN` or `ERROR`, the state in a few words, and details."""

    level: bytes
    message: str
    values: Mapping[str, object] = field(default_factory=dict)


class Diagnostics:
    """Publishes what `health` returns, with what `counts` returns and the rates of these counts.

    An error that a report finds is logged once, and so is its end. `rates` has how often each
    counted thing happened in the second before the last report [1/s]; 0 for unknown names.
    """

    def __init__(
        self,
        node: Node,
        health: Callable[[], Health],
        counts: Callable[[], Mapping[str, int]] = dict,
    ) -> None:
        self._node = node
        self._health = health
        self._counts = counts
        self.rates: defaultdict[str, float] = defaultdict(float)
        self._counted: Mapping[str, int] = {}
        self._counted_at = time.monotonic()
        self._looks = 0
        self._level: bytes | None = None
        self._error_logged = False
        self._message = ''
        self._since = self._counted_at
        self._publisher = node.create_publisher(DiagnosticArray, DIAGNOSTICS, 10)
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(PERIOD / LOOKS, self._on_timer, clock=steady_clock)

    def announce(self, health: Health) -> None:
        """Publish a health that the node has before its callbacks run."""
        self._note(health)
        self._publish(health)

    def update(self) -> None:
        """Publish at once if the level has changed."""
        health = self._look()
        if health.level != self._level:
            self._publish(health)

    def report(self) -> None:
        """Compute the rates anew and publish the present health."""
        now, counts = time.monotonic(), dict(self._counts())
        elapsed = now - self._counted_at
        self.rates.clear()
        for name, count in counts.items():
            self.rates[name] = (count - self._counted.get(name, 0)) / elapsed
        self._counted, self._counted_at = counts, now
        health = self._look()
        self._publish(health)
        self._log(health)

    def _log(self, health: Health) -> None:
        is_error = health.level == ERROR
        if is_error and not self._error_logged:
            self._node.get_logger().error(health.message)
        elif self._error_logged and not is_error:
            self._node.get_logger().info(health.message)
        self._error_logged = is_error

    def _on_timer(self) -> None:
        self._looks += 1
        if self._looks % LOOKS:
            self.update()
        else:
            self.report()

    def _look(self) -> Health:
        health = self._health()
        self._note(health)
        return health

    def _note(self, health: Health) -> None:
        if health.message != self._message:
            self._message, self._since = health.message, time.monotonic()

    def _publish(self, health: Health) -> None:
        self._level = health.level
        values = {
            **health.values,
            'time in state [s]': f'{time.monotonic() - self._since:.1f}',
            **self._counts(),
            **{f'{name} [1/s]': f'{rate:.1f}' for name, rate in self.rates.items()},
        }
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.status = [
            DiagnosticStatus(
                level=health.level,
                name=self._node.get_fully_qualified_name().lstrip('/'),
                message=health.message,
                hardware_id='tactile_push',
                values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
            )
        ]
        self._publisher.publish(message)
