# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`bag_recorder` as a process: what is in its bags however it ends."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mcap.exceptions import EndOfFile
from mcap.reader import NonSeekingReader, make_reader
from mcap_ros2.decoder import DecoderFactory
from sensor_msgs.msg import JointState

from tactile_push.parameters.config_file import config_file
from tactile_push.testing import NodeProcesses, Observer


class Sender:
    """Publishes numbered joint states."""

    def __init__(self, observer: Observer, topic: str = 'tactile') -> None:
        self._observer = observer
        self._publisher = observer.node.create_publisher(JointState, topic, 1000)
        self.sent: list[int] = []  # when each was published, by the system's clock [ns]

    def wait_until_heard(self) -> None:
        self._observer.wait_for(self._publisher.get_subscription_count, 'the recorder')

    def send(self, count: int = 1) -> None:
        for _ in range(count):
            message = JointState(position=[float(len(self.sent))])
            self.sent.append(time.time_ns())
            self._publisher.publish(message)

    def send_for(self, duration: float) -> None:
        """Publish 200 messages a second."""
        end = time.monotonic() + duration
        while time.monotonic() < end:
            self.send()
            time.sleep(0.005)


@pytest.fixture
def sender(observer: Observer) -> Sender:
    return Sender(observer)


def numbers(path: Path) -> list[float]:
    """Give the numbers in a file that may have been cut off."""
    read = []
    with path.open('rb') as stream:
        reader = NonSeekingReader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        try:
            for *_, decoded in reader.iter_decoded_messages(log_time_order=False):
                read.append(decoded.position[0])
        except EndOfFile:
            pass
    return read


def information(bag: Path) -> dict[str, Any]:
    return yaml.safe_load((bag / 'metadata.yaml').read_text())['rosbag2_bagfile_information']


@pytest.mark.parametrize('signum', [signal.SIGINT, signal.SIGTERM])
def test_interrupted_recorder_finishes_its_bag(
    nodes: NodeProcesses, observer: Observer, sender: Sender, tmp_path: Path, signum: int
):
    bag = tmp_path / 'bag'
    diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
    process = nodes.start('bag_recorder', {'output': str(bag)})
    sender.wait_until_heard()
    sender.send(300)

    def counted() -> bool:
        values = [{v.key: v.value for v in s.values} for a in diagnostics for s in a.status]
        return any(entry.get('/tactile') == '300' for entry in values)

    observer.wait_for(counted, 'the count in the diagnostics')
    process.send_signal(signum)
    assert process.wait(30.0) == 0
    with (bag / 'bag_0.mcap').open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        messages = list(reader.iter_decoded_messages(topics=['/tactile']))
    assert [decoded.position[0] for *_, decoded in messages] == list(range(300))
    # Sent and received in order, on the system's clock.
    for (_, _, message, _), sent in zip(messages, sender.sent, strict=True):
        assert sent <= message.publish_time <= message.log_time
    counts = {
        entry['topic_metadata']['name']: entry['message_count']
        for entry in information(bag)['topics_with_message_count']
    }
    assert counts['/tactile'] == 300
    assert counts['/diagnostics'] > 0
    log = nodes.log('bag_recorder').read_text()
    assert log.count('recording /tactile (sensor_msgs/msg/JointState)') == 1
    assert f'into {bag}' in log.splitlines()[-1]


@pytest.mark.parametrize('attempt', range(4))  # each at another moment
def test_killed_recorder_loses_less_than_a_second(
    nodes: NodeProcesses, sender: Sender, tmp_path: Path, attempt: int
):
    bag = tmp_path / 'bag'
    process = nodes.start('bag_recorder', {'output': str(bag), 'topics': ['tactile']})
    sender.wait_until_heard()
    sender.send_for(random.uniform(0.0, 3.0))
    process.kill()
    killed = time.time_ns()
    process.wait()
    assert [path.name for path in bag.iterdir()] == ['bag_0.mcap']
    read = numbers(bag / 'bag_0.mcap')
    assert read == list(range(len(read)))
    lost = sender.sent[len(read) :]
    assert not lost or killed - lost[0] < 1_000_000_000


def test_files_follow_one_another_and_nothing_is_lost_between(
    nodes: NodeProcesses, sender: Sender, observer: Observer, tmp_path: Path
):
    bag = tmp_path / 'bag'
    settings = {'topics': ['tactile'], 'max_duration': 0.5, 'compression': 'lz4'}
    process = nodes.start('bag_recorder', {'output': str(bag), **settings})
    sender.wait_until_heard()
    sender.send_for(2.0)
    observer.wait_for(lambda: (bag / 'bag_2.mcap').exists(), 'the third file')
    process.send_signal(signal.SIGINT)
    assert process.wait(30.0) == 0
    files = [entry['path'] for entry in information(bag)['files']]
    assert files == [f'bag_{i}.mcap' for i in range(len(files))]
    assert len(files) >= 3
    read = [number for file in files for number in numbers(bag / file)]
    # All of what was sent before the recorder was told to end; the last ones were on their way.
    assert read == list(range(len(read)))
    assert len(read) > len(sender.sent) - 20


