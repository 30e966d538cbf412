# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Streams that are closed or know few characters take whatever the package prints."""

import os
import re
import subprocess
import sys

import pytest

from support.commands import BAG, COMMAND, run_command
from tactile_push.streams import PLAIN, complain, is_nowhere

PREPARED = 'import sys; from tactile_push.streams import prepare_streams; prepare_streams(); '


def run_python(code, **options):
    options = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE} | options
    return subprocess.run([sys.executable, '-c', PREPARED + code], timeout=60, **options)


def closing(*numbers):
    """Return what closes streams of a process that is about to begin."""
    return lambda: [os.close(number) for number in numbers]


@pytest.mark.parametrize(
    ('encoding', 'printed'),
    [
        ('utf-8', 'θ = −3° … \u20ac 語'.encode()),
        ('ascii', rb'theta = -3 deg ... \u20ac \u8a9e'),
        ('iso8859-15', b'theta = -3\xb0 ... \xa4 \\u8a9e'),
        ('koi8-r', b'theta = -3\x9c ... \\u20ac \\u8a9e'),
    ],
)
def test_characters_that_a_stream_does_not_know_are_written_plainly(encoding, printed):
    code = (
        r"print('\u03b8 = \u22123\u00b0 \u2026 \u20ac \u8a9e'); print('\u22125', file=sys.stderr)"
    )
    done = run_python(code, env={**os.environ, 'PYTHONIOENCODING': encoding})
    assert done.stdout == printed + b'\n'
    minus = '−5' if encoding == 'utf-8' else '-5'
    assert done.stderr == minus.encode() + b'\n'


def test_plain_words_are_plain_and_no_two_characters_look_the_same_where_it_matters():
    assert all(words.isascii() and words.isprintable() for words in PLAIN.values())
    assert len({PLAIN[letter] for letter in 'θφμ'}) == 3


@pytest.mark.parametrize('closed', [(0,), (1,), (2,), (0, 1), (1, 2), (0, 1, 2)])
def test_what_is_printed_on_a_closed_stream_goes_nowhere_else(closed, tmp_path):
    code = (
        f"file = open({str(tmp_path / 'file')!r}, 'w'); "
        "print('out'); print('error', file=sys.stderr); sys.stdout.flush(); sys.stderr.flush(); "
        "import os; os.write(2, b'native'); "
        "file.write('content')"
    )
    done = run_python(code, stdin=subprocess.DEVNULL, preexec_fn=closing(*closed))
    assert done.returncode == 0
    assert (tmp_path / 'file').read_text() == 'content'
    assert done.stdout == (b'' if 1 in closed else b'out\n')
    assert done.stderr == (b'' if 2 in closed else b'error\nnative')


@pytest.mark.slow
@pytest.mark.parametrize('words', [('info', BAG), ('diff', BAG, BAG), ('--help',)])
def test_commands_work_with_closed_streams(words):
    for closed in ((1,), (2,), (0, 1, 2)):
        done = run_command(*words, stdin=subprocess.DEVNULL, preexec_fn=closing(*closed))
        assert (done.returncode, done.stderr) == (0, '')
        assert bool(done.stdout) == (1 not in closed)


def test_error_is_not_told_on_standard_output_where_there_is_no_other():
    done = run_command('info', 'not there', preexec_fn=closing(2))
    assert (done.returncode, done.stdout) == (2, '')


@pytest.mark.slow
@pytest.mark.parametrize('words', [('info', BAG), ('demo', '--help'), ('replay', '--help')])
def test_commands_print_all_that_they_print_whatever_the_encoding(words):
    def told(encoding):
        done = subprocess.run(
            [*COMMAND, *map(str, words)],
            env={**os.environ, 'PYTHONIOENCODING': encoding},
            capture_output=True,
            timeout=60,
        )
        assert (done.returncode, done.stderr) == (0, b'')
        return done.stdout.decode(encoding)

    text = told('utf-8')
    for character, plain in PLAIN.items():
        text = text.replace(character, plain)
    token = r'[-\w.%]*\w[-\w.%]*'  # and no lines of tables
    assert re.findall(token, told('ascii')) == re.findall(token, text)


@pytest.mark.parametrize(
    ('words', 'shown'),
    [
        ('a\nb', 'a\\nb'),
        ('a\x1b[31mb\r', 'a\\x1b[31mb\\r'),
        ('a\udcff.mcap', 'a\\udcff.mcap'),
        ('a\u2028b\x85', 'a\\u2028b\\x85'),
        (ValueError('θ: expected 1°'), 'θ: expected 1°'),
    ],
)
def test_complaint_is_one_line_whatever_the_names_in_it(words, shown, capsys):
    complain('someone', words)
    assert capsys.readouterr().err == f'someone: {shown}\n'


def test_complaint_that_nobody_can_hear_is_none(monkeypatch):
    class Gone:
        def write(self, text):
            raise BrokenPipeError

    monkeypatch.setattr(sys, 'stderr', Gone())
    complain('someone', 'something')


def test_folder_that_is_gone_is_told_once(tmp_path, monkeypatch, capsys):
    (tmp_path / 'gone').mkdir()
    monkeypatch.chdir(tmp_path / 'gone')
    assert not is_nowhere('someone')
    (tmp_path / 'gone').rmdir()
    assert is_nowhere('someone')
    assert capsys.readouterr().err == 'someone: working directory: No such file or directory\n'


@pytest.mark.parametrize(
    ('options', 'shown'),
    [
        ('error', False),
        ('default,error::DeprecationWarning', False),
        ('e', False),
        ('default', True),
    ],
)
def test_warnings_of_libraries_end_nothing(options, shown):
    program = (
        'from tactile_push.streams import ignore_warnings_that_end as ignore; ignore(); '
        'import warnings; warnings.warn("old", DeprecationWarning); print("goes on")'
    )
    ended = run_python(program, env={**os.environ, 'PYTHONWARNINGS': options})
    assert ended.stdout == b'goes on\n'
    assert (b'old' in ended.stderr) == shown
