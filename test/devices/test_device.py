# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Devices of every kind: a pseudo terminal, a TCP connection, and one without a file."""

import contextlib
import io
import os
import random
import socket
import struct
import termios
import threading
import time
import tty

import pytest
import serial
from serial.rfc2217 import PortManager

from support.many_files import no_more_files, open_files
from tactile_push.devices.device import FD_SETSIZE, Device, check_url, socket_address

BAUD_RATE = 115200
PATIENCE = 20.0  # [s]


def receive(device, count):
    """Read until there are so many bytes."""
    data = b''
    deadline = time.monotonic() + PATIENCE
    while len(data) < count:
        assert time.monotonic() < deadline, f'only {data!r} came'
        data += device.read()
    return data


def read_until_gone(device):
    """Read until the device says that it is gone."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        device.read()


def shortest_idle_read(device):
    """Return how long the quickest of some reads of nothing took [s]."""
    durations = []
    for _ in range(5):
        start = time.monotonic()
        assert device.read() == b''
        durations.append(time.monotonic() - start)
    return min(durations)


@pytest.fixture
def line():
    """Return the near end of a pseudo terminal and the path of its far end."""
    near, far = os.openpty()
    tty.setraw(far)
    yield near, os.ttyname(far)
    for end in (near, far):
        with contextlib.suppress(OSError):  # a test may have closed it
            os.close(end)


@pytest.fixture
def listener():
    """Return a listening socket at an address of its own and the URL to reach it."""
    host = f'127.{random.randint(1, 254)}.{random.randint(0, 254)}.{random.randint(1, 254)}'
    with socket.create_server((host, 0)) as listener:
        yield listener, f'socket://{host}:{listener.getsockname()[1]}'


@pytest.fixture
def devices():
    """Return an opener of devices, which are closed at the end."""
    with contextlib.ExitStack() as stack:

        def open_device(url):
            device = Device(url, BAUD_RATE)
            stack.callback(device.close)
            return device

        yield open_device


def test_bytes_of_a_pseudo_terminal_arrive_unchanged(line, devices):
    near, path = line
    device = devices(path)
    data = bytes(range(256))
    os.write(near, data)
    assert receive(device, len(data)) == data
    os.write(near, b'$PTACT,0,V,,,*18\r\n')
    assert receive(device, 18) == b'$PTACT,0,V,,,*18\r\n'


def test_bytes_of_a_tcp_connection_arrive_unchanged(listener, devices):
    server, url = listener
    device = devices(url)
    client, _ = server.accept()
    with client:
        data = bytes(range(256)) * 20
        client.sendall(data)
        assert receive(device, len(data)) == data


def test_bytes_of_a_device_without_a_file_arrive(devices):
    device = devices('loop://')
    device._port.write(b'hello')
    assert receive(device, 5) == b'hello'
    assert device.read() == b''


def test_idle_pseudo_terminal_gives_no_bytes_soon(line, devices):
    assert shortest_idle_read(devices(line[1])) < 0.2


@pytest.mark.slow
def test_idle_tcp_connection_gives_no_bytes_soon(listener, devices):
    server, url = listener
    device = devices(url)
    client, _ = server.accept()
    with client:
        assert shortest_idle_read(device) < 0.2


def test_idle_device_without_a_file_gives_no_bytes_soon(devices):
    assert shortest_idle_read(devices('loop://')) < 0.2


def test_idle_read_waits_rather_than_spins(line, devices):
    device = devices(line[1])
    start = time.process_time()
    began = time.monotonic()
    while time.monotonic() - began < 0.2:
        assert device.read() == b''
    assert time.process_time() - start < 0.1


def test_read_takes_bytes_as_soon_as_they_are_there(line, devices):
    near, path = line
    device = devices(path)
    durations = []
    for _ in range(20):
        os.write(near, b'x')
        start = time.monotonic()
        assert receive(device, 1) == b'x'
        durations.append(time.monotonic() - start)
    assert min(durations) < Device.LONGEST_WAIT / 2.0


def test_pseudo_terminal_that_goes_away_raises_oserror():
    near, far = os.openpty()
    device = Device(os.ttyname(far), BAUD_RATE)
    os.close(far)
    os.write(near, b'x')
    assert receive(device, 1) == b'x'
    os.close(near)
    with pytest.raises(OSError):
        read_until_gone(device)
    device.close()


def test_tcp_connection_that_ends_raises_oserror(listener, devices):
    server, url = listener
    device = devices(url)
    client, _ = server.accept()
    client.sendall(b'last words')
    assert receive(device, 10) == b'last words'
    client.close()
    with pytest.raises(OSError):
        read_until_gone(device)


def test_nothing_at_the_path_raises_oserror(tmp_path):
    with pytest.raises(OSError):
        Device(str(tmp_path / 'nothing'), BAUD_RATE)


def test_file_that_is_no_terminal_raises_oserror(tmp_path):
    path = tmp_path / 'text'
    path.write_text('no terminal')
    with pytest.raises(OSError):
        Device(str(path), BAUD_RATE)


def test_nobody_at_the_address_raises_oserror(listener):
    server, url = listener
    server.close()
    with pytest.raises(OSError):
        Device(url, BAUD_RATE)


@pytest.mark.parametrize('url', ['nonsense://127.0.0.1:5000', 'http://127.0.0.1'])
def test_url_of_an_unknown_kind_raises_valueerror(url):
    with pytest.raises(ValueError):
        Device(url, BAUD_RATE)
    with pytest.raises(ValueError):
        check_url(url)


@pytest.mark.parametrize('url', ['/dev/ttyUSB0', '/nowhere/sensor', 'socket://127.0.0.1:5000'])
def test_url_of_a_known_kind_is_good_whether_the_device_is_there_or_not(url):
    assert check_url(url) is None


@pytest.mark.parametrize(
    'url',
    [
        'socket://',
        'socket://127.0.0.1',
        'socket://:5000',
        'socket://127.0.0.1:port',
        'socket://127.0.0.1:65536',
        'socket://127.0.0.1:-1',
    ],
)
def test_socket_without_host_and_port_is_refused_with_what_was_expected(url):
    for refuse in (check_url, socket_address):
        with pytest.raises(
            ValueError, match=f'^expected socket://host:port, a port up to 65535, got {url!r}$'
        ):
            refuse(url)


def test_socket_address_is_host_and_port():
    assert socket_address('socket://127.0.0.1:54320') == ('127.0.0.1', 54320)
    assert socket_address('socket://robot:0') == ('robot', 0)
    assert socket_address('socket://[::1]:65535') == ('::1', 65535)


def test_closed_device_can_be_opened_again(line):
    near, path = line
    for data in (b'one', b'two'):
        device = Device(path, BAUD_RATE)
        os.write(near, data)
        assert receive(device, 3) == data
        device.close()


def read_fresh(device, send):
    """Send and read until what was read is fresh; return it."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        send()
        if (data := device.read()) and device.fresh():
            return data
    raise AssertionError('nothing fresh came')


