# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The table of the demonstration, from results that are made up."""

from pathlib import Path

import pytest

from tactile_push.cli.demo import _print_demo
from tactile_push.demo import RigResult, as_json


def result(known_step):
    return RigResult(
        settle_step=192,
        theta_final=-0.17,
        phi_final=1.44,
        d_final=0.001,
        d_lower=0.0009,
        d_upper=0.0011,
        known_step=known_step,
        theta_range=(-0.17, -0.17),
        phi_range=(1.44, 1.44),
        ticks_lost=0,
        wall_seconds=10.0,
    )


@pytest.mark.parametrize(('step', 'shown'), [(80, '80'), (0, '0'), (None, 'never')])
def test_step_from_which_d_is_known_stands_beside_the_papers(capsys, monkeypatch, step, shown):
    monkeypatch.setenv('COLUMNS', '120')
    _print_demo({'block': result(step), 'disk': result(0)}, Path('out'))
    (row,) = [
        [cell.strip() for cell in line.split('│')[1:-1]]
        for line in capsys.readouterr().out.splitlines()
        if 'd known to 2 mm' in line
    ]
    # Of the disk d is 0 by its roundness.
    assert row == ['d known to 2 mm from step', shown, '400', '', '']


def test_json_has_it():
    rigs = as_json({'block': result(None), 'disk': result(0)})['rigs']
    assert (rigs['block']['known_step'], rigs['disk']['known_step']) == (None, 0)
