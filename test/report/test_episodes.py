# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From labels to what lasted from when to when."""

from tactile_push.report.data import ERROR, WARNING, Episode
from tactile_push.report.episodes import episodes, joined

LATE, DEAD = (WARNING, 'late'), (ERROR, 'dead')


def test_label_lasts_until_the_next_one_or_as_long_as_it_counts():
    found = episodes('node', [0, 1, 2, 3, 9], [None, LATE, LATE, DEAD, LATE], 2.0)
    assert found == [
        Episode('node', 1.0, 3.0, 'late', WARNING),
        Episode('node', 3.0, 5.0, 'dead', ERROR),
        Episode('node', 9.0, 11.0, 'late', WARNING),
    ]


def test_nothing_out_of_the_ordinary_ends_an_episode():
    assert episodes('node', [0.0, 0.5, 1.0], [LATE, None, None], 2.0) == [
        Episode('node', 0.0, 0.5, 'late', WARNING)
    ]


def test_single_label_that_counts_for_its_moment_alone():
    assert episodes('readings', [0.0, 0.5, 1.0], [None, LATE, None], 0.0) == [
        Episode('readings', 0.5, 0.5, 'late', WARNING)
    ]


def test_nothing_was_said():
    assert episodes('node', [], [], 1.0) == []


def test_equal_episodes_with_no_visible_gap_are_one_and_others_are_not():
    found = [
        Episode('b', 2.0, 2.1, 'late', WARNING),
        Episode('a', 0.0, 1.0, 'late', WARNING),
        Episode('a', 1.2, 1.4, 'late', WARNING),
        Episode('a', 1.2, 1.3, 'dead', ERROR),
        Episode('a', 3.0, 9.0, 'late', WARNING),
    ]
    assert joined(found, 0.25, 5.0) == [
        Episode('a', 0.0, 1.4, 'late', WARNING),
        Episode('a', 1.2, 1.3, 'dead', ERROR),
        Episode('b', 2.0, 2.1, 'late', WARNING),
        Episode('a', 3.0, 5.0, 'late', WARNING),
    ]