def test_what_comes_while_somebody_reads_is_fresh(line, devices):
    near, path = line
    device = devices(path)
    assert read_fresh(device, lambda: os.write(near, b'x')) == b'x'


def test_what_lay_in_the_buffer_while_nobody_read_is_late(line, devices):
    near, path = line
    device = devices(path)
    read_fresh(device, lambda: os.write(near, b'x'))
    os.write(near, b'old' * 500)
    time.sleep(1.5 * Device.LONGEST_AGE)
    count = 0
    while count < 1500:
        count += len(device.read())
        assert not device.fresh()
    # The first bytes after that may have been held back further out.
    os.write(near, b'held back')
    assert device.read() and not device.fresh()
    assert read_fresh(device, lambda: os.write(near, b'new')) == b'new'


def test_what_was_read_before_a_standstill_is_late_after_it(line, devices):
    near, path = line
    device = devices(path)
    read_fresh(device, lambda: os.write(near, b'x'))
    os.write(near, b'read')
    assert device.read() == b'read'
    time.sleep(1.5 * Device.LONGEST_AGE)
    assert not device.fresh()


def test_what_comes_right_after_opening_is_late(listener, devices):
    server, url = listener
    device = devices(url)
    client, _ = server.accept()
    with client:
        client.sendall(b'x')
        assert receive(device, 1) == b'x'
        assert not device.fresh()
        assert read_fresh(device, lambda: client.sendall(b'y')).startswith(b'y')


def test_device_without_a_file_is_read_fresh_and_late_too(devices):
    device = devices('loop://')
    assert read_fresh(device, lambda: device._port.write(b'x')) == b'x'
    device._port.write(b'old')
    time.sleep(1.5 * Device.LONGEST_AGE)
    assert receive(device, 3) == b'old'
    assert not device.fresh()


def test_line_is_read_by_one_alone(line, devices):
    devices(line[1])
    with pytest.raises(OSError, match='lock'):
        devices(line[1])


@pytest.mark.parametrize('url', ['spy://{}?file={}', 'alt://{}?class=PosixPollSerial'])
def test_handlers_around_a_serial_line_read_it(url, line, devices, tmp_path):
    near, path = line
    device = devices(url.format(path, tmp_path / 'spied'))
    assert device.read() == b''
    os.write(near, b'hello')
    assert receive(device, 5) == b'hello'


