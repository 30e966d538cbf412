# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node as a process: its help, its refusals and its end, as a shell sees them."""

import contextlib
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402

from tactile_push.parameters import ContactGeometryParameters  # noqa: E402
from tactile_push.testing.processes import NodeProcesses  # noqa: E402

PATIENCE = 60.0  # [s]


@pytest.fixture(scope='module')
def environment(tmp_path_factory):
    """Return the environment of nodes that nobody else hears."""
    with NodeProcesses(tmp_path_factory.mktemp('nodes')) as nodes:
        yield nodes.environment


@pytest.fixture(scope='module')
def observer(environment):
    """Return a node in the domain of the processes, to see which nodes are there."""
    context = Context()
    rclpy.init(context=context, domain_id=int(environment['ROS_DOMAIN_ID']))
    node = rclpy.create_node('observer', context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def command(node, *arguments):
    return [sys.executable, '-m', f'tactile_push.nodes.{node}', *arguments]


def finish(environment, node, *arguments):
    """Run a node that ends by itself."""
    return subprocess.run(
        command(node, *arguments), env=environment, capture_output=True, text=True, timeout=PATIENCE
    )


@contextlib.contextmanager
def running(environment, observer, node, *arguments):
    """Start a node and wait until the graph shows it."""
    process = subprocess.Popen(
        command(node, *arguments),
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        deadline = time.monotonic() + PATIENCE
        while node not in observer.get_node_names():
            assert process.poll() is None, process.communicate()[1]
            assert time.monotonic() < deadline, 'the node does not appear'
            time.sleep(0.02)
        yield process
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.mark.parametrize('signum', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_ends_a_node_in_silence(environment, observer, signum):
    with running(environment, observer, 'contact_geometry') as process:
        process.send_signal(signum)
        out, err = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0
        assert (out, err) == ('', '')
    deadline = time.monotonic() + PATIENCE
    while 'contact_geometry' in observer.get_node_names():
        assert time.monotonic() < deadline, 'the node stays in the graph'
        time.sleep(0.02)


@pytest.mark.parametrize('signum', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('by_name', [False, True])
def test_signal_during_the_imports_ends_a_node_in_silence(environment, signum, by_name):
    script = Path(sys.executable).with_name('sim_plant')
    if by_name and not script.exists():
        pytest.skip('the commands are not beside Python: pip install . puts them there')
    process = subprocess.Popen(
        [str(script)] if by_name else command('sim_plant'),
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    maps = Path(f'/proc/{process.pid}/maps')
    while 'numpy' not in maps.read_text():  # of what a node imports, among the first
        assert process.poll() is None
        time.sleep(0.001)
    process.send_signal(signum)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out, err) == (0, '', '')


def test_node_that_shall_outlive_its_terminal_does(environment, observer):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does; children inherit it
    try:
        with running(environment, observer, 'contact_geometry') as process:
            process.send_signal(signal.SIGHUP)
            with pytest.raises(subprocess.TimeoutExpired):
                process.wait(1.0)
    finally:
        signal.signal(signal.SIGHUP, before)


def test_second_signal_does_not_disturb_the_end(environment, observer):
    with running(environment, observer, 'push_controller') as process:
        for _ in range(3):
            process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0
        assert (out, err) == ('', '')


def run_program(environment, program):
    """Run a program that makes a node of its own and interrupts it."""
    preamble = """
import ctypes, os, signal, sys, time
import rclpy
from rclpy.node import Node
from tactile_push.nodes.ros import process
from tactile_push.nodes.ros.parameters import ConfigurationError

class Own(Node):
    NAME = 'own'

    def __init__(self):
        super().__init__(self.NAME)
        self.create_timer(0.01, lambda: signal.raise_signal(signal.SIGINT))

def hold():
    ctypes.PyDLL(None).sleep(30)  # with the interpreter's lock, so that no thread runs
    os._exit(7)

"""
    return subprocess.run(
        [sys.executable, '-c', preamble + program],
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )


def test_middleware_that_does_not_let_go_of_a_node_does_not_keep_it(environment):
    program = """
from rclpy.impl.implementation_singleton import rclpy_implementation

class Handle(rclpy_implementation.Node):
    leaving = False

    def destroy_when_not_in_use(self):
        super().destroy_when_not_in_use()
        self.leaving = True
        if not self.pointer:
            hold()

    def __exit__(self, *exception):
        super().__exit__(*exception)
        if self.leaving:
            hold()

rclpy_implementation.Node = Handle
sys.exit(process.run(Own))
"""
    done = run_program(environment, program)
    assert (done.returncode, done.stdout, done.stderr) == (0, '', '')


def test_middleware_that_does_not_let_go_of_a_refused_node_does_not_keep_it(environment):
    program = """
class Refused(Own):
    def __init__(self):
        super().__init__()
        raise ConfigurationError('no such thing')

rclpy.try_shutdown = hold
sys.exit(process.run(Refused))
"""
    done = run_program(environment, program)
    assert (done.returncode, done.stdout, done.stderr) == (2, '', 'own: no such thing\n')


@pytest.mark.parametrize(('end', 'status'), [('pass', 0), ('raise OSError(28, "full")', 1)])
def test_node_may_take_its_time_to_end(environment, end, status):
    program = f"""
class Slow(Own):
    def destroy_node(self):
        time.sleep(3.0 * process.FAREWELL)
        print('done', flush=True)
        super().destroy_node()
        {end}

process.FAREWELL = 0.2
sys.exit(process.run(Slow))
"""
    done = run_program(environment, program)
    assert (done.returncode, done.stdout) == (status, 'done\n')
    assert done.stderr == ('own: full\n' if status else '')


def test_node_that_has_ended_says_what_waits_and_is_not_taken_apart(environment):
    program = """
import atexit

class Taken:
    def __del__(self):
        os.write(1, b'apart')

taken = Taken()
atexit.register(print, 'done')
print('waits')
sys.exit(process.run(Own))
"""
    done = run_program(environment, program)
    assert (done.returncode, done.stdout, done.stderr) == (0, 'waits\ndone\n', '')


def test_first_message_that_is_logged_keeps_no_tick_waiting(environment):
    # rclpy seeks its caller among the files of all modules, and looks at each file that it has not
    # seen before. On a loaded machine a look takes a millisecond, and there are hundreds of files.
    program = """
class Logs(Node):
    NAME = 'logs'

    def __init__(self):
        super().__init__(self.NAME)
        self.create_timer(0.01, self.tick)

    def tick(self):
        looks = []
        real = os.path.realpath
        os.path.realpath = lambda path: looks.append(path) or real(path)
        self.get_logger().info('first')
        os.path.realpath = real
        print(len(looks), len(sys.modules))
        signal.raise_signal(signal.SIGINT)

sys.exit(process.run(Logs))
"""
    done = run_program(environment, program)
    looks, modules = map(int, done.stdout.split())
    assert modules > 300
    assert looks < 20


def test_help_lists_every_parameter_with_default_and_unit(environment):
    done = finish(environment, 'contact_geometry', '--help')
    assert (done.returncode, done.stderr) == (0, '')
    lines = done.stdout.splitlines()
    assert lines[0].startswith('usage: contact_geometry')
    declared = ContactGeometryParameters.declared()
    assert len(declared) >= 6
    for parameter in declared:
        (index,) = (
            number
            for number, line in enumerate(lines)
            if line.split(' := ')[0].strip() == parameter.name
        )
        assert lines[index].endswith(f':= {parameter.default}')
        assert parameter.words in lines[index + 1]
        if parameter.unit:
            assert lines[index + 1].count(f'[{parameter.unit}]') == 1
    assert "effective radius of the finger's disk; a number with a decimal point [m]" in done.stdout
    assert 'from 0.0001 to 1' in done.stdout
    assert max(map(len, lines)) < 200


def test_help_whose_reader_has_read_enough_ends_in_silence(environment):
    process = subprocess.Popen(
        command('push_controller', '--help'),
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    process.stdout.close()  # while the node still imports
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == (-signal.SIGPIPE, b'')  # 141 in a shell


@pytest.mark.skipif(not Path('/dev/full').exists(), reason='needs /dev/full')
def test_help_that_cannot_be_written_is_said_in_one_line(environment):
    with open('/dev/full', 'w') as full:
        done = subprocess.run(
            command('push_controller', '--help'),
            env=environment,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=PATIENCE,
        )
    assert done.returncode == 2
    assert done.stderr == 'push_controller: standard output: No space left on device\n'


def test_help_is_plain_where_the_terminal_knows_few_characters(environment):
    done = finish({**environment, 'PYTHONIOENCODING': 'ascii'}, 'push_controller', '--help')
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.isascii()
    assert '...' in done.stdout


def refused(environment, *arguments, node='contact_geometry'):
    """Return the one line with which a node refuses to start."""
    done = finish(environment, node, *arguments)
    assert done.returncode == 2
    assert done.stdout == ''
    assert 'Traceback' not in done.stderr
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith(f'{node}: ')
    return lines[0]


@pytest.mark.parametrize(
    ('assignment', 'words'),
    [
        (
            'finger_radius:=-0.5',
            'parameter finger_radius: expected a number with a decimal point [m] '
            'from 0.0001 to 1, got -0.5',
        ),
        (
            'max_out_of_plain:=0.5',
            'parameter max_out_of_plain: unknown, did you mean max_out_of_plane?',
        ),
    ],
)
def test_bad_parameter_is_refused_on_one_line(environment, assignment, words):
    assert refused(environment, '--ros-args', '-p', assignment) == f'contact_geometry: {words}'


def test_broken_parameter_file_is_refused_on_one_line(environment, tmp_path):
    path = tmp_path / 'broken.yaml'
    path.write_text('contact_geometry:\n  ros__parameters: [1, 2\n')
    line = refused(environment, '--ros-args', '--params-file', str(path))
    assert 'broken.yaml' in line


def test_missing_parameter_file_is_refused_on_one_line(environment, tmp_path):
    path = tmp_path / 'missing.yaml'
    assert 'missing.yaml' in refused(environment, '--ros-args', '--params-file', str(path))


@pytest.mark.parametrize(
    'arguments',
    [
        ('--ros-args', '-r', '__ns:=bad//name'),  # rcl would warn of it, too
        ('--ros-args', '-p', 'nothing'),
        ('nonsense',),
    ],
    ids=' '.join,
)
def test_bad_argument_is_refused_on_one_line(environment, arguments):
    assert arguments[-1] in refused(environment, *arguments)


def test_place_that_cannot_be_served_is_refused_by_name(environment, tmp_path):
    place = tmp_path / 'nowhere' / 'sensor'
    line = refused(environment, '--ros-args', '-p', f'device:={place}', node='sim_plant')
    assert line.startswith('sim_plant: parameter device: ')
    assert str(place) in line
