# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A managed node that finds the contact in what another sensor in the finger tip measures."""

import time
from abc import abstractmethod
from collections import Counter
from collections.abc import Iterator
from typing import Any, Generic, Protocol, TypeVar

from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from tactile_push.interface import TACTILE
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.parameters.camera_sensor import CameraSensorParameters
from tactile_push.parameters.wrench_sensor import WrenchSensorParameters
from tactile_push.pipeline import Output
from tactile_push.tactile import NotUntouchedError, Reading

P = TypeVar('P', WrenchSensorParameters, CameraSensorParameters)

PATIENCE = 0.3  # of refused messages alone until it is an error [s]: the finger has stopped by then


class Told(Protocol):
    """What a message tells."""

    @property
    def reading(self) -> Reading:
        """The contact, or none."""
        ...


class Came(Protocol):
    """What came of one message."""

    @property
    def told(self) -> Told | None:
        """What it tells; None if it was refused, or tells nothing yet."""
        ...

    @property
    def refusal(self) -> str:
        """Why it was refused; empty if it was not."""
        ...

    def outputs(self) -> Iterator[Output]:
        """Yield the reading, if there is one."""
        ...


class TipSensor(ManagedNode, Generic[P]):
    """Managed node: what a sensor measures in, `tactile` out.

    The node has to know what the sensor measures while nothing touches the tip; a service takes the
    present for that. The node reports an error when no message came for `silence_timeout`, while it
    does not know the untouched tip, and when it refused all messages for `PATIENCE`. It warns while
    it refuses some.
    """

    NAME: str
    MESSAGES: str  # what they are called
    SERVICE: str  # takes the present for the untouched tip
    TAKEN, NOT_TAKEN = '', ''  # what it logs
    _settings: P
    _topic: str

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._time = NodeTime(self)
        self._is_active = False
        self._counted: Counter[str] = Counter({self.MESSAGES: 0, 'readings': 0})
        self._forget()

    def _begin(self) -> None:
        """Offer the service and diagnostics, and start without a manager if that is wanted."""
        self.create_service(Trigger, self.SERVICE, self._on_untouched)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)
        if self._settings.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics, and forget the untouched tip."""
        self._forget()
        self._forget_untouched()
        self._publisher = self.make_publisher(JointState, TACTILE)
        self._subscribe()
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to listen."""
        result = super().on_activate(state)
        self._heard = self._useful = time.monotonic()
        self._is_active = True
        return result

    def _stop(self) -> None:
        """Stop to listen."""
        self._is_active = False

    def _forget(self) -> None:
        # When the last message came, and the last useful one, by a clock that cannot be set [s].
        self._heard = self._useful = time.monotonic()
        self._refusal = ''  # why the last refused message was refused
        self._told: Told | None = None  # by the last useful message

    @abstractmethod
    def _forget_untouched(self) -> None:
        """Forget what was measured so far, and the untouched tip."""

    @abstractmethod
    def _subscribe(self) -> None:
        """Subscribe to what the sensor measures, by `_on_message`."""

    @abstractmethod
    def _came_of(self, message: Any) -> Came:
        """Return what came of a message."""

    @abstractmethod
    def _take_untouched(self) -> None:
        """Take the present for the untouched tip; NotUntouchedError if it is not."""

    @abstractmethod
    def _ignorance(self) -> str:
        """Return why the node does not know the untouched tip, or nothing if it does."""

    @abstractmethod
    def _values(self) -> dict[str, object]:
        """Return details for the diagnostics."""

    def _advice(self) -> str:
        """Return what to look at when all messages are refused for the last reason."""
        return ''

    def _doubt(self) -> str:
        """Return what there is to look at while messages are used, or nothing."""
        return ''

    def _on_message(self, message: Any) -> None:
        if not self._is_active:
            return
        self._counted[self.MESSAGES] += 1
        now = time.monotonic()
        if now - self._heard > PATIENCE:
            self._useful = now  # after a silence patience starts over
        self._heard = now
        came = self._came_of(message)
        if came.refusal:
            self._counted[f'refused: {came.refusal}'] += 1
            self._refusal = came.refusal
        else:
            self._useful = now
            self._told = came.told or self._told
        for _, fields in came.outputs():
            self._counted['readings'] += 1
            self._publisher.publish(filled(JointState(), fields))

    def _on_untouched(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        try:
            if not self._is_active:
                raise NotUntouchedError('the node is not active')
            if time.monotonic() - self._heard > self._settings.silence_timeout:
                raise NotUntouchedError(f'no {self.MESSAGES} on {self._topic}')
            self._take_untouched()
        except NotUntouchedError as reason:
            response.success, response.message = False, str(reason)
            self.get_logger().warning(f'{self.NOT_TAKEN}: {reason}')
        else:
            response.success, response.message = True, ''
            self.get_logger().info(self.TAKEN)
        return response

    def _health(self) -> Health:
        level, message = self._judgement()
        return Health(level, message, self._values())

    def _judgement(self) -> tuple[bytes, str]:
        now = time.monotonic()
        if not self._is_active:
            return OK, 'inactive'
        if now - self._heard > self._settings.silence_timeout:
            return ERROR, f'no {self.MESSAGES} on {self._topic}'
        if ignorance := self._ignorance():
            return ERROR, f'{ignorance}: lift the finger and call {self.SERVICE}'
        if now - self._useful > PATIENCE:
            return ERROR, f'{self.MESSAGES} refused: {self._refusal}{self._advice()}'
        if doubt := self._doubt():
            return WARN, doubt
        if self._told is None:
            return WARN, 'no reading yet'
        feels = 'contact' if self._told.reading.in_contact else 'no contact'
        rates = self._diagnostics.rates
        if any(rate for name, rate in rates.items() if name.startswith('refused: ')):
            return WARN, f'{feels}, some {self.MESSAGES} refused'
        return OK, feels
