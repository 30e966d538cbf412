# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A device between the sensor and its driver that can do what lines, plugs and sensors do."""

import contextlib
import random
import select
import socket
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from tactile_push.devices import Sentence, decode, encode
from tactile_push.devices.sentence import SentenceError
from tactile_push.tactile import Reading

RETRY = 0.02  # [s]


@dataclass(frozen=True)
class Sent:
    """A reading that went to the driver, and when, on the steady clock [s]."""

    at: float
    reading: Reading


class DeviceProxy:
    """Passes the sentences of a simulated sensor on to a driver, each with a number of its own.

    The number goes where the sensor's force would be, so that whoever hears a reading knows which
    one it is and how old.

    Parameters
    ----------
    port : int
        Of the sensor, on this machine.

    Attributes
    ----------
    alter : callable
        What becomes of a sentence before it is numbered.
    spoil : callable
        What becomes of its bytes afterwards.
    sent : dict of int to Sent
        Readings so far, by number.
    """

    def __init__(self, port: int) -> None:
        self._sensor_port = port
        self._listener = _listen(0)
        self.port = self._listener.getsockname()[1]
        self._sensor: socket.socket | None = None
        self._driver: socket.socket | None = None
        self._received = b''
        self._in_place = True
        self._closing = False
        self.sent: dict[int, Sent] = {}
        self.mend()
        self._thread = threading.Thread(target=self._run, name='device proxy', daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """Where the driver finds the device."""
        return f'socket://127.0.0.1:{self.port}'

    def mend(self) -> None:
        """Pass everything on as it comes."""
        self.alter: Callable[[Sentence], Sentence] = lambda sentence: sentence
        self.spoil: Callable[[bytes], bytes] = lambda data: data
        self._in_place = True

    def unplug(self) -> None:
        """Take the device away, until `mend`: its connection ends and a new one is refused."""
        self._in_place = False

    def close(self) -> None:
        """End."""
        self._closing = True
        self._thread.join()

    def _run(self) -> None:
        while not self._closing:
            if not self._in_place:
                self._drop()
                time.sleep(RETRY)
                continue
            if self._sensor is None:
                self._find_sensor()
            if self._listener.fileno() < 0 and self._sensor is not None:
                self._listener = _listen(self.port)
            ready, _, _ = select.select(self._open(), [], [], RETRY)
            if self._listener in ready:
                self._drop_driver()
                self._driver, _ = self._listener.accept()
                self._driver.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            if self._sensor in ready:
                self._pass_on()
            if self._driver in ready:
                self._hear_driver()
        self._drop()

    def _open(self) -> list[socket.socket]:
        listener = [self._listener] if self._listener.fileno() >= 0 else []
        return listener + [s for s in (self._sensor, self._driver) if s is not None]

    def _find_sensor(self) -> None:
        with contextlib.suppress(OSError):
            self._sensor = socket.create_connection(('127.0.0.1', self._sensor_port), 1.0)

    def _pass_on(self) -> None:
        assert self._sensor is not None
        try:
            data = self._sensor.recv(65536)
        except OSError:
            data = b''
        if not data:  # the sensor has gone, and its device with it
            self._drop()
            return
        *lines, self._received = (self._received + data).split(b'\n')
        for line in lines:
            with contextlib.suppress(SentenceError):
                self._send(self.alter(decode(line)))

    def _send(self, sentence: Sentence) -> None:
        if sentence.reading.in_contact:
            number = len(self.sent) + 1
            sentence = replace(
                sentence, reading=replace(sentence.reading, normal_force=float(number))
            )
            self.sent[number] = Sent(time.monotonic(), sentence.reading)
        data = self.spoil(encode(sentence))
        if self._driver is None or not data:
            return
        try:
            self._driver.sendall(data)
        except OSError:
            self._drop_driver()

    def _hear_driver(self) -> None:
        assert self._driver is not None
        try:
            heard = self._driver.recv(4096)
        except OSError:
            heard = b''
        if not heard:
            self._drop_driver()

    def _drop_driver(self) -> None:
        if self._driver is not None:
            self._driver.close()
            self._driver = None

    def _drop(self) -> None:
        self._listener.close()
        self._drop_driver()
        if self._sensor is not None:
            self._sensor.close()
            self._sensor = None
        self._received = b''


class Corruption:
    """Replaces bytes by other ones.

    Parameters
    ----------
    rate : float
        Share of the bytes, 0 to 1.
    seed : int
        Of the random numbers.
    """

    def __init__(self, rate: float, seed: int = 1) -> None:
        self._rate = rate
        self._random = random.Random(seed)

    def __call__(self, data: bytes) -> bytes:
        """Return the bytes as they arrive."""
        draw = self._random
        return bytes(b ^ draw.randrange(1, 256) if draw.random() < self._rate else b for b in data)


def free_port() -> int:
    """Return a port of this machine on which nobody listens."""
    with _listen(0) as listener:
        return int(listener.getsockname()[1])


def _listen(port: int) -> socket.socket:
    return socket.create_server(('127.0.0.1', port))
