# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A thread that reads the sensor, whatever its device does."""

import enum
import math
import threading
import time
from collections.abc import Callable

from tactile_push.devices.device import Device
from tactile_push.devices.stream import SentenceStream
from tactile_push.tactile.reading import Reading

SHORTEST_RETRY, LONGEST_RETRY = 0.1, 2.0  # [s]: a plug is soon back; an absent device costs little
RELEASE_TIME = 0.2  # in which a device is let go of, if pyserial does not block [s]: a few reads


class Condition(enum.Enum):
    """The state of the sensor, in a few words."""

    INACTIVE = 'inactive'
    NOT_THERE = 'device not there'
    STARTING = 'no reading yet'
    NO_BYTES = 'no bytes'
    UNREADABLE = 'bytes but no valid sentence, wrong baud_rate?'
    SILENT = 'sensor silent'
    NOT_NEW = 'sentences but no new reading'
    READING = 'reading'


class SensorReader:
    """Reads the sensor's device, and opens it again whenever it goes away.

    It waits between attempts, twice as long each time. Only a fresh reading makes the wait short
    again, so that a peer which accepts and hangs up is not asked ten times a second. A thread of
    its own calls the callables, and never after `stop`.
    """

    def __init__(
        self,
        url: str,
        baud_rate: int,
        clock: Callable[[], int],  # returns the present time, with which readings are stamped [ns]
        hear: Callable[[list[Reading], int], None],  # takes fresh readings, oldest first, and time
        change: Callable[[str], None],  # takes the problem; '' when readings come (again)
    ) -> None:
        self._url = url
        self._baud_rate = baud_rate
        self._clock = clock
        self._hear = hear
        self._change = change
        self.stream = SentenceStream()
        self.bytes_read = 0
        self.connections = 0  # times that the device was opened
        self.reconnects = 0  # times that it was opened after it had gone
        self.problem = ''  # why the device is not there
        self._received = 0
        # Held while the thread does what shows outside: none of that goes on when `stop` returns.
        self._lock = threading.Lock()
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None
        self._retry = SHORTEST_RETRY
        self._well: bool | None = None  # what `change` has heard last
        # Steady times [s] in the present connection.
        self._opened: float | None = None
        self._last_bytes: float | None = None
        self._last_sentence: float | None = None
        self._last_reading: float | None = None

    def start(self) -> None:
        """Start to read."""
        self._retry = SHORTEST_RETRY
        self._well = None
        self._opened = None
        self.problem = ''
        # One for each thread: a thread that blocks in pyserial may come back after the next start.
        self._stopping = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(self._stopping,), name='sensor', daemon=True
        )
        self._thread.start()

    def stop(self) -> None:
        """Let go of the device; nothing is called afterwards.

        If the device blocks, as a TCP connection to a host that does not answer does, the thread
        closes it later and nobody waits for that.
        """
        self._stopping.set()
        with self._lock:
            pass  # what is being called has returned, and nothing more will be
        if self._thread is not None:
            self._thread.join(RELEASE_TIME)
            self._thread = None

    def condition(self, patience: float) -> Condition:
        """Return the sensor's state; what has not come for `patience` [s] counts as missing."""
        now = time.monotonic()

        def recent(moment: float | None) -> bool:
            return moment is not None and now - moment <= patience

        if self._thread is None:
            return Condition.INACTIVE
        if self._opened is None:
            return Condition.NOT_THERE
        if recent(self._last_reading):
            return Condition.READING
        if self._last_reading is None and recent(self._opened):
            return Condition.STARTING
        if recent(self._last_sentence):
            return Condition.NOT_NEW
        if recent(self._last_bytes):
            return Condition.UNREADABLE
        return Condition.NO_BYTES if self._last_sentence is None else Condition.SILENT

    def age(self) -> float:
        """Return the time since the last reading of this connection [s]; NaN if there was none."""
        last = self._last_reading
        return math.nan if last is None else time.monotonic() - last

    def _run(self, stopping: threading.Event) -> None:
        opened_before = False
        while not stopping.is_set():
            device, pause = None, 0.0
            try:
                device = Device(self._url, self._baud_rate)
                if self._note_opened(stopping, opened_before):
                    opened_before = True
                    self._read(device, stopping)
            except (OSError, ValueError) as error:
                pause = self._note_gone(stopping, str(error))
            next_attempt = time.monotonic() + pause
            if device is not None:
                device.close()  # may take a while
            stopping.wait(max(0.0, next_attempt - time.monotonic()))

    def _note_opened(self, stopping: threading.Event, opened_before: bool) -> bool:
        with self._lock:
            if stopping.is_set():
                return False
            self.stream.restart()
            self.connections += 1
            self.reconnects += opened_before
            self.problem = ''
            self._last_bytes = self._last_sentence = self._last_reading = None
            self._opened = time.monotonic()
            return True

    def _note_gone(self, stopping: threading.Event, problem: str) -> float:
        with self._lock:
            if stopping.is_set():
                return 0.0
            self._opened = None
            self.problem = problem
            self._tell(well=False)
            pause, self._retry = self._retry, min(2.0 * self._retry, LONGEST_RETRY)
            return pause

    def _read(self, device: Device, stopping: threading.Event) -> None:
        while True:
            data = device.read()
            with self._lock:
                if stopping.is_set():
                    return
                if data:
                    self._take(data, device)

    def _take(self, data: bytes, device: Device) -> None:
        # The stamp comes first: if this process stands still in between, the bytes are late.
        stamp = self._clock()
        readings = self.stream.feed(data, device.fresh())
        now = time.monotonic()
        self.bytes_read += len(data)
        self._last_bytes = now
        if self.stream.received > self._received:
            self._received = self.stream.received
            self._last_sentence = now
        if readings:
            self._last_reading = now
            self._retry = SHORTEST_RETRY
            self._tell(well=True)
            self._hear(readings, stamp)

    def _tell(self, well: bool) -> None:
        if well != self._well:
            self._well = well
            self._change(self.problem)
