# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When something begins to be the matter, how long it lasts, and that nothing piles up."""

import itertools

import pytest

from tactile_push.report.data import ERROR, NOTE, WARNING
from tactile_push.watching.events import MOST_KINDS, MOST_LETTERS, Events

SILENT = ERROR, 'stopped: contact silent'


def test_what_is_said_again_lasts_and_what_is_not_ends():
    events = Events()
    for k in range(11):
        events.say(0.1 * k, 'controller', SILENT, 1.0)
    (event,) = events.listed()
    assert (event.lane, event.level, event.text) == ('controller', *SILENT)
    assert (event.times, event.start, event.end) == (1, 0.0, None)
    events.expire(1.9)
    assert events.listed()[0].end is None
    events.expire(2.1)
    assert events.listed()[0].end == pytest.approx(2.0)


def test_another_word_ends_it_at_once_and_the_same_again_is_the_second_time():
    events = Events()
    events.say(1.0, 'controller', SILENT, 1.0)
    events.say(1.5, 'controller', None, 1.0)
    events.say(1.6, 'controller', SILENT, 1.0)
    events.say(1.7, 'controller', (NOTE, 'waiting'), 1.0)
    latest, before = events.listed()
    assert (latest.text, latest.times, latest.start, latest.end) == ('waiting', 1, 1.7, None)
    assert (before.text, before.times, before.start, before.end) == (SILENT[1], 2, 1.6, 1.7)


def test_the_same_after_a_silence_began_anew():
    events = Events()
    events.say(0.0, 'driver', (WARNING, 'slow'), 2.0)
    events.say(5.0, 'driver', (WARNING, 'slow'), 2.0)
    (event,) = events.listed()
    assert (event.times, event.start, event.end) == (2, 5.0, None)


def test_sources_of_one_lane_do_not_end_each_other():
    events = Events()
    events.say(0.0, 'bounds', (NOTE, 'φ at its bound'), 1.0, 'saturated')
    events.say(0.0, 'bounds', (NOTE, 'v_x at its bound'), 1.0, 'limited')
    events.say(0.1, 'bounds', None, 1.0, 'saturated')
    assert {event.text: event.end for event in events.listed()} == {
        'φ at its bound': 0.1,
        'v_x at its bound': None,
    }


def test_what_lasts_comes_first_and_the_gravest_before_the_rest():
    events = Events()
    events.say(0.0, 'a', (NOTE, 'waiting'), 9.0)
    events.say(1.0, 'b', (WARNING, 'slow'), 9.0)
    events.say(2.0, 'c', SILENT, 9.0)
    for at, lane in ((3.0, 'd'), (4.0, 'e')):
        events.say(at, lane, SILENT, 0.5)
    events.expire(8.0)
    assert [event.lane for event in events.listed()] == ['c', 'b', 'a', 'e', 'd']


def test_version_changes_when_something_begins_or_ends_and_only_then():
    events = Events()
    versions = [events.version]
    for at, label in ((0.0, None), (0.1, SILENT), (0.2, SILENT), (0.3, None), (0.4, None)):
        events.say(at, 'controller', label, 1.0)
        versions.append(events.version)
    changes = [after != before for before, after in itertools.pairwise(versions)]
    assert changes == [False, True, False, True, False]


def test_ever_new_words_fill_no_memory_and_what_lasts_stays():
    events = Events()
    events.say(0.0, 'controller', SILENT, 1e9)
    for k in range(1000):
        events.say(float(k), 'driver', (WARNING, f'reading {k} ' + 'x' * 10_000), 2.0)
        assert len(events.listed()) <= MOST_KINDS
    assert events.listed()[0].lane == 'controller'
    assert events.listed()[1].text.startswith('reading 999')
    assert max(len(event.text) for event in events.listed()) == MOST_LETTERS
    for k in range(1000):
        events.say(1000.0, f'nobody {k}', (WARNING, 'here'), 2.0)
    events.expire(2000.0)
    assert set(events._sources) == {('controller', '')}


def test_long_words_said_again_are_the_same():
    events = Events()
    for k in range(5):
        events.say(0.1 * k, 'driver', (WARNING, 'x' * 10_000), 2.0)
    assert [event.times for event in events.listed()] == [1]
