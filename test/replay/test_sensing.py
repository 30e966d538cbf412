# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a node said of the object comes out again, wherever node and recording began."""

import json
import math

import pytest

from support.bag_making import encode, write_file
from support.clock_apart import periods
from support.sensed_bag import DATA, POSE, STATE, said_by_a_node, with_sensing
from tactile_push.bags import BagReader, BagWriter
from tactile_push.cli import main
from tactile_push.interface import CONTACT, TOPICS
from tactile_push.replay import replay
from tactile_push.replay.messages import nanoseconds

pytestmark = pytest.mark.slow

BAGS = ['block', 'stops']


@pytest.fixture(scope='module', params=BAGS)
def bag(request):
    return DATA / request.param


@pytest.fixture(scope='module')
def said(bag):
    return said_by_a_node(bag)


def run(bag, **how):
    with BagReader(bag) as reader:
        return replay(reader, **how)


def readings_of(bag):
    """Return how many readings the node had taken, by each of its messages."""
    with BagReader(bag) as reader:
        states = [reader.decode(message) for message in reader.messages([STATE])]
    return [state.position[state.name.index('readings')] for state in states]


def same(one, other):
    return main(['diff', str(one), str(other)]) == 0


def test_what_a_node_said_comes_out_to_the_last_digit(bag, said, tmp_path):
    live = with_sensing(bag, said, tmp_path / 'live')
    (comparison,) = run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')
    with BagReader(live) as reader:
        assert (
            len(comparison.sensed)
            == reader.counts[STATE]
            == len(comparison.ticks) + (comparison.kept)
        )
        assert reader.counts[POSE] > 50


def test_pose_that_was_recorded_before_its_state_is_no_other_one(bag, said, tmp_path):
    live = with_sensing(bag, said, tmp_path / 'live', pose_first=True)
    run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')


@pytest.mark.parametrize('from_tick', [1, 30])
@pytest.mark.parametrize('pose_first', [False, True])
def test_node_that_came_later_heard_less(bag, tmp_path, from_tick, pose_first):
    late = said_by_a_node(bag, from_tick)
    live = with_sensing(bag, late, tmp_path / 'live', pose_first=pose_first)
    (comparison,) = run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')
    with BagReader(live) as reader:
        assert len(comparison.sensed) == reader.counts[STATE]


@pytest.mark.parametrize('missing', [1, 2, 3, 20])
def test_recording_may_end_before_the_node_has_said_all(bag, said, tmp_path, missing):
    live = with_sensing(bag, said[:-missing], tmp_path / 'live')
    (comparison,) = run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')
    with BagReader(live) as reader:
        assert len(comparison.sensed) == reader.counts[STATE]


