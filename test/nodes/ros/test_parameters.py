# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of the nodes: what is declared, and what is refused with a reason."""

import importlib
import math
import uuid

import pytest

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import ParameterType  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.parameter import Parameter as RosParameter  # noqa: E402
from rclpy.parameter import parameter_value_to_python  # noqa: E402

from tactile_push.nodes.ros.parameters import (  # noqa: E402
    ConfigurationError,
    declare,
    descriptor,
)
from tactile_push.parameters import Parameter  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

NODES = {
    'sensor_driver': 'SensorDriver',
    'contact_geometry': 'ContactGeometry',
    'push_controller': 'PushController',
    'active_sensing': 'ActiveSensingNode',
    'sim_plant': 'SimPlant',
    'experiment': 'Experiment',
    'bag_recorder': 'BagRecorder',
    'bag_player': 'BagPlayer',
}
DECLARED = [
    pytest.param(parameter, id=f'{node}.{parameter.name}')
    for node, name in NODES.items()
    for parameter in getattr(importlib.import_module(f'tactile_push.nodes.{node}'), name).PARAMETERS
]

FAMILY = (
    Parameter('gain', 0.5, 'rad/rad', 'a gain', 0.0, 2.0),
    Parameter('friction', math.inf, '', 'a friction', 0.0),
    Parameter('length', 0.05, 'm', 'a length', 0.001, 1.0, read_only=True),
    Parameter('count', 3, '', 'a count', 1, 9),
    Parameter('object', 'block', '', 'a thing', choices=('block', 'disk')),
    Parameter('running', True, '', 'whether it runs'),
    Parameter('names', ['a', 'b'], '', 'some names'),
    Parameter('text', 'hello', '', 'a text'),
)


class Changes:
    """Counts its calls and notes the values that were there at each."""

    def __init__(self):
        self.values = None
        self.seen = []

    def __call__(self):
        self.seen.append(vars(self.values).copy())


@pytest.fixture(scope='module')
def context():
    """Return a private context."""
    context = Context()
    domain, lock = claim_domain()
    rclpy.init(context=context, domain_id=domain)
    yield context
    rclpy.shutdown(context=context)
    lock.close()


@pytest.fixture
def make_node(context):
    """Return a maker of nodes with overrides, as a command line or file gives them."""
    nodes = []

    def make(**overrides):
        node = rclpy.create_node(
            f'node_{uuid.uuid4().hex}',
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[RosParameter(name, value=v) for name, v in overrides.items()],
        )
        nodes.append(node)
        return node

    yield make
    for node in nodes:
        node.destroy_node()


def declare_family(make_node, **overrides):
    """Return a node with the family of parameters, their values and their changes."""
    node = make_node(**overrides)
    changes = Changes()
    changes.values = declare(node, FAMILY, changes)
    return node, changes.values, changes.seen


def set_one(node, name, value, type_=None):
    """Set a parameter at run time and return the answer."""
    (result,) = node.set_parameters([RosParameter(name, type_, value)])
    return result


def refusal(make_node, **overrides):
    """Return the message with which the family refuses some overrides."""
    node = make_node(**overrides)
    with pytest.raises(ConfigurationError) as refused:
        declare(node, FAMILY)
    return str(refused.value)


@pytest.mark.parametrize('parameter', DECLARED)
def test_default_lies_within_its_own_range_and_choices(parameter):
    if parameter.choices:
        assert parameter.default in parameter.choices
    if isinstance(parameter.default, float) or type(parameter.default) is int:
        assert parameter.lower <= parameter.default <= parameter.upper
        assert parameter.lower < parameter.upper


