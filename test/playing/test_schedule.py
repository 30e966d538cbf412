# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is played, and in which order, checked against lists written by hand."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.bags import BagWriter
from tactile_push.bags.reader import BagError, BagReader, Message
from tactile_push.playing.schedule import events, part_of, topic_in_bag

EPOCH = 1_700_000_000_000_000_000  # [ns]
SECOND = 10**9


def write(path, messages):
    """Write a bag of (topic, seconds since the epoch of the bag)."""
    with BagWriter(path) as bag:
        for topic in sorted({topic for topic, _ in messages} | {'/silent'}):
            bag.add_topic(topic, 'std_msgs/msg/Empty')
        for topic, seconds in messages:
            time = EPOCH + round(seconds * SECOND)
            bag.write(topic, b'\0\1\0\0\0', time, time)
    return BagReader(path)


@pytest.fixture
def bag(tmp_path):
    """Return a bag of four seconds."""
    return write(
        tmp_path / 'bag',
        [('/a', 0.0), ('/b', 0.5), ('/clock', 1.0), ('/a', 1.0), ('/b', 2.5), ('/a', 4.0)],
    )


def played(part):
    """Return topic and seconds of all messages of a part."""
    return [(m.topic, (m.log_time - EPOCH) / SECOND) for m in part.messages()]


def test_whole_bag(bag):
    part = part_of(bag)
    assert len(played(part)) == 6
    assert (part.begin, part.end) == (EPOCH, EPOCH + 4 * SECOND)


def test_topics_are_chosen_with_and_without_slash(bag):
    assert played(part_of(bag, ['a'])) == [('/a', 0.0), ('/a', 1.0), ('/a', 4.0)]
    assert played(part_of(bag, ['/b', 'b'])) == [('/b', 0.5), ('/b', 2.5)]


def test_start_counts_from_the_beginning_of_the_bag_whatever_the_topics(bag):
    part = part_of(bag, ['b'], start=0.5)
    assert played(part) == [('/b', 0.5), ('/b', 2.5)]
    assert part.begin == EPOCH + SECOND // 2
    assert played(part_of(bag, ['b'], start=0.6)) == [('/b', 2.5)]


def test_duration_counts_from_the_start_and_ends_with_the_bag(bag):
    part = part_of(bag, start=1.0, duration=1.5)
    assert played(part) == [('/clock', 1.0), ('/a', 1.0), ('/b', 2.5)]
    assert part.end == EPOCH + 5 * SECOND // 2
    assert part_of(bag, start=1.0, duration=60.0).end == EPOCH + 4 * SECOND


def test_player_that_tells_the_time_leaves_out_the_clock_of_the_bag(bag):
    assert '/clock' not in part_of(bag, with_clock=True).topics
    assert '/clock' in part_of(bag).topics


@pytest.mark.parametrize(
    ('choice', 'words'),
    [
        ({'topics': ['c']}, 'no topic /c'),
        ({'topics': ['/clok']}, 'no topic /clok, did you mean /clock?'),
        ({'topics': ['zzzzzz']}, '/a, /b, /clock, /silent'),
        ({'start': 4.1}, 'nothing at 4.1 s, the bag is 4 s long'),
        ({'topics': ['silent']}, 'no message of /silent'),
        ({'topics': ['b'], 'duration': 0.1}, 'no message of /b from 0 s to 0.1 s'),
        ({'topics': ['clock'], 'with_clock': True}, 'no message of other topics than /clock'),
        ({'start': 4.0, 'loop': True}, 'a loop of 0 s'),
    ],
)
def test_what_cannot_be_played_is_refused_in_one_line_with_the_bag(bag, choice, words):
    with pytest.raises(BagError) as refused:
        part_of(bag, **choice)
    assert words in str(refused.value)
    assert str(refused.value).startswith(f'{bag.path}: ')
    assert '\n' not in str(refused.value)


def test_empty_bag_is_refused(tmp_path):
    with pytest.raises(BagError, match='bag: expected messages, got none'):
        part_of(write(tmp_path / 'bag', []))


def test_topic_that_is_meant(bag):
    assert topic_in_bag(bag, 'clock') == topic_in_bag(bag, '/clock') == '/clock'


def message(time, topic='/a'):
    return Message(topic, time, time, b'')


def line_up(*times, begin=0, end=100, **options):
    """Return what happens, as (played, time, whether a message is sent)."""
    sent = [message(time) for time in times]
    happens = events(lambda: iter(sent), begin, end, **options)
    return ((e.played, e.time, e.message is not None) for e in happens)


def test_play_lasts_from_begin_to_end():
    assert list(line_up(20, 70)) == [(20, 20, True), (70, 70, True), (100, 100, False)]
    assert list(line_up(1020, begin=1000, end=1100)) == [(20, 1020, True), (100, 1100, False)]


def test_message_at_the_end_is_sent_before_the_play_ends():
    assert list(line_up(100)) == [(100, 100, True), (100, 100, False)]


def test_time_is_told_from_the_beginning_on_before_messages_of_the_same_time():
    happens = list(line_up(25, 50, clock_rate=SECOND / 25))
    times = [(time, sent) for _, time, sent in happens]
    assert times == [
        (0, False), (25, False), (25, True), (50, False), (50, True), (75, False), (100, False),
    ]  # fmt: skip


def test_loop_begins_at_its_beginning_again_and_goes_on_without_a_gap():
    rounds = itertools.islice(line_up(1010, 1090, begin=1000, end=1100, loop=True), 9)
    one = [(10, 1010, True), (90, 1090, True), (100, 1100, False)]
    assert list(rounds) == [
        (played + 100 * turn, time, sent) for turn in range(3) for played, time, sent in one
    ]


@given(
    st.lists(st.integers(0, 10**6)),
    st.integers(0, 2 * 10**18),
    st.floats(1e3, 1e6),
)
def test_nothing_goes_backwards_and_no_message_is_lost(offsets, begin, clock_rate):
    end = begin + 10**6
    sent = [message(begin + offset) for offset in sorted(offsets)]
    happens = list(events(lambda: iter(sent), begin, end, clock_rate=clock_rate))
    assert [e.message for e in happens if e.message] == sent
    assert [e.time for e in happens] == sorted(e.time for e in happens)
    assert all(e.played == e.time - begin for e in happens)
    told = [e.time for e in happens if not e.message]
    assert (told[0], told[-1]) == (begin, end)
    period = 1e9 / clock_rate
    assert all(b - a <= period + 1.0 for a, b in itertools.pairwise(told))
