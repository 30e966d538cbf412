# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push replay`: what it prints, of what it warns and how it ends."""

import json

import pytest

from support.bag_copies import DATA, copied
from tactile_push.bags import BagReader, BagWriter
from tactile_push.cli import main
from tactile_push.replay import replay


def test_bag_of_which_nothing_can_be_made_again_is_no_success(tmp_path, capsys):
    with BagReader(DATA / 'block') as reader, BagWriter(tmp_path / 'back') as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        # Their stamps go back from message to message.
        for k, message in enumerate(reversed(list(reader.messages()))):
            writer.write(message.topic, message.data, 10**9 + 10**6 * k, 10**9 + 10**6 * k)
    assert main(['replay', str(tmp_path / 'back'), '--kd', '3']) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert 'no control period' in line and 'kept as recorded: the stamps of ' in line


def test_what_is_kept_whatever_the_values_is_said(capsys):
    with BagReader(DATA / 'stops') as bag:
        (comparison,) = replay(bag)
    assert comparison.kept > 0  # it begins in the middle of a run
    assert main(['replay', str(DATA / 'stops')]) == 0
    assert capsys.readouterr().err == ''
    assert main(['replay', str(DATA / 'stops'), '--kd', '3']) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert f'warning: /push_controller: {comparison.kept} control periods are kept' in line


def test_without_control_periods_there_is_nothing_to_differ_from(tmp_path, capsys):
    bag = copied(DATA / 'block', tmp_path / 'bag', keep={'/tactile', '/joint_states'}.__contains__)
    assert main(['replay', str(bag)]) == 0
    assert 'none recorded to compare with' in capsys.readouterr().out
    assert main(['replay', str(bag), '--json', '-']) == 0
    (finger,) = json.loads(capsys.readouterr().out)['fingers']
    assert finger['different'] is None
    assert len(finger['ticks']) > 100


def test_parameter_that_the_bag_decides_is_said(tmp_path, capsys):
    file = tmp_path / 'rate.yaml'
    file.write_text('push_controller:\n  ros__parameters:\n    control_rate: 20.0\n    kd: 3.0\n')
    assert main(['replay', str(DATA / 'block'), '--config', str(file)]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert f'warning: {file}: push_controller: control_rate: ' in line
    # Without recorded control periods it decides when they are.
    keep = {'/tactile', '/joint_states'}.__contains__
    bag = copied(DATA / 'block', tmp_path / 'bag', keep=keep)
    assert main(['replay', str(bag), '--config', str(file)]) == 0
    assert capsys.readouterr().err == ''
    # As it was recorded it changes nothing anyway.
    file.write_text('push_controller:\n  ros__parameters:\n    control_rate: 10.0\n')
    assert main(['replay', str(DATA / 'block'), '--config', str(file)]) == 0
    assert capsys.readouterr().err == ''


@pytest.mark.parametrize(
    'text',
    [
        'hello world',
        '/other:\n  ros__parameters:\n    kd: 3.0\n',
        '/**:\n  ros__parameters:\n    anything: 1\n',
        '',
    ],
)
def test_file_that_says_nothing_of_any_node_is_refused(text, tmp_path, capsys):
    file = tmp_path / 'other.yaml'
    file.write_text(text)
    assert main(['replay', str(DATA / 'block'), '--config', str(file)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert str(file) in line and '/push_controller' in line


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['--kp', 'nan'], '--kp'),
        (['--kd', '1001'], 'parameter kd: expected a number'),
        (['--config', 'missing.yaml'], 'missing.yaml'),
        (['-o', '.'], '.: expected a new folder, got a path that exists'),
        (['--json', 'no/folder.json'], 'no/folder.json'),
    ],
)
def test_bad_input_is_one_line_and_exit_status_2(arguments, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    try:
        status = main(['replay', str(DATA / 'stops'), *arguments])
    except SystemExit as end:
        status = end.code
    said = [line for line in capsys.readouterr().err.splitlines() if 'tactile_push replay' in line]
    assert status == 2
    (line,) = said
    assert words in line


def test_command_prints_a_summary_or_all_of_it(capsys, tmp_path):
    assert main(['replay', str(DATA / 'stops')]) == 0
    assert 'commands that differ' in capsys.readouterr().out
    assert main(['replay', str(DATA / 'stops'), '--json', '-', '--kd', '2']) == 0
    (finger,) = json.loads(capsys.readouterr().out)['fingers']
    assert finger['different'] > 0
    tick = finger['ticks'][10]
    assert tick.keys() >= {'time', 'theta', 'phi', 'v_x', 'v_x_recorded', 'state', 'stop_reason'}
    assert main(['replay', str(DATA / 'stops'), '--json', str(tmp_path / 'all.json')]) == 0
    assert json.loads((tmp_path / 'all.json').read_text())['fingers'][0]['different'] == 0


@pytest.mark.parametrize(
    ('parameter', 'words'),
    [
        ('edge: 4', 'edge: expected -1 to 3, got 4'),
        ('vertices: [1, 2, 3, 4, 5, 6]', 'vertices: expected a list of numbers'),
        ('vertices: [0.1, 0.2]', 'vertices: expected x and y of three corners'),
        ('vertics: [0.1, 0.2]', 'did you mean vertices'),
    ],
)
def test_parameter_that_makes_no_sense_is_bad_input(tmp_path, capsys, parameter, words):
    config = tmp_path / 'object.yaml'
    config.write_text(f'active_sensing:\n  ros__parameters:\n    {parameter}\n')
    assert main(['replay', str(DATA / 'block'), '--config', str(config)]) == 2
    (line,) = [li for li in capsys.readouterr().err.splitlines() if 'tactile_push replay' in li]
    assert words in line
