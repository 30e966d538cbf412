# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which names that a node does not know are slips."""

import pytest

from tactile_push.parameters import PARAMETERS
from tactile_push.parameters.slips import meant

NAMES = {node: {known.name for known in kind.declared()} for node, kind in PARAMETERS.items()}


@pytest.mark.parametrize(
    ('node', 'name', 'similar'),
    [
        ('push_controller', 'theta_desird', 'theta_desired'),
        ('push_controller', 'Kp', 'kp'),
        ('active_sensing', 'vertics', 'vertices'),
        ('contact_geometry', 'theta_desird', 'theta_desired'),  # of another node, but a slip
        ('push_controller', 'zzz', ''),
        ('push_controller', 'use_sim_time', ''),
        ('push_controller', 'start_type_description_service', ''),
        ('push_controller', 'qos_overrides./parameter_events.publisher.depth', ''),
    ],
)
def test_slip_is_told_by_the_name_that_was_meant(node, name, similar):
    assert meant(name, NAMES[node]) == similar


@pytest.mark.parametrize('node', NAMES)
def test_parameters_of_the_other_nodes_are_no_slips(node):
    assert {name: meant(name, NAMES[node]) for names in NAMES.values() for name in names} == (
        dict.fromkeys(set().union(*NAMES.values()), '')
    )
