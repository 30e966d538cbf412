# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What commands do when what they write cannot be written, or nobody reads it."""

import os
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

BAG = Path(__file__).resolve().parents[1] / 'data' / 'block'
COMMAND = [sys.executable, '-m', 'tactile_push.cli']
FULL = Path('/dev/full')


def run(*arguments: object, **options) -> subprocess.CompletedProcess[str]:
    words = [*COMMAND, *map(str, arguments)]
    options = {'stdout': subprocess.PIPE} | options
    return subprocess.run(words, stderr=subprocess.PIPE, text=True, timeout=60, **options)


@pytest.mark.skipif(not FULL.exists(), reason='needs /dev/full')
@pytest.mark.parametrize(
    'arguments',
    [
        ('diff', BAG, BAG),
        ('diff', BAG, BAG, '--json'),
        ('info', BAG),
        ('replay', BAG, '--json', '-'),
    ],
    ids=lambda a: ' '.join(map(str, a)).replace(str(BAG), 'BAG'),
)
def test_full_standard_output_is_said_and_is_no_difference(arguments):
    with FULL.open('w') as full:
        done = run(*arguments, stdout=full)
    assert done.returncode == 2
    assert done.stderr == (
        f'tactile_push {arguments[0]}: standard output: No space left on device\n'
    )


@pytest.mark.parametrize(
    'command', [('diff', BAG, BAG), ('info', BAG), ('diff', BAG, BAG, '--json')]
)
def test_closed_pipe_is_silent_and_is_no_difference(command):
    reading, writing = os.pipe()
    os.close(reading)
    done = run(*command, stdout=writing)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, '')


def few_bytes() -> None:
    """Let files grow no larger than 8 kB."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))


def test_page_that_cannot_be_written_leaves_the_old_one(tmp_path: Path):
    page = tmp_path / 'page.html'
    page.write_text('old')
    done = run('report', BAG, '-o', page, preexec_fn=few_bytes)
    assert done.returncode == 2
    assert done.stderr == f'tactile_push report: {page}: File too large\n'
    assert page.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [page]


@pytest.mark.parametrize('command', ['replay', 'estimate'])
def test_bag_that_cannot_be_written_is_not_left_behind(command, tmp_path: Path):
    done = run(command, BAG, '-o', tmp_path / 'again', preexec_fn=few_bytes)
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith(f'tactile_push {command}: {tmp_path / "again"}')
    assert line.endswith(': File too large')
    assert list(tmp_path.iterdir()) == []


def test_json_that_cannot_be_written_is_not_left_behind(tmp_path: Path):
    done = run('replay', BAG, '--json', tmp_path / 'r.json', preexec_fn=few_bytes)
    assert done.returncode == 2
    assert done.stderr == f'tactile_push replay: {tmp_path / "r.json"}: File too large\n'
    assert list(tmp_path.iterdir()) == []


def test_json_goes_to_what_is_no_file(tmp_path: Path):
    done = run('replay', BAG, '--json', '/dev/stdout')
    assert done.returncode == 0
    assert done.stdout.startswith('{"fingers"')


def test_unknown_option_points_to_the_help_of_its_command():
    done = run('record', '--outt')
    assert done.returncode == 2
    assert done.stderr == (
        'tactile_push record: error: unrecognized arguments: --outt; '
        'see tactile_push record --help\n'
    )


def test_error_is_one_line_where_there_is_no_terminal(tmp_path: Path):
    empty = tmp_path / 'empty'
    shutil.copytree(BAG, empty)
    for file in empty.glob('*.mcap'):
        file.unlink()
    for command in ('info', 'replay', 'estimate', 'report'):
        done = run(command, empty)
        assert done.returncode == 2
        assert len(done.stderr.splitlines()) == 1, done.stderr
