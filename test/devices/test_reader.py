# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The reading thread against devices that fail in every way, without waiting for real ones."""

import contextlib
import fcntl
import math
import os
import queue
import socket
import threading
import time
import tty

import pytest

from tactile_push.devices import Sentence, encode, reader
from tactile_push.devices.reader import Condition, SensorReader
from tactile_push.tactile import Reading

PATIENCE = 20.0  # [s]; a bound on hanging
LATE = object()


def line(sequence, force=1.0):
    return encode(Sentence(sequence, Reading(0.0, 1.0, force)))


class ScriptedDevice:
    """A device that gives what a test puts into its queue: bytes, late bytes or an exception."""

    script: queue.Queue
    opening: list
    open_devices: int

    def __init__(self, url, baud_rate):
        if self.opening:
            problem = self.opening.pop(0)
            if isinstance(problem, threading.Event):
                assert problem.wait(PATIENCE)
            else:
                raise problem
        self._fresh = True
        type(self).open_devices += 1

    def read(self):
        try:
            item = self.script.get(timeout=0.01)
        except queue.Empty:
            return b''
        if isinstance(item, Exception):
            raise item
        self._fresh = not isinstance(item, tuple)
        return item if self._fresh else item[1]

    def fresh(self):
        return self._fresh

    def close(self):
        type(self).open_devices -= 1


class Log:
    """What a reader has called."""

    def __init__(self):
        self.heard = []
        self.changes = []

    @property
    def forces(self):
        return [reading.normal_force for readings, _ in self.heard for reading in readings]

    def hear(self, readings, stamp):
        self.heard.append((readings, stamp))


@pytest.fixture
def device(monkeypatch):
    """Put a scripted device in the place of a real one."""
    kind = type('Scripted', (ScriptedDevice,), {})
    kind.script, kind.opening, kind.open_devices = queue.Queue(), [], 0
    monkeypatch.setattr(reader, 'Device', kind)
    return kind


@pytest.fixture
def log():
    return Log()


@pytest.fixture
def readers(log):
    """Return a maker of readers, which are stopped at the end."""
    with contextlib.ExitStack() as stack:

        def make(url='anywhere'):
            made = SensorReader(url, 115200, lambda: 7, log.hear, log.changes.append)
            stack.callback(made.stop)
            return made

        yield make


@pytest.fixture
def pauses(monkeypatch):
    """Return the list of waits between attempts, none of which is waited for."""
    waits = []
    note_gone = SensorReader._note_gone

    def note_and_go_on(self, *arguments):
        waits.append(note_gone(self, *arguments))
        return 0.0

    monkeypatch.setattr(SensorReader, '_note_gone', note_and_go_on)
    return waits


def wait_for(condition, what):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, f'waited in vain: {what}'
        time.sleep(0.002)


def test_readings_of_one_read_are_heard_together_with_its_time(device, log, readers):
    sensor = readers()
    device.script.put(line(0, 1.0) + line(1, 2.0) + line(2, 3.0)[:20])
    device.script.put(line(2, 3.0)[20:])
    sensor.start()
    wait_for(lambda: len(log.heard) == 2, 'both reads')
    assert [len(readings) for readings, _ in log.heard] == [2, 1]
    assert log.forces == [1.0, 2.0, 3.0]
    assert {stamp for _, stamp in log.heard} == {7}
    assert log.changes == ['']
    assert sensor.bytes_read == sum(len(line(k, 1.0)) for k in range(3))
    assert (sensor.connections, sensor.reconnects) == (1, 0)


def test_late_readings_are_not_heard(device, log, readers):
    sensor = readers()
    for item in (line(0, 1.0), (LATE, line(1, 2.0) + line(2, 3.0)[:9])):
        device.script.put(item)
    device.script.put(line(2, 3.0)[9:] + line(3, 4.0))
    sensor.start()
    wait_for(lambda: log.forces[-1:] == [4.0], 'the last reading')
    assert log.forces == [1.0, 4.0]
    assert (sensor.stream.late, sensor.stream.lost) == (2, 0)