class Rfc2217Server(threading.Thread):
    """Serves one connection of RFC 2217 with pyserial's own server class."""

    def __init__(self, listener, data):
        super().__init__(daemon=True)
        self._listener = listener
        self._data = data

    def write(self, data):
        self.connection.sendall(data)

    def run(self):
        self.connection, _ = self._listener.accept()
        with self.connection, contextlib.suppress(OSError):
            manager = PortManager(serial.serial_for_url('loop://'), self)
            self.connection.sendall(b''.join(manager.escape(self._data)))
            while received := self.connection.recv(1024):
                list(manager.filter(received))
            # The client has gone.


@pytest.mark.slow
def test_device_of_rfc_2217_is_read_and_its_end_noticed(listener):
    server, url = listener
    data = bytes(range(256))
    served = Rfc2217Server(server, data)
    served.start()
    device = Device(url.replace('socket', 'rfc2217'), BAUD_RATE)
    served.connection.sendall(data[:100])
    assert receive(device, 100).endswith(data[:100])
    assert device.read() == b''
    served.connection.shutdown(socket.SHUT_RDWR)
    with pytest.raises(OSError):
        read_until_gone(device)
    device.close()
    served.join(PATIENCE)


class OddPort:
    """A port that throws what it is told to, where it is told to."""

    def __init__(self, place, error):
        self._place = place
        self._error = error
        self.timeout = 0

    def _do(self, place, result):
        if place == self._place:
            raise self._error
        return result

    def open(self):
        self._do('open', None)

    def fileno(self):
        raise io.UnsupportedOperation

    @property
    def in_waiting(self):
        return self._do('in_waiting', 1)

    def read(self, size):
        return self._do('read', b'x' * size)

    def close(self):
        self._do('close', None)


ERRORS = [
    serial.SerialException('read failed: [Errno 5] Input/output error'),
    serial.PortNotOpenError(),
    OSError(5, 'Input/output error'),
    termios.error(5, 'Input/output error'),
    TypeError("'NoneType' object cannot be interpreted as an integer"),
    ValueError('file descriptor cannot be a negative integer (-1)'),
    AttributeError("'NoneType' object has no attribute 'recv'"),
    struct.error('unpack requires a buffer of 4 bytes'),
    KeyError(),
]


@pytest.mark.parametrize('error', ERRORS, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize('place', ['open', 'in_waiting', 'read'])
def test_whatever_a_handler_throws_is_an_oserror_with_words(place, error, monkeypatch):
    monkeypatch.setattr(serial, 'serial_for_url', lambda url, **settings: OddPort(place, error))
    with pytest.raises(OSError) as raised:
        Device('odd://', BAUD_RATE).read()
    assert str(raised.value)


def test_device_that_does_not_even_close_is_given_up_in_silence(monkeypatch):
    port = OddPort('close', termios.error(5, 'Input/output error'))
    monkeypatch.setattr(serial, 'serial_for_url', lambda url, **settings: port)
    device = Device('odd://', BAUD_RATE)
    assert device.read() == b'x'
    device.close()


def test_line_is_read_beyond_what_select_can_wait_for(line, devices):
    near, path = line
    with open_files(FD_SETSIZE):
        device = devices(path)
        os.write(near, b'beyond')
        assert receive(device, 6) == b'beyond'
        assert device.read() == b''
        os.close(near)
        with pytest.raises(OSError):
            read_until_gone(device)


def test_handler_that_needs_select_says_in_words_that_too_many_files_are_open(listener):
    with open_files(FD_SETSIZE), pytest.raises(OSError, match='only with fewer than 1024 files'):
        Device(listener[1], BAUD_RATE)


def test_device_that_cannot_be_opened_for_want_of_a_file_is_an_oserror_with_words(line):
    with no_more_files(), pytest.raises(OSError, match='Too many open files'):
        Device(line[1], BAUD_RATE)
    Device(line[1], BAUD_RATE).close()


@pytest.mark.parametrize('url', ['', 'hwgrep://[', 'alt:///dev/ttyS0?class=Nothing'])
def test_url_that_no_handler_understands_is_refused_with_words(url):
    with pytest.raises(ValueError, match='.'):
        check_url(url)


def test_device_that_is_looked_for_by_name_may_come_later():
    assert check_url('hwgrep://no such device') is None
    with pytest.raises(OSError, match='no such device'):
        Device('hwgrep://no such device', BAUD_RATE)
