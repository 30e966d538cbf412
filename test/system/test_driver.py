# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The sensor driver as a process, on devices that the tests play."""

import contextlib
import itertools
import math
import os
import random
import select
import signal
import socket
import time
import tty
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from lifecycle_msgs.msg import Transition
from sensor_msgs.msg import JointState

from tactile_push.testing import NodeProcesses, Observer, Rig

PATIENCE = 20.0  # [s]


def xor(body: bytes) -> int:
    value = 0
    for byte in body:
        value ^= byte
    return value


def sentence(body: bytes) -> bytes:
    return b'$%s*%02X\r\n' % (body, xor(body))


class Driver:
    """A driver on a TCP connection, the sensor at the other end of it, and what both say."""

    def __init__(self, nodes: NodeProcesses, observer: Observer, listener: socket.socket) -> None:
        self.nodes = nodes
        self.wait_for = observer.wait_for
        self.observer = observer
        self._listener = listener
        self.connection: socket.socket | None = None
        self._number = itertools.count(1)
        self.readings = observer.hear(JointState, 'tactile')
        self.diagnostics = observer.hear(DiagnosticArray, '/diagnostics')

    def start(self, scheme: str = 'socket', **parameters: Any) -> None:
        host, port = self._listener.getsockname()
        device = f'{scheme}://{host}:{port}'
        self.process = self.nodes.start('sensor_driver', {'device': device, **parameters})

    def accept(self) -> None:
        """Wait until the driver connects."""
        self._listener.settimeout(PATIENCE)
        self.connection, _ = self._listener.accept()
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def hang_up(self) -> None:
        assert self.connection is not None
        self.connection.close()

    def next_sentence(self) -> bytes:
        """Return a sentence that is known by its number: so many newtons."""
        number = next(self._number)
        return sentence(b'PTACT,%d,A,0.0,70.0,%d' % (number % 65536, number))

    def send(self, data: bytes) -> None:
        assert self.connection is not None
        self.connection.sendall(data)

    def send_until(self, condition: Callable[[], Any], what: str) -> Any:
        """Send reading after reading until something holds; one alone may be lost or late."""
        return self.wait_for(lambda: self.send(self.next_sentence()) or condition(), what)

    def connect(self) -> None:
        """Accept the driver and wait until its readings are heard."""
        self.accept()
        before = len(self.readings)
        self.send_until(lambda: len(self.readings) > before, 'a reading')

    @property
    def forces(self) -> list[int]:
        return [round(message.effort[2]) for message in self.readings]

    @property
    def log(self) -> str:
        return self.nodes.log('sensor_driver').read_text()

    @property
    def status(self) -> DiagnosticStatus:
        """What the diagnostics said last."""
        return self.diagnostics[-1].status[0] if self.diagnostics else DiagnosticStatus()

    def says(self, message: str, level: bytes) -> bool:
        return (self.status.message, self.status.level) == (message, level)

    def counted(self, name: str) -> int:
        values = {value.key: value.value for value in self.status.values}
        return int(values.get(name, 0))

    def dropped(self) -> int:
        return sum(
            int(value.value)
            for value in self.status.values
            if value.key.startswith('dropped: ') and '[' not in value.key
        )

    def released(self) -> bool:
        """Whether the driver has let go of the connection."""
        assert self.connection is not None
        if not select.select([self.connection], [], [], 0.0)[0]:
            return False
        try:
            return self.connection.recv(1) == b''
        except ConnectionResetError:
            return True


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    with socket.create_server(('127.0.0.1', 0)) as server:
        yield server


@pytest.fixture
def driver(nodes: NodeProcesses, observer: Observer, listener: socket.socket) -> Iterator[Driver]:
    sensor = Driver(nodes, observer, listener)
    yield sensor
    if sensor.connection is not None:
        sensor.connection.close()


def test_malformed_sentences_are_counted_and_dropped_and_the_rest_goes_on(driver: Driver):
    driver.start()
    driver.connect()
    valid = sentence(b'PTACT,7,A,0.0000,70.0000,1.500')
    assert valid == b'$PTACT,7,A,0.0000,70.0000,1.500*15\r\n'
    blocks = 0
    # A reading may be late on a loaded machine, so there are more until both are heard in a row.
    driver.readings.clear()

    def both() -> list[JointState]:
        nonlocal blocks
        blocks += 1
        driver.send(b'\x00\xffnoise\r\n' + valid.replace(b'70', b'71') + valid[:9])
        driver.send(valid[9:] + sentence(b'PTACT,8,V,,,'))
        heard = driver.readings
        return heard[-2:] if [m.effort[2] == 1.5 for m in heard[-2:]] == [True, False] else []

    contact, no_contact = driver.wait_for(both, 'both readings')
    assert list(contact.name) == ['azimuth', 'elevation', 'normal_force']
    assert contact.position[0] == 0.0
    assert contact.position[1] == pytest.approx(math.radians(70.0))
    assert contact.effort[2] == 1.5
    assert math.isnan(no_contact.position[0]) and math.isnan(no_contact.position[1])
    driver.wait_for(
        lambda: (
            driver.counted('dropped: wrong checksum') == blocks
            and driver.counted('dropped: no sentence') == blocks
        ),
        'the drops to be counted by reason',
    )