def test_waits_double_from_a_tenth_of_a_second_to_two_and_it_is_said_once(
    device, log, readers, pauses
):
    device.opening += [OSError('not there')] * 5 + [OSError('not yours')] * 3
    device.script.put(line(0))
    readers().start()
    wait_for(lambda: log.forces, 'the reading')
    assert pauses == [0.1, 0.2, 0.4, 0.8, 1.6, 2.0, 2.0, 2.0]
    assert log.changes == ['not there', '']


def test_only_a_fresh_reading_makes_the_waits_short_again(device, log, readers, pauses):
    sensor = readers()
    gone = OSError('hung up')
    for item in (line(0), gone, gone, b'noise\r\n', gone, (LATE, line(1)), gone, line(9), gone):
        device.script.put(item)
    sensor.start()
    wait_for(lambda: len(pauses) == 5, 'five ends')
    assert pauses == [0.1, 0.2, 0.4, 0.8, 0.1]
    assert log.changes == ['', 'hung up', '', 'hung up']
    wait_for(lambda: sensor.connections == 6, 'another attempt')
    assert sensor.reconnects == 5


@pytest.mark.slow
def test_waits_are_waited(device, log, readers):
    device.opening += [OSError('not there')] * 3
    device.script.put(line(0))
    began = time.monotonic()
    readers().start()
    wait_for(lambda: log.forces, 'the reading')
    assert time.monotonic() - began > 0.1 + 0.2 + 0.4


@pytest.mark.slow
def test_peer_that_accepts_and_hangs_up_is_asked_less_and_less_often(log, readers):
    with socket.create_server(('127.0.0.1', 0)) as server:
        sensor = readers(f'socket://127.0.0.1:{server.getsockname()[1]}')
        began = time.monotonic()
        sensor.start()
        for _ in range(4):
            server.settimeout(PATIENCE)
            connection, _ = server.accept()
            connection.close()
        assert time.monotonic() - began > 0.1 + 0.2 + 0.4
        assert sensor.condition(10.0) in (Condition.NOT_THERE, Condition.STARTING)
        wait_for(lambda: len(log.changes) == 1, 'that it is said')
        sensor.stop()
    assert len(log.changes) == 1 and log.changes[0]


def test_url_that_is_refused_only_when_it_is_opened_is_tried_on(device, log, readers, pauses):
    device.opening += [ValueError('odd option')]
    device.script.put(line(0))
    readers().start()
    wait_for(lambda: log.forces, 'the reading')
    assert log.changes == ['odd option', '']


def condition_becomes(sensor, condition, patience):
    wait_for(lambda: sensor.condition(patience) is condition, str(condition))


def test_conditions_are_told_apart(device, readers, pauses):
    sensor = readers()
    assert sensor.condition(0.05) is Condition.INACTIVE
    assert math.isnan(sensor.age())
    blocked = threading.Event()
    device.opening += [OSError('not there'), blocked]
    sensor.start()
    condition_becomes(sensor, Condition.NOT_THERE, 0.05)
    assert sensor.problem in ('', 'not there')  # before the first attempt and after it
    blocked.set()
    condition_becomes(sensor, Condition.STARTING, PATIENCE)
    assert sensor.problem == ''
    condition_becomes(sensor, Condition.NO_BYTES, 0.05)
    device.script.put(b'\x00\xff' * 20)
    wait_for(lambda: sensor.bytes_read, 'bytes')
    # With patience for bytes but not for the time since the device was opened:
    time.sleep(0.05)
    opened, last_bytes = sensor._opened, sensor._last_bytes
    between = time.monotonic() - (opened + last_bytes) / 2.0
    assert sensor.condition(between) is Condition.UNREADABLE
    device.script.put(line(0))
    condition_becomes(sensor, Condition.READING, PATIENCE)
    assert 0.0 <= sensor.age() < PATIENCE
    condition_becomes(sensor, Condition.SILENT, 0.05)
    for _ in range(3):
        device.script.put(line(0))
    wait_for(lambda: sensor.stream.repeated == 3, 'repeated sentences')
    assert sensor.condition(time.monotonic() - sensor._last_sentence) is Condition.SILENT
    between = time.monotonic() - (sensor._last_reading + sensor._last_sentence) / 2.0
    assert sensor.condition(between) is Condition.NOT_NEW
    device.script.put(OSError('pulled out'))
    pulled_out = threading.Event()
    device.opening += [pulled_out]
    condition_becomes(sensor, Condition.NOT_THERE, PATIENCE)
    assert sensor.problem == 'pulled out'
    sensor.stop()
    pulled_out.set()
    assert sensor.condition(0.05) is Condition.INACTIVE


