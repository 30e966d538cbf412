# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The way of a topic from the plant to the nodes, on which its messages can be spoiled."""

import time
from collections import deque
from collections.abc import Callable
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from .observer import FaultObserver

LOOK_PERIOD = 0.01  # [s]


class Relay:
    """Takes messages from one topic and gives them to the one that the nodes hear.

    Parameters
    ----------
    observer : FaultObserver
        Its node does it.
    message_type : type
        Of the messages.
    topic : str
        The full name under which the nodes hear it.

    Attributes
    ----------
    source : str
        The topic to publish to.
    alter : callable
        What becomes of a message; None if it gets lost.
    delay : float
        How late a message arrives [s].
    """

    def __init__(self, observer: FaultObserver, message_type: type, topic: str) -> None:
        self.source = f'{topic}_of_the_plant'
        self._waiting: deque[tuple[float, Any]] = deque()
        self._publisher = observer.node.create_publisher(message_type, topic, 10)
        observer.node.create_subscription(message_type, self.source, self._take, 100)
        observer.node.create_timer(
            LOOK_PERIOD, self._give, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self.mend()

    def mend(self) -> None:
        """Pass everything on at once."""
        self.alter: Callable[[Any], Any] = lambda message: message
        self.delay = 0.0

    def _take(self, message: Any) -> None:
        altered = self.alter(message)
        if altered is not None:
            self._waiting.append((time.monotonic() + self.delay, altered))
        self._give()

    def _give(self) -> None:
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            self._publisher.publish(self._waiting.popleft()[1])
