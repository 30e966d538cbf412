# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags played to real nodes, by the node and by the command."""

import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Int64, String
from std_srvs.srv import SetBool, Trigger

from support.on_terminal import OnTerminal
from tactile_push.bags import BagWriter
from tactile_push.bags.reader import BagReader
from tactile_push.control import PUSHING, STATES
from tactile_push.paper import CONTROL_PERIOD
from tactile_push.parameters.config_file import config_file
from tactile_push.recording.recorder import Recorder
from tactile_push.testing import NodeProcesses, Observer, field, seconds
from tactile_push.testing.observer import PATIENCE

STEPS = 80
PUSHED = float(STATES.index(PUSHING))
SIMULATED = {'use_sim_time': True}
EPOCH = 1_700_000_000_000_000_000  # [ns]
MS = 10**6
DRIVEN = ('contact_geometry', 'push_controller')
# However late a loaded machine lets a process run, the controller shall not stop for it here.
PATIENT = {
    'max_ticks_lost': 100,
    'contact_timeout': 10.0,
    'joint_state_timeout': 10.0,
    **SIMULATED,
}


@pytest.fixture(scope='module')
def rig_bag(tmp_path_factory) -> Path:
    """Return a bag of the simulated rig, recorded on simulated time."""
    folder = tmp_path_factory.mktemp('rig')
    device, config = str(folder / 'sensor'), config_file('block.yaml')
    with NodeProcesses(folder) as nodes:
        plant = {'sensor_rate': 20.0, 'publish_clock': True, 'real_time_factor': 20.0}
        nodes.start('sim_plant', {'device': device, **plant}, config=config)
        nodes.start('sensor_driver', {'device': device, **SIMULATED})
        nodes.start('contact_geometry', SIMULATED, config=config)
        nodes.start('push_controller', {'autostart': False, **SIMULATED}, config=config)
        nodes.start('active_sensing', SIMULATED, config=config)
        experiment = {'bag': str(folder / 'bag'), 'steps': STEPS, **SIMULATED}
        assert nodes.start('experiment', experiment).wait(2 * PATIENCE) == 0
    return folder / 'bag'


def write_numbers(path: Path, milliseconds: list[int], **options: Any) -> Path:
    with BagWriter(path) as bag:
        bag.add_topic('/number', 'std_msgs/msg/Int64', **options)
        for ms in milliseconds:
            now = EPOCH + ms * MS
            bag.write('/number', serialize_message(Int64(data=ms)), now, now)
    return path


def recorded(bag: Path, topic: str) -> list[Any]:
    reader = BagReader(bag)
    return [reader.decode(message) for message in reader.messages([topic])]


def stamp(message: Any) -> tuple[int, int]:
    return message.header.stamp.sec, message.header.stamp.nanosec


def pose(message: Any) -> tuple[float, ...]:
    position, orientation = message.pose.position, message.pose.orientation
    return position.x, position.y, orientation.z, orientation.w


def pushes(states: list[Any]) -> tuple[np.ndarray, np.ndarray, int]:
    """Give times and velocities of the ticks that pushed, and how many had a new contact."""
    pushing = [m for m in states if field(m, 'state') == PUSHED]
    return (
        np.array([seconds(m) for m in pushing]),
        np.array([field(m, 'v_x') for m in pushing]),
        len({field(m, 'theta') for m in pushing}),
    )


def extrapolated_by(joint_states: list[Any], key: tuple[int, int]) -> float:
    """Give the most by which a contact may differ that knew other joint states [rad].

    That is all that may differ: joint states that overtake their reading, or are overtaken, decide
    for how long the tip's angle is extrapolated. That is 0.1 s at the most, over which it goes on
    by as much as it turned in 0.1 s before, in place of the turn that it made.
    """
    ago = key[0] + 1e-9 * key[1] - np.array([seconds(m) for m in joint_states])
    turned = np.array([sum(m.position) for m in joint_states])
    near = turned[(ago < 0.2 + 1e-6) & (ago > -0.05 - 1e-6)]  # and to the next one
    return float(np.abs(np.diff(near)).sum()) + 1e-12


def times_of(diagnostics: list[DiagnosticArray]) -> list[tuple[str, int]]:
    """Give names of nodes and the times that they had [ns]."""
    return [
        (a.status[0].name, a.header.stamp.sec * 10**9 + a.header.stamp.nanosec) for a in diagnostics
    ]


