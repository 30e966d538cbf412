# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push estimate`: what it prints beside the paper, and how it ends."""

import json
import math

import pytest

from support.bag_copies import DATA, without
from support.sensed_bag import POSE, STATE, TICKS
from support.states import read_states
from tactile_push.bags import BagReader, BagWriter
from tactile_push.cli import main

BLOCK, STOPS = DATA / 'block', DATA / 'stops'
TRUTH = '/ground_truth/state'


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
        (['-o', '.'], '.: expected a new folder, got a path that exists'),
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
