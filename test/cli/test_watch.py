# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The words of `tactile_push watch`, and what it becomes."""

import sys

import pytest

from tactile_push.parameters import LivePageParameters


@pytest.fixture
def aiohttp():
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")


def test_without_more_words_the_node_decides(become, aiohttp):
    assert become('watch') == ('live_page', {})


def test_every_word_becomes_a_parameter_or_the_namespace(become, aiohttp):
    node, given = become(
        *('watch', '--host', '0.0.0.0', '--port', '0', '--history', '120', '--namespace', 'left')
    )
    assert node == 'live_page'
    assert given == {'host': '0.0.0.0', 'port': 0, 'history': 120.0, '__ns': '/left'}
    assert isinstance(given['history'], float)  # as the node insists


def test_help_tells_the_defaults_of_the_node(command):
    node = LivePageParameters()
    said = ' '.join(command('watch', '--help')[1].split())
    for default in (f'{node.host}, for this machine alone', node.port, f'{node.history:g}'):
        assert f'(default: {default})' in said


@pytest.mark.parametrize('name', ['left', '/left', '/left/'])
def test_namespace_may_have_slashes_around_it(become, aiohttp, name):
    assert become('watch', '--namespace', name)[1] == {'__ns': '/left'}


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (['--port', '65536'], '--port: expected a whole number, 0 to 65535, got 65536'),
        (['--port', '-1'], '--port: expected'),
        (['--port', 'http'], '--port: expected a whole number, 0 to 65535, got http'),
        (['--history', '0'], '--history: expected seconds from 1 to 600, got 0'),
        (['--history', 'nan'], '--history: expected seconds from 1 to 600, got nan'),
    ],
)
def test_bad_words_are_refused_in_one_line(command, words, expected):
    status, out, err = command('watch', *words)
    assert (status, out) == (2, '')
    assert err.count('\n') == 1
    assert expected in err


def test_without_its_library_it_says_what_to_install(command, monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    assert command('watch') == (
        2,
        '',
        "tactile_push watch: needs aiohttp: pip install 'tactile_push[watch]'\n",
    )
