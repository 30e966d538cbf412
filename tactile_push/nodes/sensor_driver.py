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
"""Reads the tactile sensor's sentences from a device and publishes them."""

import sys
import threading

from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.time import Time
from sensor_msgs.msg import JointState

from tactile_push.nodes.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.parameters import ConfigurationError, Parameter, declare
from tactile_push.nodes.process import autostart, run
from tactile_push.tactile import Reading, SentenceStream
from tactile_push.tactile.device import Device, check_url

SHORTEST_RETRY, LONGEST_RETRY = 0.1, 2.0  # [s]


class SensorDriver(LifecycleNode):
    """Managed node: device bytes in, `tactile` out."""

    NAME = 'sensor_driver'
    PARAMETERS = (
        Parameter(
            'device',
            'socket://127.0.0.1:54320',
            '',
            'where the sensor is: /dev/ttyUSB0, a pseudo terminal, socket://host:port, or any '
            'other URL of pyserial',
            read_only=True,
        ),
        Parameter(
            'baud_rate', 115200, 'bit/s', 'speed of a serial line', 50, 4000000, read_only=True
        ),
        Parameter(
            'silence_timeout', 0.3, 's', 'without a sentence for so long is an error', 0.01, 60.0
        ),
        Parameter(
            'autostart', True, '', 'configure and activate without a manager', read_only=True
        ),
    )

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, self.PARAMETERS)
        try:
            check_url(self._settings.device)
        except ValueError as error:
            raise ConfigurationError(f'parameter device: {error}') from None
        self._stream = SentenceStream()
        self._reader: threading.Thread | None = None
        self._stopping = threading.Event()
        self._connected = False
        self._connections = 0
        self._last_sentence: Time | None = None
        self._diagnostics = Diagnostics(self, self._health, self._counts)
        if self._settings.autostart:
            autostart(self)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the publisher."""
        self._publisher = self.create_lifecycle_publisher(JointState, 'tactile', 10)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to read the device."""
        result = super().on_activate(state)
        self._stopping.clear()
        self._reader = threading.Thread(target=self._read, name='device', daemon=True)
        self._reader.start()
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Let go of the device."""
        self._stop_reading()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove the publisher."""
        self.destroy_lifecycle_publisher(self._publisher)
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Let go of the device for good."""
        self._stop_reading()
        return TransitionCallbackReturn.SUCCESS

    def destroy_node(self) -> None:
        """Let go of the device and end."""
        self._stop_reading()
        super().destroy_node()

    def _stop_reading(self) -> None:
        self._stopping.set()
        if self._reader is not None:
            self._reader.join()
            self._reader = None

    def _read(self) -> None:
        """Read the device until told to stop, and open it again whenever it goes away."""
        retry = SHORTEST_RETRY
        complaint = ''
        while not self._stopping.is_set():
            try:
                device = Device(self._settings.device, self._settings.baud_rate)
            except OSError as error:
                if str(error) != complaint:
                    complaint = str(error)
                    self.get_logger().warning(f'{error}; trying on')
                self._stopping.wait(retry)
                retry = min(2.0 * retry, LONGEST_RETRY)
                continue
            self.get_logger().info(f'reading {self._settings.device}')
            retry = SHORTEST_RETRY
            complaint = ''
            self._connections += 1
            self._connected = True
            self._stream.restart()
            try:
                while not self._stopping.is_set():
                    for reading in self._stream.feed(device.read()):
                        self._publish(reading)
            except OSError as error:
                self.get_logger().warning(f'{self._settings.device}: {error}')
                self._stopping.wait(retry)
            finally:
                self._connected = False
                device.close()

    def _publish(self, reading: Reading) -> None:
        self._last_sentence = self.get_clock().now()
        if self._last_sentence.nanoseconds == 0:
            return  # simulated time has not begun, so there is no stamp to give
        message = JointState()
        message.header.stamp = self._last_sentence.to_msg()
        message.name = ['azimuth', 'elevation', 'normal_force']
        message.position = [reading.azimuth, reading.elevation, float('nan')]
        message.velocity = [float('nan')] * 3
        message.effort = [float('nan'), float('nan'), reading.normal_force]
        self._publisher.publish(message)

    def _counts(self) -> dict[str, int]:
        stream = self._stream
        return {
            'connections': self._connections,
            'readings': stream.received - stream.repeated,
            'lost': stream.lost,
            'repeated': stream.repeated,
            'sensor restarts': stream.restarts,
            **{f'dropped: {reason}': count for reason, count in stream.dropped.copy().items()},
        }

    def _health(self) -> Health:
        values = {'device': self._settings.device}
        if self._reader is None:
            return Health(OK, 'inactive', values)
        if not self._connected:
            return Health(ERROR, 'device not there', values)
        if self._last_sentence is None:
            return Health(ERROR, 'no valid sentence yet', values)
        silence = (self.get_clock().now() - self._last_sentence).nanoseconds * 1e-9
        if silence > self._settings.silence_timeout:
            return Health(ERROR, 'sensor silent', values)
        if any(self._diagnostics.rates[f'dropped: {reason}'] for reason in self._stream.dropped):
            return Health(WARN, 'sentences dropped', values)
        return Health(OK, 'reading', values)


def main() -> int:
    """Run the node as a process."""
    return run(SensorDriver)


if __name__ == '__main__':
    sys.exit(main())
