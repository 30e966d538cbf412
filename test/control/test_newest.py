# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.control.newest import Newest


def test_there_is_nothing_at_first():
    newest = Newest()
    assert math.isnan(newest.value)
    assert not newest.known
    assert not newest.fresh(0.0, 10.0)


def test_the_newest_of_those_that_arrived_is_given_once():
    newest = Newest()
    newest.take(1.0, 5.0)
    newest.take(2.0, 5.5)
    newest.take(3.0, 5.25)

    assert newest.fresh(6.0, 1.0)
    assert (newest.value, newest.stamp, newest.known) == (2.0, 5.5, True)
    assert not newest.fresh(6.0, 1.0)
    assert newest.value == 2.0


@pytest.mark.parametrize(('stamp', 'since'), [(5.5, 5.5), (6.0, 6.0), (6.75, 6.0)])
def test_a_value_that_is_ahead_ages_from_when_it_was_looked_at(stamp, since):
    newest = Newest()
    newest.take(2.0, stamp)

    assert newest.fresh(6.0, 1.0)
    assert (newest.stamp, newest.since) == (stamp, since)


@pytest.mark.parametrize('stamp', [5.5, 5.0, -math.inf, math.nan, math.inf])
def test_what_is_not_newer_is_ignored(stamp):
    newest = Newest()
    newest.take(2.0, 5.5)
    newest.fresh(6.0, 1.0)
    newest.take(4.0, stamp)

    assert not newest.fresh(6.0, 1.0)
    assert (newest.value, newest.newest) == (2.0, 5.5)


def test_what_is_too_old_is_known_and_not_fresh():
    newest = Newest()
    newest.take(2.0, 5.0)

    assert not newest.fresh(6.5, 1.0)
    assert (newest.value, newest.stamp) == (2.0, 5.0)


def test_what_comes_from_the_future_is_neither_known_nor_in_the_way_of_later_ones():
    newest = Newest()
    newest.take(2.0, 100.0)
    assert newest.newest == 100.0
    assert not newest.fresh(6.0, 1.0)
    assert not newest.known
    newest.take(3.0, 6.5)

    assert newest.fresh(6.0, 1.0)
    assert newest.value == 3.0
