# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Qualities of service: those that ROS writes are taken as they are, others are warned of."""

import pytest
import yaml

from support.bag_by_rosbags import refuse
from tactile_push.bags.qos import read_profiles

# What rosbag2 writes: in Jazzy in words, before in numbers.
JAZZY = {
    'history': 'keep_last',
    'depth': 10,
    'reliability': 'reliable',
    'durability': 'volatile',
    'deadline': {'sec': 9223372036, 'nsec': 854775807},
    'lifespan': {'sec': 0, 'nsec': 0},
    'liveliness': 'automatic',
    'liveliness_lease_duration': {'sec': 2147483647, 'nsec': 4294967295},
    'avoid_ros_namespace_conventions': False,
}
HUMBLE = JAZZY | {'history': 3, 'depth': 0, 'reliability': 1, 'durability': 2, 'liveliness': 1}
ODD = {
    'a number for a duration': ('deadline: 5', 'deadline: expected sec and nsec, got'),
    'a fraction of a second': ('lifespan: {sec: 0.5, nsec: 0}', 'lifespan: expected sec'),
    'a text for a duration': ('deadline: infinite', 'deadline: expected sec and nsec'),
    'a list for a duration': ('liveliness_lease_duration: [1, 0]', 'duration: expected sec'),
    'a duration in other words': ('deadline: {seconds: 1}', 'deadline: expected sec'),
    'a duration of texts': ('deadline: {sec: one, nsec: 0}', 'deadline: expected sec'),
    'a negative duration': ('deadline: {sec: -1, nsec: 0}', 'deadline: expected sec'),
    'an empty duration': ('deadline:', 'deadline: expected sec'),
    'a date': ('deadline: 2026-01-01', 'deadline: expected sec'),
    'a text for the depth': ('depth: ten', 'depth: expected a whole number from 0 to'),
    'a negative depth': ('depth: -1', 'depth: expected a whole number'),
    'a depth beyond all bounds': ('depth: 99999999999999999999', 'depth: expected a whole number'),
    'a depth that is a mapping': ('depth: {sec: 1}', 'depth: expected a whole number'),
    'true as a depth': ('depth: true', 'depth: expected a whole number'),
    'a word in capitals': (
        'reliability: BEST_EFFORT',
        'reliability: expected one of system_default',
    ),
    'a list of words': ('durability: [volatile]', 'durability: expected one of'),
    'a number too large': ('liveliness: 9', 'liveliness: expected one of'),
    'a text for a flag': ('avoid_ros_namespace_conventions: "no"', 'expected true or false'),
    'a number as a key': ('1: 2', '1: expected plain entries'),
    'itself': ('mine: &a [*a]', 'mine: expected plain entries'),
}


@pytest.mark.parametrize('profile', [JAZZY, HUMBLE, {'depth': 3}, {'mine': 'own'}, {}])
def test_profile_of_ros_is_taken_as_it_is(profile):
    assert read_profiles(yaml.safe_dump([profile, profile]), refuse) == (profile, profile)


@pytest.mark.parametrize(('text', 'words'), ODD.values(), ids=ODD)
def test_entry_of_another_shape_is_left_out_and_told(text, words):
    warnings = []
    profiles = read_profiles(f'- {text}\n  history: keep_all\n- depth: 7\n', warnings.append)
    assert profiles == ({'history': 'keep_all'}, {'depth': 7})
    (line,) = warnings
    assert words in line
    assert line.endswith('; the default is used') and '\n' not in line


@pytest.mark.parametrize(
    'text', ['depth: 7', '[3]', '[[]]', '{', 'a text', '- a\n- depth: 7', '&a [*a]']
)
def test_what_is_no_list_of_mappings_is_not_used(text):
    warnings = []
    assert read_profiles(text, warnings.append) == ()
    (line,) = warnings
    assert line.startswith('not used: ')
