# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The contact finder that the parameters of `contact_geometry` make."""

import math
from dataclasses import replace

import pytest

from tactile_push.parameters import ContactGeometryParameters
from tactile_push.parameters.contact_geometry import make_finder, take_values
from tactile_push.tactile import Reading, ReadingRejectedError

AT_POLE = Reading(0.0, math.pi / 2.0)
# Each number that may change while the node runs, and where it has to arrive.
VALUES = {
    'finger_radius': (0.02, lambda finder: finder.radius),
    'mount_angle': (1.2, lambda finder: finder.mount_angle),
    'joint_state_timeout': (0.3, lambda finder: finder.pole.timeout),
    'max_out_of_plane': (0.1, lambda finder: finder.max_out_of_plane),
    'detectable_range': (0.9, lambda finder: finder.detectable_range),
    'max_theta_rate': (2.0, lambda finder: finder.jumps.max_rate),
    'jump_tolerance': (0.05, lambda finder: finder.jumps.tolerance),
}


def test_every_number_that_may_change_is_tested_here():
    changeable = {p.name for p in ContactGeometryParameters.declared() if not p.read_only}
    assert changeable == set(VALUES)


@pytest.mark.parametrize('name', VALUES)
def test_each_number_arrives_at_the_start_and_while_the_node_runs(name):
    value, place = VALUES[name]
    changed = ContactGeometryParameters(**{name: value})
    assert place(make_finder(changed)) == value
    finder = make_finder(ContactGeometryParameters())
    assert place(finder) != value
    take_values(finder, changed)
    assert place(finder) == value


def test_the_direction_of_the_tip_is_that_of_the_joints():
    finder = make_finder(ContactGeometryParameters())
    with pytest.raises(ReadingRejectedError, match='no joint state'):
        finder.contact(AT_POLE, 1.0)
    finder.joints(2.0, [0.2, 0.1])
    assert finder.contact(AT_POLE, 2.0).theta == pytest.approx(0.3)


def test_without_joint_states_the_direction_of_the_tip_is_the_mount_angle():
    ahead = ContactGeometryParameters(use_joint_states=False, joint_names=[])
    assert make_finder(ahead).contact(AT_POLE, 1.0).theta == pytest.approx(0.0, abs=1e-12)
    aside = replace(ahead, mount_angle=math.pi / 2.0 + 0.2)
    assert make_finder(aside).contact(AT_POLE, 1.0).theta == pytest.approx(0.2)


def test_a_tip_that_turns_with_no_joint_is_refused():
    with pytest.raises(ValueError, match='joint_names: expected the name of a joint'):
        make_finder(ContactGeometryParameters(joint_names=[]))
