# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags in, bags out.

data/block is the paper's block on simulated time with a noisy sensor, from the first tick on.
data/stops is recorded from the middle of a run in real time: new goals, a killed driver, a
deactivation, a controller that stood still, a command of somebody else, two resumes. Nodes of an
earlier version made them: what the present code makes of their readings must not differ.
"""

import hashlib
import json
import math
from pathlib import Path

import pytest

from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.cli import main
from tactile_push.control import STOP_REASONS
from tactile_push.replay import replay

DATA = Path(__file__).parents[1] / 'data'
BAGS = ['block', 'stops']
REPLAYED = ('/contact', '/contact_geometry/state', '/push_controller/state', '/finger/cmd_vel')


def contents(bag, topics=None):
    """Return messages by topic and stamp as text: every digit, and NaN as NaN."""
    with BagReader(bag) as reader:
        return sorted(
            (message.topic, str(reader.decode(message))) for message in reader.messages(topics)
        )


def copied(bag, out, rename=lambda topic: topic, keep=lambda topic: True, note=True):
    """Copy a bag, or a part of it, under other names."""
    with BagReader(bag) as reader, BagWriter(out) as writer:
        for topic in reader.topics.values():
            if keep(topic.name):
                writer.add_topic(rename(topic.name), topic.type_name, definition=topic.definition)
        for message in reader.messages():
            if keep(message.topic):
                writer.write(
                    rename(message.topic), message.data, message.log_time, message.publish_time
                )
        for key, text in reader.notes.items() if note else ():
            writer.note(key, text)
    return out


def run(bag, **how):
    with BagReader(bag) as reader:
        return replay(reader, **how)


def test_the_bags_hold_what_they_are_for():
    with BagReader(DATA / 'stops') as reader:
        reasons = set()
        for message in reader.messages(['/push_controller/state']):
            state = reader.decode(message)
            values = dict(zip(state.name, state.position, strict=True))
            reasons.add(STOP_REASONS[int(values['stop_reason'])])
    assert reasons >= {'', 'contact silent', 'ticks lost', 'another command'}
    with BagReader(DATA / 'block') as reader:
        assert reader.counts['/push_controller/state'] > 200
        assert reader.counts['/contact_geometry/state'] > reader.counts['/contact']  # refused ones


@pytest.mark.parametrize('name', BAGS)
def test_no_command_differs_from_that_of_the_nodes(name):
    (comparison,) = run(DATA / name)
    assert len(comparison.ticks) > 100
    assert comparison.kept <= 3
    assert not comparison.different()


@pytest.mark.parametrize('name', BAGS)
def test_the_new_bag_has_what_the_nodes_said_to_the_last_digit(name, tmp_path):
    run(DATA / name, out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(DATA / name)
    assert main(['diff', str(DATA / name), str(tmp_path / 'out')]) == 0


@pytest.mark.parametrize('name', BAGS)
def test_commands_may_be_recorded_after_what_the_node_says_of_them(name, tmp_path):
    with BagReader(DATA / name) as reader, BagWriter(tmp_path / 'bag') as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        rows = []
        for message in reader.messages():
            later = 30_000_000 if message.topic == '/finger/cmd_vel' else 0
            rows.append((message.log_time + later, message.topic, message.data))
        for log_time, topic, data in sorted(rows, key=lambda row: row[0]):
            writer.write(topic, data, log_time, log_time)
        for key, text in reader.notes.items():
            writer.note(key, text)
    run(tmp_path / 'bag', out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(tmp_path / 'bag')


def test_a_change_of_a_command_is_found_out(tmp_path):
    run(DATA / 'block', controller={'kd': 5.0 + 1e-12}, out=tmp_path / 'out')
    assert main(['diff', str(DATA / 'block'), str(tmp_path / 'out')]) == 1


def test_a_replay_of_a_replay_gives_the_same_bytes(tmp_path):
    run(DATA / 'stops', out=tmp_path / 'one')
    run(tmp_path / 'one', out=tmp_path / 'two')
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert list(one.messages()) == list(two.messages())
        assert one.notes == two.notes


def test_other_gains_command_otherwise_and_nothing_else_changes(tmp_path):
    (comparison,) = run(DATA / 'block', controller={'kd': 0.0, 'kp': 0.0}, out=tmp_path / 'out')
    # Without gains the law stays where it starts: straight ahead.
    assert {tick.v_x for tick in comparison.ticks} == {0.0}
    assert comparison.different()
    inputs = ['/tactile', '/joint_states', '/contact', '/contact_geometry/state', '/clock']
    assert contents(tmp_path / 'out', inputs) == contents(DATA / 'block', inputs)


def test_config_file_overrides_the_record_and_an_option_the_file(tmp_path):
    config = tmp_path / 'gains.yaml'
    config.write_text('/**:\n  ros__parameters:\n    kp: 0.0\n    kd: 1.0\n')
    (by_file,) = run(DATA / 'block', config=config)
    (by_option,) = run(DATA / 'block', config=config, controller={'kd': 0.0})
    assert any(tick.v_x for tick in by_file.ticks)
    assert not any(tick.v_x for tick in by_option.ticks)


def test_geometry_follows_its_parameters_too(tmp_path):
    config = tmp_path / 'finger.yaml'
    config.write_text('contact_geometry:\n  ros__parameters:\n    finger_radius: 0.027\n')
    run(DATA / 'block', config=config, out=tmp_path / 'out')
    with BagReader(tmp_path / 'out') as new, BagReader(DATA / 'block') as old:
        pairs = zip(new.messages(['/contact']), old.messages(['/contact']), strict=True)
        for ours, theirs in pairs:
            after, before = (r.decode(m).pose.position for r, m in ((new, ours), (old, theirs)))
            assert after.x == pytest.approx(2.0 * before.x, abs=1e-15)
            assert after.y == pytest.approx(2.0 * before.y, abs=1e-15)


def test_readings_alone_give_contacts_and_commands(tmp_path):
    only = {'/tactile', '/joint_states'}
    bag = copied(DATA / 'block', tmp_path / 'readings', keep=only.__contains__)
    (comparison,) = run(bag, out=tmp_path / 'out')
    with BagReader(DATA / 'block') as reader:
        expected = {
            m.log_time: reader.decode(m).twist.linear.x
            for m in reader.messages(['/finger/cmd_vel'])
        }
    assert len(comparison.ticks) > 200
    assert all(math.isnan(tick.v_x_recorded) for tick in comparison.ticks)
    # The ticks fall between the readings otherwise than they did: about the same commands.
    largest = max(abs(v_x) for v_x in expected.values())
    assert max(abs(tick.v_x) for tick in comparison.ticks) == pytest.approx(largest, rel=0.1)
    with BagReader(tmp_path / 'out') as reader:
        assert all(reader.counts[topic] > 100 for topic in REPLAYED)


def test_contacts_alone_give_commands(tmp_path):
    keep = {'/contact', '/push_controller/state', '/finger/cmd_vel'}
    bag = copied(DATA / 'stops', tmp_path / 'contacts', keep=keep.__contains__)
    (comparison,) = run(bag, out=tmp_path / 'out')
    assert not comparison.different()
    assert contents(tmp_path / 'out') == contents(bag)


def test_two_fingers_are_two(tmp_path):
    def left(topic):
        return topic if topic.startswith('/parameter') else f'/left{topic}'

    bag = copied(DATA / 'stops', tmp_path / 'left', rename=left, note=False)
    both = tmp_path / 'both'
    with BagReader(bag) as a, BagReader(DATA / 'block') as b, BagWriter(both) as writer:
        for reader in (a, b):
            for topic in reader.topics.values():
                if topic.name != '/parameter_events':
                    writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
            for message in reader.messages():
                if message.topic != '/parameter_events':
                    writer.write(message.topic, message.data, message.log_time, message.log_time)
    fingers = {comparison.finger: comparison for comparison in run(both)}
    assert set(fingers) == {'', 'left'}
    # The epoch is that of the bag's beginning: simulated time here, for both.
    assert not fingers[''].different()
    assert len(fingers['left'].ticks) > 100


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


def test_source_is_not_touched(tmp_path):
    bag = copied(DATA / 'stops', tmp_path / 'bag')
    before = {f.name: hashlib.sha256(f.read_bytes()).digest() for f in bag.iterdir()}
    run(bag, out=tmp_path / 'out')
    assert {f.name: hashlib.sha256(f.read_bytes()).digest() for f in bag.iterdir()} == before


def test_nothing_to_replay_is_said(tmp_path):
    bag = copied(DATA / 'stops', tmp_path / 'bag', keep={'/joint_states'}.__contains__)
    with pytest.raises(BagError, match='nothing to replay'):
        run(bag)


def test_topic_of_another_type_is_refused(tmp_path):
    def swap(topic):
        return {'/contact': '/tactile', '/tactile': '/contact'}.get(topic, topic)

    bag = copied(DATA / 'stops', tmp_path / 'bag', rename=swap)
    with pytest.raises(BagError, match='expected geometry_msgs|expected sensor_msgs'):
        run(bag)


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['--kp', 'nan'], '--kp'),
        (['--kd', '1001'], 'parameter kd: expected a number'),
        (['--config', 'missing.yaml'], 'missing.yaml'),
        (['-o', '.'], 'is there already, expected a new folder'),
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
