# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.control import PushLaw, settle_step
from tactile_push.figures import gains
from tactile_push.figures.gains import CREEPS, KD, KP, SERVOS, SWINGS
from tactile_push.simulation import paper_block, rollout

pytestmark = pytest.mark.slow

THETA_D = math.radians(-10.0)
PERFECT, LAG, LAG_AND_DELAY = SERVOS
FRICTIONS = (0.0, 0.3, math.inf)


@pytest.fixture(scope='module')
def maps():
    return {
        (name, mu_c): gains.settle_steps(mu_c, servo)
        for name, servo in SERVOS.items()
        for mu_c in FRICTIONS
    }


def at(steps, kp, kd):
    """Return the map's value at the nearest gains."""
    return steps[np.abs(np.log(KD / kd)).argmin(), np.abs(np.log(KP / kp)).argmin()]


@pytest.mark.parametrize('name', SERVOS)
@pytest.mark.parametrize('mu_c', FRICTIONS)
def test_papers_gains_are_on_the_map_and_settle_everywhere(maps, name, mu_c):
    assert at(KP + 0.0 * KD[:, None], 0.05, 5.0) == pytest.approx(0.05)
    assert at(0.0 * KP + KD[:, None], 0.05, 5.0) == pytest.approx(5.0)
    assert 180 <= at(maps[name, mu_c], 0.05, 5.0) <= 210


@pytest.mark.parametrize('mu_c', [0.3, math.inf])
def test_larger_gains_are_better_with_friction_and_a_perfect_finger(maps, mu_c):
    steps = [at(maps[PERFECT, mu_c], kp, kd) for kp, kd in ((0.05, 5.0), (0.2, 10.0), (1.0, 10.0))]
    assert steps[0] > 1.5 * steps[1] > 1.5**2 * steps[2] > 0


def test_a_lagging_finger_makes_larger_gains_fail_without_friction_first(maps):
    large = 0.2, 10.0
    assert 100 < at(maps[PERFECT, 0.0], *large) < 140
    assert at(maps[LAG_AND_DELAY, 0.0], *large) == SWINGS
    for mu_c in (0.3, math.inf):
        assert 90 < at(maps[LAG_AND_DELAY, mu_c], *large) < 115
    assert at(maps[LAG, 0.0], 1.0, 20.0) == SWINGS
    for mu_c in FRICTIONS:
        settles = {name: (maps[name, mu_c] >= 0).mean() for name in SERVOS}
        assert settles[PERFECT] > settles[LAG] > settles[LAG_AND_DELAY] > 0.05


def test_small_gains_creep_beside_a_large_derivative(maps):
    for name, mu_c in maps:
        assert at(maps[name, mu_c], 0.005, 20.0) == CREEPS


@pytest.mark.parametrize(('row', 'column'), [(10, 20), (20, 20), (30, 45), (20, 50), (5, 50)])
@pytest.mark.parametrize('name', SERVOS)
def test_map_is_what_single_rollouts_do(maps, name, row, column):
    law = PushLaw(KP[column], KD[row], THETA_D)
    run = rollout(paper_block(mu_c=0.3), law, 600, servo=SERVOS[name])
    settled = settle_step(run.theta, THETA_D, math.radians(3.0))
    expected = settled if settled is not None and settled <= 500 else SWINGS
    assert maps[name, 0.3][row, column] == expected


def test_figure_has_a_row_a_finger_and_a_column_a_friction_with_the_papers_gains_marked(
    figures,
):
    figure = figures['gains']
    panels, (colorbar,) = figure.axes[:9], figure.axes[9:]
    for axes in panels:
        dots = [line.get_xydata()[0].tolist() for line in axes.get_lines()]
        assert dots == [[0.02, 2.0], [0.05, 5.0], [0.2, 10.0]]
        assert (axes.get_xscale(), axes.get_yscale()) == ('log', 'log')
    assert [axes.get_title() for axes in panels[:3]] == [
        r'$\mu_c = 0$',
        r'$\mu_c = 0.3$',
        r'$\mu_c = \infty$',
    ]
    for axes, name in zip(panels[::3], SERVOS, strict=True):
        assert axes.get_ylabel().startswith(f'{name}\n')
        assert '[rad/rad]' in axes.get_ylabel()
    for axes in panels[6:]:
        assert '[rad/rad]' in axes.get_xlabel()
    assert 'step' in colorbar.get_ylabel()