def test_readings_of_one_read_have_stamps_that_grow_up_to_the_time_of_the_read(driver: Driver):
    driver.start()
    driver.connect()

    def stamps_of(block: range) -> list[int]:
        return [
            message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
            for message in driver.readings
            if round(message.effort[2]) in block
        ]

    def in_one_read() -> list[int]:
        first = next(driver._number) + 1
        began = time.time_ns()
        driver.send(b''.join(driver.next_sentence() for _ in range(20)))
        block = range(first, first + 20)
        with contextlib.suppress(TimeoutError):
            driver.wait_for(lambda: len(stamps_of(block)) == 20, 'the block', 1.0)
        stamps = stamps_of(block)
        assert all(began < stamp < time.time_ns() for stamp in stamps)
        steps = [b - a for a, b in itertools.pairwise(stamps)]
        assert all(step >= 1 for step in steps)
        return stamps if steps == [1] * 19 else []

    # The kernel may hand a block over in two parts, so there are more until one comes whole.
    driver.wait_for(in_one_read, 'a block read at once')


def test_device_that_goes_and_comes_back_is_said_once_each_time(
    driver: Driver, nodes: NodeProcesses, tmp_path: Path
):
    path = tmp_path / 'tty'
    nodes.start('sensor_driver', {'device': str(path)})
    for opened in (1, 2):
        driver.wait_for(
            lambda: driver.says('device not there', DiagnosticStatus.ERROR), 'the driver to miss it'
        )
        reports = len(driver.diagnostics)
        driver.wait_for(
            lambda reports=reports: len(driver.diagnostics) > reports + 2, 'more attempts'
        )
        assert driver.log.count('; trying again') == opened
        assert driver.log.count(f'reading {path}') == opened - 1
        near, far = os.openpty()
        tty.setraw(far)
        path.symlink_to(os.ttyname(far))
        before = len(driver.readings)
        driver.wait_for(
            lambda near=near, before=before: (
                os.write(near, driver.next_sentence()) and len(driver.readings) > before
            ),
            'a reading',
        )
        assert driver.log.count(f'reading {path}') == opened
        path.unlink()
        os.close(far)
        os.close(near)
    driver.wait_for(lambda: driver.counted('connections') == 2, 'connections to be counted')
    assert driver.counted('reconnects') == 1


def test_peer_that_hangs_up_at_once_is_said_once_however_often_it_does(driver: Driver):
    driver.start()
    for _ in range(5):
        driver.accept()
        driver.hang_up()
    driver.wait_for(lambda: driver.counted('connections') >= 5, 'it to be counted')
    assert driver.log.count('; trying again') == 1
    assert 'reading socket' not in driver.log
    driver.connect()
    driver.wait_for(lambda: 'reading socket' in driver.log, 'the sensor to be back')
    assert driver.log.count('; trying again') == 1


def test_bytes_without_sentences_are_taken_for_a_wrong_baud_rate(driver: Driver):
    noise = random.Random(0)
    driver.start()
    driver.accept()
    # It is told to open a socket, as of a simulated device.
    silent = 'no bytes; sim_plant sends none while it compiles'
    driver.wait_for(lambda: driver.says(silent, DiagnosticStatus.ERROR), 'the lack of bytes')
    wrong = 'bytes but no valid sentence, wrong baud_rate?'
    driver.wait_for(
        lambda: driver.send(noise.randbytes(30)) or driver.says(wrong, DiagnosticStatus.ERROR),
        'the wrong baud rate',
    )
    assert not driver.readings
    driver.send_until(lambda: driver.says('reading', DiagnosticStatus.OK), 'all to be well')
    driver.wait_for(lambda: driver.says('sensor silent', DiagnosticStatus.ERROR), 'the silence')


