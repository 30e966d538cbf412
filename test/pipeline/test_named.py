# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.pipeline import by_name


@pytest.mark.parametrize(
    ('names', 'positions', 'values'),
    [
        (['a', 'b'], [1.0, 2.0], {'a': 1.0, 'b': 2.0}),
        (['a', 'b', 'a'], [1.0, 2.0, 3.0], {'b': 2.0}),
        (['a', 'a'], [1.0, 1.0], {}),  # equal values do not make it clear either
        (['a', 'b', 'c'], [1.0, 2.0], {'a': 1.0, 'b': 2.0}),
        (['a', 'b', 'a'], [1.0, 2.0], {'b': 2.0}),
        (['a'], [1.0, 2.0], {'a': 1.0}),
        (['a'], [], {}),
        ([], [1.0], {}),
    ],
)
def test_name_has_a_value_if_it_stands_once_and_has_a_position(names, positions, values):
    assert by_name(names, positions) == values


@given(
    names=st.lists(st.sampled_from('abcd'), max_size=8),
    positions=st.lists(st.floats(allow_nan=False), max_size=8),
)
@settings(derandomize=True, deadline=None)
def test_order_of_the_entries_does_not_matter(names, positions):
    together = min(len(names), len(positions))
    names, positions = names[:together], positions[:together]
    assert by_name(names, positions) == by_name(names[::-1], positions[::-1])
