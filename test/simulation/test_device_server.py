# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated sensor's end of the wire, with the sensor driver's device at the other end."""

import errno
import os
import random
import re
import time

import pytest

from support.many_files import no_more_files
from tactile_push.devices.device import Device
from tactile_push.simulation import serve

BAUD_RATE = 115200
PATIENCE = 20.0  # [s]
LINE = b'$PTACT,0,V,,,*18\r\n'


def exchange(server, device, data=LINE):
    """Send until something comes through, and return what came."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        server.send(data)
        if received := device.read():
            return received
    raise AssertionError('nothing came')


def send_until_gone(server, device):
    """Send and read until the device says that it is gone."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        device.read()


@pytest.fixture
def address():
    """Return the URL of an address that nobody else uses."""
    host = f'127.{random.randint(1, 254)}.{random.randint(0, 254)}.{random.randint(1, 254)}'
    return f'socket://{host}:{random.randint(10000, 30000)}'


@pytest.fixture
def path(tmp_path):
    """Return a path at which a pseudo terminal may appear."""
    return str(tmp_path / 'sensor')


@pytest.fixture(params=['tcp', 'pty'])
def device_url(request):
    """Return both kinds of URL."""
    return request.getfixturevalue({'tcp': 'address', 'pty': 'path'}[request.param])


@pytest.fixture
def server(device_url):
    """Return an open server of either kind."""
    server = serve(device_url)
    yield server
    server.close()


def test_device_receives_what_the_server_sends(server, device_url):
    device = Device(device_url, BAUD_RATE)
    assert exchange(server, device).startswith(LINE)
    device.close()


def test_every_byte_comes_through_unchanged(server, device_url):
    device = Device(device_url, BAUD_RATE)
    exchange(server, device)
    while device.read():
        pass
    data = bytes(range(256))
    server.send(data)
    received = b''
    deadline = time.monotonic() + PATIENCE
    while len(received) < len(data) and time.monotonic() < deadline:
        received += device.read()
    assert received == data
    device.close()


def test_sending_to_nobody_does_no_harm(server, device_url):
    for _ in range(100):
        server.send(LINE)
    device = Device(device_url, BAUD_RATE)
    assert LINE in exchange(server, device)
    device.close()


@pytest.mark.slow
def test_device_may_go_and_another_may_come(server, device_url):
    for _ in range(3):
        device = Device(device_url, BAUD_RATE)
        assert LINE in exchange(server, device)
        device.close()
        for _ in range(5):
            server.send(LINE)


@pytest.mark.slow
def test_reader_that_does_not_keep_up_does_not_block(server, device_url):
    device = Device(device_url, BAUD_RATE)
    exchange(server, device)
    start = time.monotonic()
    block = LINE * 200
    for _ in range(8000):  # 29 MB, far more than any line or socket holds
        server.send(block)
    assert time.monotonic() - start < PATIENCE
    # What was in the line comes, then what is sent from now on.
    while device.read():
        pass
    assert exchange(server, device, b'now').endswith(b'now')
    device.close()


def test_second_server_at_the_same_place_is_refused(server, device_url):
    with pytest.raises(OSError):
        serve(device_url)
    device = Device(device_url, BAUD_RATE)
    assert LINE in exchange(server, device)  # the first one lives on
    device.close()


@pytest.mark.slow
def test_place_is_free_again_after_close(device_url):
    for _ in range(2):
        server = serve(device_url)
        device = Device(device_url, BAUD_RATE)
        assert LINE in exchange(server, device)
        server.close()
        with pytest.raises(OSError):
            send_until_gone(server, device)
        device.close()
    with pytest.raises(OSError):
        Device(device_url, BAUD_RATE)


def test_message_about_an_address_in_use_names_it(address):
    server = serve(address)
    with pytest.raises(OSError, match=address.removeprefix('socket://')):
        serve(address)
    server.close()


@pytest.mark.slow
def test_two_tcp_clients_both_receive(address):
    server = serve(address)
    devices = [Device(address, BAUD_RATE), Device(address, BAUD_RATE)]
    for device in devices:
        exchange(server, device)
    for device in devices:
        while device.read():
            pass
    server.send(b'both')
    for device in devices:
        received = b''
        deadline = time.monotonic() + PATIENCE
        while len(received) < 4 and time.monotonic() < deadline:
            received += device.read()
        assert received == b'both'
        device.close()
    server.close()


