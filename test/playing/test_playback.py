# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The timing of a play, by a clock that goes when the test says so."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tactile_push.bags.reader import Message
from tactile_push.playing.playback import LATE, Playback, Playhead
from tactile_push.playing.schedule import Event

SECOND = 10**9
START = 123_456_789_012_345  # some time of a steady clock [ns]


def event(seconds, topic='/a'):
    """Return an event, which only tells the time if it has no topic."""
    time = round(seconds * SECOND)
    return Event(time, time, Message(topic, time, time, b'') if topic else None)


class Stage:
    """Plays events by its own clock and notes when what was published."""

    def __init__(self, happens, rate=1.0):
        self.now = START
        self.published = []
        self.playback = Playback(iter(happens), rate, self.publish)

    def publish(self, event):
        self.published.append((self.now - START, event))

    def play(self):
        """Come back exactly when asked to, until nothing more is due."""
        while (due := self.playback.advance(self.now)) is not None:
            self.now = max(self.now, due)

    def pass_time(self, seconds):
        """Let time go by, and publish what is due in it."""
        until = self.now + round(seconds * SECOND)
        while (due := self.playback.advance(self.now)) is not None and due <= until:
            self.now = max(self.now, due)
        self.now = until

    def seconds(self):
        """Return when messages were published, since the start [s]."""
        return [now / SECOND for now, event in self.published if event.message]


HAPPENS = [event(0.0, None), event(0.5), event(0.5, '/b'), event(2.0), event(3.0, None)]


@pytest.mark.parametrize('rate', [0.25, 1.0, 4.0])
def test_messages_come_when_they_are_due(rate):
    stage = Stage(HAPPENS, rate)
    stage.playback.head.resume(stage.now)
    stage.play()
    assert stage.seconds() == [0.5 / rate, 0.5 / rate, 2.0 / rate]
    assert stage.now - START == 3.0 * SECOND / rate
    assert [event for _, event in stage.published] == HAPPENS
    assert stage.playback.done
    assert stage.playback.late == 0


def test_nothing_comes_before_it_is_due():
    stage = Stage(HAPPENS)
    stage.playback.head.resume(START)
    assert stage.playback.advance(START) == START + SECOND // 2
    assert stage.playback.advance(START + SECOND // 2 - 1) == START + SECOND // 2
    assert stage.seconds() == []
    stage.playback.advance(START + SECOND // 2)
    assert len(stage.seconds()) == 1


def test_play_that_was_not_let_go_rests():
    stage = Stage(HAPPENS)
    stage.pass_time(100.0)
    assert stage.published == []
    assert stage.playback.advance(stage.now) is None
    assert not stage.playback.done


def test_pause_moves_all_that_follows_by_its_length():
    stage = Stage(HAPPENS, rate=2.0)
    head = stage.playback.head
    head.resume(stage.now)
    stage.pass_time(0.3)
    head.pause(stage.now)
    stage.pass_time(50.0)
    assert head.paused
    assert head.played(stage.now) == 0.6 * SECOND
    head.resume(stage.now)
    stage.play()
    assert stage.seconds() == [0.25, 0.25, 51.0]


def test_pausing_twice_and_going_on_twice_is_like_once():
    head = Playhead(1.0)
    head.resume(0)
    head.resume(3)
    assert head.played(10) == 10
    head.pause(10)
    head.pause(20)
    assert head.played(30) == 10


def test_step_publishes_the_next_message_and_rests_there():
    stage = Stage(HAPPENS)
    assert stage.playback.step().topic == '/a'
    # What only tells the time before it comes, too: the message is not from the future.
    assert [event for _, event in stage.published] == HAPPENS[:2]
    assert stage.playback.step().topic == '/b'
    assert stage.playback.head.played(stage.now) == SECOND // 2
    stage.pass_time(7.0)
    stage.playback.head.resume(stage.now)
    stage.play()
    assert stage.seconds() == [0.0, 0.0, 7.0 + 1.5]


def test_step_after_the_last_message_plays_to_the_end():
    stage = Stage(HAPPENS)
    assert [stage.playback.step().log_time / SECOND for _ in range(3)] == [0.5, 0.5, 2.0]
    assert stage.playback.step() is None
    assert stage.playback.done
    assert stage.playback.step() is None
    assert [event for _, event in stage.published] == HAPPENS


def test_step_after_a_pause_never_takes_the_play_back():
    stage = Stage(HAPPENS)
    stage.playback.head.resume(stage.now)
    stage.now += 10 * SECOND  # nobody came to publish in all that time
    stage.playback.head.pause(stage.now)
    stage.playback.step()
    assert stage.playback.head.played(stage.now) == 10 * SECOND


def test_who_comes_late_publishes_all_that_is_due_in_order_and_is_on_time_again():
    stage = Stage(HAPPENS)
    stage.playback.head.resume(stage.now)
    stage.now += round(1.9 * SECOND)
    stage.play()
    assert stage.seconds() == [1.9, 1.9, 2.0]
    assert stage.playback.late == 3  # the beginning, and the two messages


def test_a_little_late_is_not_late():
    stage = Stage([event(1.0), event(2.0)])
    stage.playback.head.resume(stage.now)
    stage.now += SECOND + LATE
    stage.playback.advance(stage.now)
    assert stage.playback.late == 0
    stage.now += SECOND + 1
    stage.playback.advance(stage.now)
    assert stage.playback.late == 1


def test_play_without_events_is_done():
    assert Stage([]).playback.done


@given(st.floats(1e-3, 1e3), st.integers(0, 10**18), st.integers(0, 10**15))
def test_what_is_due_at_a_time_is_played_at_that_time(rate, start, played):
    head = Playhead(rate)
    head.resume(start)
    assert head.due(0) == start
    # A nanosecond is as exact as a time is; at a high rate many of the bag's go by in it.
    assert abs(head.played(head.due(played)) - played) <= max(1.0, rate) + played * 2e-15
    head.pause(start)
    assert head.due(played) is None


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 10**12)), max_size=30))
def test_play_goes_on_while_it_is_not_paused_and_never_back(pieces):
    head, now, expected = Playhead(2.0), 0, 0
    for paused, length in pieces:
        (head.pause if paused else head.resume)(now)
        now += length
        expected += 0 if paused else 2 * length
        assert head.played(now) == expected