@pytest.mark.parametrize('rate', [1.0, 2.0])
def test_readings_and_joints_drive_geometry_and_controller_as_if_live(
    rig_bag: Path, nodes: NodeProcesses, observer: Observer, rate
):
    contacts = observer.hear(PoseStamped, 'contact')
    states = observer.hear(JointState, 'push_controller/state')
    diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
    nodes.start('contact_geometry', SIMULATED, config=config_file('block.yaml'))
    nodes.start('push_controller', PATIENT, config=config_file('block.yaml'))
    hearing = {'tactile': 1, 'joint_states': 2, 'contact': 2, '/clock': 2}
    observer.wait_for(
        lambda: all(observer.node.count_subscribers(t) >= n for t, n in hearing.items()),
        'all nodes to hear each other',
    )
    live_times, live_v_x, live_updates = pushes(recorded(rig_bag, '/push_controller/state'))
    # The live controller was activated after the first reading, the played one begins with it.
    start = max(0.0, live_times[0] - CONTROL_PERIOD - BagReader(rig_bag).start_time * 1e-9)
    begin = BagReader(rig_bag).start_time + round(start * 1e9)
    bag = {'bag': str(rig_bag), 'topics': ['tactile', 'joint_states'], 'start': start}
    play = {**bag, 'clock': 100.0, 'rate': rate, 'start_paused': True}
    player = nodes.start('bag_player', play)
    observer.wait_for(
        lambda: {name for name, now in times_of(diagnostics) if now >= begin} >= {*DRIVEN},
        'both nodes to have the time from the player',
    )
    assert observer.call(SetBool, 'bag_player/pause', SetBool.Request(data=False)).success
    observer.wait_for(lambda: player.poll() is not None, 'the end of the play')
    assert player.returncode == 0

    # A reading that is played before any joint state, nobody can turn into a contact.
    played_from = divmod(begin, 10**9)
    first = next(s for s in map(stamp, recorded(rig_bag, '/joint_states')) if s >= played_from)
    # Where the recording ended, it may have a contact and not its reading: these are two topics.
    read = {stamp(m) for m in recorded(rig_bag, '/tactile')}
    contacts_live = {stamp(m): pose(m) for m in recorded(rig_bag, '/contact')}
    live = {key: contacts_live[key] for key in read & contacts_live.keys() if key > first}
    assert len(live) > 2 * STEPS
    observer.wait_for(
        lambda: {stamp(m) for m in contacts} >= live.keys(), 'a contact for each that was recorded'
    )
    played = {stamp(m): pose(m) for m in contacts}
    errors = [max(abs(np.subtract(played[key], live[key]))) for key in live]
    joint_states = recorded(rig_bag, '/joint_states')
    bounds = [extrapolated_by(joint_states, key) for key in live]
    assert np.all(np.less_equal(errors, bounds))
    assert np.median(errors) == 0.0

    times, v_x, updates = pushes(states)
    # It ticks at moments of its own, and begins with the first reading that is played, so it may be
    # ahead or behind by one update of phi for either. An update
    # is kp |theta - theta_desired| at most, of which 30 degrees go on to -10, with 1 / sin(phi)^2
    # < 1.3 from phi to v_x. A tick that a loaded machine loses is one less.
    wanted = np.interp(times, live_times, live_v_x)
    apart = 2 + max(0, live_updates - updates)
    allowed = 0.1 * np.abs(live_v_x).max() + apart * 1.3 * 0.005 * 0.05 * np.radians(30.0)
    assert np.abs(v_x - wanted).max() < allowed