def test_simulated_time_and_parameters_of_the_rig(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    bag, device = tmp_path / 'bag', str(tmp_path / 'sensor')
    nodes.start('bag_recorder', {'output': str(bag), 'use_sim_time': True})
    plant = {'device': device, 'publish_clock': True, 'real_time_factor': 10.0}
    simulated = {'use_sim_time': True}
    nodes.start('sim_plant', plant, config=config_file('block.yaml'))
    nodes.start('sensor_driver', {'device': device, **simulated})
    nodes.start('contact_geometry', simulated, config=config_file('block.yaml'))
    nodes.start('push_controller', {'kp': 0.07, **simulated}, config=config_file('block.yaml'))
    commands = observer.hear(JointState, 'push_controller/state')
    mcap = bag / 'bag_0.mcap'
    nodes_with_parameters = [b'"push_controller"', b'"sim_plant"', b'"contact_geometry"']
    observer.wait_for(
        lambda: (
            len(commands) > 50 and all(name in mcap.read_bytes() for name in nodes_with_parameters)
        ),
        'commands, and parameters in the bag',
    )
    process = nodes.running['bag_recorder']
    process.send_signal(signal.SIGINT)
    assert process.wait(30.0) == 0
    start = information(bag)['starting_time']['nanoseconds_since_epoch']
    assert 0 < start < 600 * 10**9  # simulated time begins at 0
    with mcap.open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        messages = list(reader.iter_decoded_messages(log_time_order=False))
        notes = {
            key: text
            for record in reader.iter_metadata()
            if record.name == 'tactile_push'
            for key, text in record.metadata.items()
        }
    topics = {channel.topic for _, channel, _, _ in messages}
    assert {'/clock', '/tactile', '/contact', '/push_controller/state', '/joint_states'} <= topics
    clock = 0
    for _, channel, message, decoded in messages:
        if channel.topic == '/clock':
            clock = decoded.clock.sec * 10**9 + decoded.clock.nanosec
            assert message.log_time == clock
        elif channel.topic == '/ground_truth/state':
            stamp = decoded.header.stamp.sec * 10**9 + decoded.header.stamp.nanosec
            # Stamped with the plant's time, and received not before; the clock may be a tick late.
            assert 0 <= message.log_time - stamp + 100_000_000 < 2 * 10**9
    parameters = json.loads(notes['tactile_push.parameters'])
    assert parameters['push_controller']['kp'] == 0.07
    assert parameters['sim_plant']['real_time_factor'] == 10.0
    assert information(bag)['custom_data'] == notes
    assert notes['tactile_push.version'].count('.') == 2


@pytest.mark.parametrize(
    ('parameters', 'expected'),
    [
        ({'output': 'there'}, 'parameter output: '),
        ({'output': '/proc/nowhere/bag'}, 'parameter output: '),
        ({'topics': ['a b']}, "parameter topics: expected names of topics, got 'a b'"),
        ({'topics': []}, 'parameter topics: expected'),
        ({'compression': 'gzip'}, 'parameter compression: expected one of zstd, lz4, none'),
        ({'max_size': -1}, 'parameter max_size: expected a whole number'),
        ({'max_duration': -1.0}, 'parameter max_duration: expected a number'),
        ({'outputt': 'bag'}, 'parameter outputt: unknown, did you mean output?'),
    ],
)
def test_bad_parameter_ends_the_recorder_with_one_line_and_no_bag(
    nodes: NodeProcesses, tmp_path: Path, monkeypatch, parameters: dict, expected: str
):
    folder = tmp_path / 'work'
    (folder / 'there').mkdir(parents=True)
    monkeypatch.chdir(folder)
    assert nodes.start('bag_recorder', parameters).wait(30.0) == 2
    said = nodes.log('bag_recorder').read_text()
    assert said.count('\n') == 1
    assert expected in said
    assert [path.name for path in folder.iterdir()] == ['there']
    assert list((folder / 'there').iterdir()) == []


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Give the folder of a file system with room for 300 kB, to be left before the recorder."""
    folder = tmp_path / 'small'
    folder.mkdir()
    mount = ['mount', '-t', 'tmpfs', '-o', 'size=300k', 'tmpfs', str(folder)]
    if subprocess.run(mount, capture_output=True).returncode != 0:
        pytest.skip('no file system can be mounted here')
    yield folder
    subprocess.run(['umount', '--lazy', str(folder)], check=True)


def test_full_disk_ends_the_recorder_with_one_clear_error(
    small_disk: Path, nodes: NodeProcesses, observer: Observer, sender: Sender
):
    bag = small_disk / 'bag'
    settings = {'topics': ['tactile'], 'compression': 'none'}
    process = nodes.start('bag_recorder', {'output': str(bag), **settings})
    sender.wait_until_heard()

    def ended() -> bool:
        sender.send(20)
        return process.poll() is not None

    observer.wait_for(ended, 'the end of the recorder')
    assert process.returncode == 1
    path = bag / 'bag_0.mcap'
    lines = nodes.log('bag_recorder').read_text().splitlines()
    errors = [line for line in lines if not line.startswith('[INFO]')]
    assert errors == [f'bag_recorder: {path}: No space left on device']
    assert [file.name for file in bag.iterdir()] == ['bag_0.mcap']
    read = numbers(path)
    assert read == list(range(len(read)))
    assert len(read) > 1000
    (said,) = [line for line in lines if 'recorded at most ' in line]
    # A chunk did not fit, or what follows it in the file: then all its messages are there.
    assert int(said.split('at most ')[1].split()[0]) >= len(read)


def test_command_records_until_it_is_interrupted(
    nodes: NodeProcesses, observer: Observer, sender: Sender, tmp_path: Path
):
    bag = tmp_path / 'bag'
    command = [sys.executable, '-m', 'tactile_push.cli', 'record', '-o', str(bag), 'tactile']
    process = subprocess.Popen(
        command,
        env={**nodes.environment, 'PYTHONPATH': os.pathsep.join(sys.path)},
        stderr=subprocess.PIPE,
        text=True,
    )
    sender.wait_until_heard()
    sender.send(10)
    observer.wait_for(lambda: len(numbers(bag / 'bag_0.mcap')) == 10, 'the messages')
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=30.0)[1]
    assert process.returncode == 0
    assert 'Traceback' not in said
    assert 'recorded 10 messages' in said.splitlines()[-1]
    assert information(bag)['message_count'] == 10
