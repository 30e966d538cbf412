# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What commands do when what they write cannot be written, or nobody reads it."""

import errno
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from support.commands import BAG, few_bytes, run_command
from tactile_push.bags import BagError
from tactile_push.cli import output
from tactile_push.cli.arguments import Refused

FULL = Path('/dev/full')


@pytest.mark.slow
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
        done = run_command(*arguments, stdout=full)
    assert done.returncode == 2
    assert done.stderr == (
        f'tactile_push {arguments[0]}: standard output: No space left on device\n'
    )


def test_error_without_a_file_is_not_blamed_on_standard_output(monkeypatch, command):
    for error, words, status in (
        (OSError(errno.ENOMEM, 'Cannot allocate memory'), 'Cannot allocate memory', 2),
        (FileNotFoundError(errno.ENOENT, 'No such file or directory'), 'No such file', 2),
        (OSError('cannot load library'), 'cannot load library', 2),
        (MemoryError(), 'not enough memory', 1),
    ):

        def fail(*arguments, error=error, **options):
            raise error

        monkeypatch.setattr('tactile_push.cli.info._info', fail)
        code, out, err = command('info', BAG)
        assert (code, out) == (status, '')
        assert err.startswith(f'tactile_push info: {words}')
        assert 'standard output' not in err


def test_folder_that_is_gone_is_no_fault_of_standard_output(tmp_path):
    program = (
        f'import os, sys; os.rmdir({str(tmp_path / "gone")!r}); '
        'from tactile_push.cli import main; sys.exit(main(["info", "bag"]))'
    )
    (tmp_path / 'gone').mkdir()
    done = subprocess.run(
        [sys.executable, '-c', program], cwd=tmp_path / 'gone', capture_output=True, text=True
    )
    assert done.returncode == 2
    assert done.stderr == 'tactile_push info: working directory: No such file or directory\n'


@pytest.mark.slow
@pytest.mark.parametrize('backend', ['module://matplotlib_inline.backend_inline', 'TkAgg', 'none'])
def test_backend_of_somebody_elses_matplotlib_has_no_effect(backend, tmp_path):
    environment = {**os.environ, 'MPLBACKEND': backend}
    words = ('simulate', '--steps', '3', '--plot', tmp_path / 'plot.png')
    done = run_command(*words, env=environment)
    assert (done.returncode, done.stderr) == (0, '')
    assert (tmp_path / 'plot.png').read_bytes().startswith(b'\x89PNG')


@pytest.mark.slow
@pytest.mark.parametrize(
    'command',
    [
        ('diff', BAG, BAG),
        ('info', BAG),
        ('diff', BAG, BAG, '--json'),
        ('simulate', '--steps', '3000', '--json', '-'),
    ],
)
def test_closed_pipe_is_silent_and_is_no_difference(command):
    reading, writing = os.pipe()
    os.close(reading)
    done = run_command(*command, stdout=writing)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, '')


@pytest.mark.slow
@pytest.mark.parametrize('command', ['replay', 'estimate'])
def test_bag_that_cannot_be_written_is_not_left_behind(command, tmp_path: Path):
    done = run_command(command, BAG, '-o', tmp_path / 'again', preexec_fn=few_bytes)
    assert done.returncode == 2
    (line,) = (
        line
        for line in done.stderr.splitlines()
        if 'machine code cannot be kept' not in line  # where there is none yet
    )
    assert line.startswith(f'tactile_push {command}: {tmp_path / "again"}')
    assert line.endswith(': File too large')
    assert list(tmp_path.iterdir()) == []


def test_json_that_cannot_be_written_is_not_left_behind(tmp_path: Path):
    done = run_command('replay', BAG, '--json', tmp_path / 'r.json', preexec_fn=few_bytes)
    assert done.returncode == 2
    assert done.stderr == f'tactile_push replay: {tmp_path / "r.json"}: File too large\n'
    assert list(tmp_path.iterdir()) == []


def test_json_goes_to_what_is_no_file(tmp_path: Path):
    done = run_command('replay', BAG, '--json', '/dev/stdout')
    assert done.returncode == 0
    assert done.stdout.startswith('{"fingers"')


@pytest.mark.slow
def test_error_is_one_line_where_there_is_no_terminal(tmp_path: Path):
    empty = tmp_path / 'empty'
    shutil.copytree(BAG, empty)
    for file in empty.glob('*.mcap'):
        file.unlink()
    for command in ('info', 'replay', 'estimate', 'report'):
        done = run_command(command, empty)
        assert done.returncode == 2
        assert len(done.stderr.splitlines()) == 1, done.stderr


def test_warning_names_the_command(capsys):
    output.warner('info')('the bag is cut off')
    assert capsys.readouterr() == ('', 'tactile_push info: warning: the bag is cut off\n')


def test_json_has_text_for_what_json_cannot_say():
    values = {'a': [math.inf, (math.nan, 1.5)], 'b': Path('bag'), 'c': b'\x01\xff', 'd': None}
    expected = {'a': ['inf', ['nan', 1.5]], 'b': 'bag', 'c': [1, 255], 'd': None}
    assert output.plain(values) == expected
    assert json.loads(json.dumps(output.plain(values), allow_nan=False)) == expected


@pytest.mark.parametrize('error', [BagError('no bag'), ValueError('no number')])
def test_what_is_wrong_with_a_bag_is_refused_while_it_is_open(error):
    with (
        pytest.raises(Refused, match=str(error)) as refused,
        output.opened(BAG, print) as bag,
    ):
        assert bag.counts
        raise error
    assert refused.value.status == 2


def test_quantity_is_told_with_its_intervals_in_the_unit_of_people():
    values = {'d': 0.00107, 'd_lower': 0.000984, 'd_upper': 0.00117}
    values |= {'d_least': -0.000001, 'd_most': math.inf}
    words = output.bounded(values, 'd', 1e3, 2)
    assert words == '1.07, 95 %: 0.98 to 1.17, guaranteed: 0.00 to ∞'
    assert output.bounded(values | {'d': math.nan}, 'd', 1e3, 2).startswith('unknown, 95 %')
