# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""An edge that is brought to its angle by what the pushes tell, from figure 8's start."""

import math

import numpy as np
import pytest

from tactile_push.control import settle_step
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import RigConfig, paper_block, paper_disk
from tactile_push.simulation.settled_run import settled_run

GOAL, BAND = math.radians(-10.0), math.radians(3.0)


def on_corners():
    block = Outline.rectangle(0.05, 0.0475)
    slider = Slider.on(block, Support.corners(block), exact=True)
    return RigConfig(slider, math.inf, math.radians(20.0), -0.006)


@pytest.mark.slow
@pytest.mark.parametrize('config', [paper_block(), on_corners()], ids=['ellipsoid', 'corners'])
def test_theta_is_there_by_step_50_and_stays(config):
    run = settled_run(config, GOAL, 150, noise=math.radians(0.2))
    assert run.end == 'done'
    assert len(run.theta) == 151
    assert settle_step(run.theta, GOAL, BAND) <= 50  # law (18): 192
    assert np.abs(run.theta[80:] - GOAL).max() < math.radians(1.0)


def test_it_starts_where_the_rig_does_and_repeats_to_the_bit():
    runs = [settled_run(paper_block(), GOAL, 45, seed=1) for _ in range(2)]
    assert runs[0].theta[0] == pytest.approx(math.radians(20.0))
    assert runs[0].phi[0] == math.pi / 2.0
    assert (runs[0].theta == runs[1].theta).all()
    assert (settled_run(paper_block(), GOAL, 45, seed=2).phi != runs[0].phi).any()


def test_a_round_object_is_refused():
    with pytest.raises(ValueError, match='^object: expected one with straight edges to settle'):
        settled_run(paper_disk(), GOAL, 10)
