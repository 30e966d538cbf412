# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from support.waiting import PATIENCE, wait_for
from tactile_push.testing import fork_server
from tactile_push.testing.fork_server import fork_node

SPIN = ['--ros-args', '--log-level', 'fatal']


@pytest.fixture
def log(tmp_path):
    """Return the file in which a node's output ends."""
    with (tmp_path / 'log').open('ab') as file:
        yield file


@pytest.fixture
def environment():
    """Return an environment in which a node stays on this machine."""
    return {**os.environ, 'A_VARIABLE': 'kept'}


@pytest.fixture
def node(log, environment):
    """Start a node that runs until the test ends."""
    process = fork_node('contact_geometry', SPIN, environment, log)
    yield process
    process.kill()
    process.wait(PATIENCE)


def has_ended(pid):
    """Return whether a process is gone."""
    return not Path(f'/proc/{pid}').exists()


def test_node_is_a_process_in_a_session_of_its_own(node):
    assert node.pid not in (os.getpid(), fork_server._server()[1].pid)
    assert os.getsid(node.pid) == node.pid


def test_streams_of_the_node_are_the_log_and_nothing_to_read(node, log):
    streams = [os.readlink(f'/proc/{node.pid}/fd/{number}') for number in range(3)]
    assert streams == [os.devnull, log.name, log.name]


def test_node_has_arguments_environment_and_folder_of_whoever_starts_it(
    log, environment, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    Path('settings.yaml').write_text('contact_geometry:\n  ros__parameters: {finger_radius: 7.0}\n')
    arguments = ['--ros-args', '--params-file', 'settings.yaml']
    node = fork_node('contact_geometry', arguments, environment, log)
    assert node.wait(PATIENCE) == 2
    assert 'got 7.0' in Path(log.name).read_text()
    environment['ROS_DOMAIN_ID'] = 'none'
    node = fork_node('contact_geometry', SPIN, environment, log)
    assert node.wait(PATIENCE) == 2
    assert 'ROS_DOMAIN_ID' in Path(log.name).read_text()


def test_signal_ends_the_node_as_the_node_wants(node, log):
    # Like everybody's, its own handler is there once it has begun to run.
    signals = Path(f'/proc/{node.pid}/status')
    caught = 1 << (signal.SIGTERM - 1)
    wait_for(
        lambda: int(signals.read_text().split('SigCgt:')[1].split()[0], 16) & caught, 'the handler'
    )
    assert node.poll() is None
    node.send_signal(signal.SIGTERM)
    assert node.wait(PATIENCE) == 0
    assert node.poll() == node.returncode == 0
    assert Path(log.name).read_text() == ''
    node.send_signal(signal.SIGTERM)  # to nobody


def test_killed_node_is_gone_with_the_status_of_the_signal(node):
    node.kill()
    assert node.wait(PATIENCE) == -signal.SIGKILL
    wait_for(lambda: has_ended(node.pid), 'its end')


def test_wait_has_an_end(node):
    with pytest.raises(subprocess.TimeoutExpired, match='contact_geometry'):
        node.wait(0.01)
    assert node.returncode is None


def test_server_ends_with_whoever_started_it(tmp_path):
    program = (
        'import os\n'
        'from tactile_push.testing import fork_server\n'
        f"log = open({str(tmp_path / 'log')!r}, 'ab')\n"
        f"node = fork_server.fork_node('contact_geometry', {SPIN}, os.environ, log)\n"
        'node.kill()\n'
        'node.wait()\n'
        'print(fork_server._server()[1].pid)\n'
    )
    done = subprocess.run([sys.executable, '-c', program], capture_output=True, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, b'')
    wait_for(lambda: has_ended(int(done.stdout)), 'its end')


def test_server_that_has_ended_is_said(log, environment, monkeypatch):
    ours, theirs = fork_server.socket.socketpair(
        fork_server.socket.AF_UNIX, fork_server.socket.SOCK_SEQPACKET
    )
    theirs.close()
    monkeypatch.setattr(fork_server, '_server', lambda: (ours, None))
    with ours, pytest.raises(RuntimeError, match='the process that starts the nodes has ended'):
        fork_node('contact_geometry', SPIN, environment, log)


def test_end_of_a_node_that_nobody_waits_for_is_told_to_nobody():
    program = (
        'import os\n'
        'from tactile_push.testing.fork_server import fork_node\n'
        "with open(os.devnull, 'ab') as log:\n"
        f"    node = fork_node('contact_geometry', {SPIN}, dict(os.environ), log)\n"
        'node._watcher.close()\n'
        'os.kill(node.pid, 9)\n'
    )
    done = subprocess.run([sys.executable, '-c', program], capture_output=True, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, b'')


def test_node_ends_with_whoever_started_it_even_if_that_is_killed(tmp_path, environment):
    starts = (
        'import os, sys, time\n'
        'from tactile_push.testing.fork_server import fork_node\n'
        f'log = open({str(tmp_path / "log")!r}, "ab")\n'
        f'node = fork_node("contact_geometry", {SPIN}, dict(os.environ), log)\n'
        'print(node.pid, flush=True)\n'
        'time.sleep(600.0)\n'
    )
    command = [sys.executable, '-c', starts]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) as starter:
        pid = int(starter.stdout.readline())
        assert not has_ended(pid)
        starter.kill()
    wait_for(lambda: has_ended(pid), 'the end of the node')
    assert (tmp_path / 'log').read_text() == ''


def test_node_that_has_ended_by_itself_is_not_ended_again():
    asker, reported = socket.socketpair()
    asker.close()
    ended = subprocess.Popen([sys.executable, '-c', ''])
    ended.wait()
    fork_server._end_with_the_asker(reported, ended.pid)
    reported.close()
