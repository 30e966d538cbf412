# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark of the estimator runs on a few experiments and reports what it says."""

import importlib.util
import json
import math
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / 'benchmarks'
sys.path.insert(0, str(BENCHMARKS))

from estimating import groups, rivals, study  # noqa: E402


@pytest.fixture
def script():
    """Load the command as a module."""
    spec = importlib.util.spec_from_file_location('estimation', BENCHMARKS / 'estimation.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def named(name):
    return next(group for group in groups.GROUPS if group.name == name)


@pytest.mark.slow
def test_a_short_run_of_a_few_groups_prints_and_writes(script, monkeypatch, tmp_path, capsys):
    chosen = (named('figure 8, sticks, 0.2°'), named('mu_c 0'), named('any edge, 8 x 2 cm'))
    for module in (script, study):
        monkeypatch.setattr(module, 'GROUPS', chosen)
    for module in (script, study, groups, rivals):
        monkeypatch.setattr(module, 'STEPS', (10, 20))
    monkeypatch.setattr(rivals, 'PARTICLES', 200)
    file, figure = tmp_path / 'out.json', tmp_path / 'out.png'
    monkeypatch.setattr(
        sys,
        'argv',
        ['estimation', '--experiments', '6', '--json', str(file), '--plot', str(figure)],
    )
    script.main()

    results = json.loads(file.read_text())
    assert list(results) == [group.name for group in chosen]
    for result in results.values():
        for step in ('10', '20'):
            row = result['estimator'][step]
            assert row['experiments'] == 2
            assert 0.0 <= row['coverage'] <= 1.0
            assert 0.0 < row['width_mm'] <= 80.0
        assert all(row['coverage'] == 1.0 for row in result['guaranteed'].values())
    assert set(results[chosen[0].name]['particles']) == {'10', '20'}
    assert 0.0 <= results[chosen[2].name]['edge']['leads']['20'] <= 1.0
    printed = capsys.readouterr().out
    assert 'Cramer-Rao' in printed
    assert 'pushed edge' in printed
    assert figure.stat().st_size > 0


def test_the_bound_falls_with_the_steps():
    group = named('figure 8, sticks, 0.2°')
    run = groups.experiment(group, np.random.default_rng(0))
    widths = rivals.cramer_rao(group, run)

    assert all(a > b for a, b in pairwise(widths.values()))
    assert widths[400] < 2.0 * 1.96 * group.edges[0].length / math.sqrt(12.0)


def test_commands_and_a_known_lag_give_the_measured_motion():
    group = named('lag 0.3 s, known')
    run = groups.experiment(group, np.random.default_rng(1))

    assert study.followed(group, run) == pytest.approx(run.measured, abs=2e-6)


def test_figures_count_what_outcomes_say():
    group = named('any edge')
    outcomes = [
        study.Outcome(
            truth={10: 0.001},
            intervals={'estimator': {10: (0.0, 0.004)}, 'guaranteed': {10: (-0.01, 0.01)}},
            leads={10: True},
            found=7,
            ticks=10,
            cost=0.005,
            worst=0.001,
        ),
        study.Outcome(
            truth={10: 0.005},
            intervals={'estimator': {10: (0.0, 0.002)}},
            leads={10: False},
            misled=True,
            contradiction='no',
            ticks=10,
            cost=0.015,
            worst=0.002,
        ),
    ]
    result = study.figures(group, outcomes)

    assert result['estimator'] == {
        '10': {'coverage': 0.5, 'width_mm': pytest.approx(3.0), 'experiments': 2}
    }
    assert result['guaranteed']['10']['experiments'] == 1
    assert result['edge'] == {
        'leads': {'10': 0.5},
        'found': 0.5,
        'found_at_step': 7,
        'misled': 0.5,
    }
    assert result['contradictions'] == {'no': 1}
    assert result['milliseconds_a_tick']['mean'] == pytest.approx(1.0)


def test_a_short_run_on_mujoco_prints_and_writes(script, monkeypatch, tmp_path, capsys):
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from estimating import on_mujoco

    chosen = (
        on_mujoco.Case('mass off centre', centre=on_mujoco.BESIDE, steps=5),
        on_mujoco.Case('disk', vertices=(), steps=5),
    )
    monkeypatch.setattr(on_mujoco, 'CASES', chosen)
    monkeypatch.setattr(on_mujoco, 'LATE', 4)
    file = tmp_path / 'out.json'
    monkeypatch.setattr(
        sys,
        'argv',
        ['estimation', '--physics', 'mujoco', '--starts', '0', '--json', str(file)],
    )
    script.main()

    results = json.loads(file.read_text())
    assert list(results) == ['mass off centre', 'disk']
    for result in results.values():
        assert (result['runs'], result['periods']) == (1, 5)
        assert result['guaranteed'] == 1.0
        assert result['milliseconds_a_tick'] > 0.0
    assert results['disk']['coverage'] == 1.0
    assert 'known while wrong' in capsys.readouterr().out


def test_figures_on_mujoco_count_what_was_told():
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from estimating import on_mujoco

    # True d, 95 % interval and bounds [m]: right, wrong and narrow, wrong and wide.
    right = (399, 0.001, 0.0, 0.003, -0.01, 0.01)
    narrow = (400, 0.005, 0.0, 0.001, -0.01, 0.01)
    wide = (401, 0.02, 0.0, 0.004, -0.01, 0.01)
    told = on_mujoco.Told('block', [right, narrow, wide], 5, 2, {'no'}, 0.01, 0.05)
    figures = on_mujoco.figures([told])

    assert figures['coverage'] == pytest.approx(1 / 3)
    assert figures['known_while_wrong'] == pytest.approx(1 / 3)
    assert figures['guaranteed'] == pytest.approx(2 / 3)
    assert (figures['width_mm'], figures['d_mm']) == pytest.approx((1.0, 5.0))
    assert (figures['runs_with_contradiction'], figures['silent']) == (1, 0.4)
    assert figures['milliseconds_a_tick'] == pytest.approx(2.0)
    assert figures['rig_share_of_a_core'] == pytest.approx(0.1)


def test_feet_under_an_object_bear_its_weight_wherever_that_is():
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from estimating import on_mujoco

    case = on_mujoco.Case('mass off centre', centre=on_mujoco.BESIDE)
    support = case.rig().physics.support
    assert support.centre == pytest.approx((0.0, 0.0), abs=1e-12)
    assert support.loads.min() > 0.0
    corners = np.reshape(case.told().vertices, (-1, 2))
    assert corners.mean(axis=0) == pytest.approx([-0.004, 0.002])
