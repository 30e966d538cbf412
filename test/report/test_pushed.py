# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What was pushed, from the parameters of the simulator or, without one, of active sensing."""

import math

import pytest

from support.package import run_python
from tactile_push.paper import BLOCK, DISK, OTHER
from tactile_push.report.pushed import plant_object, pushed_object

# 80 x 40 mm with the centre of mass 5 mm left of the middle and 4 mm above it.
OFF_CENTRE = [-0.035, -0.024, 0.045, -0.024, 0.045, 0.016, -0.035, 0.016]
# The paper's block, but pushed on any of its edges.
BLOCK_OUTLINE = [-0.025, -0.02375, 0.025, -0.02375, 0.025, 0.02375, -0.025, 0.02375]
SQUARE = [-0.03, -0.03, 0.03, -0.03, 0.03, 0.03, -0.03, 0.03]
PLANT = {'object': 'block', 'edge_length': 0.05, 'edge_to_cm': 0.02375}


@pytest.mark.parametrize(
    ('plant', 'pushed', 'l'),
    [
        ({}, None, None),
        ({'object': 'block', 'edge_length': 0.05, 'edge_to_cm': 0.02375}, 'block', 0.02375),
        ({'object': 'block', 'edge_length': 0.08, 'edge_to_cm': 0.02375}, OTHER, 0.02375),
        ({'object': 'block', 'edge_length': 0.05, 'edge_to_cm': 0.03}, OTHER, 0.03),
        ({'object': 'block', 'edge_to_cm': math.nan}, OTHER, None),
        ({'object': 'disk', 'edge_to_cm': 0.03, 'disk_radius': 0.0285}, 'disk', 0.0285),
        ({'object': 'disk', 'disk_radius': 0.03}, OTHER, 0.03),
        ({'object': 'disk'}, 'disk', None),
        ({'object': 7}, OTHER, None),
    ],
)
def test_object_of_the_plant_is_the_papers_only_with_its_sizes(plant, pushed, l):
    assert plant_object(plant) == (pushed, l)


@pytest.mark.parametrize(
    ('sensing', 'pushed', 'l'),
    [
        ({'vertices': BLOCK_OUTLINE, 'edge': 0}, BLOCK, 0.02375),
        ({'vertices': BLOCK_OUTLINE, 'edge': 1}, BLOCK, 0.025),
        ({'vertices': OFF_CENTRE, 'edge': 0}, OTHER, 0.024),
        ({'vertices': OFF_CENTRE, 'edge': 1}, OTHER, 0.045),
        ({'vertices': OFF_CENTRE, 'edge': 2}, OTHER, 0.016),
        ({'vertices': SQUARE}, OTHER, 0.03),  # whichever edge it is
        ({'vertices': BLOCK_OUTLINE, 'disk_radius': 0.0285}, DISK, 0.0285),
        ({'vertices': [], 'disk_radius': 0.04}, OTHER, 0.04),
        ({'edge': 0}, None, None),  # nobody told of an object
        ({}, None, None),
        ({'vertices': BLOCK_OUTLINE, 'edge': 7}, None, None),
        ({'vertices': BLOCK_OUTLINE[:5]}, None, None),
        ({'vertices': 'round'}, None, None),
        ({'vertices': [0.0] * 8, 'edge': 0}, None, None),
        (
            {'vertices': [-0.03, 0.03, 0.03, 0.03, 0.03, -0.03, -0.03, -0.03]},
            None,
            None,
        ),  # clockwise
    ],
)
def test_without_a_simulator_active_sensing_was_told_what_is_pushed(sensing, pushed, l):
    found = pushed_object({'left/active_sensing': sensing}, '/left')
    assert found.object == pushed
    assert found.l == (None if l is None else pytest.approx(l, rel=1e-12))
    assert found.remark == ''


def test_what_is_pushed_is_found_without_compiled_mathematics():
    loaded = run_python(
        'import json, sys\n'
        'from tactile_push.report.pushed import pushed_object\n'
        f"found = pushed_object({{'active_sensing': {{'vertices': {SQUARE}}}}}, '')\n"
        "print(json.dumps([found.l, 'numba' in sys.modules]))"
    )
    assert loaded == [pytest.approx(0.03), False]


def test_other_finger_has_another_object():
    parameters = {'active_sensing': {'disk_radius': 0.03}, 'left/sim_plant': PLANT}
    assert pushed_object(parameters, '').l == 0.03
    assert pushed_object(parameters, '/left').l == 0.02375
    assert pushed_object(parameters, '/right')[:3] == (None, None, '')


def test_edge_that_nobody_told_of_leaves_l_open_and_that_is_said():
    found = pushed_object({'active_sensing': {'vertices': OFF_CENTRE, 'edge': -1}}, '')
    assert (found.object, found.l) == (OTHER, None)
    assert found.remark == (
        'l is not known: /active_sensing was not told which edge is pushed, '
        'so l is 16 or 24 or 35 or 45 mm'
    )


@pytest.mark.parametrize(
    ('sensing', 'said'),
    [
        ({'vertices': OFF_CENTRE, 'edge': 0}, '24 mm'),
        ({'vertices': OFF_CENTRE}, '16 or 24 or 35 or 45 mm'),
        ({'vertices': BLOCK_OUTLINE, 'edge': 1}, '25 mm'),
        ({'vertices': BLOCK_OUTLINE, 'disk_radius': 0.0285}, '28.5 mm'),
    ],
)
def test_simulator_is_right_and_another_l_of_active_sensing_is_said(sensing, said):
    found = pushed_object({'left/sim_plant': PLANT, 'left/active_sensing': sensing}, '/left')
    assert (found.object, found.l) == (BLOCK, 0.02375)
    assert found.remark == (
        'l is 23.75 mm by the parameters of /left/sim_plant '
        f'and {said} by those of /left/active_sensing'
    )


@pytest.mark.parametrize(
    'sensing', [{'vertices': BLOCK_OUTLINE}, {'vertices': BLOCK_OUTLINE, 'edge': 2}, {'edge': 0}]
)
def test_simulator_and_active_sensing_agree_if_an_edge_may_have_that_l(sensing):
    found = pushed_object({'sim_plant': PLANT, 'active_sensing': sensing}, '')
    assert found[:3] == (BLOCK, 0.02375, '')


@pytest.mark.parametrize(
    ('parameters', 'lever'),
    [
        ({}, 0.0135),
        ({'sim_plant': {'finger_radius': 0.02, 'commanded_point': 'centre'}}, 0.02),
        ({'mujoco_plant': {'finger_radius': 0.02, 'commanded_point': 'pole'}}, 0.0),
        ({'active_sensing': {'finger_radius': 0.01, 'commanded_point': 'contact'}}, 0.0),
        ({'active_sensing': {'finger_radius': 0.01}}, 0.01),
        ({'active_sensing': {'finger_radius': 'thin'}}, 0.0135),
    ],
)
def test_lever_is_from_the_commanded_point_to_the_contact(parameters, lever):
    assert pushed_object(parameters, '').lever == lever
