# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The way of the joint states from the plant to the nodes, on which they can be spoiled."""

import time
from collections import deque
from collections.abc import Callable

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from sensor_msgs.msg import JointState

from .observer import FaultObserver

LOOK_PERIOD = 0.01  # [s]


class JointRelay:
    """Takes joint states from one topic and gives them to the one that the nodes hear.

    Parameters
    ----------
    observer : FaultObserver
        Its node does it.
    namespace : str
        Of the finger.

    Attributes
    ----------
    source : str
        The topic to publish to.
    alter : callable
        What becomes of a message; None if it gets lost.
    delay : float
        How late a message arrives [s].
    """

    def __init__(self, observer: FaultObserver, namespace: str) -> None:
        prefix = f'/{namespace}' if namespace else ''
        self.source = f'{prefix}/finger/joint_states'
        self._waiting: deque[tuple[float, JointState]] = deque()
        self._publisher = observer.node.create_publisher(JointState, f'{prefix}/joint_states', 10)
        observer.node.create_subscription(JointState, self.source, self._take, 100)
        observer.node.create_timer(
            LOOK_PERIOD, self._give, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self.mend()

    def mend(self) -> None:
        """Pass everything on at once."""
        self.alter: Callable[[JointState], JointState | None] = lambda message: message
        self.delay = 0.0

    def _take(self, message: JointState) -> None:
        altered = self.alter(message)
        if altered is not None:
            self._waiting.append((time.monotonic() + self.delay, altered))
        self._give()

    def _give(self) -> None:
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            self._publisher.publish(self._waiting.popleft()[1])
