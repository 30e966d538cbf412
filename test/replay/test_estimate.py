# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What recorded pushes tell, against the simulator's truth in the same bag."""

import json
import math

import numpy as np
import pytest

from support.sensed_bag import DATA, POSE, STATE, TICKS, said_by_a_node, with_sensing
from support.states import read_states
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.cli import main
from tactile_push.replay import estimate

BLOCK, STOPS = DATA / 'block', DATA / 'stops'
TRUTH = '/ground_truth/state'


def run(bag, **how):
    with BagReader(bag) as reader:
        return estimate(reader, **how)


def without(bag, out, *topics):
    """Copy a bag without some topics."""
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        for message in reader.messages():
            if message.topic not in topics:
                writer.write(message.topic, message.data, message.log_time, message.publish_time)
    return out


@pytest.fixture(scope='module')
def block():
    (figures,) = run(BLOCK, sensing={'edge': 0})
    return figures


def test_truth_is_inside(block):
    assert block.compared > 200
    assert block.inside_guaranteed == 1.0
    assert block.inside > 0.9
    truth = read_states(BLOCK, TRUTH)['d'][-1]
    assert block.values['d_lower'] <= truth <= block.values['d_upper']
    assert block.values['d'] == pytest.approx(truth, abs=0.001)


def test_d_is_known_long_before_the_object_translates(block):
    assert 0 < block.known_step < 200
    # The definition, from the control periods themselves: all of them are steps of the law here.
    states = read_states(BLOCK, TICKS)['state']
    widths = np.array([tick.d_upper - tick.d_lower for tick in block.ticks])[states == 2.0]
    assert (widths[block.known_step :] <= 0.002).all()
    assert widths[block.known_step - 1] > 0.002


def test_all_control_periods_are_told_and_nothing_is_amiss(block):
    with BagReader(BLOCK) as reader:
        assert len(block.ticks) == reader.counts[TICKS]
    assert block.contradictions == []
    assert block.forgotten == []
    assert not block.object_told


def test_stops_make_it_forget(tmp_path):
    (figures,) = run(STOPS)
    assert 'contact lost' in {forgotten.reason for forgotten in figures.forgotten}
    times = [forgotten.at for forgotten in figures.forgotten]
    assert times == sorted(times)
    assert figures.compared == 0
    assert figures.inside is figures.inside_guaranteed is None


def test_new_bag_has_what_a_node_that_heard_all_of_it_says(tmp_path):
    live = with_sensing(BLOCK, said_by_a_node(BLOCK), tmp_path / 'live')
    late = with_sensing(BLOCK, said_by_a_node(BLOCK, 100), tmp_path / 'late')
    run(late, out=tmp_path / 'estimated')
    assert main(['diff', str(live), str(tmp_path / 'estimated')]) == 0


def test_two_fingers_are_two(tmp_path, capsys):
    with BagReader(BLOCK) as reader, BagWriter(tmp_path / 'two') as writer:
        for name in ('/left', '/right'):
            writer.add_topic(f'{name}{TICKS}', reader.topics[TICKS].type_name)
            writer.add_topic(f'{name}{TRUTH}', reader.topics[TRUTH].type_name)
        for message in reader.messages([TICKS, TRUTH]):
            for name in ('/left', '/right')[: 2 if message.topic == TICKS else 1]:
                topic = f'{name}{message.topic}'
                writer.write(topic, message.data, message.log_time, message.log_time)
    config = tmp_path / 'edges.yaml'
    config.write_text('/left/active_sensing:\n  ros__parameters:\n    edge: 0\n')
    left, right = run(tmp_path / 'two', config=config)
    assert (left.finger, right.finger) == ('left', 'right')
    assert left.values['edge_weight'] == 1.0
    assert right.values['edge_weight'] < 1.0
    assert (left.compared > 0, right.compared) == (True, 0)
    assert main(['estimate', str(tmp_path / 'two')]) == 0
    out, err = capsys.readouterr()
    assert [line.strip() for line in out.splitlines() if line.startswith('/')] == [
        '/left/active_sensing',
        '/right/active_sensing',
    ]
    assert '/left/active_sensing was not recorded' in err


def test_disk_has_no_edge_and_d_0_by_its_roundness(tmp_path, capsys):
    config = tmp_path / 'disk.yaml'
    config.write_text('active_sensing:\n  ros__parameters:\n    disk_radius: 0.0285\n')
    (figures,) = run(BLOCK, config=config)
    assert figures.object_told
    assert {(tick.d_least, tick.d_most) for tick in figures.ticks} == {(0.0, 0.0)}
    main(['estimate', str(BLOCK), '--config', str(config)])
    rows = [
        line.split('│')[1].strip() for line in capsys.readouterr().out.splitlines() if '│' in line
    ]
    assert 'd [mm]' in rows
    assert 'edge' not in rows
    assert not [row for row in rows if 'known to 2 mm' in row]


def test_readings_without_control_periods_tell_nothing(tmp_path):
    bag = without(BLOCK, tmp_path / 'bag', TICKS)
    with pytest.raises(BagError, match='no control periods, expected a topic push_controller'):
        run(bag)


