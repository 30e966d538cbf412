# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Reading ahead: the same events, bounded memory, errors where they belong."""

import itertools
import threading
import time

import pytest

from tactile_push.bags.reader import BagError, Message
from tactile_push.playing.read_ahead import BATCH, MOST, OVERHEAD, ReadAhead
from tactile_push.playing.schedule import Event


def event(number, size=0):
    return Event(number, number, Message('/a', number, number, bytes(size)))


class Source:
    """Gives events without end, or until it fails, and counts them."""

    def __init__(self, size=0, good=None):
        self.given = 0
        self.size = size
        self.good = good

    def __iter__(self):
        for number in itertools.count():
            if number == self.good:
                raise BagError('cut off')
            self.given += 1
            yield event(number, self.size)


def wait_until(condition):
    deadline = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.001)


@pytest.mark.parametrize('count', [0, 1, 7, 10_000])
def test_same_events_in_the_same_order(count):
    happens = [event(number, number % 300) for number in range(count)]
    ahead = ReadAhead(iter(happens))
    assert list(ahead) == happens
    assert list(ahead) == []
    ahead.close()


def test_reads_ahead_of_who_asks_but_no_more_than_fits():
    size = 10_000
    source = Source(size)
    ahead = ReadAhead(iter(source))
    wait_until(lambda: source.given * (size + OVERHEAD) >= MOST)
    read = -1
    while read != source.given:  # until it rests
        read = source.given
        time.sleep(0.05)
    assert source.given * (size + OVERHEAD) <= MOST + 2 * (BATCH + size + OVERHEAD)
    for number in range(5000):
        assert next(ahead).played == number
    assert source.given >= 5000
    ahead.close()


def test_message_larger_than_all_room_passes():
    happens = [event(0, MOST + 1), event(1, MOST + 1), event(2)]
    ahead = ReadAhead(iter(happens))
    assert [e.played for e in ahead] == [0, 1, 2]


def test_error_comes_after_the_events_before_it():
    ahead = ReadAhead(iter(Source(good=500)))
    assert [next(ahead).played for _ in range(500)] == list(range(500))
    for _ in range(2):
        with pytest.raises(BagError, match='cut off'):
            next(ahead)


def test_close_ends_the_reading_and_whoever_waits_for_it():
    gate = threading.Event()

    def slow():
        yield event(0, BATCH)
        gate.wait()
        yield event(1)

    ahead = ReadAhead(slow())
    assert next(ahead).played == 0
    rest = []
    waiting = threading.Thread(target=lambda: rest.append(list(ahead)))
    waiting.start()
    closing = threading.Thread(target=ahead.close)
    closing.start()
    waiting.join(60.0)
    assert rest == [[]]
    gate.set()
    closing.join(60.0)
    assert not closing.is_alive()
    ahead.close()
    assert 'read ahead' not in {thread.name for thread in threading.enumerate()}
