# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes as processes: a domain of their own, parameters as the command line takes them, the end."""

import contextlib
import fcntl
import math
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402

from support.waiting import PATIENCE, wait_for  # noqa: E402
from tactile_push.testing.processes import DOMAINS, NodeProcesses, loopback, yaml_value  # noqa: E402


def start_program(nodes, name, program):
    """Start a Python program in place of a node, which costs less time."""
    return nodes.run(name, [sys.executable, '-c', program])


def test_environment_keeps_the_nodes_to_themselves(tmp_path, monkeypatch):
    monkeypatch.setenv('A_VARIABLE', 'kept')
    monkeypatch.setenv('ROS_DOMAIN_ID', '77')
    with NodeProcesses(tmp_path) as nodes:
        assert nodes.domain in DOMAINS
        assert nodes.environment['ROS_DOMAIN_ID'] == str(nodes.domain)
        assert nodes.environment.items() >= loopback().items()
        assert nodes.environment['ROS_LOG_DIR'].startswith(str(tmp_path))
        assert nodes.environment['A_VARIABLE'] == 'kept'
        assert os.environ['ROS_DOMAIN_ID'] == '77'


def sockets_of(process):
    """Give the local addresses of a process's TCP and UDP sockets, as the kernel writes them."""
    inodes = set()
    for file in Path(f'/proc/{process.pid}/fd').iterdir():
        with contextlib.suppress(FileNotFoundError):  # closed meanwhile
            inodes.add(os.readlink(file).removeprefix('socket:[').rstrip(']'))
    return [
        line.split()[1]
        for table in ('udp', 'udp6', 'tcp', 'tcp6')
        for line in Path(f'/proc/{process.pid}/net/{table}').read_text().splitlines()[1:]
        if line.split()[9] in inodes
    ]


def test_nodes_talk_over_the_loopback_and_nothing_else(tmp_path):
    with NodeProcesses(tmp_path) as nodes:
        process = nodes.start('contact_geometry')
        context = Context()
        rclpy.init(context=context, domain_id=nodes.domain)
        observer = rclpy.create_node('observer', context=context)
        wait_for(lambda: 'contact_geometry' in observer.get_node_names(), 'the node')
        addresses = {address.partition(':')[0] for address in sockets_of(process)}
        mapped = Path(f'/proc/{process.pid}/maps').read_text()
        observer.destroy_node()
        rclpy.shutdown(context=context)
    assert addresses == {'0100007F'}
    assert '/dev/shm/fast' not in mapped


def test_another_middleware_is_asked_to_stay_on_this_machine(monkeypatch):
    monkeypatch.setenv('RMW_IMPLEMENTATION', 'rmw_cyclonedds_cpp')
    assert loopback() == {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}


def test_domains_need_no_port_that_the_system_gives_away():
    # DDS: ports from 7400 + 250 * domain on, for up to 250 ports; Linux gives away 32768 and up.
    assert max(DOMAINS) <= (32768 - 7400 - 250) / 250
    assert min(DOMAINS) > 0  # 0 is everybody's


def test_no_two_share_a_domain(tmp_path):
    held = [NodeProcesses(tmp_path) for _ in range(12)]
    assert len({nodes.domain for nodes in held}) == 12
    for nodes in held:
        nodes.stop()


