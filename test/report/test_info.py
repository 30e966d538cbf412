# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag, and `tactile_push info`, against bags of which it is known."""

import json
import math
import re

import numpy as np
import pytest
from mcap.writer import CompressionType, Writer

from support.bag_making import encode, joint_state, write_bag, write_file, write_foreign_bag
from tactile_push.bags import BagReader, schema_text
from tactile_push.cli import main
from tactile_push.report.info import bag_info

JOINT_STATE = 'sensor_msgs/msg/JointState'
CLOCK = 'rosgraph_msgs/msg/Clock'
STATE = '/push_controller/state'
BAND = math.radians(3.0)
PERIOD = 100_000_000  # [ns]
NOTES = {
    'tactile_push.version': '1.2.3',
    'tactile_push.parameters': json.dumps(
        {
            'sim_plant': {'object': 'block', 'edge_to_cm': 0.02375, 'disk_radius': 0.0285},
            'push_controller': {'kp': 0.05, 'joint_names': ['a', 'b'], 'max': math.inf},
            'left/sim_plant': {'object': 'disk', 'edge_to_cm': 0.02375, 'disk_radius': 0.0285},
        }
    ),
}


def clocks(*times):
    return CLOCK, [(time, encode(CLOCK)) for time in times]


def pushes(theta_desired, count=450, settled=192, late=0, **more):
    """Return the states of a push that is 4 degrees off until it settles exactly, and phi."""
    messages = []
    for k in range(count):
        theta = theta_desired + math.radians(4.0) * (k < settled)
        values = {'theta': theta, 'theta_desired': theta_desired, 'phi': math.radians(82.5)}
        values |= {'state': 2.0, 'stop_reason': 0.0, 'silence': 0.0, 'v_x': 0.001, **more}
        messages.append((late + k * PERIOD, joint_state(k * PERIOD, **values)))
    return JOINT_STATE, messages


def info_of(path):
    with BagReader(path) as bag:
        return bag_info(bag, BAND)


@pytest.fixture(params=[write_bag, write_foreign_bag])
def write(request, tmp_path):
    """Return a function that writes a bag, with our own writer or that of rosbags."""
    return lambda topics: request.param(tmp_path / 'bag', topics)


def test_topics_rates_gaps_and_order(write):
    start = 1_732_540_000 * 10**9
    # Every 20 ms, but for 35 ms after the fourth.
    times = start + np.array([0, 20, 40, 60, 95, 115]) * 1_000_000
    stamps = [5, 6, 4, 7, 7, 6]
    topics = {
        '/tactile': (
            JOINT_STATE,
            [(int(t), joint_state(s)) for t, s in zip(times, stamps, strict=True)],
        ),
        '/clock': clocks(start + 250_000_000),
        '/quick': clocks(*[start] * 3),
    }
    info = info_of(write(topics))
    assert [topic.name for topic in info.topics] == ['/clock', '/quick', '/tactile']
    clock, quick, tactile = info.topics
    assert (info.start_time, info.messages) == (start, 10)
    assert info.duration == pytest.approx(0.25)
    assert (tactile.type_name, tactile.messages, tactile.out_of_order) == (JOINT_STATE, 6, 2)
    assert tactile.rate == pytest.approx(50.0)
    assert (tactile.largest_gap, tactile.gap_at) == pytest.approx((0.035, 0.06))
    assert (clock.messages, clock.rate, clock.largest_gap, clock.gap_at) == (1, None, None, None)
    assert clock.out_of_order is None
    assert (quick.rate, quick.largest_gap, quick.gap_at) == (None, 0.0, 0.0)
    assert info.pushes == {}
    assert info.version is info.parameters is None


def test_median_of_very_many_intervals(tmp_path):
    # Every seventh interval is 70 ms, the others 10 ms.
    intervals = np.where(np.arange(40_000) % 7 == 0, 70, 10) * 1_000_000
    times = np.cumsum(intervals)
    path = write_file(tmp_path / 'many.mcap', {'/clock': clocks(*map(int, times))})
    (clock,) = info_of(path).topics
    assert clock.rate == pytest.approx(100.0)
    assert clock.messages == 40_000


def test_empty_bag(tmp_path):
    info = info_of(write_bag(tmp_path / 'bag', {'/clock': (CLOCK, [])}))
    assert (info.messages, info.duration, info.start_time) == (0, 0.0, 0)
    assert [(topic.name, topic.messages, topic.rate) for topic in info.topics] == [
        ('/clock', 0, None)
    ]


