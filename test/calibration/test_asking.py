# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.calibration.asking import (
    FREE,
    LIFT,
    TAKEN,
    TAKING,
    TOUCH,
    Asking,
)
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.calibration.steadiness import HOLD, Sight
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError

PLACES = suggested_touches()
PERIOD = 0.125  # [s], of which sums are exact


class Numbers:
    """A sensor that measures one number: 0 for nothing, else where it is touched."""

    LEAST, LEAST_FREE, FREE_TIME, HINT = 3, 4, 0.2, 'press'

    def take_free(self, values):
        if any(values):
            raise NotUntouchedError('touched')

    def sight(self, value):
        if value < 0.0:
            raise ReadingRejectedError('below zero')
        return Sight(value > 0.0, value == 0.0, np.array([value]))

    def words(self, values):
        return f'felt {values[-1]}'


class Person:
    """Answers what is asked for, and remembers what was said and kept."""

    def __init__(self):
        self.said, self.kept = [], []
        self.time = 0.0
        self.asking = Asking(Numbers(), self, self.said.append)

    def free(self, messages):
        self.kept.append(('free', len(messages)))

    def touch(self, place, messages):
        self.kept.append((place, [*messages]))

    def feel(self, value, seconds=HOLD):
        for _ in range(math.ceil(seconds / PERIOD) + 1):
            self.time += PERIOD
            self.asking.message(self.time, value, f'message {value}')

    def start(self):
        self.asking.key('\n')
        self.feel(0.0)
        return self

    @property
    def places(self):
        return [entry[0] for entry in self.kept if entry[0] != 'free']


@pytest.fixture
def person():
    return Person()


def test_untouched_tip_is_taken_when_the_person_says_so(person):
    assert person.asking.line == FREE
    person.feel(5.0)
    assert person.asking.line == FREE
    person.asking.key('\n')
    assert person.asking.line == TAKING
    person.feel(0.0, 0.3)
    assert person.kept == [('free', 4)]
    assert person.said == ['  taken; press', 'touch 1 of 21: pole, azimuth 0°, elevation 90°']


def test_touched_tip_is_not_taken_for_an_untouched_one(person):
    person.asking.key('\n')
    person.feel(1.0)
    assert (person.asking.line, person.said) == (FREE, ['  touched'])
    assert person.kept == []


def test_touch_is_kept_on_enter_and_the_next_waits_for_a_free_tip(person):
    person.start().feel(5.0)
    assert person.said[-1] == '  felt 5.0'
    assert person.asking.line == TAKEN
    assert person.places == []
    person.asking.key('\n')
    assert person.kept[-1] == (PLACES[0], ['message 5.0'] * 6)
    person.feel(5.0, 2.0)
    assert person.asking.line == LIFT
    person.feel(0.0, 0.0)
    assert person.asking.line == TOUCH
    assert person.kept[-1] == ('free', 1)
    assert person.said[-1].startswith('touch 2 of 21: down, azimuth -90°')


def test_repeated_touch_is_kept_once(person):
    person.start().feel(5.0)
    person.asking.key('r')
    person.feel(5.0, 2.0)
    person.feel(0.0, 0.0)
    assert person.said[-1] == 'touch 1 of 21: pole, azimuth 0°, elevation 90°'
    person.feel(7.0)
    person.asking.key('\n')
    assert person.places == PLACES[:1]
    assert person.kept[-1][1][0] == 'message 7.0'


def test_place_is_skipped_before_and_after_the_touch(person):
    person.start().asking.key('s')
    assert person.asking.line == TOUCH
    person.feel(5.0)
    person.asking.key('s')
    person.feel(0.0, 0.0)
    person.feel(6.0)
    person.asking.key('\n')
    assert person.places == [PLACES[2]]


@pytest.mark.parametrize('moment', ['free', 'touch', 'taken'])
def test_q_ends_and_drops_what_was_not_kept(person, moment):
    if moment != 'free':
        person.start()
    if moment == 'taken':
        person.feel(5.0)
    person.asking.key('q')
    assert person.asking.done
    assert not person.asking.listens
    assert person.places == []


def test_all_places_are_asked_for_and_then_it_is_done(person):
    person.start()
    for _ in PLACES:
        assert not person.asking.done
        person.feel(5.0)
        person.asking.key('\n')
        person.feel(0.0, 0.0)
    assert person.asking.done
    assert person.places == PLACES


def test_skipping_the_last_place_is_the_end(person):
    person.start()
    for _ in PLACES:
        assert not person.asking.done
        person.asking.key('s')
    assert person.asking.done


def test_what_a_message_does_not_tell_is_said_until_one_does(person):
    person.start().feel(-1.0)
    assert person.asking.trouble == 'below zero'
    person.feel(5.0, 0.0)
    assert person.asking.trouble == ''


def test_other_keys_do_nothing(person):
    for key in ('x', '\x1b[C', 's', 'r'):
        person.asking.key(key)
    assert (person.asking.line, person.said) == (FREE, [])
