# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of definitions against those that rosbags knows of the same types."""

import re

import pytest
from rosbags.interfaces import Nodetype

from support.bad_definitions import BAD_DEFINITIONS, FIELDS, HEADER
from support.bag_making import TYPES
from tactile_push.bags import schema_text
from tactile_push.bags.fields import NUMBER, TEXT, WHOLE, fields_of, trouble_with

JOINT_STATE = 'sensor_msgs/msg/JointState'
READ = {'header.stamp.sec': WHOLE, 'name[]': TEXT, 'position[]': NUMBER}


def by_rosbags(description, path):
    """Yield path and primitive type of each field."""
    kind, detail = description
    if kind == Nodetype.NAME:
        for name, part in TYPES.fielddefs[detail][1]:
            yield from by_rosbags(part, f'{path}.{name}' if path else name)
    elif kind == Nodetype.BASE:
        yield path, {'octet': 'byte'}.get(detail[0], detail[0])
    else:
        element, length = detail
        yield from by_rosbags(element, f'{path}[{length if kind == Nodetype.ARRAY else ""}]')


@pytest.mark.parametrize(
    'type_name',
    [
        JOINT_STATE,
        'geometry_msgs/msg/PoseWithCovarianceStamped',
        'visualization_msgs/msg/MarkerArray',
        'diagnostic_msgs/msg/DiagnosticArray',
        'rcl_interfaces/msg/ParameterEvent',
        'sensor_msgs/msg/CameraInfo',
    ],
)
def test_fields_are_those_of_the_type(type_name):
    pytest.importorskip(type_name.split('/')[0])
    expected = list(by_rosbags((Nodetype.NAME, type_name), ''))
    assert list(fields_of(type_name, schema_text(type_name)).items()) == expected


def test_time_is_known_without_its_definition():
    fields = fields_of(
        'a_msgs/msg/B', 'builtin_interfaces/Time at\nbuiltin_interfaces/Duration for'
    )
    assert fields == {
        'at.sec': 'int32',
        'at.nanosec': 'uint32',
        'for.sec': 'int32',
        'for.nanosec': 'uint32',
    }


@pytest.mark.parametrize(('definition', 'wrong'), BAD_DEFINITIONS.values(), ids=BAD_DEFINITIONS)
def test_what_is_wrong_with_a_definition(definition, wrong, capfd):
    try:
        found = trouble_with(fields_of(JOINT_STATE, definition), READ)
    except ValueError as error:
        found = str(error)
    assert re.search(wrong, found)
    assert '\n' not in found
    assert capfd.readouterr() == ('', '')


def test_definition_with_more_or_narrower_fields_will_do():
    fields = fields_of(JOINT_STATE, FIELDS.replace('float64', 'float32') + 'bool new\n' + HEADER)
    assert trouble_with(fields, READ) == trouble_with({}, {}) == ''
