# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters in the notes of a bag, of the right shape and of others."""

import json

import pytest

from support.bad_notes import BAD_NOTES, NO_JSON
from tactile_push.parameters.recorded import recorded_parameters

NOTE = 'tactile_push.parameters'


def test_bag_without_a_note_has_none():
    assert recorded_parameters({'other': '{'}) == (None, [])


def test_parameters_are_values_by_node():
    values = {'left/push_controller': {'kp': 0.1, 'use_sim_time': True}, 'somebody': {'kp': 'x'}}
    assert recorded_parameters({NOTE: json.dumps(values)}) == (values, [])


def test_node_may_have_a_leading_slash():
    assert recorded_parameters({NOTE: '{"/left/push_controller": {"kp": 0.1}}'}) == (
        {'left/push_controller': {'kp': 0.1}},
        [],
    )


@pytest.mark.parametrize(('text', 'words'), BAD_NOTES.values(), ids=BAD_NOTES)
def test_what_has_another_shape_is_left_out_and_told(text, words):
    found, (line,) = recorded_parameters({NOTE: text})
    assert words in line
    assert len(line) <= 201 and '\n' not in line
    assert (found is None) == (words == NO_JSON)
    assert not any('kp' in values or 'vertices' in values for values in (found or {}).values())


@pytest.mark.parametrize('node', ['sim_plant', 'left/mujoco_plant'])
def test_of_a_plant_that_refuses_a_value_nothing_stays(node):
    text = json.dumps({node: {'object': 7, 'mu_c': 0.3}})
    found, (line,) = recorded_parameters({NOTE: text})
    assert found == {}
    assert f'/{node}: left out: parameter object: expected' in line


def test_the_rest_stays():
    text = '{"push_controller": {"kp": "fast", "kd": 3.0}, "sim_plant": 3, "other": {"a": 1}}'
    found, lines = recorded_parameters({NOTE: text})
    assert found == {'push_controller': {'kd': 3.0}, 'other': {'a': 1}}
    assert len(lines) == 2
