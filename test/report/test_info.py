# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag, against bags of which it is known."""

import json
import math
import re

import numpy as np
import pytest
from mcap.writer import CompressionType, Writer

from support.bad_definitions import BAD_DEFINITIONS
from support.bad_notes import BAD_NOTES, NO_JSON
from support.bag_making import joint_state, write_bag, write_file, write_foreign_bag
from support.bags_to_know import BAND, CLOCK, JOINT_STATE, NOTES, PERIOD, STATE, clocks, pushes
from support.placed_bag import placed_bag
from support.placed_tables import OFF
from tactile_push.bags import BagReader, schema_text
from tactile_push.report.info import bag_info


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


@pytest.mark.slow
def test_median_of_very_many_intervals(tmp_path):
    # Every seventh interval is 70 ms, the others 10 ms.
    intervals = np.where(np.arange(40_000) % 7 == 0, 70, 10) * 1_000_000
    times = np.cumsum(intervals)
    path = write_file(tmp_path / 'many.mcap', {'/clock': clocks(*map(int, times))})
    (clock,) = info_of(path).topics
    assert clock.rate == pytest.approx(100.0)
    assert clock.messages == 40_000


SECOND = 10**9  # [ns]


@pytest.mark.parametrize(
    ('times', 'rate'),
    [
        # Nodes declare their parameters within microseconds; they start at once, or one by one.
        ([1000 * k for k in range(30)], None),
        ([second * SECOND + 2329 * k for second in (0, 1, 3) for k in range(10)], None),
        ([5 * SECOND, 5 * SECOND + 1], None),
        # Two changes of parameters 5 s apart say how often that happened.
        ([1 * SECOND, 6 * SECOND], 0.2),
        # A fast topic that fell silent, for most of the bag or even of an hour.
        ([k * SECOND // 50 for k in range(500)], 50.0),
        ([k * SECOND // 50 for k in range(500)] + [3600 * SECOND], 50.0),
        # 1 kHz for a fifth of a second.
        ([k * SECOND // 1000 for k in range(201)], 1000.0),
    ],
)
def test_rate_is_what_messages_keep_up_and_a_burst_does_not(write, times, rate):
    (_, topic) = info_of(write({'/a': clocks(0, 12 * SECOND), '/b': clocks(*times)})).topics
    assert topic.rate == (None if rate is None else pytest.approx(rate))
    assert topic.messages == len(times)


def test_rate_in_a_bag_that_is_shorter_than_a_second(write):
    burst, steady = [0, 700, 1400, 2100], [k * 20_000_000 for k in range(5)]
    quick, tactile = info_of(write({'/a': clocks(*burst), '/b': clocks(*steady)})).topics
    assert (quick.rate, tactile.rate) == (None, pytest.approx(50.0))


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


def test_goals_and_what_became_of_them(tmp_path):
    info = info_of(placed_bag(tmp_path / 'bag'))
    (goals,) = info.goals.values()
    assert list(info.goals) == ['']
    assert [one.stage for one in goals] == ['released', 'missed', 'preempted', 'not ended']
    assert goals[0].error == pytest.approx(OFF)
    assert info.pushes == {}


def test_the_truth_alone_has_no_goals(tmp_path):
    assert info_of(placed_bag(tmp_path / 'bag', places=False)).goals == {}


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


def test_topics_without_a_leading_slash_are_known_as_with_one(tmp_path):
    fingers = {STATE: pushes(math.radians(-10.0)), f'/left{STATE}': pushes(0.0, settled=110)}
    bare = {name[1:]: content for name, content in fingers.items()}
    info = info_of(write_file(tmp_path / 'bare.mcap', bare, NOTES))
    expected = info_of(write_file(tmp_path / 'two.mcap', fingers, NOTES))
    assert (info.topics, info.pushes) == (expected.topics, expected.pushes)


@pytest.mark.parametrize('edge', [1, -1])
def test_d_of_a_finger_without_a_simulator_follows_from_the_outline_of_active_sensing(
    tmp_path, edge
):
    vertices = [-0.04, -0.016, 0.04, -0.016, 0.04, 0.016, -0.04, 0.016]
    told = {'active_sensing': {'vertices': vertices, 'edge': edge}}
    notes = {'tactile_push.parameters': json.dumps(told)}
    info = info_of(write_file(tmp_path / 'x.mcap', {STATE: pushes(math.radians(-10.0))}, notes))
    (push,) = info.pushes.values()
    assert push.paper is None  # which pushed a block of another size
    if edge < 0:
        assert push.l is push.d_range is None
        assert info.remarks == [
            'l is not known: /active_sensing was not told which edge is pushed, so l is 16 or 40 mm'
        ]
    else:
        assert push.l == pytest.approx(0.04)
        # (17) by hand: -l / tan(82.5 deg + 10 deg).
        assert push.d_range == pytest.approx((-0.04 / math.tan(math.radians(92.5)),) * 2)
        assert info.remarks == []


@pytest.mark.parametrize(('text', 'words'), BAD_NOTES.values(), ids=BAD_NOTES)
def test_parameters_that_make_no_sense_are_left_out(tmp_path, text, words):
    notes = {'tactile_push.parameters': text}
    info = info_of(write_file(tmp_path / 'x.mcap', {'/clock': clocks(1)}, notes))
    assert (info.parameters is None) == (words == NO_JSON)
    (remark,) = info.remarks
    assert words in remark


def test_state_of_another_type_is_left_out(tmp_path):
    info = info_of(write_bag(tmp_path / 'bag', {STATE: clocks(1)}))
    assert info.pushes == {}
    assert info.remarks == [f'left alone: {STATE} (expected {JOINT_STATE}, got {CLOCK})']


@pytest.mark.parametrize(('definition', 'wrong'), BAD_DEFINITIONS.values(), ids=BAD_DEFINITIONS)
def test_bad_definition_is_marked(tmp_path, definition, wrong):
    path = tmp_path / 'x.mcap'
    topics = {STATE: pushes(0.0, 20), '/wheels': pushes(0.0, 20), '/clock': clocks(1, 2)}
    info = info_of(write_file(path, topics, definitions={JOINT_STATE: definition or ' '}))
    assert info.pushes == {}
    for topic in (STATE, '/wheels'):
        (remark,) = [line for line in info.remarks if f'for {topic} ' in line]
        assert remark.startswith(f'the definition of {JOINT_STATE} for {topic} ')
        assert re.search(wrong, remark)
    assert [topic.messages for topic in info.topics] == [2, 20, 20]


def test_missing_definition_of_any_type_is_marked(tmp_path):
    empty = ('std_msgs/msg/Empty', [(1, b'\0\1\0\0\0')])
    topics = {'/empty': empty, '/clock': clocks(1)}
    info = info_of(write_file(tmp_path / 'x.mcap', topics, definitions={CLOCK: '\n'}))
    assert info.remarks == [f'the definition of {CLOCK} for /clock is missing']


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