def test_topic_of_another_type_is_refused(tmp_path):
    with BagReader(BLOCK) as reader, BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TICKS, reader.topics['/contact'].type_name)
        for message in reader.messages(['/contact']):
            writer.write(TICKS, message.data, message.log_time, message.log_time)
    with pytest.raises(BagError, match='push_controller/state: expected sensor_msgs'):
        run(tmp_path / 'bag')


def test_command_prints_a_summary_beside_the_paper(capsys):
    assert main(['estimate', str(BLOCK), '--edge', '0', '--noise-deg', '0.2']) == 0
    out, err = capsys.readouterr()
    rows = {}
    for line in out.splitlines():
        cells = [cell.strip() for cell in line.replace('┃', '│').split('│')[1:-1]]
        if len(cells) == 3:
            rows[cells[0]] = cells[1:]
    assert rows['d known to 2 mm from step'][1] == '400'
    assert 0 < int(rows['d known to 2 mm from step'][0]) < 400
    assert rows['edge'] == ['0 (100%)', '']
    assert rows['of them within the guaranteed bounds'] == ['100.0%', '']
    mean, interval, bounds = rows['d [mm]'][0].split(', ')
    truth = 1e3 * read_states(BLOCK, TRUTH)['d'][-1]
    lower, upper = map(float, interval.removeprefix('95 %: ').split(' to '))
    least, most = map(float, bounds.removeprefix('guaranteed: ').split(' to '))
    assert least <= lower <= float(mean) <= upper <= most
    assert lower - 0.005 <= truth <= upper + 0.005
    assert 'was not recorded' in err


@pytest.mark.parametrize(
    'outline',
    ['vertices: [-0.03, -0.03, 0.03, -0.03, 0.03, 0.03, -0.03, 0.03]', 'disk_radius: 0.04'],
)
def test_command_shows_no_figure_of_the_paper_beside_another_object(tmp_path, capsys, outline):
    config = tmp_path / 'object.yaml'
    config.write_text(f'active_sensing:\n  ros__parameters:\n    {outline}\n')
    main(['estimate', str(BLOCK), '--config', str(config)])
    out = capsys.readouterr().out
    assert 'this bag' in out
    assert 'paper' not in out
    assert ' 400 ' not in out


def test_json_has_all_of_it(capsys, tmp_path):
    assert main(['estimate', str(STOPS), '--json', '-']) == 0
    (finger,) = json.loads(capsys.readouterr().out)['fingers']
    with BagReader(STOPS) as reader:
        assert len(finger['ticks']) == reader.counts[TICKS]
    assert finger['ticks'][0].keys() == {'time', 'd', 'd_lower', 'd_upper', 'd_least', 'd_most'}
    assert finger['values'].keys() >= {'d', 'c', 'mu_c', 'edge', 'edge_weight'}
    assert finger['forgotten'][0].keys() == {'reason', 'at'}
    assert finger['inside'] is None
    assert main(['estimate', str(STOPS), '--json', str(tmp_path / 'all.json')]) == 0
    (again,) = json.loads((tmp_path / 'all.json').read_text())['fingers']
    assert again == finger


def test_nothing_ever_known_is_status_1(tmp_path, capsys):
    from rclpy.serialization import serialize_message
    from sensor_msgs.msg import JointState

    with BagReader(BLOCK) as reader, BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TICKS, reader.topics[TICKS].type_name)
        for message in reader.messages([TICKS]):
            state = reader.decode(message)
            values = dict(zip(state.name, state.position, strict=True))
            values |= {'theta': math.nan, 'v_x': math.nan, 'state': 1.0}  # waiting for contact
            written = JointState(name=list(values), position=list(values.values()))
            written.header.stamp.sec = state.header.stamp.sec
            written.header.stamp.nanosec = state.header.stamp.nanosec
            data = serialize_message(written)
            writer.write(TICKS, data, message.log_time, message.log_time)
    assert main(['estimate', str(tmp_path / 'bag')]) == 1
    assert 'never known' in capsys.readouterr().out


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['--edge', '4'], 'edge: expected -1 to 3, got 4'),
        (['--edge', 'left'], '--edge: expected a whole number from -1 on, got left'),
        (['--noise-deg', '0'], '--noise-deg: expected degrees from 0.001 to 28, got 0'),
        (['--config', 'missing.yaml'], 'missing.yaml: No such file'),
        (
            ['--config', 'gains.yaml'],
            'gains.yaml: no parameter of a node of the bag, expected some',
        ),
        (['-o', '.'], 'is there already, expected a new folder'),
        (['--json', 'no/folder.json'], 'no/folder.json: No such file'),
    ],
)
def test_bad_input_is_one_line_and_exit_status_2(arguments, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    gains = '/push_controller:\n  ros__parameters:\n    kd: 3.0\n'  # which it does not need
    (tmp_path / 'gains.yaml').write_text(gains)
    try:
        status = main(['estimate', str(STOPS), *arguments])
    except SystemExit as end:
        status = end.code
    assert status == 2
    out, err = capsys.readouterr()
    assert out == ''
    (line,) = [line for line in err.splitlines() if 'warning' not in line]
    assert line.startswith('tactile_push estimate: ')
    assert words in line


def test_bag_without_readings_of_its_own_is_refused_in_one_line(tmp_path, capsys):
    bag = without(BLOCK, tmp_path / 'bag', TICKS, STATE, POSE)
    assert main(['estimate', str(bag)]) == 2
    assert capsys.readouterr().err.count('\n') == 1