def test_message_that_the_recorder_missed_is_made_again(bag, said, tmp_path):
    live = with_sensing(bag, said, tmp_path / 'live')
    missed = with_sensing(bag, said[:20] + said[23:], tmp_path / 'missed')
    run(missed, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')


@pytest.mark.parametrize('pose_first', [False, True])
@pytest.mark.parametrize('missed', [1, 2])
def test_node_that_began_where_the_recorder_missed_it_is_kept(
    bag, said, tmp_path, missed, pose_first
):
    # The recorder heard what the node said of its first control periods, but not these themselves.
    live = with_sensing(bag, said, tmp_path / 'live', pose_first=pose_first, ticks_missed=missed)
    assert min(readings_of(live)) <= 1.0
    (comparison,) = run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')
    # Nobody can know how it went on, before it began anew.
    begins = [k for k, count in enumerate(readings_of(live)) if count <= 1.0 and k >= missed]
    assert len(comparison.sensed) == (len(readings_of(live)) - begins[0] if begins else 0)


def test_pose_is_made_where_the_state_alone_was_recorded(bag, said, tmp_path):
    states = [message for message in said if message.topic == STATE]
    run(with_sensing(bag, states, tmp_path / 'states'), out=tmp_path / 'again')
    assert same(with_sensing(bag, said, tmp_path / 'live'), tmp_path / 'again')


@pytest.mark.parametrize('pose_first', [False, True])
def test_recording_from_the_middle_keeps_what_nobody_can_know(bag, said, tmp_path, pose_first):
    live = with_sensing(bag, said, tmp_path / 'live', begin=3 * 10**9, pose_first=pose_first)
    readings = readings_of(live)
    assert readings[0] > 1.0
    (comparison,) = run(live, out=tmp_path / 'again')
    assert same(live, tmp_path / 'again')
    begins = [k for k, count in enumerate(readings) if count <= 1.0]
    assert len(comparison.sensed) == (len(readings) - begins[0] if begins else 0)
    assert bool(begins) == (bag.name == 'stops')  # where the finger lost the contact


def test_other_parameters_tell_otherwise_and_nothing_else_changes(said, tmp_path, bag):
    live = with_sensing(bag, said, tmp_path / 'live')
    config = tmp_path / 'noise.yaml'
    config.write_text('active_sensing:\n  ros__parameters:\n    noise: 0.006\n')
    run(live, config=config, out=tmp_path / 'again')
    assert not same(live, tmp_path / 'again')
    assert main(['diff', str(live), str(tmp_path / 'again'), '--ignore', STATE, POSE]) == 0


def test_object_is_sensed_if_somebody_asks_for_it_by_name(tmp_path, bag):
    config = tmp_path / 'config.yaml'
    config.write_text('/**:\n  ros__parameters:\n    noise: 0.006\n')
    (comparison,) = run(bag, config=config, out=tmp_path / 'without')
    assert comparison.sensed is None
    with BagReader(tmp_path / 'without') as reader:
        assert STATE not in reader.topics
    outline = [-0.025, -0.02375, 0.025, -0.02375, 0.025, 0.02375, -0.025, 0.02375]
    config.write_text(f'/**/active_sensing:\n  ros__parameters:\n    vertices: {outline}\n')
    (comparison,) = run(bag, config=config, out=tmp_path / 'with')
    assert len(comparison.sensed) == len(comparison.ticks) + comparison.kept
    assert all(-0.025 <= tick.d_least <= tick.d_lower for tick in comparison.sensed)
    with BagReader(tmp_path / 'with') as reader:
        assert reader.counts[STATE] == len(comparison.sensed)
        assert reader.counts[POSE] > 0


def test_rig_is_that_of_the_other_nodes_where_nobody_recorded_it(tmp_path):
    bag = DATA / 'block'
    config = tmp_path / 'config.yaml'
    section = 'active_sensing:\n  ros__parameters:\n    edge: 0\n'
    speed = 'push_controller:\n  ros__parameters:\n    belt_speed: 0.006\n'
    given = section + '    belt_speed: 0.006\n'
    with BagReader(bag) as reader, BagWriter(tmp_path / 'faster') as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        for message in reader.messages():
            writer.write(message.topic, message.data, message.log_time, message.publish_time)
        notes = json.loads(reader.notes['tactile_push.parameters'])
        notes['push_controller']['belt_speed'] = 0.006
        writer.note('tactile_push.parameters', json.dumps(notes))
    results = []
    for source, text in ((tmp_path / 'faster', section), (bag, speed + given), (bag, section)):
        config.write_text(text)
        results.append([str(tick) for tick in run(source, config=config)[0].sensed])
    assert results[0] == results[1] != results[2]


def test_command_tells_d_at_the_end_and_of_every_control_period(bag, said, tmp_path, capsys):
    live = with_sensing(bag, said, tmp_path / 'live')
    assert main(['replay', str(live)]) == 0
    (line,) = [li for li in capsys.readouterr().out.splitlines() if 'd at the end [mm]' in li]
    assert 'guaranteed' in line
    assert main(['replay', str(live), '--json', '-']) == 0
    (finger,) = json.loads(capsys.readouterr().out)['fingers']
    states = []
    with BagReader(live) as reader:
        for message in reader.messages([STATE]):
            state = reader.decode(message)
            states.append(dict(zip(state.name, state.position, strict=True)))
    for ours, theirs in zip(finger['sensed'], states, strict=True):
        for name in ('d', 'd_lower', 'd_upper', 'd_least', 'd_most'):
            assert ours[name] == (None if math.isnan(theirs[name]) else theirs[name])
    assert main(['replay', str(bag), '--json', '-']) == 0
    assert json.loads(capsys.readouterr().out)['fingers'][0]['sensed'] is None


def bag_of_a_clock_apart(path, ahead):
    """Write a bag of the block, pushed on contacts whose stamps are ahead by so many ns."""
    topics = {}
    for period in periods(ahead, 67):
        outputs = [(CONTACT, contact) for contact in period.contacts]
        outputs += period.control.outputs(period.stamp, period.tick)
        for topic, fields in outputs:
            kind = TOPICS[topic].type_name
            _, messages = topics.setdefault(f'/{topic}', (kind, []))
            messages.append((nanoseconds(period.stamp), encode(kind, **fields)))
    notes = {'tactile_push.parameters': json.dumps({'push_controller': {}})}
    return write_file(path, topics, notes)


@pytest.mark.parametrize('ahead', [-280_000_000, 1, 20_000_000, 280_000_000])
def test_what_a_node_made_of_readings_of_another_clock_comes_out_again(tmp_path, ahead):
    bag = bag_of_a_clock_apart(tmp_path / 'bag.mcap', ahead)
    live = with_sensing(bag, said_by_a_node(bag), tmp_path / 'live')
    (comparison,) = run(live, out=tmp_path / 'again')
    assert not comparison.different()
    assert same(live, tmp_path / 'again')
    assert readings_of(live)[-1] >= 63
    with BagReader(live) as reader:
        assert len(comparison.sensed) == reader.counts[STATE] == 67
        stamps = [reader.decode(message).header.stamp for message in reader.messages([POSE])]
        contacts = [
            reader.decode(message).header.stamp for message in reader.messages(['/contact'])
        ]
    read = {(stamp.sec, stamp.nanosec) for stamp in contacts}
    assert read.issuperset((stamp.sec, stamp.nanosec) for stamp in stamps)
