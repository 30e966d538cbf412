# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The table of the demonstration, from results that are made up."""

import sys
from pathlib import Path

import pytest

from support.demo_results import results
from support.placed_tables import states, truth
from tactile_push.cli import main
from tactile_push.cli.demo import _print
from tactile_push.report.placings import placings


def table(capsys):
    """Return the rows of the table that was printed by their first cell."""
    lines = [line.replace('┃', '│') for line in capsys.readouterr().out.splitlines()]
    rows = [[cell.strip() for cell in line.split('│')[1:-1]] for line in lines if '│' in line]
    return {row[0]: row[1:] for row in rows}


@pytest.mark.parametrize(('step', 'shown'), [(80, '80'), (0, '0'), (None, 'never')])
def test_results_stand_beside_the_papers(capsys, monkeypatch, step, shown):
    monkeypatch.setenv('COLUMNS', '120')
    _print(results(step), Path('out'))
    rows = table(capsys)
    assert rows[''] == ['block', 'paper, fig. 9', 'disk', 'paper, fig. 10']
    assert rows['θ within 3° of θ_d from step'] == ['192', '173', '', '']
    assert rows['θ within 1° of θ_d from step'] == ['', '', '192', '110']
    assert rows['φ from step 400 [°]'] == ['82.5 to 82.5', '80.2 to 85.8', '82.5 to 82.5', '']
    # Of the disk d is 0 by its roundness.
    assert rows['d known to 2 mm from step'] == [shown, '400', '', '']


@pytest.mark.parametrize(('goals', 'status'), [(1, 0), (2, 1)])
def test_goals_stand_beside_what_was_reached(capsys, monkeypatch, tmp_path, goals, status):
    pytest.importorskip('rclpy')
    from tactile_push.demo import placing

    monkeypatch.setenv('COLUMNS', '120')
    found = placings(states(), truth()[0])[:goals]
    monkeypatch.setattr(placing, 'GOALS', [()] * goals)
    result = placing.PlacedResult(found, 12.5)
    monkeypatch.setattr(placing, 'run_placing', lambda *arguments: result)
    monkeypatch.chdir(tmp_path)
    assert main(['demo', '--place']) == status
    lines = [line.replace('┃', '│') for line in capsys.readouterr().out.splitlines()]
    rows = [[cell.strip() for cell in line.split('│')[1:-1]] for line in lines if '│' in line]
    assert rows[0] == ['goal', 'let go at', 'error', 'belt', 'in reach', 'end']
    assert rows[1][2:] == ['0.20 mm, -0.06°', '47 mm', 'with reserve', 'released']
    assert len(rows) == 1 + goals
    assert lines[-1] == 'out/placed.png, out/placed/'


def test_without_mujoco_it_says_what_to_install(capsys, monkeypatch, tmp_path):
    pytest.importorskip('rclpy')
    monkeypatch.setitem(sys.modules, 'mujoco', None)
    assert main(['demo', '--physics', 'mujoco', '-o', str(tmp_path / 'out')]) == 2
    needs = "tactile_push demo: needs MuJoCo: pip install 'tactile_push[mujoco]'\n"
    assert capsys.readouterr() == ('', needs)
    assert not (tmp_path / 'out').exists()