@pytest.mark.parametrize(
    ('kind', 'word'),
    [
        (CompressionType.NONE, 'none'),
        (CompressionType.LZ4, 'lz4'),
        (CompressionType.ZSTD, 'zstd'),
    ],
)
def test_files(tmp_path, kind, word):
    path = write_file(tmp_path / 'one.mcap', {'/clock': clocks(1, 2)}, compression=kind)
    (file,) = info_of(path).files
    assert (file.path, file.size, file.compression) == (path, path.stat().st_size, word)


def test_push(write):
    desired = math.radians(-10.0)
    kind, messages = pushes(desired)
    stop = {'theta': desired, 'state': 3.0, 'stop_reason': 1.0, 'silence': 0.4}
    messages += [(k * PERIOD, joint_state(k * PERIOD, **stop)) for k in (450, 451, 452)]
    messages += [(453 * PERIOD, joint_state(453 * PERIOD, theta=desired, state=0.0))]
    (push,) = info_of(write({STATE: (kind, messages)})).pushes.values()
    assert (push.states, push.steps, push.settle_step, push.ranges_from) == (454, 450, 192, 400)
    assert push.theta_range == (desired, desired)
    assert push.phi_range == (math.radians(82.5),) * 2
    assert (push.silence, push.silence_at) == pytest.approx((0.4, 45.0))
    (stop,) = push.stops
    assert (stop.reason, stop.ended) == ('contact silent', True)
    assert (stop.at, stop.duration) == pytest.approx((45.0, 0.3))
    assert push.missing == ('saturated', 'limited', 'ticks', 'ticks_lost')
    assert push.paper.figure == '9'
    assert push.l is push.d_range is None


def test_several_fingers_and_what_is_known_of_them(tmp_path):
    topics = {STATE: pushes(math.radians(-10.0)), f'/left{STATE}': pushes(0.0, settled=110)}
    info = info_of(write_file(tmp_path / 'two.mcap', topics, NOTES))
    assert list(info.pushes) == ['', '/left']
    block, disk = info.pushes.values()
    assert (block.settle_step, disk.settle_step) == (192, 110)
    assert (block.paper.figure, disk.paper.figure) == ('9', '10')
    assert (block.l, disk.l) == (0.02375, 0.0285)
    # (17) by hand: -l / tan(82.5 deg + 10 deg), and for the disk -l / tan(82.5 deg).
    assert block.d_range == pytest.approx((-0.02375 / math.tan(math.radians(92.5)),) * 2)
    assert disk.d_range == pytest.approx((-0.0285 / math.tan(math.radians(82.5)),) * 2)
    assert info.version == '1.2.3'
    assert info.parameters['push_controller']['kp'] == 0.05


@pytest.mark.parametrize('text', ['{', '[]', '{"node": 3}', ''])
def test_parameters_that_make_no_sense_are_left_out(tmp_path, text):
    notes = {'tactile_push.parameters': text}
    info = info_of(write_file(tmp_path / 'x.mcap', {'/clock': clocks(1)}, notes))
    assert info.parameters is None
    assert info.remarks == ['the recorded parameters cannot be read: expected JSON, node to values']


def test_state_of_another_type_is_left_out(tmp_path):
    info = info_of(write_bag(tmp_path / 'bag', {STATE: clocks(1)}))
    assert info.pushes == {}
    assert info.remarks == [f'{STATE} has type {CLOCK}, expected {JOINT_STATE}']


@pytest.fixture
def command(capsys):
    """Return a function that runs the command: exit status, standard output, standard error."""

    def run(*arguments):
        capsys.readouterr()
        try:
            status = main(['info', *map(str, arguments)])
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


def rows_of(out):
    """Return the rows of the tables, and the words of the other lines."""
    return [re.split(r'\s*[│┃]\s*|\s{2,}', line.strip('│┃ \n')) for line in out.splitlines()]


def test_command_says_what_is_in_a_bag(tmp_path, command):
    topics = {STATE: pushes(math.radians(-10.0)), '/clock': clocks(1, 2)}
    path = write_file(tmp_path / 'block.mcap', topics, NOTES)
    status, out, err = command(path)
    assert (status, err) == (0, '')
    rows = rows_of(out)
    assert ['start', '0.000000000 s (simulated time)'] in rows
    assert ['duration', '44.900 s'] in rows
    assert ['messages', '452'] in rows
    assert ['tactile_push', '1.2.3'] in rows
    headings = ['topic', 'type', 'messages', 'rate [Hz]', 'largest gap [s]', 'at [s]']
    assert [*headings, 'out of order'] in rows
    assert [STATE, JOINT_STATE, '450', '10.00', '0.100', '0.000', '0'] in rows
    assert ['/clock', CLOCK, '2', '1000000000.00', '0.000', '0.000'] in rows
    assert ['this bag', 'paper, fig. 9'] in rows
    assert ['θ within 3° of θ_d from step', '192', '173'] in rows
    assert ['θ from step 400 [°]', '-10.0 to -10.0', '-10.4 to -8.9'] in rows
    assert ['φ from step 400 [°]', '82.5 to 82.5', '80.2 to 85.8'] in rows
    assert ['so d by (17) [mm]', '1.04 to 1.04', '0.30 to 2.10'] in rows
    assert ['l [mm]', '23.75'] in [row[:2] for row in rows]
    assert ['stops', 'none'] in [row[:2] for row in rows]
    assert ['kp', '0.05'] in rows
    assert 'not in this bag: saturated, limited, ticks, ticks_lost\n' in out
    assert 'parameters of /push_controller\n' in out


