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
"""The device that the sensor's bytes come from: anything that pyserial opens by URL."""

import io
import select
from urllib.parse import urlsplit

import serial


class Device:
    """An open serial port, pseudo terminal or TCP connection to read from.

    Parameters
    ----------
    url : str
        What `serial.serial_for_url` takes: a path such as /dev/ttyUSB0, socket://host:port, …
    baud_rate : int
        Bits per second of a serial line; other devices ignore it.

    Raises
    ------
    ValueError
        If the URL is of no kind that pyserial knows.
    OSError
        If the device is not there or refuses.
    """

    LONGEST_WAIT = 0.05  # [s]

    def __init__(self, url: str, baud_rate: int) -> None:
        self._port = serial.serial_for_url(url, baudrate=baud_rate, timeout=0)
        try:
            self._file = self._port.fileno()
        except (AttributeError, io.UnsupportedOperation):
            self._file = None
            self._port.timeout = self.LONGEST_WAIT

    def read(self) -> bytes:
        """Wait a moment for bytes and take all that are there.

        Returns
        -------
        bytes
            What came, b'' if nothing did.

        Raises
        ------
        OSError
            If the device is gone.
        """
        if self._file is None:
            return self._port.read(max(1, self._port.in_waiting))
        ready, _, _ = select.select([self._file], [], [], self.LONGEST_WAIT)
        return self._port.read(4096) if ready else b''

    def close(self) -> None:
        """Close the device."""
        self._port.close()


def check_url(url: str) -> None:
    """Refuse a URL that no device can be opened by, whether it is there or not.

    Parameters
    ----------
    url : str
        What `serial.serial_for_url` takes.

    Raises
    ------
    ValueError
        If the URL is of no kind that pyserial knows.
    """
    serial.serial_for_url(url, do_not_open=True)
    if urlsplit(url).scheme == 'socket':
        socket_address(url)


def socket_address(url: str) -> tuple[str, int]:
    """Give the address in a URL of the form socket://host:port.

    Parameters
    ----------
    url : str
        The URL.

    Returns
    -------
    host : str
        Name or address.
    port : int
        0 to 65535.

    Raises
    ------
    ValueError
        If the URL is not of this form.
    """
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not host or port is None:
        raise ValueError(f'expected socket://host:port, got {url!r}')
    return host, port
