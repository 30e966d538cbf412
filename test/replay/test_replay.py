# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags in, bags out.

data/block is the paper's block on simulated time with a noisy sensor, from the first tick on.
data/stops is recorded from the middle of a run in real time: new goals, a killed driver, a
deactivation, a controller that stood still, a command of somebody else, two resumes. Nodes of an
earlier version made them: what the present code makes of their readings must not differ.
"""

import hashlib
import re

import pytest

from support.bad_definitions import BAD_DEFINITIONS
from support.bad_notes import BAD_NOTES
from support.bag_copies import DATA, contents, copied, replayed, with_topics
from support.bag_making import encode, write_file
from support.foreign_topics import BOOL, NAMESAKES, OTHERS
from tactile_push.bags import BagError, BagReader, BagWriter, schema_text
from tactile_push.cli import main
from tactile_push.control import STOP_REASONS

BAGS = ['block', 'stops']


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
    (comparison,) = replayed(DATA / name)
    assert len(comparison.ticks) > 100
    assert comparison.kept <= 3
    assert not comparison.different()


@pytest.mark.parametrize('name', BAGS)
def test_the_new_bag_has_what_the_nodes_said_to_the_last_digit(name, tmp_path):
    replayed(DATA / name, out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(DATA / name)
    assert main(['diff', str(DATA / name), str(tmp_path / 'out')]) == 0


def test_a_change_of_a_command_is_found_out(tmp_path):
    replayed(DATA / 'block', controller={'kd': 5.0 + 1e-12}, out=tmp_path / 'out')
    assert main(['diff', str(DATA / 'block'), str(tmp_path / 'out')]) == 1


def test_a_replay_of_a_replay_gives_the_same_bytes(tmp_path):
    replayed(DATA / 'stops', out=tmp_path / 'one')
    replayed(tmp_path / 'one', out=tmp_path / 'two')
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert list(one.messages()) == list(two.messages())
        assert one.notes == two.notes


def test_other_gains_command_otherwise_and_nothing_else_changes(tmp_path):
    (comparison,) = replayed(
        DATA / 'block', controller={'kd': 0.0, 'kp': 0.0}, out=tmp_path / 'out'
    )
    # Without gains the law stays where it starts: straight ahead.
    assert {tick.v_x for tick in comparison.ticks} == {0.0}
    assert comparison.different()
    inputs = ['/tactile', '/joint_states', '/contact', '/contact_geometry/state', '/clock']
    assert contents(tmp_path / 'out', inputs) == contents(DATA / 'block', inputs)


def test_config_file_overrides_the_record_and_an_option_the_file(tmp_path):
    config = tmp_path / 'gains.yaml'
    config.write_text('/**:\n  ros__parameters:\n    kp: 0.0\n    kd: 1.0\n')
    (by_file,) = replayed(DATA / 'block', config=config)
    (by_option,) = replayed(DATA / 'block', config=config, controller={'kd': 0.0})
    assert any(tick.v_x for tick in by_file.ticks)
    assert not any(tick.v_x for tick in by_option.ticks)


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
    fingers = {comparison.finger: comparison for comparison in replayed(both)}
    assert set(fingers) == {'', 'left'}
    # The epoch is that of the bag's beginning: simulated time here, for both.
    assert not fingers[''].different()
    assert len(fingers['left'].ticks) > 100


def test_topics_without_a_leading_slash_are_replayed_and_compared_as_with_one(tmp_path):
    bag = copied(DATA / 'block', tmp_path / 'bag', rename=lambda topic: topic[1:])
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert len(comparison.ticks) > 100
    assert not comparison.different()
    for one, other in ((bag, DATA / 'block'), (DATA / 'block', tmp_path / 'out')):
        assert main(['diff', str(one), str(other)]) == 0
        assert main(['diff', str(one), str(other), '--topics', 'contact', '/tactile']) == 0


def test_source_is_not_touched(tmp_path):
    bag = copied(DATA / 'stops', tmp_path / 'bag')
    before = {f.name: hashlib.sha256(f.read_bytes()).digest() for f in bag.iterdir()}
    replayed(bag, out=tmp_path / 'out')
    assert {f.name: hashlib.sha256(f.read_bytes()).digest() for f in bag.iterdir()} == before


def test_nothing_to_replay_is_said(tmp_path):
    bag = copied(DATA / 'stops', tmp_path / 'bag', keep={'/joint_states'}.__contains__)
    with pytest.raises(BagError, match='nothing to replay'):
        replayed(bag)


@pytest.fixture
def mixed(tmp_path):
    """Return the block's bag with topics of other software."""
    return with_topics(DATA / 'block', tmp_path / 'mixed', *NAMESAKES, *OTHERS)


def test_foreign_topics_are_left_alone_and_named_once(mixed, capsys):
    assert main(['replay', str(mixed)]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f'tactile_push replay: warning: {mixed}: left alone: ')
    assert line.count('/hand/contact (expected geometry_msgs/msg/PoseStamped, got std_m') == 1
    assert line.count('/glove/tactile (expected sensor_msgs/msg/JointState, got no type)') == 1
    assert '/scene' not in line
    (comparison,) = replayed(mixed)
    assert (comparison.finger, comparison.different()) == ('', [])
    assert len(comparison.ticks) > 100


