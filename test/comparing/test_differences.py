# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which tolerance holds for a field, and which differences are remembered."""

import math

import pytest

from tactile_push.comparing.differences import Difference, FieldDiff, Tolerances, TopicDiff, is_part


@pytest.mark.parametrize(
    ('part', 'expected'),
    [
        ('twist.linear.x', True),
        ('twist.linear', True),
        ('linear.x', True),
        ('x', True),
        ('linear', False),
        ('ear.x', False),
        ('twist.lin', False),
    ],
)
def test_part_of_a_path_reaches_to_its_beginning_or_end(part, expected):
    assert is_part(part, 'twist.linear.x') is expected


def test_array_is_named_by_the_path_before_it():
    assert is_part('poses', 'poses[].position.x')


def test_last_tolerance_that_fits_counts():
    tolerances = Tolerances(0.5, {('/a', 'x'): 1.0, ('/a', 'linear.x'): math.inf, ('/b', 'x'): 2.0})
    assert tolerances.of('/a', 'linear.x') == math.inf
    assert tolerances.of('/a', 'angular.x') == 1.0
    assert tolerances.of('/b', 'linear.x') == 2.0
    assert tolerances.of('/c', 'linear.x') == 0.5


def test_first_and_largest_difference_are_remembered():
    small, large, equal = (
        Difference(key, 'x', 0.0, distance, distance)
        for key, distance in [(5, 1.0), (9, 3.0), (2, 3.0)]
    )
    entry = FieldDiff(small, small)
    entry.add(large)
    assert (entry.first, entry.largest) == (small, large)
    entry.add(equal)
    assert (entry.first, entry.largest) == (equal, equal)


@pytest.mark.parametrize('found', [{}, {'different': 1}, {'only_a': 1}, {'remarks': ['differs']}])
def test_topic_is_the_same_if_nothing_was_found(found):
    assert TopicDiff('/a', ('T', 'T'), (1, 1), **found).same is (not found)