@pytest.mark.parametrize('parameter', DECLARED)
def test_descriptor_tells_unit_range_and_whether_it_is_fixed(parameter):
    described = descriptor(parameter)
    assert described.name == parameter.name
    assert described.description.startswith(parameter.description)
    assert len(parameter.description) >= 8
    assert described.read_only is parameter.read_only
    if parameter.unit:
        assert described.description.endswith(f' [{parameter.unit}]')
    if isinstance(parameter.default, float):
        (bounds,) = described.floating_point_range
        assert (bounds.from_value, bounds.to_value) == (parameter.lower, parameter.upper)
        assert not described.integer_range
    elif type(parameter.default) is int:
        (bounds,) = described.integer_range
        assert (bounds.from_value, bounds.to_value) == (parameter.lower, parameter.upper)
    else:
        assert not described.floating_point_range
        assert not described.integer_range
    for choice in parameter.choices:
        assert choice in described.additional_constraints


# Quantities without a unit: shares, counts and coefficients.
WITHOUT_UNIT = {
    'belt_ripple',
    'edge',
    'l_share',
    'max_out_of_plane',
    'max_ticks_lost',
    'mu_c',
    'mu_c_max',
    'mu_c_min',
    'mu_c_ripple',
    'seed',
    'sensor_dropout',
    'sensor_outlier',
    'steps',
}


@pytest.mark.parametrize('parameter', DECLARED)
def test_number_has_a_unit_unless_it_is_a_pure_number(parameter):
    default = parameter.default
    if type(default[0] if default and isinstance(default, list) else default) in (int, float):
        assert parameter.unit or parameter.name in WITHOUT_UNIT
    else:
        assert not parameter.unit


@pytest.mark.parametrize('node', NODES)
def test_names_of_a_node_are_unique_and_in_snake_case(node):
    names = [p.values[0].name for p in DECLARED if p.id.startswith(f'{node}.')]
    assert names
    assert len(set(names)) == len(names)
    assert all(name == name.lower() and name.isidentifier() for name in names)


def test_values_are_the_defaults_unless_somebody_says_otherwise(make_node):
    node, values, changes = declare_family(make_node)
    assert vars(values) == {parameter.name: parameter.default for parameter in FAMILY}
    assert node.get_parameter('gain').value == 0.5
    assert changes == []


def test_overrides_become_the_values(make_node):
    given = {
        'gain': 1.25,
        'friction': 0.0,
        'length': 1.0,
        'count': 9,
        'object': 'disk',
        'running': False,
        'names': ['x'],
        'text': '',
    }
    _, values, _ = declare_family(make_node, **given)
    assert vars(values) == given


def test_declared_parameters_describe_themselves(make_node):
    node, _, _ = declare_family(make_node)
    description = node.describe_parameter('gain')
    assert description.type == ParameterType.PARAMETER_DOUBLE
    assert description.description == 'a gain [rad/rad]'
    assert node.describe_parameter('length').read_only
    assert 'block' in node.describe_parameter('object').additional_constraints


