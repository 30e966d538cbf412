# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pairing of messages, by properties that any right pairing has."""

import random
from collections import Counter
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.bag_making import encode
from tactile_push.bags import schema_text
from tactile_push.bags.reader import Message
from tactile_push.comparing import pairing
from tactile_push.comparing.pairing import pairs_by_stamp, pairs_in_order

JOINT_STATE = 'sensor_msgs/msg/JointState'
HEAD = encode(JOINT_STATE, 0)


class MadeBag:
    """A bag of messages (topic, stamp, serial number) in their order, with sizes if given."""

    def __init__(self, messages, size=0):
        topics = {topic for topic, _ in messages} | {'/a', '/b'}
        definition = schema_text(JOINT_STATE)
        self.path = 'made'
        self.topics = {
            name: SimpleNamespace(type_name=JOINT_STATE, definition=definition, decodes=True)
            for name in topics
        }
        self.most_read = 0
        self._messages = [
            Message(
                topic,
                time,
                time,
                HEAD[:4] + stamp.to_bytes(4, 'little', signed=True) + bytes(4 + size),
            )
            for time, (topic, stamp) in enumerate(messages)
        ]

    def messages(self, topics):
        for message in self._messages:
            if message.topic in topics:
                yield message


def pairs_of(messages_a, messages_b, size=0):
    """Return the pairs as (topic, stamp, place in A, place in B)."""
    a, b = MadeBag(messages_a, size), MadeBag(messages_b, size)
    pairs = list(pairs_by_stamp(a, b, sorted(a.topics.keys() | b.topics.keys())))
    assert all(pair.key % 10**9 == 0 for pair in pairs)
    return [
        (
            pair.topic,
            pair.key // 10**9,
            None if pair.a is None else pair.a.log_time,
            None if pair.b is None else pair.b.log_time,
        )
        for pair in pairs
    ]


def right_pairs(messages_a, messages_b):
    """Return what is right: the k-th message of a topic and stamp belongs to the k-th."""

    def numbered(messages):
        seen = Counter()
        places = {}
        for place, key in enumerate(messages):
            places[(*key, seen[key])] = place
            seen[key] += 1
        return places

    a, b = numbered(messages_a), numbered(messages_b)
    return Counter((*key[:2], a.get(key), b.get(key)) for key in a.keys() | b.keys())


MESSAGES = st.lists(st.tuples(st.sampled_from(['/a', '/b']), st.integers(-3, 12)), max_size=40)


@given(MESSAGES, MESSAGES)
def test_equal_stamps_of_a_topic_are_paired_in_their_order_whatever_the_order(a, b):
    assert Counter(pairs_of(a, b)) == right_pairs(a, b)


@given(MESSAGES, MESSAGES)
def test_pairing_does_not_depend_on_which_bag_comes_first(a, b):
    swapped = Counter((topic, stamp, y, x) for topic, stamp, x, y in pairs_of(b, a))
    assert Counter(pairs_of(a, b)) == swapped


def steady(start, count, topics=('/a', '/b')):
    return [(topic, start + k) for k in range(count) for topic in topics]


@pytest.mark.parametrize(
    ('a', 'b'),
    [
        pytest.param(steady(0, 2_000), steady(1_200, 800), id='B starts later'),
        pytest.param(steady(0, 2_000), steady(0, 800), id='B ends earlier'),
        pytest.param(steady(0, 2_000), steady(0, 200) + steady(1_400, 600), id='B has a gap'),
        pytest.param(
            steady(0, 2_800),
            steady(0, 200) + steady(200, 2_600, ['/a']),
            id='a topic of B ends early',
        ),
        pytest.param(
            [('/b', 2_000_000_000), *steady(0, 800)],
            steady(0, 800),
            id='one stamp of A is far ahead',
        ),
        pytest.param(
            steady(0, 800) + steady(0, 800),
            [key for key in steady(0, 800) + steady(0, 800) if key[1] % 100 != 7],
            id='the clock starts over',
        ),
        pytest.param(
            [(topic, stamp + 10**9 * (topic == '/b')) for topic, stamp in steady(0, 1_000)],
            [(topic, stamp + 10**9 * (topic == '/b')) for topic, stamp in steady(600, 1_000)],
            id='the clocks of the topics differ',
        ),
        pytest.param([('/a', 0)] * 1_500, [('/a', 0)] * 1_500, id='never stamped'),
    ],
)
def test_long_stretches_that_one_bag_lacks_do_not_keep_the_rest_apart(monkeypatch, a, b):
    # Both a tenth of what they are: each stretch is longer than what may wait.
    monkeypatch.setattr(pairing, 'MOST_MESSAGES', 1000)
    monkeypatch.setattr(pairing, 'LATELY', 100)
    assert Counter(pairs_of(a, b)) == right_pairs(a, b)
    assert Counter(pairs_of(b, a)) == right_pairs(b, a)


def test_messages_that_are_shuffled_a_little_are_found():
    a = steady(0, 8_000)
    order = random.Random(5)
    b = sorted(a, key=lambda key: key[1] + order.uniform(0, 300))
    assert Counter(pairs_of(a, b)) == right_pairs(a, b)


@pytest.mark.slow
@pytest.mark.parametrize('size', [0, 100_000])
def test_what_waits_is_bounded_by_number_and_by_bytes(size):
    waiting, most = 0, 0
    count = 1_000 if size else 40_000
    a, b = MadeBag(steady(0, count, ['/a']), size), MadeBag([])

    def counted():
        nonlocal waiting
        for message in MadeBag.messages(a, ['/a']):
            waiting += 1
            yield message

    a.messages = lambda topics: counted()
    for pair in pairs_by_stamp(a, b, ['/a']):
        assert pair.b is None
        most = max(most, waiting)
        waiting -= 1
    assert waiting == 0
    assert most <= (161 if size else 10_001)


def test_messages_without_header_are_paired_by_their_place():
    a, b = MadeBag(steady(0, 3, ['/a'])), MadeBag(steady(7, 5))
    pairs = list(pairs_in_order(a, b, '/a'))
    assert [(pair.topic, pair.key) for pair in pairs] == [('/a', k) for k in range(5)]
    assert [pair.a and pair.a.log_time for pair in pairs] == [0, 1, 2, None, None]
    assert [pair.b and pair.b.log_time for pair in pairs] == [0, 2, 4, 6, 8]
