# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The figures of merit beside the paper, in words and numbers for people."""

import math

import numpy as np
import pytest

from support.pushed_bag import (
    phi,
    run_of,
    sensing_bag,
)
from tactile_push.paper import BLOCK
from tactile_push.report.outcome import outcome_of
from tactile_push.report.pushed import Pushed


def test_outcome_has_what_follows_from_the_states(run):
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome['steps'] == ('111', '')  # 121 ticks less those of the stop
    assert outcome['θ within 3° of θ_d from step'] == ('never', '173')
    last = [t / 10.0 for t in range(121) if not 60 <= t < 70][-37:]  # the last third
    angles = [math.degrees(phi(t)) for t in last]
    expected = f'{min(angles):.1f} to {max(angles):.1f}'
    assert outcome['φ from step 74 [°]'][0].replace('\u00a0', ' ') == expected
    assert outcome['longest silence of the contact [s]'] == ('0.900 at 6.900 s', '')
    assert outcome['stops'] == ('contact silent 1×', '')


def test_bounds_of_d_are_shown_and_the_step_from_which_it_is_known(tmp_path):
    widths = [0.05, 0.01, 0.0015, 0.003, 0.001, 0.0005]
    run = run_of(sensing_bag(tmp_path / 'bag', widths, [0.0] * 6))
    assert run.series['d_upper'].values - run.series['d_lower'].values == pytest.approx(widths)
    assert set(run.series['d_least'].values) == {-0.025}
    assert set(run.series['d_most'].values) == {0.025}
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome['d known to 2 mm from step'] == ('4', '400')


@pytest.mark.parametrize(
    ('widths', 'row'), [([0.05, 0.001, 0.01], ('never', '400')), ([0.0] * 3, None)]
)
def test_d_that_is_never_known_or_known_by_roundness(tmp_path, widths, row):
    run = run_of(sensing_bag(tmp_path / 'bag', widths, [0.0] * 3))
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome.get('d known to 2 mm from step') == row


def test_a_trim_is_told_and_the_paper_s_column_is_that_of_the_angle_asked_for():
    asked, trim = math.radians(-10.0), math.radians(5.0)
    columns = {'time': [0.0, 0.1, 0.2], 'theta': [0.1, 0.0, asked], 'phi': [1.5, 1.6, 1.6]}
    columns |= {
        'trim': [0.0, trim / 2.0, trim],
        'theta_desired': [asked, asked + trim / 2.0, asked + trim],
    }
    table = {name: np.array(values) for name, values in columns.items()}
    rows = {row.what: row for row in outcome_of(table, {}, Pushed(BLOCK))}
    assert rows['θ_d [°]'].here == '-10.0'
    assert rows['θ_d trimmed by [°]'].here == '0.0 to 5.0'
    assert rows['θ within 3° of θ_d from step'].paper == '173'