def test_losses_and_repetitions_are_a_warning(driver: Driver):
    driver.start()
    driver.connect()
    last = b''

    def lose() -> bool:
        driver.next_sentence()
        driver.send(driver.next_sentence())
        return driver.says('readings lost', DiagnosticStatus.WARN)

    def repeat() -> bool:
        nonlocal last
        last = driver.next_sentence()
        driver.send(last + last)
        return driver.says('sentences repeated', DiagnosticStatus.WARN)

    driver.wait_for(lose, 'the losses')
    assert driver.counted('lost') > 0
    driver.wait_for(repeat, 'the repetitions')
    assert driver.counted('repeated') > 0
    driver.wait_for(
        lambda: (
            driver.send(last) or driver.says('sentences but no new reading', DiagnosticStatus.ERROR)
        ),
        'the sensor to be stuck',
    )


def test_nothing_that_came_while_the_driver_was_stopped_is_published(driver: Driver):
    driver.start()
    driver.connect()
    process = driver.process
    stat = Path(f'/proc/{process.pid}/stat')
    for _ in range(2):
        process.send_signal(signal.SIGSTOP)
        driver.wait_for(lambda: stat.read_text().rsplit(')', 1)[1].split()[0] == 'T', 'the stop')
        first = next(driver._number) + 1
        end = time.monotonic() + 1.0
        while time.monotonic() < end:
            driver.send(driver.next_sentence())
            time.sleep(0.01)
        half = driver.next_sentence()
        driver.send(half[:12])
        process.send_signal(signal.SIGCONT)
        after = next(driver._number) + 1
        time.sleep(0.3)  # so that the other half is fresh beyond doubt
        driver.send(half[12:])
        driver.send_until(lambda after=after: driver.forces[-1] >= after, 'new readings')
        old = [force for force in driver.forces if first <= force < after]
        assert old == []
    driver.wait_for(lambda: driver.counted('late') > 50, 'the late readings to be counted')
    assert driver.forces == sorted(set(driver.forces))


def test_simulated_time_goes_on_after_the_driver_was_stopped(rig: Rig):
    rig.start()
    rig.wait_until_moving()
    driver = rig.nodes.running['sensor_driver']
    driver.send_signal(signal.SIGSTOP)
    rig.wait_until_resting()
    driver.send_signal(signal.SIGCONT)
    # The plant waits for the contact of a reading that was late, and sends it again.
    rig.wait_until_moving()


def test_half_of_the_sentences_corrupted_costs_those_and_no_others(driver: Driver):
    chance = random.Random(1)
    driver.start()
    driver.connect()
    intact: set[int] = set()
    sent = 0

    def send_some() -> bool:
        nonlocal sent
        for _ in range(10):
            data = bytearray(driver.next_sentence())
            sent += 1
            if chance.random() < 0.5:
                place = chance.randrange(1, len(data) - 5)
                data[place] ^= chance.randrange(1, 256)
            else:
                intact.add(round(float(data.split(b',')[-1].split(b'*')[0])))
            driver.send(bytes(data))
        return sent >= 600

    before = driver.forces[-1]
    driver.wait_for(send_some, 'all to be sent')
    driver.send_until(lambda: driver.forces[-1] > before + sent, 'the end of it')
    of_those = [force for force in driver.forces if before < force <= max(intact)]
    assert set(of_those) <= intact | set(range(before + 1, min(intact)))
    assert len(of_those) == len(set(of_those))
    assert len(intact) > 200
    assert sent - len(intact) > 200
    # Only a loaded machine makes readings late; what is not late has come, or is dropped.
    driver.wait_for(
        lambda: driver.dropped() + driver.counted('late') >= sent - len(of_those),
        'what has not come to be counted by reason',
    )
    assert driver.counted('dropped: wrong checksum') > 0


def test_line_noise_without_line_ends_does_not_fill_the_memory(driver: Driver):
    driver.start()
    driver.connect()
    status = Path(f'/proc/{driver.process.pid}/status')

    def memory() -> int:
        (line,) = [line for line in status.read_text().splitlines() if line.startswith('VmRSS')]
        return int(line.split()[1])  # [kB]

    before = memory()
    noise = b'x' * 2**20
    for _ in range(64):
        driver.send(noise)
    driver.send(b'\n')
    driver.send_until(lambda: driver.counted('bytes') > 64 * 2**20, 'all bytes to be read')
    driver.send_until(lambda: driver.says('reading', DiagnosticStatus.OK), 'all to be well')
    assert memory() - before < 16 * 1024
    assert driver.counted('dropped: no line end') == 1


