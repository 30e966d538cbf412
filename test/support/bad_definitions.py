# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Definitions of sensor_msgs/msg/JointState that are not the one that everybody knows."""

HEADER = """
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
FIELDS = 'std_msgs/Header header\nstring[] name\nfloat64[] position\n'
# Each with what is wrong with it.
BAD_DEFINITIONS = {
    'none': ('', 'is missing'),
    'blank': (' \n\n', 'is missing'),
    'other fields': ('int32 data\n', 'lacks header.stamp.sec'),
    'a field less': (FIELDS.replace('string[] name\n', '') + HEADER, r'lacks name\[\]'),
    'one number for many': (FIELDS.replace('float64[]', 'float64') + HEADER, r'lacks position\[\]'),
    'texts for numbers': (
        FIELDS.replace('float64[] position', 'string[] position') + HEADER,
        r'has another position\[\]: expected a number, got string',
    ),
    'no parts': (FIELDS, 'lacks std_msgs/Header'),
    'parts of itself': (FIELDS + HEADER + 'std_msgs/Header again\n', 'a part of itself'),
    'no words': ('float64[', 'is invalid'),
    'binary': ('\0\1\2', 'is invalid'),
}
