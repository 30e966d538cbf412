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


@pytest.mark.parametrize(
    'words',
    [
        ['--topics', 'a', 'b', 'BAG'],
        ['--topics', 'a', 'b', 'BAG', '--loop'],
        ['--loop', '--rate', '2', '--topics', 'a', 'b', 'BAG', '--start', '0'],
        ['--topics', 'a', 'b', '--remap', 'a:=c', 'BAG'],
        ['--topics', 'a', 'b', '--clock', 'BAG'],
        ['--clock', 'BAG', '--topics', 'a', 'b'],
        ['--topics', 'a', 'b', '--', 'BAG'],
        ['--topics', 'a', 'b', '--clock', '5', 'BAG'],
        ['--rate=2', 'BAG', '--topics', 'a', 'b'],
    ],
    ids=' '.join,
)
def test_bag_may_stand_behind_a_list(become, tmp_path, words):
    node, parameters = become('play', *(str(tmp_path) if word == 'BAG' else word for word in words))
    assert (node, parameters['bag']) == ('bag_player', str(tmp_path))
    assert parameters['topics'] == ['a', 'b']
    assert parameters.get('remap', ['a:=c']) == ['a:=c']
    assert parameters.get('clock', 100.0) == (5.0 if '5' in words else 100.0)


@pytest.mark.parametrize('words', [['a'], ['a', 'no bag'], ['a', '--loop']])
def test_missing_bag_is_said_and_where_it_stands(command, words):
    status, out, err = command('play', '--topics', *words)
    assert (status, out) == (2, '')
    assert err == (
        'tactile_push play: error: the following arguments are required: BAG, before --topics; '
        'see tactile_push play --help\n'
    )


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