def test_foreign_topics_are_copied_as_they_are(mixed, tmp_path):
    replayed(mixed, out=tmp_path / 'out')
    with BagReader(mixed) as a, BagReader(tmp_path / 'out') as b:
        for name, *_ in NAMESAKES + OTHERS:
            assert a.topics[name] == b.topics[name]
            assert [m.data for m in a.messages([name])] == [m.data for m in b.messages([name])]
    assert main(['diff', str(mixed), str(tmp_path / 'out')]) == 0


def test_name_of_the_finger_itself_may_be_taken_by_something_foreign(tmp_path):
    bag = copied(DATA / 'block', tmp_path / 'bag', keep=lambda topic: topic != '/contact')
    bag = with_topics(bag, tmp_path / 'mixed', ('/contact', *BOOL))
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert not comparison.different()
    assert contents(tmp_path / 'out') == contents(bag)


def test_parameter_events_of_another_type_are_left_alone(tmp_path, capsys):
    bag = copied(DATA / 'block', tmp_path / 'bag', keep=lambda topic: topic != '/parameter_events')
    bag = with_topics(bag, tmp_path / 'mixed', ('/parameter_events', *BOOL))
    assert main(['replay', str(bag), '-o', str(tmp_path / 'out')]) == 0
    assert '/parameter_events (expected rcl_interfaces/' in capsys.readouterr().err
    assert main(['diff', str(bag), str(tmp_path / 'out')]) == 0


@pytest.mark.parametrize(('definition', 'wrong'), BAD_DEFINITIONS.values(), ids=BAD_DEFINITIONS)
def test_bad_definition_of_a_topic_that_is_needed_is_refused_in_one_line(
    tmp_path, capsys, definition, wrong
):
    topic = '/push_controller/state'
    bag = copied(DATA / 'block', tmp_path / 'bag', definitions={topic: definition})
    for command in ('replay', 'estimate', 'report'):
        assert main([command, str(bag)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f'tactile_push {command}: {bag}: the definition of sensor_msgs/msg/')
        assert f'for {topic} ' in line
        assert re.search(wrong, line)


def test_bad_definition_of_a_topic_that_is_not_needed_does_not_matter(tmp_path):
    bag = copied(DATA / 'block', tmp_path / 'bag', definitions={'/ground_truth/state': ''})
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert not comparison.different()


@pytest.mark.parametrize('shape', ['no JSON', 'a mapping for a list'])  # of all that are refused
def test_notes_of_another_shape_are_warned_of_and_left_out(tmp_path, capsys, shape):
    text, words = BAD_NOTES[shape]
    bag = with_topics(copied(DATA / 'block', tmp_path / 'a', note=False), tmp_path / 'b')
    write_file(bag / 'notes_0.mcap', {}, notes={'tactile_push.parameters': text})
    for command in ('replay', 'estimate', 'report'):
        out = ['-o', str(tmp_path / 'page.html')] if command == 'report' else []
        assert main([command, str(bag), *out]) == 0
        lines = capsys.readouterr().err.splitlines()
        (told,) = [line for line in lines if words in line]
        assert told.startswith(f'tactile_push {command}: warning: ')


EVENT = 'rcl_interfaces/msg/ParameterEvent'
REFUSED = [
    ('push_controller', 'contact_timeout', {'type': 3, 'double_value': -1.0}),
    ('push_controller', 'max_speed', {'type': 4, 'string_value': 'fast'}),
    ('push_controller', 'max_acceleration', {'type': 9}),
    ('contact_geometry', 'jump_tolerance', {'type': 1, 'bool_value': True}),
    ('contact_geometry', 'max_theta_rate', {'type': 200}),
]


@pytest.mark.parametrize(('node', 'name', 'value'), REFUSED, ids=[name for _, name, _ in REFUSED])
def test_change_that_a_node_refuses_is_none(tmp_path, node, name, value):
    change = encode(EVENT, node=f'/{node}', changed_parameters=[{'name': name, 'value': value}])
    definition = schema_text(EVENT).encode()
    row = ('/parameter_events', EVENT, 'cdr', 'ros2msg', definition, change)
    (comparison,) = replayed(with_topics(DATA / 'block', tmp_path / 'bag', row))
    assert len(comparison.ticks) > 100
    assert not comparison.different()


def test_bag_of_foreign_topics_alone_is_refused_in_one_line_that_names_them(tmp_path, capsys):
    bag = with_topics(
        copied(DATA / 'block', tmp_path / 'bag', keep={'/clock'}.__contains__),
        tmp_path / 'mixed',
        *NAMESAKES,
    )
    for command in ('replay', 'estimate'):
        assert main([command, str(bag)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert '/sim/push_controller/state (expected sensor_msgs/msg/JointState, got std_' in line
