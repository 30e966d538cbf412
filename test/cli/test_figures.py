# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push figures`: which files it prints, and how it ends; the drawing is a stand-in."""

import errno
import json
from pathlib import Path

import pytest

from tactile_push import figures

DRAWN = ('figure_2.png', 'figure_2.svg')


@pytest.fixture(autouse=True)
def folders(monkeypatch):
    """Return the folders that figures were asked for in."""
    asked = []

    def save_figures(out, progress):
        asked.append(out)
        progress('figure 2')
        return [out / name for name in DRAWN]

    monkeypatch.setattr(figures, 'save_figures', save_figures)
    return asked


def test_files_are_printed_one_a_line(command, folders, tmp_path):
    status, out, _ = command('figures', '-o', tmp_path)
    assert status == 0
    assert out.splitlines() == [str(tmp_path / name) for name in DRAWN]
    assert folders == [tmp_path]


def test_json_has_the_same_files(command, tmp_path):
    status, out, _ = command('figures', '--out', tmp_path, '--json')
    assert status == 0
    assert json.loads(out) == {'files': [str(tmp_path / name) for name in DRAWN]}


def test_figures_go_to_a_folder_of_their_own_unless_one_is_given(command, folders):
    command('figures')
    assert folders == [Path('out/figures')]


@pytest.mark.parametrize('named', [True, False])
def test_folder_that_cannot_be_written_is_bad_input_in_one_line(
    command, monkeypatch, tmp_path, named
):
    def save_figures(out, progress):
        file = [str(out / DRAWN[0])] if named else []
        raise OSError(errno.ENOSPC, 'No space left on device', *file)

    monkeypatch.setattr(figures, 'save_figures', save_figures)
    status, out, err = command('figures', '-o', tmp_path)
    where = tmp_path / DRAWN[0] if named else tmp_path
    assert (status, out) == (2, '')
    assert f'tactile_push figures: {where}: No space left on device\n' in err