@pytest.mark.parametrize('reliability', ['reliable', 'best_effort'])
def test_bag_of_a_played_bag_is_the_same(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path, reliability
):
    forever = {'sec': 9223372036, 'nsec': 854775807}
    offer = {
        'history': 'unknown',  # the graph tells neither
        'depth': 0,
        'reliability': reliability,
        'durability': 'volatile',
        'deadline': forever,
        'lifespan': forever,
        'liveliness': 'automatic',
        'liveliness_lease_duration': forever,
        'avoid_ros_namespace_conventions': False,
    }
    original = write_numbers(tmp_path / 'original', list(range(0, 1000, 20)), qos=[offer])
    with BagWriter(tmp_path / 'copy') as writer:
        recorder = Recorder(observer.node, ['/number'], writer)
        player = nodes.start('bag_player', {'bag': str(original), 'rate': 2.0})
        observer.wait_for(lambda: player.poll() is not None, 'the end of the play')
        observer.wait_for(lambda: recorder.counts['/number'] == 50, 'all messages')
        recorder.stop()
    first, second = BagReader(original), BagReader(tmp_path / 'copy')
    assert [m.data for m in second.messages()] == [m.data for m in first.messages()]
    assert second.topics['/number'].type_name == first.topics['/number'].type_name
    assert second.topics['/number'].qos == first.topics['/number'].qos == (offer,)


def test_pause_and_step_by_service(nodes: NodeProcesses, observer: Observer, tmp_path: Path):
    heard = observer.hear(Int64, '/number')
    diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
    bag = write_numbers(tmp_path / 'bag', [0, 60_000, 120_000, 120_100])
    player = nodes.start('bag_player', {'bag': str(bag)})
    observer.wait_for(lambda: heard, 'the first message')

    def call(service: type, name: str, **request: Any) -> Any:
        return observer.call(service, f'bag_player/{name}', service.Request(**request))

    assert not call(Trigger, 'step').success
    answer = call(SetBool, 'pause', data=True)
    assert answer.success
    assert answer.message.startswith('paused')
    assert call(Trigger, 'step').message == '/number'
    observer.wait_for(lambda: len(heard) == 2, 'the next message')
    assert call(Trigger, 'step').success
    observer.wait_for(lambda: len(heard) == 3, 'the one after that')

    def health() -> dict[str, DiagnosticStatus]:
        return {s.message: s for array in diagnostics for s in array.status}

    observer.wait_for(lambda: 'paused' in health(), 'the pause in the diagnostics')
    assert health()['paused'].name == 'bag_player'
    assert health()['paused'].level == DiagnosticStatus.OK
    call(SetBool, 'pause', data=False)
    observer.wait_for(lambda: player.poll() is not None, 'the end of the play')
    assert player.returncode == 0
    assert [message.data for message in heard] == [0, 60_000, 120_000, 120_100]


