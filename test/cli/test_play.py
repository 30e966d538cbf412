# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The words of `tactile_push play`, and what it becomes."""

import pytest


def test_without_more_words_the_node_decides(become):
    assert become('play', 'a bag') == ('bag_player', {'bag': 'a bag'})


def test_every_word_becomes_a_parameter(become):
    node, parameters = become(
        'play',
        'bag.mcap',
        *('--rate', '2', '--start', '1.5', '--duration', '60', '--loop', '--clock', '50'),
        *('--topics', '/tactile', 'contact', '--remap', 'tactile:=/touch', '--start-paused'),
    )
    assert node == 'bag_player'
    assert parameters == {
        'bag': 'bag.mcap',
        'rate': 2.0,
        'start': 1.5,
        'duration': 60.0,
        'loop': True,
        'clock': 50.0,
        'topics': ['/tactile', 'contact'],
        'remap': ['tactile:=/touch'],
        'start_paused': True,
    }
    assert isinstance(parameters['rate'], float)  # as the node insists


def test_clock_has_a_rate_of_its_own_unless_one_is_given(become):
    assert become('play', 'bag', '--clock')[1]['clock'] == 100.0


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (['--rate', '0'], '--rate: expected a factor from 0.001 to 1000, got 0'),
        (['--start=-1'], '--start: expected seconds from 0 to 1e9, got -1'),
        (['--duration', 'long'], '--duration: expected seconds from 0 to 1e9, got long'),
        (['--clock', '1e5'], '--clock: expected a rate from 0.001 to 10000, got 1e5'),
    ],
)
def test_bad_words_are_refused_in_one_line(command, words, expected):
    status, out, err = command('play', 'bag', *words)
    assert (status, out) == (2, '')
    assert err.count('\n') == 1
    assert expected in err
