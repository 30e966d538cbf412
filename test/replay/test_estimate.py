# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What recorded pushes tell, against the simulator's truth in the same bag."""

import numpy as np
import pytest

from support.bag_copies import copied, with_topics, without
from support.foreign_topics import NAMESAKES, OTHERS
from support.sensed_bag import DATA, TICKS, said_by_a_node, with_sensing
from support.states import read_states
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.cli import main
from tactile_push.replay import estimate

BLOCK, STOPS = DATA / 'block', DATA / 'stops'
TRUTH = '/ground_truth/state'


def run(bag, **how):
    with BagReader(bag) as reader:
        return estimate(reader, **how)


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


def test_topics_without_a_leading_slash_tell_the_same(block, tmp_path):
    bag = copied(BLOCK, tmp_path / 'bag', rename=lambda topic: topic[1:])
    (figures,) = run(bag, sensing={'edge': 0})
    assert (figures.values, figures.at) == (block.values, block.at)
    assert (figures.compared, figures.inside) == (block.compared, block.inside)


def test_stops_make_it_forget(tmp_path):
    (figures,) = run(STOPS)
    assert 'contact lost' in {forgotten.reason for forgotten in figures.forgotten}
    times = [forgotten.at for forgotten in figures.forgotten]
    assert times == sorted(times)
    assert figures.compared == 0
    assert figures.inside is figures.inside_guaranteed is None


@pytest.mark.slow
def test_new_bag_has_what_a_node_that_heard_all_of_it_says(tmp_path):
    live = with_sensing(BLOCK, said_by_a_node(BLOCK), tmp_path / 'live')
    late = with_sensing(BLOCK, said_by_a_node(BLOCK, 100), tmp_path / 'late')
    run(late, out=tmp_path / 'estimated')
    assert main(['diff', str(live), str(tmp_path / 'estimated')]) == 0


@pytest.mark.slow
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


def test_foreign_topics_are_left_alone_and_named_once(tmp_path, capsys):
    bag = with_topics(BLOCK, tmp_path / 'mixed', *NAMESAKES, *OTHERS)
    assert main(['estimate', str(bag), '--edge', '0', '-o', str(tmp_path / 'out')]) == 0
    named, block = capsys.readouterr().err.splitlines()
    assert named.endswith(
        ': left alone: /sim/push_controller/state (expected sensor_msgs/msg/JointState, got '
        'std_msgs/msg/Bool)'
    )
    assert "paper's block" in block
    with BagReader(bag) as a, BagReader(tmp_path / 'out') as b:
        assert [a.topics[name] for name, *_ in OTHERS] == [b.topics[name] for name, *_ in OTHERS]


def test_topic_of_another_type_is_refused(tmp_path):
    with BagReader(BLOCK) as reader, BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TICKS, reader.topics['/contact'].type_name)
        for message in reader.messages(['/contact']):
            writer.write(TICKS, message.data, message.log_time, message.log_time)
    with pytest.raises(BagError, match=r'push_controller/state \(expected sensor_msgs'):
        run(tmp_path / 'bag')