def test_stop_lets_go_of_a_silent_device_at_once_and_it_can_be_started_again(device, log, readers):
    sensor = readers()
    for number in range(3):
        device.script.put(line(number, float(number)))
        sensor.start()
        wait_for(lambda number=number: len(log.forces) == number + 1, 'a reading')
        began = time.monotonic()
        sensor.stop()
        assert time.monotonic() - began < 0.3
        assert device.open_devices == 0
    assert log.forces == [0.0, 1.0, 2.0]
    assert (sensor.connections, sensor.reconnects) == (3, 0)
    sensor.stop()


@pytest.mark.slow
def test_stop_closes_a_tcp_connection_although_pyserial_sleeps_after_that(log, readers):
    took = []
    with socket.create_server(('127.0.0.1', 0)) as server:
        sensor = readers(f'socket://127.0.0.1:{server.getsockname()[1]}')
        for _ in range(3):
            sensor.start()
            connection, _ = server.accept()
            with connection:
                wait_for(lambda: sensor.condition(PATIENCE) is Condition.STARTING, 'the opening')
                began = time.monotonic()
                sensor.stop()
                took.append(time.monotonic() - began)
                connection.settimeout(PATIENCE)
                assert connection.recv(1) == b''
    assert min(took) < 0.3


def test_stop_does_not_wait_for_a_device_that_blocks_and_nothing_is_heard_of_it(
    device, log, readers
):
    others = set(threading.enumerate())
    blocked = threading.Event()
    device.opening += [blocked]
    sensor = readers()
    sensor.start()
    wait_for(lambda: not device.opening, 'the attempt')
    began = time.monotonic()
    sensor.stop()
    assert time.monotonic() - began < 0.3
    # The next thread reads while the first still blocks.
    device.script.put(line(0, 5.0))
    sensor.start()
    wait_for(lambda: log.forces == [5.0], 'the reading')
    threads = set(threading.enumerate()) - others
    assert len(threads) == 2
    device.script.put(line(1, 6.0))
    blocked.set()
    wait_for(lambda: sum(thread.is_alive() for thread in threads) == 1, 'the first to end')
    wait_for(lambda: log.forces == [5.0, 6.0], 'the next reading')
    assert device.open_devices == 1
    assert (sensor.connections, log.changes) == (1, [''])


def test_nothing_is_called_after_stop(device, log, readers):
    sensor = readers()
    inside, go_on = threading.Event(), threading.Event()

    def hear_slowly(readings, stamp):
        inside.set()
        assert go_on.wait(PATIENCE)
        log.hear(readings, stamp)

    sensor._hear = hear_slowly
    for number in range(5):
        device.script.put(line(number))
    sensor.start()
    assert inside.wait(PATIENCE)
    threading.Timer(0.05, go_on.set).start()
    sensor.stop()  # waits for the call that goes on
    assert len(log.heard) == 1
    time.sleep(0.05)
    assert len(log.heard) == 1


def test_line_of_a_stopped_reader_is_free(log, readers):
    near, far = os.openpty()
    tty.setraw(far)
    sensor = readers(os.ttyname(far))
    for round_ in range(3):
        sensor.start()
        numbers = iter(range(100 * round_, 60000))
        wait_for(
            lambda numbers=numbers, round_=round_: (
                os.write(near, line(next(numbers))) and len(log.changes) > round_
            ),
            'a reading',
        )
        sensor.stop()
        with open(os.ttyname(far), 'rb', buffering=0) as free:
            fcntl.flock(free, fcntl.LOCK_EX | fcntl.LOCK_NB)
    assert log.changes == [''] * 3
    os.close(near)
    os.close(far)
