# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The words of `tactile_push record`, and what it becomes."""

import pytest

from tactile_push.cli import main


def test_without_words_the_node_decides(become):
    assert become('record') == ('bag_recorder', {'compression': 'zstd'})


def test_every_word_becomes_a_parameter(become, tmp_path):
    out = tmp_path / 'a bag: "quoted"'
    node, parameters = become(
        'record',
        *('-o', str(out), '--compression', 'lz4', '--max-size', '2.5', '--max-duration', '60'),
        *('--use-sim-time', '/tactile', 'contact'),
    )
    assert node == 'bag_recorder'
    assert parameters == {
        'output': str(out),
        'topics': ['/tactile', 'contact'],
        'compression': 'lz4',
        'max_size': 2_500_000,
        'max_duration': 60.0,
        'use_sim_time': True,
    }
    assert isinstance(parameters['max_duration'], float)  # as the node insists
    assert become('record', '--all')[1] == {'compression': 'zstd', 'all': True}


@pytest.mark.parametrize(
    'words, expected',
    [
        (['--compression', 'gzip'], '--compression: invalid choice'),
        (['--max-size', '0'], '--max-size: expected megabytes, more than 0, got 0'),
        (['--max-size', 'nan'], '--max-size: expected megabytes'),
        (['--max-duration', '-1'], '--max-duration: expected seconds, more than 0, got -1'),
        (['--max-duration', 'long'], '--max-duration: expected seconds'),
        (['--all', 'tactile'], '--all: expected no topics'),
    ],
)
def test_bad_words_are_refused_in_one_line(capsys, words, expected):
    try:
        status = main(['record', *words])
    except SystemExit as ended:
        status = ended.code
    assert status == 2
    out, err = capsys.readouterr()
    assert out == ''
    assert err.count('\n') == 1
    assert expected in err


@pytest.mark.parametrize('kind', ['folder', 'file', 'broken link'])
def test_what_is_there_is_never_overwritten(capsys, tmp_path, kind):
    out = tmp_path / 'there'
    if kind == 'folder':
        out.mkdir()
    elif kind == 'file':
        out.write_text('precious')
    else:
        out.symlink_to('nowhere')
    assert main(['record', '-o', str(out)]) == 2
    err = capsys.readouterr().err
    assert (
        err == f'tactile_push record: --out: {out}: expected a new folder, got a path that exists\n'
    )