@pytest.mark.slow
def test_tcp_client_that_goes_leaves_the_other_alone(address):
    server = serve(address)
    one, other = Device(address, BAUD_RATE), Device(address, BAUD_RATE)
    for device in (one, other):
        exchange(server, device)
    one.close()
    for _ in range(20):
        server.send(LINE)
    assert LINE in exchange(server, other)
    other.close()
    server.close()


@pytest.mark.slow
def test_tcp_clients_that_went_are_forgotten(address):
    server = serve(address)
    for _ in range(4):
        device = Device(address, BAUD_RATE)
        exchange(server, device)
        device.close()
    deadline = time.monotonic() + PATIENCE
    while server._clients:
        assert time.monotonic() < deadline, 'connections are kept for ever'
        server.send(LINE)
    server.close()


def test_path_of_a_file_is_refused_and_the_file_kept(tmp_path):
    path = tmp_path / 'precious'
    path.write_text('data')
    with pytest.raises(FileExistsError, match='precious'):
        serve(str(path))
    assert path.read_text() == 'data'


def test_link_to_something_is_refused_and_kept(tmp_path):
    (tmp_path / 'precious').write_text('data')
    link = tmp_path / 'link'
    link.symlink_to(tmp_path / 'precious')
    with pytest.raises(FileExistsError):
        serve(str(link))
    assert link.readlink() == tmp_path / 'precious'


def test_dangling_link_of_a_killed_process_is_replaced(path):
    os.symlink('/dev/pts/no-such-terminal', path)
    server = serve(path)
    device = Device(path, BAUD_RATE)
    assert LINE in exchange(server, device)
    device.close()
    server.close()
    assert not os.path.lexists(path)


def test_pseudo_terminal_is_raw_for_a_reader_that_does_not_make_it_so(path):
    server = serve(path)
    reader = os.open(path, os.O_RDONLY | os.O_NOCTTY | os.O_NONBLOCK)
    server.send(LINE)
    assert os.read(reader, 100) == LINE
    os.close(reader)
    server.close()


def test_folder_that_is_not_there_is_refused_by_name(tmp_path):
    with pytest.raises(OSError, match='nowhere/sensor'):
        serve(str(tmp_path / 'nowhere' / 'sensor'))


def test_close_survives_that_somebody_removed_the_link(path):
    server = serve(path)
    os.unlink(path)
    server.close()


@pytest.mark.parametrize(
    'device',
    [
        '',
        'sensor',
        './sensor',
        'socket://',
        'socket://127.0.0.1',
        'socket://:5000',
        'socket://127.0.0.1:port',
        'socket://127.0.0.1:99999',
        'socket://127.0.0.1:-1',
        'tcp://127.0.0.1:5000',
        'file:///tmp/sensor',
    ],
)
def test_device_of_neither_kind_is_refused_with_what_was_expected(device):
    with pytest.raises(ValueError, match='expected socket://host:port'):
        serve(device)


def test_port_that_no_driver_would_find_is_refused():
    with pytest.raises(ValueError, match='port from 1 to 65535'):
        serve('socket://127.0.0.1:0')


def test_host_that_cannot_be_served_is_named_in_words():
    with pytest.raises(OSError, match=r'^(?!.*Unknown error).*192\.0\.2\.1:54321: .') as refusal:
        serve('socket://192.0.2.1:54321')  # an address of nobody
    assert 'address' in str(refusal.value)
    with pytest.raises(OSError, match=r'^(?!.*Unknown error).*\[2001:db8::1\]:54321: .'):
        serve('socket://[2001:db8::1]:54321')


@pytest.mark.parametrize('host', ['::1', '::'])
def test_sensor_is_served_on_ipv6(host):
    url = f'socket://[{host}]:{random.randint(10000, 30000)}'
    try:
        server = serve(url)
    except OSError as error:
        if error.errno in (errno.EAFNOSUPPORT, errno.EADDRNOTAVAIL):
            pytest.skip(f'no IPv6 here: {error}')
        raise
    device = Device(url, BAUD_RATE)
    assert LINE.startswith(exchange(server, device)[: len(LINE)])
    with pytest.raises(OSError, match=re.escape(url.removeprefix('socket://'))):
        serve(url)
    device.close()
    server.close()


def test_name_of_this_machine_is_served_where_a_driver_finds_it():
    url = f'socket://localhost:{random.randint(10000, 30000)}'
    server = serve(url)
    device = Device(url, BAUD_RATE)
    exchange(server, device)
    device.close()
    server.close()


def test_client_waits_while_the_server_can_open_no_file(address):
    server = serve(address)
    device = Device(address, BAUD_RATE)
    with no_more_files():
        server.send(LINE)
        assert server._clients == []
    exchange(server, device)
    device.close()
    server.close()
