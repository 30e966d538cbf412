# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""An object placed by touch alone, and its way there."""

import math

import numpy as np
import pytest

from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.stages import RELEASED
from tactile_push.mechanics import STICK
from tactile_push.simulation import paper_block, paper_disk
from tactile_push.simulation.placed_run import placed_run

PIECE = 0.0005  # of belt in a control period, V.A


@pytest.mark.slow
def test_the_way_of_finger_and_object_ends_at_the_goal():
    goal = Goal(0.002, -0.1)
    done = placed_run(paper_block(0.2, 0.003), goal, 600)
    run, finger, placed = done.run, done.finger, done.placement
    assert (placed.stage, run.end) == (RELEASED, 'done')
    # Errors by the way that was recorded, the finger's start being x = 0.
    assert run.x[-1] - goal.x == pytest.approx(placed.x_error, abs=1e-9)
    assert run.theta[-1] - goal.theta == pytest.approx(placed.theta_error, abs=1e-9)
    assert abs(placed.x_error) < 5e-4
    assert abs(placed.theta_error) < math.radians(0.5)
    # The belt brings the finger forward evenly, up to the moment within a period.
    assert np.diff(finger[:-1, 1]) == pytest.approx(np.full(len(finger) - 2, PIECE))
    assert 0.0 < finger[-1, 1] - finger[-2, 1] <= PIECE
    assert tuple(finger[0]) == (0.0, 0.0)
    assert (run.theta[0], run.d[0]) == pytest.approx((0.2, 0.003))
    # d along the edge from the foot of the centre of mass, by plane geometry.
    along = (finger[:, 0] - run.x) * np.cos(run.theta) + (finger[:, 1] - run.y) * np.sin(run.theta)
    assert along == pytest.approx(run.d, abs=1e-9)
    # mu_c is infinite, and a mode is that at the end of its own period.
    assert (run.mode == STICK).all()


def test_a_round_object_is_refused():
    with pytest.raises(ValueError, match='^object: expected one with straight edges to place'):
        placed_run(paper_disk(), Goal(0.0, 0.0), 10)
