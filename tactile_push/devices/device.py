# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The device that the sensor's bytes come from: anything that pyserial opens by URL."""

import contextlib
import io
import math
import os
import select
import time
from urllib.parse import urlsplit

import serial

FD_SETSIZE = 1024  # descriptors from here on are beyond select(), with which pyserial reads


class Device:
    """An open serial port, pseudo terminal or TCP connection to read from.

    `url` is what `serial.serial_for_url` takes: a path such as /dev/ttyUSB0, socket://host:port, …
    Raise ValueError for a URL that pyserial does not know, OSError if the device is not there.
    """

    LONGEST_WAIT = 0.05  # for bytes [s]
    LONGEST_AGE = 0.1  # of bytes that are taken for fresh [s]
    SETTLING_TIME = 0.05  # in which what an outer buffer held back still comes [s]
    LONGEST_READ = 4096  # [bytes]

    def __init__(self, url: str, baud_rate: int) -> None:
        try:
            # Exclusive: a second reader of the same line would take bytes away from the first.
            self._port = serial.serial_for_url(
                url, do_not_open=True, baudrate=baud_rate, timeout=0, exclusive=True
            )
        except (OSError, ValueError):
            raise
        except Exception as error:
            raise _gone(error) from error
        try:
            self._port.open()
        except Exception as error:  # a refused baud rate is a ValueError here
            raise _gone(error) from error
        try:
            self._file = self._port.fileno()
        except (AttributeError, io.UnsupportedOperation):
            self._file = None
            self._port.timeout = self.LONGEST_WAIT
        else:
            self._arrival = select.poll()
            self._arrival.register(self._file, select.POLLIN)
        # Steady times [s]: what is read next came after the first, what was read last after the
        # second. Never yet, for what a line held before it was opened may still come.
        self._empty_at = -math.inf
        self._came_after = -math.inf
        self._fresh_from = math.inf

    def read(self) -> bytes:
        """Wait a moment for bytes and return them; raise OSError if the device is gone."""
        try:
            began = time.monotonic()
            # Not asked again when it was just read empty: a wait for bytes still fits in their age.
            if began - self._empty_at > self.LONGEST_WAIT / 2.0 and not self._bytes_are_there(0.0):
                self._note_empty(began)
            self._came_after = self._empty_at
            if self._file is None:
                began = time.monotonic()
                data = self._port.read(max(1, self._port.in_waiting))
            elif self._bytes_are_there(self.LONGEST_WAIT):
                began = time.monotonic()
                data = self._read_file(self._file)
            else:
                return b''
            if len(data) < self.LONGEST_READ:
                self._note_empty(began)
            return data
        except Exception as error:
            raise _gone(error) from error

    def fresh(self) -> bool:
        """Return whether what was last read had come no longer than `LONGEST_AGE` before now.

        Bytes came after the moment at which nothing was left to read. If that is too long ago,
        because this process stood still or could not keep up, the device has to be read empty
        first, and for `SETTLING_TIME` more is expected from buffers further out.
        """
        now = time.monotonic()
        if now - self._came_after > self.LONGEST_AGE:
            self._fresh_from = now + self.SETTLING_TIME
        return now >= self._fresh_from

    def close(self) -> None:
        """Close the device."""
        with contextlib.suppress(Exception):  # it may be gone already
            self._port.close()

    def _bytes_are_there(self, patience: float) -> bool:
        if self._file is None:
            return bool(self._port.in_waiting)
        return bool(self._arrival.poll(1000.0 * patience))

    def _read_file(self, file: int) -> bytes:
        if file < FD_SETSIZE:
            return self._port.read(self.LONGEST_READ)
        data = os.read(file, self.LONGEST_READ)
        if not data:
            raise OSError('the device is gone')
        return data

    def _note_empty(self, moment: float) -> None:
        if moment - self._empty_at > self.LONGEST_AGE:
            self._fresh_from = moment + self.SETTLING_TIME
        self._empty_at = moment


def _gone(error: Exception) -> OSError:
    """Make an OSError of what pyserial throws: termios.error, TypeError, ValueError, and more."""
    if 'out of range in select' in str(error):
        return OSError(f'pyserial opens it only with fewer than {FD_SETSIZE} files open')
    return OSError(getattr(error, 'strerror', None) or str(error) or type(error).__name__)


def check_url(url: str) -> None:
    """Raise ValueError for a URL of no kind that pyserial knows; the device may be absent."""
    if not url:
        raise ValueError("expected a path or a URL of pyserial, got ''")
    try:
        serial.serial_for_url(url, do_not_open=True)
    except OSError:
        pass  # hwgrep:// looks for its device at once, and it may come later
    except Exception as error:  # ValueError, or what a handler makes of a bad option
        raise ValueError(f'{error}') from error
    if urlsplit(url).scheme == 'socket':
        socket_address(url)


def socket_address(url: str) -> tuple[str, int]:
    """Return the address in a URL of the form socket://host:port."""
    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not host or port is None:
        raise ValueError(f'expected socket://host:port, a port up to 65535, got {url!r}')
    return host, port
