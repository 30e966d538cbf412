# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Steering through sensor, finger and the steps that the nodes run."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import RigConfig, paper_disk
from tactile_push.simulation.steered_run import NEAR, steered_run


def on_uniform_pressure(mu_c):
    block = Outline.rectangle(0.05, 0.0475)
    slider = Slider.on(block, Support.uniform(block), exact=True)
    return RigConfig(slider, mu_c, math.radians(20.0), -0.006, tip_turns=False)


@pytest.mark.slow
def test_a_block_whose_contact_slips_is_held_at_the_goal_by_touch_alone():
    goal = 0.0
    config = replace(on_uniform_pressure(0.1), theta=0.1, d=-0.005)  # |d| > l mu_c
    run = steered_run(config, goal, 250, seed=3)
    assert run.end == 'done'
    assert np.abs(run.x[-50:] - goal).max() < NEAR
    # There the contact sticks, right behind the centre of mass.
    assert np.abs(run.d[-50:] + 0.02375 * np.tan(run.theta[-50:])).max() < 1e-3


def test_it_starts_where_the_rig_does_and_repeats_to_the_bit():
    config = on_uniform_pressure(math.inf)
    runs = [steered_run(config, 0.0, 12, seed=1) for _ in range(2)]
    assert runs[0].theta[0] == pytest.approx(math.radians(20.0))
    assert runs[0].d[0] == pytest.approx(-0.006)
    assert (runs[0].phi == runs[1].phi).all()
    assert (steered_run(config, 0.0, 12, seed=2).phi != runs[0].phi).any()


def test_a_round_object_is_refused():
    with pytest.raises(ValueError, match='^object: expected one with straight edges to steer'):
        steered_run(paper_disk(), 0.0, 10)
