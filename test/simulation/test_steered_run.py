# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Steering through sensor, finger and the steps that the nodes run."""

import math

import numpy as np
import pytest

from tactile_push.control import PushLaw
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import RigConfig, paper_disk
from tactile_push.simulation.steered_run import NEAR, steered_run


def on_uniform_pressure(mu_c):
    block = Outline.rectangle(0.05, 0.0475)
    slider = Slider.on(block, Support.uniform(block), exact=True)
    return RigConfig(slider, mu_c, math.radians(20.0), -0.006, tip_turns=False)


@pytest.mark.slow
@pytest.mark.parametrize('mu_c', [0.5, math.inf])
def test_a_block_on_uniform_pressure_is_held_at_the_goal_by_touch_alone(mu_c):
    goal = 0.0
    run = steered_run(on_uniform_pressure(mu_c), goal, 1100, seed=3)
    assert run.end == 'done'
    assert np.abs(run.x[-300:] - goal).max() < NEAR
    # The tip turns on the way and is taken to by rolling: d + r (theta - psi) is kept.
    rolled = run.d + 0.0135 * run.theta
    assert np.ptp(rolled) > 1e-3


def test_it_starts_where_the_rig_does_and_takes_the_law_that_it_is_given():
    config, law = on_uniform_pressure(math.inf), PushLaw(0.1, 6.0, 0.0)
    run = steered_run(config, 0.0, 5, law)
    assert run.theta[0] == pytest.approx(math.radians(20.0))
    assert run.d[0] == pytest.approx(-0.006)
    assert law.phi == pytest.approx(run.phi[-1])
    assert law.trim != 0.0


def test_a_round_object_is_refused():
    with pytest.raises(ValueError, match='^object: expected one with straight edges to steer'):
        steered_run(paper_disk(), 0.0, 10)
