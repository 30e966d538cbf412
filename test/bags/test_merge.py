# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Batches of a bag merged by time, against a sort of all their messages."""

from hypothesis import given
from hypothesis import strategies as st

from tactile_push.bags import Message, merge
from tactile_push.bags.merge import Batch, in_order

BATCHES = st.lists(st.lists(st.integers(0, 40), min_size=1, max_size=12).map(sorted), max_size=8)


def batches_of(times, loads):
    """Return batches with messages of these times; each reading is noted in `loads`."""

    def batch(number, own):
        messages = [Message(f'/{number}', time, place, bytes(50)) for place, time in enumerate(own)]

        def load():
            loads.append(number)
            return messages

        return Batch(messages[0].log_time, load)

    return [batch(number, own) for number, own in enumerate(times)]


def sorted_messages(times):
    """Return topic, place and time of all messages by time, batch and place."""
    return sorted(
        (
            (time, f'/{number}', place)
            for number, own in enumerate(times)
            for place, time in enumerate(own)
        ),
    )


@given(BATCHES, st.sampled_from([0, 300, 2_000, 10**9]))
def test_messages_come_sorted_however_little_may_be_in_memory(times, budget):
    kept = merge._BUDGET
    merge._BUDGET = budget
    try:
        found = list(in_order(batches_of(times, [])))
    finally:
        merge._BUDGET = kept
    assert [(each.log_time, each.topic, each.publish_time) for each in found] == sorted_messages(
        times
    )


def test_a_batch_is_read_when_its_time_has_come():
    loads = []
    messages = in_order(batches_of([[1, 2, 3], [3, 4], [10, 11]], loads))
    assert loads == []
    assert [next(messages).log_time for _ in range(2)] == [1, 2]
    assert loads == [0]
    assert [next(messages).log_time for _ in range(3)] == [3, 3, 4]
    assert loads == [0, 1]
    assert next(messages).log_time == 10
    assert loads == [0, 1, 2]


def test_batches_that_do_not_fit_together_are_read_again(monkeypatch):
    monkeypatch.setattr(merge, '_BUDGET', 1_000)
    loads = []
    times = [[0, *range(100 + number, 110 + number)] for number in range(5)]
    found = list(in_order(batches_of(times, loads)))
    assert [each.log_time for each in found] == sorted(time for own in times for time in own)
    assert len(loads) > 5


def test_batches_without_messages_are_passed_over():
    empty = Batch(0, list)
    (batch,) = batches_of([[5]], [])
    assert [each.log_time for each in in_order([empty, batch, empty])] == [5]
    assert list(in_order([empty])) == []