def test_lifecycle_transitions_in_every_order_and_the_device_is_free_unless_active(driver: Driver):
    driver.start(autostart=False)
    allowed = {
        ('unconfigured', Transition.TRANSITION_CONFIGURE): 'inactive',
        ('inactive', Transition.TRANSITION_ACTIVATE): 'active',
        ('active', Transition.TRANSITION_DEACTIVATE): 'inactive',
        ('inactive', Transition.TRANSITION_CLEANUP): 'unconfigured',
    }
    names = [
        Transition.TRANSITION_CONFIGURE,
        Transition.TRANSITION_ACTIVATE,
        Transition.TRANSITION_DEACTIVATE,
        Transition.TRANSITION_CLEANUP,
    ]
    order = random.Random(2).choices(names, k=30)
    # Every pair of transitions, and some by chance.
    order += [wanted for pair in itertools.product(names, names) for wanted in pair]
    state = 'unconfigured'
    activations = 0
    for wanted in order:
        expected = allowed.get((state, wanted))
        assert driver.observer.change_state('sensor_driver', wanted) == (expected is not None)
        if state == 'active' and expected:
            driver.wait_for(driver.released, 'the device to be let go of')
            driver.hang_up()
        if expected == 'active':
            driver.connect()
            activations += 1
        state = expected or state
    assert activations >= 3
    if state == 'unconfigured':
        assert driver.observer.change_state('sensor_driver', Transition.TRANSITION_CONFIGURE)
    if state != 'active':
        assert driver.observer.change_state('sensor_driver', Transition.TRANSITION_ACTIVATE)
        driver.connect()
    assert driver.observer.change_state('sensor_driver', Transition.TRANSITION_ACTIVE_SHUTDOWN)
    driver.wait_for(driver.released, 'the device to be let go of')
    assert not driver.observer.change_state('sensor_driver', Transition.TRANSITION_ACTIVATE)
    driver.process.send_signal(signal.SIGINT)
    assert driver.process.wait(PATIENCE) == 0


def test_host_that_does_not_answer_keeps_nobody_waiting(
    nodes: NodeProcesses, observer: Observer, listener: socket.socket
):
    # A full queue of connections that nobody accepts: the next one gets no answer.
    listener.listen(0)
    with contextlib.ExitStack() as stack:
        for _ in range(4):
            waiting = stack.enter_context(socket.socket())
            waiting.setblocking(False)
            with contextlib.suppress(BlockingIOError):
                waiting.connect(listener.getsockname())
        driver = Driver(nodes, observer, listener)
        driver.start()
        driver.wait_for(
            lambda: driver.says('device not there', DiagnosticStatus.ERROR), 'the driver to miss it'
        )
        began = time.monotonic()
        for wanted in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_ACTIVATE) * 3:
            assert observer.change_state('sensor_driver', wanted)
        driver.process.send_signal(signal.SIGINT)
        assert driver.process.wait(PATIENCE) == 0
        assert time.monotonic() - began < 5.0  # in which pyserial would give up once


def test_peer_of_rfc_2217_that_speaks_no_telnet_ends_nothing(driver: Driver):
    driver.start(scheme='rfc2217')
    driver.accept()
    driver.send(b'\xff\xf0')  # the end of a subnegotiation that nobody began
    driver.wait_for(lambda: '; trying again' in driver.log, 'the driver to give up for now')
    assert driver.process.poll() is None
    driver.accept()


def test_no_reading_without_a_time_to_stamp_it_with(driver: Driver):
    driver.start(use_sim_time=True)
    driver.accept()
    driver.send_until(
        lambda: driver.says('no simulated time yet', DiagnosticStatus.WARN), 'the lack of time'
    )
    assert driver.counted('unstamped') > 0
    assert not driver.readings


@pytest.mark.parametrize(
    ('device', 'complaint'),
    [
        ('', "expected a path or a URL of pyserial, got ''"),
        (
            'socket://127.0.0.1',
            "expected socket://host:port, a port up to 65535, got 'socket://127.0.0.1'",
        ),
        ('nonsense://x', "invalid URL, protocol 'nonsense' not known"),
    ],
)
def test_device_of_no_kind_ends_the_driver_with_one_line(
    nodes: NodeProcesses, device: str, complaint: str
):
    process = nodes.start('sensor_driver', {'device': device})
    assert process.wait(PATIENCE) == 2
    assert nodes.log('sensor_driver').read_text() == (
        f'sensor_driver: parameter device: {complaint}\n'
    )


def test_port_in_use_ends_the_plant_with_one_line(nodes: NodeProcesses, listener: socket.socket):
    port = listener.getsockname()[1]
    plant = nodes.start('sim_plant', {'device': f'socket://127.0.0.1:{port}'})
    assert plant.wait(60.0) == 2
    said = nodes.log('sim_plant').read_text()
    assert said == (f'sim_plant: parameter device: 127.0.0.1:{port}: Address already in use\n')
