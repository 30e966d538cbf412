# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The table of the demonstration, from results that are made up."""

import math
from pathlib import Path

import numpy as np
import pytest

from tactile_push.cli.demo import _print
from tactile_push.demo import DISTANCES, RIGS, RigResult
from tactile_push.report.merit import push_figures


def result(name, known_step):
    steps = np.arange(450.0)
    states = {
        'time': 0.1 * steps,
        'theta': RIGS[name].theta_desired + np.where(steps < 192, 0.1, 0.0),
        'theta_desired': np.full(450, RIGS[name].theta_desired),
        'phi': np.full(450, 1.44),
        'state': np.full(450, 2.0),
        'ticks_lost': np.zeros(450),
    }
    push = push_figures(states, RIGS[name].band, DISTANCES[name], name)
    return RigResult(push, -0.17, 1.44, 0.001, known_step, 10.0)


def results(known_step):
    return {'block': result('block', known_step), 'disk': result('disk', 0)}


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


def test_json_has_it():
    block, disk = (one.as_json() for one in results(None).values())
    assert (block['known_step'], disk['known_step']) == (None, 0)
    assert (block['settle_step'], block['ticks_lost'], block['wall_seconds']) == (192, 0, 10.0)
    # (17) by hand for phi = 1.44 and theta = -10 degrees.
    expected = -0.02375 / math.tan(1.44 + math.radians(10.0))
    assert block['d_lower'] == block['d_upper'] == pytest.approx(expected)
    assert list(block) == [
        'settle_step',
        'theta_final',
        'phi_final',
        'd_final',
        'd_lower',
        'd_upper',
        'known_step',
        'theta_range',
        'phi_range',
        'ticks_lost',
        'wall_seconds',
    ]
