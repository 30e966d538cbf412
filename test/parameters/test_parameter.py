# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from tactile_push.interface import NODES
from tactile_push.parameters import PARAMETERS, NodeParameters, Parameter
from tactile_push.parameters.parameter import parameter


@dataclasses.dataclass(frozen=True)
class Family(NodeParameters):
    gain: float = parameter(0.5, 'rad/rad', 'a gain', 0.0, 10.0)
    count: int = parameter(3, '', 'a count', 0, 100)
    kind: str = parameter('block', '', 'a kind', choices=('block', 'disk'))
    flag: bool = parameter(True, '', 'a flag', read_only=True)
    names: list[str] = parameter(['a', 'b'], '', 'names')
    any_names: list[str] = parameter([], '', 'names')
    places: list[float] = parameter([0.0, 0.1], 'm', 'places')


GAIN, COUNT, KIND, FLAG, NAMES, ANY_NAMES, PLACES = Family.declared()
EVERYTHING = [(node, declared) for node, kind in PARAMETERS.items() for declared in kind.declared()]


def test_a_field_is_a_parameter_of_its_name():
    assert Parameter('gain', 0.5, 'rad/rad', 'a gain', 0.0, 10.0) == GAIN
    assert Parameter('kind', 'block', '', 'a kind', choices=('block', 'disk')) == KIND
    assert Parameter('flag', True, '', 'a flag', read_only=True) == FLAG


def test_values_do_not_share_their_lists():
    Family().names.append('c')
    assert Family().names == NAMES.default == ['a', 'b']


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
    assert getattr(Family.of({parameter.name: value}), parameter.name) == value


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
        Family.of({parameter.name: value})
    assert parameter.name in str(refused.value)
    assert parameter.expected() in str(refused.value)


def test_what_is_not_given_has_its_default_and_what_is_not_known_is_left_out():
    values = Family.of({'gain': 2.0, 'use_sim_time': True})
    assert values == Family(gain=2.0)
    assert values.count == 3


def test_every_node_declares_its_parameters():
    assert list(PARAMETERS) == list(NODES)


def test_every_default_is_a_value():
    for _, declared in EVERYTHING:
        declared.check(declared.default)
        assert declared.lower < declared.upper


# Quantities without a unit: shares, counts and coefficients.
WITHOUT_UNIT = {
    'axes',
    'belt_ripple',
    'edge',
    'image_noise',
    'l_share',
    'least_manipulability',
    'max_out_of_plane',
    'max_ticks_lost',
    'mu_c',
    'mu_c_max',
    'mu_c_min',
    'mu_c_ripple',
    'mu_s',
    'port',
    'seed',
    'sensor_dropout',
    'sensor_outlier',
    'spread',
    'steps',
    'untouched_images',
}


def has_its_unit(declared):
    """Return whether a number has a unit unless it is a pure number, and nothing else has one."""
    default = declared.default
    if type(default[0] if default and isinstance(default, list) else default) in (int, float):
        return bool(declared.unit) or declared.name in WITHOUT_UNIT
    return not declared.unit


def test_every_parameter_has_words_a_name_in_snake_case_and_its_unit():
    lacking = [
        f'{node}.{declared.name}'
        for node, declared in EVERYTHING
        if len(declared.words) < 8
        or declared.name != declared.name.lower()
        or not has_its_unit(declared)
    ]
    assert lacking == []
