# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the tactile sensor's sentences from a device and publishes them."""

import math
import sys
import threading

from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.time import Time
from sensor_msgs.msg import JointState

from tactile_push.devices.device import check_url
from tactile_push.devices.reader import Condition, SensorReader
from tactile_push.interface import TACTILE, TOPICS
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.parameters import SensorDriverParameters
from tactile_push.tactile import Reading


class SensorDriver(ManagedNode):
    """Managed node: device bytes in, `tactile` out."""

    NAME = 'sensor_driver'

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, SensorDriverParameters, self._take_parameters)
        with refusing('device'):
            check_url(self._settings.device)
        none = [math.nan] * 3
        names = list(TOPICS[TACTILE].field_names[:3])  # sentences tell no tangential force
        self._message = JointState(name=names, position=none, velocity=none, effort=none)
        self._readings = 0
        self._unstamped = 0
        self._reader = SensorReader(
            self._settings.device,
            self._settings.baud_rate,
            clock=lambda: self.get_clock().now().nanoseconds,
            hear=self._publish,
            change=self._log_change,
        )
        self._diagnostics = Diagnostics(self, self._health, self._counts)
        if self._settings.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the publisher."""
        self._publisher = self.make_publisher(JointState, TACTILE)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to read the device."""
        result = super().on_activate(state)
        self._reader.start()
        return result

    def _stop(self) -> None:
        """Let go of the device."""
        self._reader.stop()

    def _take_parameters(self, settings: SensorDriverParameters) -> None:
        self._settings = settings

    def _publish(self, readings: list[Reading], stamp: int) -> None:
        """Publish the readings of one read; stamps grow by 1 ns up to the time of the read."""
        first = stamp - len(readings) + 1
        if first <= 0:
            self._unstamped += len(readings)
            return  # simulated time has not begun, so there is no stamp
        message = self._message
        for nanoseconds, reading in enumerate(readings, first):
            message.header.stamp = Time(nanoseconds=nanoseconds).to_msg()
            message.position[0], message.position[1] = reading.azimuth, reading.elevation
            message.effort[2] = reading.normal_force
            self._publisher.publish(message)
        self._readings += len(readings)

    def _log_change(self, problem: str) -> None:
        device = self._settings.device
        if problem:
            self.get_logger().warning(f'{device}: {problem}; trying again')
        else:
            self.get_logger().info(f'reading {device}')

    def _counts(self) -> dict[str, int]:
        stream = self._reader.stream
        return {
            'bytes': self._reader.bytes_read,
            'readings': self._readings,
            'connections': self._reader.connections,
            'reconnects': self._reader.reconnects,
            'lost': stream.lost,
            'repeated': stream.repeated,
            'late': stream.late,
            'unstamped': self._unstamped,
            'sensor restarts': stream.restarts,
            **{f'dropped: {reason}': count for reason, count in stream.dropped.copy().items()},
        }

    def _health(self) -> Health:
        condition = self._reader.condition(self._settings.silence_timeout)
        values = {
            'device': self._settings.device,
            'problem': self._reader.problem,
            'age of last reading [s]': f'{self._reader.age():.3f}',
        }
        if condition == Condition.INACTIVE:
            return Health(OK, condition.value, values)
        if condition != Condition.READING:
            waits = condition == Condition.NO_BYTES and self._settings.device.startswith('socket:')
            hint = '; sim_plant sends none while it compiles' if waits else ''
            return Health(ERROR, condition.value + hint, values)
        rates = self._diagnostics.rates
        for message, slips in (
            ('no simulated time yet', ['unstamped']),
            ('readings late', ['late']),
            ('readings lost', ['lost']),
            ('sentences repeated', ['repeated']),
            ('sentences dropped', [name for name in rates if name.startswith('dropped: ')]),
        ):
            if any(rates[name] for name in slips):
                return Health(WARN, message, values)
        return Health(OK, condition.value, values)


def main() -> int:
    """Run the node as a process."""
    threading.excepthook = _report
    return run(SensorDriver)


def _report(thread: threading.ExceptHookArgs) -> None:
    """Report what ends a thread, unless it is pyserial's, whose port then says that it ended.

    Bytes that are no proper Telnet end the thread of rfc2217://.
    """
    if thread.thread is None or not thread.thread.name.startswith('pySerial'):
        threading.__excepthook__(thread)


if __name__ == '__main__':
    sys.exit(main())
