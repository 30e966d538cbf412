# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Machine code that is outdated, damaged, written by two at once, or has no place."""

import hashlib
import importlib.util
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import tactile_push.mechanics
from tactile_push.mechanics import machine_code
from tactile_push.mechanics.compiled import compilation_announced

SOURCE = """
from tactile_push.mechanics.compiled import compiled

@compiled
def power(x, n):
    result = x
    for _ in range(n - 1):
        result *= x
    return result
"""
PRINTS = """
from tactile_push.mechanics.compiled import compilation_announced

with compilation_announced(lambda: print('compiled')):
    print(power(3.0, 2), power(3, 3))
"""
RIGHT = '9.0 27\n'
COMPILED = 'compiled\n' + RIGHT


@pytest.fixture(autouse=True)
def nothing_said():
    """Let the process warn again of what it has warned of."""
    machine_code._warn_once.cache_clear()


@pytest.fixture
def program(tmp_path):
    path = tmp_path / 'powers' / 'powers.py'
    path.parent.mkdir()
    path.write_text(SOURCE)
    return path


def results(path):
    """Return what a fresh module gives, as in another process, and whether it had to compile."""
    spec = importlib.util.spec_from_file_location('powers', path)
    module = importlib.util.module_from_spec(spec)
    said = []
    with compilation_announced(lambda: said.append('compiled')):
        spec.loader.exec_module(module)
        return module.power(3.0, 2), module.power(3, 3), bool(said)


