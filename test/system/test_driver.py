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
import itertools
import math
import os
import socket
from pathlib import Path

import pytest
from conftest import Observer
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import JointState

from tactile_push.processes import NodeProcesses


def xor(body: bytes) -> int:
    value = 0
    for byte in body:
        value ^= byte
    return value


def sentence(body: bytes) -> bytes:
    return b'$%s*%02X\r\n' % (body, xor(body))


@pytest.fixture
def sensor():
    """Listen where the driver will connect."""
    with socket.create_server(('127.0.0.1', 0)) as server:
        yield server


def test_malformed_sentences_are_counted_and_dropped_and_the_rest_goes_on(
    nodes: NodeProcesses, observer: Observer, sensor: socket.socket
):
    readings = observer.collect(JointState, 'tactile')
    diagnostics = observer.collect(DiagnosticArray, '/diagnostics')
    port = sensor.getsockname()[1]
    nodes.start('sensor_driver', {'device': f'socket://127.0.0.1:{port}'})
    connection, _ = sensor.accept()
    # A reading that nobody hears yet is gone, so there are more until one is heard.
    number = itertools.count(100)
    observer.wait_for(
        lambda: connection.send(sentence(b'PTACT,%d,V,,,' % next(number))) and readings,
        'the first reading',
    )
    valid = sentence(b'PTACT,7,A,0.0000,70.0000,1.500')
    assert valid == b'$PTACT,7,A,0.0000,70.0000,1.500*15\r\n'
    connection.sendall(b'\x00\xffnoise\r\n' + valid.replace(b'70', b'71') + valid[:9])
    connection.sendall(valid[9:] + sentence(b'PTACT,8,V,,,'))
    observer.wait_for(
        lambda: readings[1:] and not math.isnan(readings[-2].position[0]), 'both readings'
    )
    contact, no_contact = readings[-2:]
    assert list(contact.name) == ['azimuth', 'elevation', 'normal_force']
    assert contact.position[0] == 0.0
    assert contact.position[1] == pytest.approx(math.radians(70.0))
    assert contact.effort[2] == 1.5
    assert math.isnan(no_contact.position[0]) and math.isnan(no_contact.position[1])

    def counted() -> dict[str, str]:
        values: dict[str, str] = {}
        for array in diagnostics:
            values |= {v.key: v.value for v in array.status[0].values}
        return values

    observer.wait_for(
        lambda: (
            counted().get('dropped: wrong checksum') == '1'
            and counted().get('dropped: no sentence') == '1'
        ),
        'the drops to be counted by reason',
    )
    connection.close()


def test_driver_waits_for_its_device_and_finds_it_again(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    readings = observer.collect(JointState, 'tactile')
    diagnostics = observer.collect(DiagnosticArray, '/diagnostics')
    path = tmp_path / 'tty'
    nodes.start('sensor_driver', {'device': str(path)})
    observer.wait_for(
        lambda: any(a.status[0].level == DiagnosticStatus.ERROR for a in diagnostics),
        'the driver to miss its device',
    )
    sequence = 0

    def heard(near: int, log_lines: int) -> bool:
        nonlocal sequence
        sequence += 1
        os.write(near, sentence(b'PTACT,%d,V,,,' % sequence))
        log = nodes.log('sensor_driver').read_text()
        return log.count(f'reading {path}') == log_lines and len(readings) > before

    for opened in (1, 2):
        near, far = os.openpty()
        path.symlink_to(os.ttyname(far))
        before = len(readings)
        observer.wait_for(lambda near=near, opened=opened: heard(near, opened), 'a reading')
        path.unlink()
        os.close(far)
        os.close(near)


def test_port_in_use_ends_the_plant_with_one_line(nodes: NodeProcesses, sensor: socket.socket):
    port = sensor.getsockname()[1]
    plant = nodes.start('sim_plant', {'device': f'socket://127.0.0.1:{port}'})
    assert plant.wait(60.0) == 2
    said = nodes.log('sim_plant').read_text()
    assert said == (f'sim_plant: parameter device: 127.0.0.1:{port}: Address already in use\n')
