# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Comparison of decoded messages against differences that were put there."""

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.records import Schema
from mcap_ros2.decoder import DecoderFactory

from support.bag_making import encode
from tactile_push.bags import schema_text
from tactile_push.comparing.fields import Lone, Unequal, compare_messages, field_paths, seconds

JOINT_STATE = 'sensor_msgs/msg/JointState'
DECODERS = DecoderFactory()


def decode(type_name, data):
    schema = Schema(abs(hash(type_name)), schema_text(type_name).encode(), 'ros2msg', type_name)
    return DECODERS.decoder_for('cdr', schema)(data)


def differences(type_name, a, b):
    """Return the differences of two messages that are given by their fields."""
    messages = (decode(type_name, encode(type_name, **fields)) for fields in (a, b))
    return list(compare_messages(*messages))


def joints(names, **arrays):
    return {'name': list(names), **arrays}


def test_equal_messages_have_no_difference():
    fields = {'values': [{'key': 'age', 'value': '1'}], 'level': 2, 'name': 'driver'}
    assert differences('diagnostic_msgs/msg/DiagnosticStatus', fields, fields) == []


def test_nested_number():
    a = {'twist': {'linear': {'x': 1.0, 'y': 5.0}}}
    b = {'twist': {'linear': {'x': 1.25, 'y': 5.0}}}
    place = 'twist.linear.x'
    assert differences('geometry_msgs/msg/TwistStamped', a, b) == [
        Unequal(place, place, 1.0, 1.25, 0.25)
    ]


def test_text_and_truth_differ_without_a_size():
    a, b = {'frame_locked': True, 'ns': 'x'}, {'ns': 'y'}
    assert differences('visualization_msgs/msg/Marker', a, b) == [
        Unequal('ns', 'ns', 'x', 'y', math.inf),
        Unequal('frame_locked', 'frame_locked', True, False, math.inf),
    ]


def test_time_is_one_number_in_seconds():
    a = {'clock': {'sec': 1_732_540_000, 'nanosec': 999_999_999}}
    b = {'clock': {'sec': 1_732_540_001, 'nanosec': 1}}
    (found,) = differences('rosgraph_msgs/msg/Clock', a, b)
    assert found == Unequal('clock', 'clock', '1732540000.999999999', '1732540001.000000001', 2e-9)


@pytest.mark.parametrize(
    ('a', 'b', 'distance'),
    [
        (math.nan, math.nan, None),
        (math.inf, math.inf, None),
        (-math.inf, -math.inf, None),
        (0.0, -0.0, None),
        (5e-324, 0.0, 5e-324),
        (1.0, math.nextafter(1.0, 2.0), 2.0**-52),
        (math.nan, 1.0, math.inf),
        (1.0, math.inf, math.inf),
        (math.inf, -math.inf, math.inf),
        (math.inf, math.nan, math.inf),
        (1.7e308, -1.7e308, math.inf),
    ],
)
def test_special_numbers_alone_and_in_arrays(a, b, distance):
    expected = [] if distance is None else [distance]
    for one, other in ((a, b), (b, a)):
        single = differences('std_msgs/msg/Float64', {'data': one}, {'data': other})
        arrays = [{'data': [3.0, value]} for value in (one, other)]
        inside = differences('std_msgs/msg/Float64MultiArray', *arrays)
        assert [found.distance for found in single] == expected
        assert [found.distance for found in inside] == expected
        assert [found.where for found in inside] == ['data[1]'] * len(expected)


@pytest.mark.parametrize(
    ('kind', 'a', 'b'), [('UInt64', 2**64 - 1, 2**64 - 2), ('Int64', -(2**63), -(2**63) + 1)]
)
def test_large_integers_are_compared_exactly(kind, a, b):
    (single,) = differences(f'std_msgs/msg/{kind}', {'data': a}, {'data': b})
    arrays = [{'data': [value]} for value in (a, b)]
    (inside,) = differences(f'std_msgs/msg/{kind}MultiArray', *arrays)
    assert single == Unequal('data', 'data', a, b, 1.0)
    assert inside == Unequal('data[]', 'data[0]', a, b, 1.0)


def test_first_and_largest_difference_of_an_array_of_numbers():
    a = {'data': [0.0, 1.0, 2.0, 3.0, 4.0]}
    b = {'data': [0.0, 1.5, 2.0, 0.0, 4.5]}
    assert differences('std_msgs/msg/Float64MultiArray', a, b) == [
        Unequal('data[]', 'data[1]', 1.0, 1.5, 0.5),
        Unequal('data[]', 'data[3]', 3.0, 0.0, 3.0),
    ]


def test_bytes_are_numbers():
    a, b = ({'data': values, 'height': 1} for values in ([0, 255, 7], [0, 0, 7]))
    assert differences('sensor_msgs/msg/Image', a, b) == [
        Unequal('data[]', 'data[1]', 255, 0, 255.0)
    ]


