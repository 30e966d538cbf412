# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from tactile_push.parameters import (
    Parameter,
    config_file,
    contact_geometry,
    push_controller,
    sim_plant,
    values_of,
)

GAIN = Parameter('gain', 0.5, 'rad/rad', 'a gain', 0.0, 10.0)
COUNT = Parameter('count', 3, '', 'a count', 0, 100)
KIND = Parameter('kind', 'block', '', 'a kind', choices=('block', 'disk'))
FLAG = Parameter('flag', True, '', 'a flag')
NAMES = Parameter('names', ['a', 'b'], '', 'names')
ANY_NAMES = Parameter('any_names', [], '', 'names')
PLACES = Parameter('places', [0.0, 0.1], 'm', 'places')
EVERYTHING = [
    parameter
    for module in (contact_geometry, push_controller, sim_plant)
    for parameter in module.PARAMETERS
]


@pytest.mark.parametrize(
    ('parameter', 'value'),
    [
        (GAIN, 0.0),
        (GAIN, 10.0),
        (COUNT, 100),
        (KIND, 'disk'),
        (FLAG, False),
        (NAMES, []),
        (ANY_NAMES, ['c']),
        (PLACES, [0.2]),
    ],
)
def test_a_value_of_its_type_and_range_is_taken(parameter, value):
    assert getattr(values_of([parameter], {parameter.name: value}), parameter.name) == value


@pytest.mark.parametrize(
    ('parameter', 'value'),
    [
        (GAIN, 10.000001),
        (GAIN, -1e-12),
        (GAIN, math.nan),
        (GAIN, math.inf),
        (GAIN, 1),  # as a node refuses a number without a decimal point
        (GAIN, True),
        (GAIN, '0.5'),
        (COUNT, 101),
        (COUNT, 3.0),
        (COUNT, True),
        (KIND, 'cube'),
        (KIND, 3),
        (FLAG, 1),
        (FLAG, 'true'),
        (NAMES, 'a'),
        (NAMES, None),
        (NAMES, ['a', 1]),
        (ANY_NAMES, [0.5]),
        (PLACES, [0.0, 1]),
        (PLACES, ['a']),
    ],
)
def test_any_other_is_refused_with_what_was_expected(parameter, value):
    with pytest.raises(ValueError, match='expected') as refused:
        values_of([parameter], {parameter.name: value})
    assert parameter.name in str(refused.value)
    assert parameter.expected() in str(refused.value)


def test_what_is_not_given_has_its_default_and_what_is_not_known_is_left_out():
    values = values_of([GAIN, COUNT], {'gain': 2.0, 'use_sim_time': True})
    assert vars(values) == {'gain': 2.0, 'count': 3}


def test_every_default_is_a_value():
    for parameter in EVERYTHING:
        parameter.check(parameter.default)


@pytest.mark.parametrize('name', ['block.yaml', 'disk.yaml', 'loopback.xml', 'demo.rviz'])
def test_files_are_found(name):
    assert config_file(name).is_file()
