# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of numba that it cannot read end nothing and are named in a line each."""

import os
import subprocess
import sys

import pytest

from tactile_push.mechanics.numba_settings import THREADS, import_numba


@pytest.mark.parametrize('value', ['0', '-1', 'many', '', '1.5', '9' * 5000, '²'])
def test_threads_of_no_positive_number_are_left_out(monkeypatch, caplog, value):
    monkeypatch.setenv(THREADS, value)
    import_numba()
    assert THREADS not in os.environ
    assert THREADS in caplog.text


@pytest.mark.parametrize('value', ['1', '2', '08'])
def test_threads_of_a_positive_number_stay(monkeypatch, caplog, value):
    monkeypatch.setenv(THREADS, value)
    import_numba()
    assert os.environ[THREADS] == value
    assert caplog.text == ''


def test_every_setting_that_cannot_be_read_costs_a_line_and_no_more():
    odd = {THREADS: 'many', 'NUMBA_OPT': 'x', 'NUMBA_DEBUG': 'yes', 'PYTHONWARNINGS': 'error'}
    ended = subprocess.run(
        [sys.executable, '-c', 'import tactile_push.mechanics'],
        env={**os.environ, **odd},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert ended.returncode == 0
    lines = ended.stderr.splitlines()
    assert len(lines) == 3
    for name in (THREADS, 'NUMBA_OPT', 'NUMBA_DEBUG'):
        assert any(f'{name}=' in line and 'left out' in line for line in lines)