@pytest.mark.parametrize('stop_signal', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('playing', [False, True])
def test_signal_ends_the_player_in_silence(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path, stop_signal, playing
):
    heard = observer.hear(Int64, '/number')
    bag = write_numbers(tmp_path / 'bag', [0, 60_000])
    player = nodes.start('bag_player', {'bag': str(bag), 'start_paused': not playing})
    log = nodes.log('bag_player')
    if playing:
        observer.wait_for(lambda: heard, 'the first message')
    else:
        observer.wait_for(lambda: 'waiting' in log.read_text(), 'the player')
    said = log.read_text() if playing else ''
    player.send_signal(stop_signal)
    observer.wait_for(lambda: player.poll() is not None, 'the end')
    assert player.returncode == 0
    if playing:
        assert log.read_text() == said


def run(*words: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, '-m', 'tactile_push.cli', 'play', *map(str, words)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )


@pytest.mark.parametrize(
    ('options', 'words'),
    [
        (['--rate', '-1'], '--rate: expected a factor from 0.001 to 1000, got -1'),
        (['--rate', 'nan'], '--rate: expected a factor'),
        (['--start', 'x'], '--start: expected seconds'),
        (['--clock', '0'], '--clock: expected a rate'),
        (['--start', '2'], 'nothing at 2 s, the bag is 1 s long'),
        (['--topics', 'nummer'], 'no topic /nummer, did you mean /number?'),
        (['--remap', 'number'], "remap: expected OLD:=NEW, got 'number'"),
        (['--remap', 'nummer:=x'], 'no topic /nummer, did you mean /number?'),
        (['--remap', 'number:=1x'], "remap: expected the name of a topic, got '1x'"),
        (
            ['--clock', '--remap', 'number:=/clock'],
            'remap: expected different names, got /clock for 2 topics',
        ),
    ],
)
def test_command_refuses_bad_options_in_one_line(tmp_path: Path, options, words):
    done = run(write_numbers(tmp_path / 'bag', [0, 1000]), *options)
    assert (done.returncode, done.stdout) == (2, '')
    assert words in done.stderr
    assert done.stderr.count('\n') == 1


def test_command_refuses_what_is_no_bag_in_one_line(tmp_path: Path):
    (tmp_path / 'text').write_text('no bag')
    (tmp_path / 'folder').mkdir()
    write_numbers(tmp_path / 'empty', [])
    for name, words in [
        ('missing', 'No such file'),
        ('text', 'text: '),
        ('folder', 'folder: '),
        ('empty', 'expected messages, got none'),
    ]:
        done = run(tmp_path / name)
        assert (done.returncode, done.stdout) == (2, ''), name
        assert str(tmp_path / name) in done.stderr
        assert words in done.stderr
        assert done.stderr.count('\n') == 1


def test_command_on_a_terminal_pauses_steps_and_leaves_the_terminal_as_it_was(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    heard = observer.hear(Int64, '/left/number')
    bag = write_numbers(tmp_path / 'bag', [0, 60_000, 120_000])
    options = ['--start-paused', '--remap', 'number:=/left/number']
    with OnTerminal(['play', str(bag), *options], nodes.environment) as play:
        observer.wait_for(lambda: play.says('waiting for subscribers, 0.0 s of 120.0 s'), 'a line')
        observer.wait_for(lambda: play.says('paused, 0.0 s of 120.0 s'), 'the pause')
        assert play.attributes() != play.before
        play.type('s')
        observer.wait_for(lambda: len(heard) == 1, 'a step')
        play.type('\x1b[C')  # right arrow
        observer.wait_for(lambda: len(heard) == 2, 'another step')
        observer.wait_for(lambda: play.says('paused, 60.0 s'), 'the new place')
        play.type(' ')
        observer.wait_for(lambda: play.says('playing, 60.'), 'going on')
        play.type('\x03')  # Ctrl-C
        observer.wait_for(play.ended, 'the end')
        assert play.status == 0
        assert play.attributes() == play.before
        assert 'Traceback' not in play.said


def test_command_plays_what_it_is_told_and_ends(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    heard = observer.hear(Int64, '/number')
    texts = observer.hear(String, '/text')
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic('/number', 'std_msgs/msg/Int64')
        bag.add_topic('/text', 'std_msgs/msg/String')
        for ms in range(0, 1000, 100):
            bag.write('/number', serialize_message(Int64(data=ms)), EPOCH + ms * MS, 0)
            bag.write('/text', serialize_message(String(data='x')), EPOCH + ms * MS, 0)
    options = ['--start', '0.2', '--duration', '0.3', '--rate', '5', '--topics', 'number']
    command = [sys.executable, '-m', 'tactile_push.cli', 'play', str(tmp_path / 'bag'), *options]
    player = subprocess.Popen(command, env=nodes.environment, stdin=subprocess.DEVNULL)
    observer.wait_for(lambda: player.poll() is not None, 'the end of the play')
    assert player.returncode == 0
    observer.wait_for(lambda: len(heard) >= 4, 'the messages')
    assert [message.data for message in heard] == [200, 300, 400, 500]
    assert texts == []


@pytest.mark.parametrize(
    ('error', 'words'),
    [
        ("BagError('/bag: cut off')", 'bag_player: /bag: cut off'),
        ("OSError(5, 'Input/output error', '/bag')", 'bag_player: /bag: Input/output error'),
    ],
)
def test_bag_that_cannot_be_read_further_ends_the_player_with_one_line_and_status_1(
    nodes: NodeProcesses, tmp_path: Path, error, words
):
    bag = write_numbers(tmp_path / 'bag', [0, 1, 2])
    program = f"""
import sys
from tactile_push.bags import reader
from tactile_push.playing import player
from tactile_push.bags.reader import BagError
from tactile_push.nodes.bag_player import main

def messages(self, *choice, read=reader.BagReader.messages):
    first, *rest = read(self, *choice)
    yield first
    raise {error}

reader.BagReader.messages = messages
player.PATIENCE = 0.0
sys.argv = ['bag_player', '--ros-args', '-p', 'bag:={bag}']
sys.exit(main())
"""
    done = subprocess.run(
        [sys.executable, '-c', program],
        env=nodes.environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    assert done.returncode == 1
    said = [line for line in done.stderr.splitlines() if not line.startswith(('[INFO]', '[WARN]'))]
    assert said == [words]
