# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a topic says about itself."""

import pytest

from tactile_push.bags import Topic
from tactile_push.bags.fields import NUMBER, WHOLE

DEFINITION = 'int32 count\nfloat64[] values\n'


def topic(definition=DEFINITION, encodings=('cdr', 'ros2msg')):
    return Topic('/a', 'a_msgs/msg/A', definition, (), '', encodings)


@pytest.mark.parametrize(
    ('expected', 'trouble'),
    [
        ({}, ''),
        ({'count': WHOLE, 'values[]': NUMBER}, ''),
        ({'count': WHOLE, 'value': NUMBER}, 'lacks value'),
        ({'values[]': WHOLE}, 'has another values[]: expected a whole number, got float64'),
    ],
)
def test_trouble_names_type_topic_and_field(expected, trouble):
    words = f'the definition of a_msgs/msg/A for /a {trouble}' if trouble else ''
    assert topic().trouble(expected) == words


@pytest.mark.parametrize('encodings', [('cdr', 'omgidl'), ('cdr', ''), ('json', 'ros2msg')])
def test_trouble_with_another_encoding_names_it(encodings):
    one = topic(encodings=encodings)
    assert not one.decodes
    assert one.trouble({}) == (
        "/a cannot be decoded: expected message encoding 'cdr', schema encoding 'ros2msg', got "
        f"message encoding '{encodings[0]}', schema encoding '{encodings[1]}'"
    )


def test_message_without_fields_needs_no_definition():
    assert topic('').decodes
    assert topic('').trouble({}) == ''
    assert topic('').trouble({'count': WHOLE}).endswith('for /a is missing')
