# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark of placing runs on a few goals and reports what it says."""

import importlib.util
import json
import math
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / 'benchmarks'
sys.path.insert(0, str(BENCHMARKS))

from deliveries import cases, rivals, runs  # noqa: E402

from tactile_push.control.placing.believing import Belief  # noqa: E402
from tactile_push.control.placing.model import Goal  # noqa: E402
from tactile_push.control.placing.stages import (  # noqa: E402
    MISSED,
    OUT_OF_REACH,
    PLACING,
    RELEASED,
    WITH_RESERVE,
)
from tactile_push.simulation.placement import Placement, pushed_of  # noqa: E402

BLOCK = cases.Group('block')


@pytest.fixture
def script():
    """Load the command as a module."""
    spec = importlib.util.spec_from_file_location('placing', BENCHMARKS / 'placing.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def ended(x_error, theta_error=0.0, stage=RELEASED):
    return Placement(stage, '', x_error, theta_error, 0.06, 0.01)


def outcome(seed, placement, verdict=WITH_RESERVE, promise='', shortest=0.05):
    return runs.Outcome(seed, verdict, promise, shortest, placement)


def test_a_row_counts_goals_with_reserve_alone_and_what_is_not_let_go_as_missed():
    some = [
        outcome(0, ended(1e-4)),
        outcome(1, ended(-9e-4)),
        outcome(2, ended(0.0, math.radians(3.0))),
        outcome(3, ended(0.0, stage=MISSED)),
        outcome(4, ended(0.0), verdict=OUT_OF_REACH),
    ]
    name, count, *cells = runs.row('block', some, (0.5, 1.0, 2.0))
    assert (name, count) == ('block', '4')
    assert cells[:3] == ['25.0%', '50.0%', '50.0%']
    assert cells[5:] == ['60', '10', '1.20']


def test_promises_and_refusals_are_held_against_what_is_done_told_or_by_touch():
    told = [
        outcome(0, ended(0.0)),  # promised and done
        outcome(1, ended(0.0), OUT_OF_REACH),  # refused and done
        outcome(2, ended(0.01), OUT_OF_REACH, shortest=math.nan),  # refused, and rightly
        outcome(3, ended(0.01), shortest=math.nan),  # promised, and done by touch alone
    ]
    ends = [None, None, None, ended(0.0)]
    estimated = [outcome(seed, end, promise=WITH_RESERVE) for seed, end in enumerate(ends)]
    in_advance, committed = runs.judged(told, estimated)
    assert in_advance[1:4] == ('4', '3', '1 (33.3%)')
    assert in_advance[4:] == ('2', '1 (50.0%)', '1 (50.0%)', '0 (0.0%)')
    assert committed[1:4] == ('4', '3', '0 (0.0%)')
    assert committed[4:] == ('4', '3 (75.0%)', '2 (50.0%)', '1 (25.0%)')


def test_runs_are_kept_as_they_end_and_not_made_again(script, tmp_path):
    file, made = tmp_path / 'runs', []

    def run(seed, group, every):
        made.append((group.name, seed))
        return outcome(seed, ended(1e-4) if every else None)

    groups = (script.ESTIMATED, script.GROUPS[-1])
    with script.workers(1) as pool:
        script.outcomes_of(pool, groups, range(2), run, file)
        found = script.outcomes_of(pool, groups, range(3), run, file)
    names = [group.name for group in groups]
    assert made == [(name, seed) for seed in range(3) for name in names]
    assert found[names[0]] == [outcome(seed, ended(1e-4)) for seed in range(3)]
    assert [one.placement for one in found[names[1]]] == [None] * 3
    assert len(file.read_text().splitlines()) == len(made)


def test_the_cascade_turns_the_object_so_that_it_drifts_to_the_goal():
    one = cases.case(0, BLOCK)
    law = rivals.Rival(Goal(-0.02, 0.1), 0.3, 5e-4, cascade=True)
    pushed = pushed_of(one.config)
    x = 0.01 + 0.1 + (pushed.l + pushed.r) * math.sin(0.1)  # 30 mm to the right of the goal
    belief = Belief(x - 0.1, 0.1, 0.0, pushed, (1.0, 1.0), one.edge.d, None)
    law.believe(belief)
    law.update(0.1)
    # Its ray has the angle theta, and it translates along the ray: to the left if theta > 0.
    assert law.theta_desired == pytest.approx(0.1 + 0.03 * rivals.GAIN)
    assert law.stage == PLACING


def test_a_mass_off_centre_is_balanced_on_each_support():
    group = cases.Group('mass off centre', centre=cases.BESIDE)
    one = cases.case(0, group)
    for kind in range(4):
        bearing = cases.support(one.config.slider.outline, kind, 36)
        assert bearing.centre == pytest.approx((0.0, 0.0), abs=1e-12)
    assert one.edge.l == pytest.approx(0.0475 / 2.0 - 0.002)
    assert sum(one.edge.d) / 2.0 == pytest.approx(-0.004)


@pytest.mark.slow
def test_a_short_run_of_a_few_groups_prints_and_writes(script, monkeypatch, tmp_path, capsys):
    file = tmp_path / 'out.json'
    groups = ['block', 'state told', 'cascade, state told']
    arguments = ['--runs', '6', '--seed', '2000', '--processes', '1', '--json', str(file)]
    monkeypatch.setattr(sys, 'argv', ['placing', *arguments, '--groups', *groups])
    assert script.main() == 0
    results = [json.loads(line) for line in file.read_text().splitlines()]
    assert [one['group'] for one in results] == groups * 2
    assert [one['seed'] for one in results if one['group'] == 'block'] == [2000, 2001]
    told = [one for one in results if one['group'] == 'state told']
    assert all(one['placement']['stage'] == RELEASED for one in told)
    printed = capsys.readouterr().out
    assert 'of shortest' in printed
    assert 'of these refused' in printed


@pytest.mark.slow
def test_an_object_is_placed_on_mujoco():
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from deliveries import on_mujoco

    found = on_mujoco.run(2007)
    assert found.placement.stage == RELEASED
    assert found.error < 1.0