@pytest.mark.parametrize(
    ('name', 'value', 'expected'),
    [
        ('gain', 2.5, 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('gain', -0.1, 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('gain', math.nan, 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('gain', math.inf, 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('gain', 1, 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('gain', '1.0', 'a number with a decimal point [rad/rad] from 0 to 2'),
        ('friction', -1.0, 'a number with a decimal point from 0 to inf'),
        ('friction', math.nan, 'a number with a decimal point from 0 to inf'),
        ('length', 0.0, 'a number with a decimal point [m] from 0.001 to 1'),
        ('count', 0, 'a whole number from 1 to 9'),
        ('count', 10, 'a whole number from 1 to 9'),
        ('count', 2.0, 'a whole number from 1 to 9'),
        ('count', True, 'a whole number from 1 to 9'),
        ('object', 'ball', 'one of block, disk'),
        ('object', 'Block', 'one of block, disk'),
        ('object', '', 'one of block, disk'),
        ('object', 3, 'one of block, disk'),
        ('running', 1, 'true or false'),
        ('running', 'true', 'true or false'),
        ('names', 'a', 'a list of texts'),
        ('names', [1, 2], 'a list of texts'),
        ('text', 1.5, 'a text'),
    ],
)
def test_bad_value_is_refused_with_name_expectation_and_value(make_node, name, value, expected):
    message = refusal(make_node, **{name: value})
    assert message == f'parameter {name}: expected {expected}, got {value!r}'


@pytest.mark.parametrize(
    ('slip', 'meant'),
    [('gian', 'gain'), ('Gain', 'gain'), ('lenght', 'length'), ('objects', 'object')],
)
def test_misspelt_name_is_refused_with_the_name_that_was_meant(make_node, slip, meant):
    message = refusal(make_node, **{slip: 1.0})
    assert message == f'parameter {slip}: unknown, did you mean {meant}?'


def test_name_that_is_like_no_other_does_no_harm(make_node):
    _, values, _ = declare_family(make_node, zzz=1.0)
    assert not hasattr(values, 'zzz')


def test_parameters_of_the_node_itself_are_no_slips(make_node):
    _, values, _ = declare_family(make_node, use_sim_time=True)
    assert not hasattr(values, 'use_sim_time')


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('gain', 0.75),
        ('gain', 0.0),
        ('gain', 2.0),
        ('friction', 0.3),
        ('count', 1),
        ('object', 'disk'),
        ('running', False),
        ('names', ['c', 'd', 'e']),
    ],
)
def test_good_value_at_run_time_is_taken_and_told(make_node, name, value):
    node, values, changes = declare_family(make_node)
    assert set_one(node, name, value).successful
    assert getattr(values, name) == value
    assert node.get_parameter(name).value == value
    assert len(changes) == 1
    assert changes[0][name] == value  # the value is there before `changed` is called


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('gain', 2.1),
        ('gain', -1e-3),
        ('gain', math.nan),
        ('gain', math.inf),
        ('gain', 1),
        ('gain', 'much'),
        ('friction', math.nan),
        ('length', 0.06),
        ('count', 0),
        ('count', 2.5),
        ('object', 'ball'),
        ('object', 3),
        ('running', 'false'),
        ('names', 'c'),
    ],
)
def test_bad_value_at_run_time_is_refused_and_changes_nothing(make_node, name, value):
    node, values, changes = declare_family(make_node)
    before = vars(values).copy()
    result = set_one(node, name, value)
    assert not result.successful
    assert name in result.reason or result.reason
    assert vars(values) == before
    assert node.get_parameter(name).value == before[name]
    assert changes == []


def test_value_of_no_choice_is_refused_with_the_choices(make_node):
    node, _, _ = declare_family(make_node)
    assert set_one(node, 'object', 'ball').reason == (
        "object: expected one of block, disk, got 'ball'"
    )


def test_value_cannot_be_taken_away_at_run_time(make_node):
    node, values, changes = declare_family(make_node)
    assert not set_one(node, 'gain', None, RosParameter.Type.NOT_SET).successful
    assert values.gain == 0.5
    assert changes == []


def test_several_values_at_once_are_taken_all_or_none(make_node):
    node, values, changes = declare_family(make_node)
    good, bad = RosParameter('gain', value=1.0), RosParameter('count', value=99)
    assert not node.set_parameters_atomically([good, bad]).successful
    assert (values.gain, values.count, changes) == (0.5, 3, [])
    also_good = RosParameter('count', value=7)
    assert node.set_parameters_atomically([good, also_good]).successful
    assert (values.gain, values.count) == (1.0, 7)
    assert len(changes) == 1


def test_parameters_of_others_change_nothing_here(make_node):
    node, values, changes = declare_family(make_node)
    node.declare_parameter('theirs', 1.0)
    before = vars(values).copy()
    assert set_one(node, 'theirs', 2.0).successful
    assert vars(values) == before
    assert changes == []


def test_two_nodes_have_values_of_their_own(make_node):
    one, one_values, _ = declare_family(make_node)
    _, other_values, _ = declare_family(make_node)
    assert set_one(one, 'gain', 1.0).successful
    assert (one_values.gain, other_values.gain) == (1.0, 0.5)


@pytest.mark.parametrize('parameter', DECLARED)
def test_node_starts_with_its_declared_default(make_node, parameter):
    node = make_node()
    values = declare(node, [parameter])
    assert getattr(values, parameter.name) == parameter.default
    message = node.get_parameter(parameter.name).get_parameter_value()
    assert parameter_value_to_python(message) == parameter.default