def started(program, **environment):
    """Start a program in a process in which these variables alone say where to keep code."""
    known = {name: value for name, value in os.environ.items() if not name.startswith('NUMBA')}
    return subprocess.Popen(
        [sys.executable, program],
        env={**known, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(program, **environment):
    """Return what a program prints, and the lines that it warns with."""
    process = started(program, **environment)
    out, error = process.communicate()
    assert process.returncode == 0, error
    return out, error.splitlines()


def files(program, ending):
    """Return the files of one kind: one index, or the code for each of two types."""
    found = sorted(program.parent.rglob(f'*.{ending}'))
    assert len(found) == {'nbi': 1, 'nbc': 2}[ending]
    return found


def test_changed_source_is_compiled_again_and_nothing_piles_up(program, caplog):
    assert results(program) == (9.0, 27, True)
    assert results(program) == (9.0, 27, False)
    program.write_text(SOURCE.replace('n - 1', 'n'))
    assert results(program) == (27.0, 81, True)
    assert files(program, 'nbc')
    assert caplog.text == ''


DAMAGE = {
    'empty': lambda content: b'',
    'cut': lambda content: content[: len(content) // 2],
    'last byte missing': lambda content: content[:-1],
    'zeroed': lambda content: bytes(len(content)),
    'second half zeroed': lambda content: content[: len(content) // 2] + bytes(len(content) // 2),
    'one bit wrong': lambda content: content[:-100] + bytes([content[-100] ^ 1]) + content[-99:],
    'of another program': lambda content: b'#!/bin/sh\n',
}


@pytest.mark.parametrize('ending', ['nbi', 'nbc'])
@pytest.mark.parametrize('damage', DAMAGE.values(), ids=DAMAGE)
def test_damaged_machine_code_is_compiled_again(program, ending, damage, caplog):
    results(program)
    for file in files(program, ending):
        file.write_bytes(damage(file.read_bytes()))
    assert results(program) == (9.0, 27, True)
    (warning,) = caplog.messages
    folder = program.parent / '__pycache__'
    assert warning == (
        f'tactile_push: machine code in {folder} is damaged, so it is compiled again'
    )
    assert results(program) == (9.0, 27, False)


def test_machine_code_of_sources_with_other_types_is_compiled_again_in_silence(program, caplog):
    assert results(program) == (9.0, 27, True)
    (index,) = program.parent.glob('__pycache__/*.nbi')
    content = b'cno_such_module\nPush\n.'  # a pickle of a class that is not there any more
    index.write_bytes(hashlib.sha256(content).digest() + content)
    assert results(program) == (9.0, 27, True)
    assert results(program) == (9.0, 27, False)
    assert not caplog.records


def test_data_that_is_gone_is_compiled_again(program):
    results(program)
    for file in files(program, 'nbc'):
        file.unlink()
    assert results(program) == (9.0, 27, True)
    assert results(program) == (9.0, 27, False)


@pytest.mark.slow
def test_of_processes_that_need_the_code_at_once_one_compiles(program):
    program.write_text(SOURCE + PRINTS.replace(', power(3, 3)', ''))
    processes = [started(program) for _ in range(3)]
    told = [process.communicate() for process in processes]
    assert sorted(told) == [('9.0\n', ''), ('9.0\n', ''), ('compiled\n9.0\n', '')]


def test_process_that_fails_to_compile_holds_others_up_no_longer_than_they_are_patient(
    program, monkeypatch
):
    first, second = (machine_code._Turn(program.with_suffix('.lock')) for _ in range(2))
    monkeypatch.setattr(machine_code, 'PATIENCE', 0.2)

    def waited(turn):
        start = time.monotonic()
        turn.take()
        return time.monotonic() - start

    first.take()
    first.take()  # which is its own
    assert waited(second) >= 0.2
    second.end()
    first.end()
    monkeypatch.setattr(machine_code, 'PATIENCE', 60.0)
    assert waited(second) < 60.0


@pytest.fixture
def no_folder(program, tmp_path):
    """Return variables with which there is a file wherever numba would make a folder."""
    program.write_text(SOURCE + PRINTS)
    (program.parent / '__pycache__').write_text('')
    home = tmp_path / 'home'
    home.write_text('')
    return {'HOME': str(home), 'XDG_CACHE_HOME': str(home)}


@pytest.mark.slow
def test_without_a_folder_a_start_compiles_and_says_so_once(program, no_folder):
    out, (warning,) = run(program, **no_folder)
    assert out == COMPILED
    assert 'no folder for machine code can be written, so every start compiles' in warning
    assert 'NUMBA_CACHE_DIR' in warning


@pytest.mark.slow
@pytest.mark.parametrize('variable', ['XDG_CACHE_HOME', 'NUMBA_CACHE_DIR'])
def test_another_folder_serves_where_the_package_cannot_be_written(
    program, no_folder, tmp_path, variable
):
    where = {**no_folder, variable: str(tmp_path / 'named')}
    assert run(program, **where) == (COMPILED, [])
    assert run(program, **where) == (RIGHT, [])


@pytest.mark.slow
def test_full_disk_is_said_once(program):
    program.write_text(
        'import resource\n'
        f'resource.setrlimit(resource.RLIMIT_FSIZE, (100, {resource.RLIM_INFINITY}))\n'
        + SOURCE
        + PRINTS
    )
    out, (warning,) = run(program, PYTHONDONTWRITEBYTECODE='1')
    assert out == COMPILED
    assert 'machine code cannot be kept, so the next start compiles again' in warning
    assert list(program.parent.rglob('*.tmp*')) == []


@pytest.mark.slow
def test_changed_function_of_another_file_is_compiled_again(tmp_path):
    """The machine code of a function holds the functions that it calls."""
    package = tmp_path / 'copy' / 'tactile_push'
    (package / 'mechanics').mkdir(parents=True)
    for name in ('__init__.py', 'mechanics/__init__.py'):
        (package / name).touch()
    for name in ('compiled.py', 'machine_code.py'):
        shutil.copy(Path(tactile_push.mechanics.__file__).parent / name, package / 'mechanics')
    decorated = 'from tactile_push.mechanics.compiled import compiled\n@compiled\n'
    first = package / 'first.py'
    first.write_text(decorated + 'def first(x):\n    return x + 1.0\n')
    (package / 'second.py').write_text(
        f'from tactile_push.first import first\n{decorated}'
        'def second(x):\n    return 2.0 * first(x)\n'
    )
    program = tmp_path / 'program.py'
    program.write_text('from tactile_push.second import second\nprint(second(3.0))\n')
    where = {'PYTHONPATH': str(package.parent), 'PYTHONDONTWRITEBYTECODE': '1'}
    assert run(program, **where) == ('8.0\n', [])
    kept = first.stat()
    first.write_text(first.read_text().replace('1.0', '2.0'))
    os.utime(first, ns=(kept.st_atime_ns, kept.st_mtime_ns))  # as a build with fixed times does
    assert run(program, **where) == ('10.0\n', [])
