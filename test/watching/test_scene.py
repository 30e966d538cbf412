# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which object the parameters of running nodes tell of."""

import math

import pytest

from tactile_push.watching.scene import known_scene

BLOCK = {'object': 'block', 'edge_length': 0.05, 'edge_to_cm': 0.02375, 'mu_c': 0.3}
TRIANGLE = [-0.01, -0.01, 0.02, -0.01, -0.01, 0.02]


def test_nobody_knows_an_object():
    scene = known_scene({}, '')
    assert (scene.radius, list(scene.outline), scene.mu_c) == (0.0135, [], None)


def test_the_simulator_knows_before_active_sensing_does():
    told = {'sim_plant': BLOCK, 'active_sensing': {'vertices': TRIANGLE}}
    scene = known_scene(told, '')
    assert max(x for x, _ in scene.outline) == pytest.approx(0.025)
    assert scene.mu_c == 0.3


def test_active_sensing_was_told_of_a_polygon():
    told = {'left/active_sensing': {'vertices': TRIANGLE, 'finger_radius': 0.01}}
    scene = known_scene(told, '/left')
    assert (scene.radius, scene.mu_c) == (0.01, None)
    assert list(scene.outline) == [(-0.01, -0.01), (0.02, -0.01), (-0.01, 0.02)]
    assert not known_scene(told, '').outline  # another finger's


def test_active_sensing_was_told_of_a_disk():
    outline = known_scene({'active_sensing': {'disk_radius': 0.03}}, '').outline
    assert len(outline) > 50
    assert [math.hypot(x, y) for x, y in outline] == pytest.approx([0.03] * len(outline))


@pytest.mark.parametrize('node', ['sim_plant', 'active_sensing'])
def test_values_of_another_version_are_left_out(node):
    scene = known_scene({node: {'finger_radius': 'large'}}, '')
    assert scene.radius == 0.0135
