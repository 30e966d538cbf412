# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

from tactile_push.doctor import Heard


def test_rate_is_messages_a_second_of_the_nodes_time():
    assert Heard(30, 3.0).rate == 10.0
    assert math.isnan(Heard(30, 0.0).rate)  # while that time stands


def test_names_are_those_of_any_message():
    assert Heard(2, 1.0, values=({'a': 1.0}, {'b': 2.0, 'a': 3.0})).names == {'a', 'b'}
    assert Heard(0, 1.0).names == frozenset()