def test_other_processes_do_not_get_a_domain_that_is_held(tmp_path):
    program = (
        'import sys, tempfile\n'
        'from pathlib import Path\n'
        'from tactile_push.testing import processes\n'
        'processes.DOMAINS = range(41, 43)\n'
        'nodes = processes.NodeProcesses(Path(sys.argv[1]))\n'
        'print(nodes.domain, flush=True)\n'
        'sys.stdin.read()\n'
    )

    def start():
        return subprocess.Popen(
            [sys.executable, '-c', program, str(tmp_path)],
            # Locks of their own, so that no real run is in the way.
            env={**os.environ, 'TMPDIR': str(tmp_path)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    first, second = start(), start()
    domains = {first.stdout.readline().strip(), second.stdout.readline().strip()}
    third = start()
    _, complaint = third.communicate(timeout=PATIENCE)
    first.communicate(timeout=PATIENCE)
    fourth = start()
    assert fourth.stdout.readline().strip() in domains  # it was given back
    for process in (second, fourth):
        process.communicate(timeout=PATIENCE)
    assert domains == {'41', '42'}
    assert third.returncode == 1
    assert 'all ROS domains are in use' in complaint


def test_domain_is_given_back_when_all_is_stopped(tmp_path):
    nodes = NodeProcesses(tmp_path)
    path = nodes._lock.name
    with open(path, 'wb') as lock, pytest.raises(BlockingIOError):
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    nodes.stop()
    with open(path, 'wb') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)


def test_node_gets_its_parameters_and_ends_with_the_block(tmp_path):
    config = tmp_path / 'config.yaml'
    config.write_text(
        '/**:\n  ros__parameters:\n    finger_radius: 0.02\n    max_out_of_plane: 0.5\n'
    )
    with NodeProcesses(tmp_path) as nodes:
        process = nodes.start(
            'contact_geometry',
            {'finger_radius': 7.0},
            config=config,
            name='geometry',
            arguments=('-r', '__ns:=/left'),
        )
        assert nodes.running == {'geometry': process}
        process.wait(PATIENCE)
        # 7 m is out of range, so the value given here takes precedence over the file's 0.02.
        assert process.returncode == 2
        assert 'got 7.0' in nodes.log('geometry').read_text()
        nodes.start('contact_geometry', {'use_joint_states': False}, config=config)
        context = Context()
        rclpy.init(context=context, domain_id=nodes.domain)
        observer = rclpy.create_node('observer', context=context)
        wait_for(lambda: 'contact_geometry' in observer.get_node_names(), 'the node')
        observer.destroy_node()
        rclpy.shutdown(context=context)
        survivor = nodes.running['contact_geometry']
        assert survivor.poll() is None
    assert survivor.returncode == 0
    assert nodes.log('contact_geometry').read_text() == ''


def test_all_are_interrupted_even_after_an_exception(tmp_path):
    program = (
        'import signal, time\n'
        'def stop(*_):\n'
        "    print('interrupted', flush=True)\n"
        '    raise SystemExit(0)\n'
        'signal.signal(signal.SIGINT, stop)\n'
        "print('up', flush=True)\n"
        'time.sleep(60)\n'
    )
    with pytest.raises(KeyError, match='wrong'), NodeProcesses(tmp_path) as nodes:
        processes = [start_program(nodes, name, program) for name in ('one', 'two')]
        wait_for(lambda: all('up' in nodes.log(name).read_text() for name in nodes.running), 'both')
        raise KeyError('wrong')
    assert [process.returncode for process in processes] == [0, 0]
    assert nodes.log('one').read_text() == 'up\ninterrupted\n'


def test_process_that_does_not_listen_is_killed(tmp_path, monkeypatch):
    monkeypatch.setattr('tactile_push.testing.processes.STOP_TIMEOUT', 0.2)
    program = (
        'import signal, time\n'
        'signal.signal(signal.SIGINT, signal.SIG_IGN)\n'
        "print('up', flush=True)\n"
        'time.sleep(60)\n'
    )
    with NodeProcesses(tmp_path) as nodes:
        process = start_program(nodes, 'deaf', program)
        wait_for(lambda: 'up' in nodes.log('deaf').read_text(), 'the process')
    assert process.returncode == -signal.SIGKILL


def test_process_that_ended_by_itself_keeps_its_status(tmp_path):
    with NodeProcesses(tmp_path) as nodes:
        process = start_program(nodes, 'short', 'import sys; print(1); sys.exit(3)')
        process.wait(PATIENCE)
    assert process.returncode == 3
    assert nodes.log('short').read_text() == '1\n'


def test_stop_may_be_called_before_the_block_ends(tmp_path):
    with NodeProcesses(tmp_path) as nodes:
        process = start_program(nodes, 'short', 'import time; time.sleep(60)')
        nodes.stop()
        assert process.poll() is not None
    nodes.stop()


def test_ctrl_c_at_the_terminal_is_for_the_parent(tmp_path):
    with NodeProcesses(tmp_path) as nodes:
        process = start_program(nodes, 'sleeper', 'import time; time.sleep(60)')
        assert os.getpgid(process.pid) != os.getpgid(0)
        assert os.getsid(process.pid) != os.getsid(0)


VALUES = [
    True,
    False,
    0,
    -7,
    12345678901,
    0.0,
    1.0,
    -2.5,
    0.1,
    1e-05,
    1e22,
    math.pi,
    math.inf,
    -math.inf,
    'block',
    '/dev/ttyUSB0',
    '/tmp/with space/sensor',
    'socket://127.0.0.1:54320',
    '12',
    '1.5',
    'true',
    'on',
    'no',
    '~',
    '',
    "it's",
    '/tmp/a #b',
    'key: value',
    '{x}',
    '[x]',
    '- x',
    '*x',
    '&x',
    '!x',
    '%x',
    '@x',
    '"quoted"',
    'back\\slash',
    'été',
    ['a', 'b'],
    ['with space', 'with, comma'],
    ['1', 'true'],
]


@pytest.fixture(scope='module')
def as_rcl_reads_them():
    """Return what rcl makes of all values: those of a node with a command line of them all."""
    arguments = ['--ros-args', '--log-level', 'fatal']
    context = Context()
    rclpy.init(context=context)

    def read(value):
        node = rclpy.create_node(
            'reader',
            context=context,
            cli_args=[*arguments, '-p', f'value:={yaml_value(value)}'],
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            automatically_declare_parameters_from_overrides=True,
        )
        try:
            return node.get_parameter('value').value
        finally:
            node.destroy_node()

    yield read
    rclpy.shutdown(context=context)


@pytest.mark.parametrize('value', VALUES, ids=repr)
def test_value_reaches_the_node_as_it_is(as_rcl_reads_them, value):
    read = as_rcl_reads_them(value)
    assert type(read) is type(value)
    assert read == value


def test_number_of_numpy_reaches_the_node_as_a_number(as_rcl_reads_them):
    assert as_rcl_reads_them(np.float64(0.6)) == 0.6


def test_nan_reaches_the_node_as_nan(as_rcl_reads_them):
    assert math.isnan(as_rcl_reads_them(math.nan))