def test_array_of_fixed_length():
    a, b = ({'pose': {'covariance': np.eye(6).ravel() * scale}} for scale in (1.0, 1.5))
    assert differences('geometry_msgs/msg/PoseWithCovarianceStamped', a, b) == [
        Unequal('pose.covariance[]', 'pose.covariance[0]', 1.0, 1.5, 0.5)
    ]


def test_array_of_another_length():
    a, b = ({'status': [{'values': [{}] * n}, {}]} for n in (2, 3))
    assert differences('diagnostic_msgs/msg/DiagnosticArray', a, b) == [
        Unequal('len(status[].values)', 'len(status[0].values)', 2, 3, math.inf)
    ]


def test_array_of_messages_has_its_places_named():
    a = {'poses': [{'position': {'x': k}} for k in range(4)]}
    b = {'poses': [{'position': {'x': k + (k > 1)}} for k in range(4)]}
    assert differences('geometry_msgs/msg/PoseArray', a, b) == [
        Unequal('poses[].position.x', 'poses[2].position.x', 2.0, 3.0, 1.0),
        Unequal('poses[].position.x', 'poses[3].position.x', 3.0, 4.0, 1.0),
    ]


def test_joint_states_are_matched_by_name():
    a = joints(['theta', 'phi', 'old'], position=[1.0, 2.0, 9.0])
    b = joints(['new', 'phi', 'theta'], position=[7.0, 2.5, 1.0])
    assert differences(JOINT_STATE, a, b) == [
        Lone('position.old', True),
        Lone('position.new', False),
        Unequal('position.phi', 'position.phi', 2.0, 2.5, 0.5),
    ]


def test_joint_states_with_efforts_and_without():
    a = joints(['force'], position=[math.nan], effort=[1.0])
    b = joints(['force'], position=[math.nan], effort=[3.0])
    assert differences(JOINT_STATE, a, b) == [
        Unequal('effort.force', 'effort.force', 1.0, 3.0, 2.0)
    ]
    del b['effort']
    assert differences(JOINT_STATE, a, b) == [Unequal('len(effort)', 'len(effort)', 1, 0, math.inf)]


@pytest.mark.parametrize('position', [[1.0, 2.0], [1.0]], ids=['name twice', 'too short'])
def test_joint_states_that_cannot_be_matched_are_compared_as_they_are(position):
    a = joints(['x', 'x'], position=position)
    b = joints(['x', 'x'], position=[*position[:-1], 5.0])
    (found,) = differences(JOINT_STATE, a, b)
    assert found.field == 'position[]'


@pytest.mark.parametrize(
    ('type_name', 'a', 'b'),
    [
        ('geometry_msgs/msg/TwistStamped', {}, {'twist': {'linear': {'x': 1.0}}}),
        ('builtin_interfaces/msg/Time', {}, {'sec': 1}),
        (JOINT_STATE, joints('ab', position=[1.0, 2.0]), joints('ab', position=[1.0, 3.0])),
        (JOINT_STATE, joints('ab', position=[1.0, 2.0]), joints('ab', effort=[1.0, 2.0])),
        (JOINT_STATE, joints('ab', position=[1.0, 2.0]), joints('bb', position=[1.0, 3.0])),
        ('sensor_msgs/msg/CompressedImage', {'data': [1]}, {'data': [2]}),
        (
            'diagnostic_msgs/msg/DiagnosticStatus',
            {'values': [{'key': 'age'}]},
            {'values': [{'key': 'rate'}]},
        ),
    ],
)
def test_fields_of_differences_are_among_the_paths(type_name, a, b):
    messages = [decode(type_name, encode(type_name, **fields)) for fields in (a, b)]
    found = {unequal.field for unequal in compare_messages(*messages)}
    assert found and found <= {path for message in messages for path in field_paths(message)}


def test_fields_of_another_definition():
    old, new = '# of old\nfloat64 x\nfloat64 y\n', 'float64 y\nfloat64 z\n'
    a, b = (
        DecoderFactory().decoder_for('cdr', Schema(1, text.encode(), 'ros2msg', 'my/msg/Pair'))(
            b'\0\1\0\0' + struct.pack('<2d', *values)
        )
        for text, values in ((old, [1.0, 2.0]), (new, [2.5, 3.0]))
    )
    x, y, z = compare_messages(a, b)
    assert (x, z) == (Lone('x', True), Lone('z', False))
    assert y == Unequal('y', 'y', 2.0, 2.5, 0.5)


NUMBERS = st.floats(width=64)


@given(st.dictionaries(st.text('abcdef', min_size=1), NUMBERS), st.randoms())
def test_joint_state_equals_itself_in_any_order(positions, order):
    shuffled = list(positions)
    order.shuffle(shuffled)
    a = joints(positions, position=list(positions.values()))
    b = joints(shuffled, position=[positions[name] for name in shuffled])
    assert differences(JOINT_STATE, a, b) == []


@given(st.integers(-(2**31) * 10**9, 2**31 * 10**9))
def test_seconds_are_exact(time):
    whole, fraction = seconds(time).split('.')
    assert len(fraction) == 9
    assert int(whole + fraction) == time
