# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The truth about a rig, by plane geometry."""

import math

import pytest

from tactile_push.interface import TOPICS, TRUE_STATE
from tactile_push.simulation import Rig, paper_block
from tactile_push.simulation.truth import true_values

R, L = 0.0135, 0.02375


def test_the_truth_is_named_as_the_interface_says():
    assert tuple(true_values(Rig(paper_block()), 0.0)) == TOPICS[TRUE_STATE].field_names


def test_the_centre_of_mass_is_where_geometry_has_it():
    rig = Rig(paper_block(0.25, 0.004))
    truth = true_values(rig, 0.003)
    # From the finger's centre straight through the edge, across r and l, and back along d.
    aside = (R + L) * math.sin(0.25) + 0.004 * math.cos(0.25)
    assert truth['object_x'] == pytest.approx(rig.finger_pose.x - aside)
    assert truth['theta'] == truth['edge_angle'] == pytest.approx(0.25)
    assert (truth['v_x_commanded'], truth['lifted']) == (0.003, 0.0)


def test_of_an_object_that_was_let_go_place_and_angle_stay():
    rig = Rig(paper_block(0.25, 0.004))
    rig.step(0.002, 1.0)
    touched = true_values(rig, 0.0)
    rig.lift()
    rig.step(-0.01, 1.0)
    left = true_values(rig, 0.0)
    assert left['lifted'] == 1.0
    assert math.isnan(left['theta'])
    assert math.isnan(left['d'])
    for name in ('object_x', 'edge_angle'):
        assert left[name] == pytest.approx(touched[name], abs=1e-12)
