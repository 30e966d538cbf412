# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of the nodes: what is declared, and what is refused with a reason."""

import dataclasses
import math
import uuid

import pytest

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import ParameterType  # noqa: E402
from rclpy.parameter import Parameter as RosParameter  # noqa: E402
from rclpy.parameter import parameter_value_to_python  # noqa: E402

from support.params_file import private_context  # noqa: E402
from tactile_push.nodes.ros.parameters import (  # noqa: E402
    ConfigurationError,
    declare,
    descriptor,
)
from tactile_push.parameters import PARAMETERS, NodeParameters  # noqa: E402
from tactile_push.parameters.parameter import parameter  # noqa: E402


@dataclasses.dataclass(frozen=True)
class Family(NodeParameters):
    gain: float = parameter(0.5, 'rad/rad', 'a gain', 0.0, 2.0)
    friction: float = parameter(math.inf, '', 'a friction', 0.0)
    length: float = parameter(0.05, 'm', 'a length', 0.001, 1.0, read_only=True)
    count: int = parameter(3, '', 'a count', 1, 9)
    object: str = parameter('block', '', 'a thing', choices=('block', 'disk'))
    running: bool = parameter(True, '', 'whether it runs')
    names: list[str] = parameter(['a', 'b'], '', 'some names')
    text: str = parameter('hello', '', 'a text')


class Changes:
    """Keeps the present values and all that there were after a change."""

    def __init__(self):
        self.values = None
        self.seen = []

    def __call__(self, values):
        self.values = values
        self.seen.append(values)


@pytest.fixture(scope='module')
def context():
    """Return a private context."""
    with private_context() as context:
        yield context


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
    """Return a node with the family of parameters and what becomes of their values."""
    node = make_node(**overrides)
    changes = Changes()
    changes.values = declare(node, Family, changes)
    return node, changes


def set_one(node, name, value, type_=None):
    """Set a parameter at run time and return the answer."""
    (result,) = node.set_parameters([RosParameter(name, type_, value)])
    return result


def refusal(make_node, **overrides):
    """Return the message with which the family refuses some overrides."""
    node = make_node(**overrides)
    with pytest.raises(ConfigurationError) as refused:
        declare(node, Family)
    return str(refused.value)


@pytest.mark.parametrize('node', PARAMETERS)
def test_descriptors_tell_unit_range_and_what_is_fixed(node):
    for declared in PARAMETERS[node].declared():
        described = descriptor(declared)
        assert described.name == declared.name
        assert described.description.startswith(declared.words)
        assert described.read_only is declared.read_only
        if declared.unit:
            assert described.description.endswith(f' [{declared.unit}]')
        if isinstance(declared.default, float):
            (bounds,) = described.floating_point_range
            assert (bounds.from_value, bounds.to_value) == (declared.lower, declared.upper)
            assert not described.integer_range
        elif type(declared.default) is int:
            (bounds,) = described.integer_range
            assert (bounds.from_value, bounds.to_value) == (declared.lower, declared.upper)
        else:
            assert not described.floating_point_range
            assert not described.integer_range
        for choice in declared.choices:
            assert choice in described.additional_constraints


def test_values_are_the_defaults_unless_somebody_says_otherwise(make_node):
    node, family = declare_family(make_node)
    assert family.values == Family()
    assert node.get_parameter('gain').value == 0.5
    assert family.seen == []


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
    _, family = declare_family(make_node, **given)
    assert dataclasses.asdict(family.values) == given


def test_declared_parameters_describe_themselves(make_node):
    node, _ = declare_family(make_node)
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
    _, family = declare_family(make_node, zzz=1.0)
    assert family.values == Family()


def test_parameters_of_the_node_itself_are_no_slips(make_node):
    _, family = declare_family(make_node, use_sim_time=True)
    assert family.values == Family()


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
    node, family = declare_family(make_node)
    assert set_one(node, name, value).successful
    assert node.get_parameter(name).value == value
    assert family.seen == [Family(**{name: value})]


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
    node, family = declare_family(make_node)
    result = set_one(node, name, value)
    assert not result.successful
    assert name in result.reason or result.reason
    assert node.get_parameter(name).value == getattr(Family(), name)
    assert family.seen == []


def test_value_of_no_choice_is_refused_with_the_choices(make_node):
    node, _ = declare_family(make_node)
    assert set_one(node, 'object', 'ball').reason == (
        "parameter object: expected one of block, disk, got 'ball'"
    )


def test_value_cannot_be_taken_away_at_run_time(make_node):
    node, family = declare_family(make_node)
    assert not set_one(node, 'gain', None, RosParameter.Type.NOT_SET).successful
    assert node.get_parameter('gain').value == 0.5
    assert family.seen == []


def test_several_values_at_once_are_taken_all_or_none(make_node):
    node, family = declare_family(make_node)
    good, bad = RosParameter('gain', value=1.0), RosParameter('count', value=99)
    assert not node.set_parameters_atomically([good, bad]).successful
    assert (family.values, family.seen) == (Family(), [])
    also_good = RosParameter('count', value=7)
    assert node.set_parameters_atomically([good, also_good]).successful
    assert family.seen == [Family(gain=1.0, count=7)]


def test_values_change_one_after_the_other(make_node):
    node, family = declare_family(make_node)
    assert set_one(node, 'gain', 1.0).successful
    assert set_one(node, 'count', 7).successful
    assert family.values == Family(gain=1.0, count=7)


def test_values_that_do_not_fit_together_are_refused_with_the_reason(make_node):
    def fit(values):
        if values.count * values.gain > 3.0:
            raise ValueError('too much in all')

    node, seen = make_node(count=4), []
    declare(node, Family, seen.append, fit)
    assert set_one(node, 'gain', 1.0).reason == 'too much in all'
    both = [RosParameter('gain', value=1.0), RosParameter('count', value=3)]
    assert node.set_parameters_atomically(both).successful
    assert seen == [Family(gain=1.0, count=3)]


def test_parameters_of_others_change_nothing_here(make_node):
    node, family = declare_family(make_node)
    node.declare_parameter('theirs', 1.0)
    assert set_one(node, 'theirs', 2.0).successful
    assert (family.values, family.seen) == (Family(), [])


def test_two_nodes_have_values_of_their_own(make_node):
    one, one_family = declare_family(make_node)
    _, other_family = declare_family(make_node)
    assert set_one(one, 'gain', 1.0).successful
    assert (one_family.values.gain, other_family.values.gain) == (1.0, 0.5)


@pytest.mark.parametrize('name', PARAMETERS)
def test_a_node_starts_with_its_declared_defaults(make_node, name):
    node = make_node()
    assert declare(node, PARAMETERS[name]) == PARAMETERS[name]()
    for declared in PARAMETERS[name].declared():
        message = node.get_parameter(declared.name).get_parameter_value()
        assert parameter_value_to_python(message) == declared.default