def test_command_counts_real_time_from_the_epoch(tmp_path, command):
    path = write_bag(tmp_path / 'bag', {'/clock': clocks(1_732_540_000_123_000_000)})
    assert ['start', '2024-11-25 13:06:40.123+00:00'] in rows_of(command(path)[1])


def test_command_takes_the_band(tmp_path, command):
    path = write_bag(tmp_path / 'bag', {STATE: pushes(0.0)})
    rows = rows_of(command(path, '--band-deg', '1')[1])
    assert ['θ within 1° of θ_d from step', '192', '110'] in rows
    rows = rows_of(command(path, '--band-deg', '5')[1])
    assert ['θ within 5° of θ_d from step', '0', '110 (1°)'] in rows


@pytest.mark.parametrize('band', ['0', '-1', '180', 'x', 'nan'])
def test_command_refuses_other_bands(tmp_path, command, band):
    status, out, err = command(tmp_path, f'--band-deg={band}')
    assert (status, out) == (2, '')
    assert 'expected degrees between 0 and 180' in err


def refuse(name):
    raise AssertionError(f'{name} in JSON')


def test_command_gives_json(tmp_path, command):
    topics = {STATE: pushes(math.radians(-10.0)), '/clock': clocks(1, 2)}
    path = write_file(tmp_path / 'block.mcap', topics, NOTES)
    status, out, err = command(path, '--json')
    assert (status, err) == (0, '')
    info = json.loads(out, parse_constant=refuse)
    assert info['path'] == info['files'][0]['path'] == str(path)
    assert (info['start_time_ns'], info['duration'], info['messages']) == (0, 44.9, 452)
    assert info['topics'][1]['rate'] == pytest.approx(10.0)
    assert info['version'] == '1.2.3'
    assert info['parameters']['push_controller']['max'] == 'inf'
    push = info['pushes']['']
    assert push['settle_step'] == 192
    assert push['phi_range'] == [math.radians(82.5)] * 2
    assert push['band'] == pytest.approx(BAND)
    assert push['paper']['settle_step'] == 173


def test_command_refuses_bad_bags_in_one_line(tmp_path, command):
    (tmp_path / 'text.mcap').write_text('no bag')
    (tmp_path / 'empty').mkdir()
    for wrong in ('nowhere', 'text.mcap', 'empty'):
        status, out, err = command(tmp_path / wrong)
        assert (status, out) == (2, '')
        assert len(err.splitlines()) == 1
        assert err.startswith(f'tactile_push info: {tmp_path / wrong}')


def test_what_cannot_be_decoded_is_counted_all_the_same(tmp_path):
    definition = schema_text('sensor_msgs/msg/JointState').encode()
    with open(tmp_path / 'bag.mcap', 'wb') as stream:
        mcap = Writer(stream)
        mcap.start('')
        schema = mcap.register_schema('sensor_msgs/msg/JointState', 'ros2msg', definition)
        for name, encoding in (('/push_controller/state', 'json'), ('/tactile', 'cdr')):
            channel = mcap.register_channel(name, encoding, schema)
            for k in range(5):
                mcap.add_message(channel, k * 10**9, b'{}', k * 10**9)
        mcap.finish()
    info = info_of(tmp_path / 'bag.mcap')
    assert {topic.name: topic.messages for topic in info.topics} == {
        '/push_controller/state': 5,
        '/tactile': 5,
    }
    assert info.pushes == {}
    assert info.remarks == [
        "1 of 2 topics cannot be decoded: message encoding 'json', schema encoding 'ros2msg'",
        '5 messages of /tactile end before their stamp',
    ]


def test_states_that_do_not_decode_are_counted_and_left_out(tmp_path):
    state = joint_state(10**9, theta=0.1)
    cut = [(k * 10**9, state[:20]) for k in range(3)]  # behind the stamp
    info = info_of(write_bag(tmp_path / 'bag', {STATE: ('sensor_msgs/msg/JointState', cut)}))
    assert [topic.messages for topic in info.topics] == [3]
    assert info.remarks == [f'3 messages of {STATE} do not decode']
