# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from tactile_push.launching import DemoArguments, FingerArguments
from tactile_push.launching.arguments import MACHINE, OBJECTS
from tactile_push.parameters import PARAMETERS, config_file


def test_texts_become_values_of_the_type_of_each_argument():
    texts = {
        'sensor': 'sentence',
        'sim': 'true',
        'rviz': 'False',
        'belt_speed': '1e-2',
        'joint_names': '[a, b]',
        'joint_min': '[-1.5, -2.0]',
        'namespace': '',
        'object': 'disk',
    }
    assert FingerArguments.read(texts) == {
        'sensor': 'sentence',
        'sim': True,
        'rviz': False,
        'belt_speed': 0.01,
        'joint_names': ['a', 'b'],
        'joint_min': [-1.5, -2.0],
        'object': 'disk',
    }


@pytest.mark.parametrize(
    ('kind', 'name', 'text', 'expected'),
    [
        (FingerArguments, 'sensor', 'nose', 'expected one of sentence'),
        (FingerArguments, 'sim', 'perhaps', 'expected true or false'),
        (FingerArguments, 'belt_speed', 'fast', r'expected a number .*\[m/s\]'),
        (FingerArguments, 'belt_speed', 'nan', r'expected a number .*\[m/s\]'),
        (FingerArguments, 'belt_speed', '40', 'expected a number .* from 1e-05 to 1'),
        (FingerArguments, 'joint_names', '[a, 1]', 'expected a list of texts'),
        (FingerArguments, 'joint_names', '[a, b', 'expected a list of texts'),
        (FingerArguments, 'joint_max', '[1, 2]', 'expected a list of numbers with decimal points'),
        (DemoArguments, 'object', 'cone', 'expected one of block, disk'),
    ],
)
def test_text_that_is_no_value_is_refused_by_name(kind, name, text, expected):
    with pytest.raises(ValueError, match=f'^argument {name}: {expected}') as refused:
        kind.read({name: text})
    assert '\n' not in str(refused.value)


@pytest.mark.parametrize(
    ('name', 'meant'), [('belt_sped', 'belt_speed'), ('sensors', 'sensor'), ('sm', 'sim')]
)
def test_name_that_looks_like_a_slip_is_refused(name, meant):
    with pytest.raises(ValueError, match=f'^argument {name}: unknown, did you mean {meant}\\?$'):
        FingerArguments.read({'sim': 'true', name: ''})


def test_names_of_who_includes_the_file_are_not_ours():
    others = {'robot_description': '<robot/>', 'log_level': 'info', 'x': ''}
    assert FingerArguments.read({'sim': 'true', **others}) == {'sim': True}


@pytest.mark.parametrize(
    'wrong',
    [
        {'joint_names': ['a']},
        {'joint_names': ['a', 'a']},
        {'joint_names': ['a', 'b', 'c', 'd']},
        {'joint_min': [0.0]},
        {'joint_max': [0.0] * 3},
        {'joint_speed': []},
    ],
)
def test_a_finger_has_two_joints_and_perhaps_a_wrist(wrong):
    with pytest.raises(ValueError, match=f'^{next(iter(wrong))}: expected two'):
        FingerArguments(**wrong)
    assert FingerArguments(joint_names=['a', 'b', 'wrist']).joint_names[2] == 'wrist'


def test_an_axis_has_one_joint():
    given = {
        'joint_names': ['slide'],
        'joint_min': [-0.1],
        'joint_max': [0.1],
        'joint_speed': [0.05],
    }
    assert FingerArguments(robot='axis', **given).joint_names == ['slide']
    for name, value in given.items():
        with pytest.raises(ValueError, match=f'^{name}: expected one .* for an axis'):
            FingerArguments(robot='axis', **{**given, name: 2 * value})


def test_facts_about_the_machine_are_those_that_nodes_declare_alike():
    declared = [{p.name: p for p in kind.declared()} for kind in PARAMETERS.values()]
    for fact in FingerArguments.declared():
        if fact.name not in MACHINE:
            continue
        known = [node[fact.name] for node in declared if fact.name in node]
        assert known, fact.name
        for one in known:
            assert (one.default, one.unit) == (fact.default, fact.unit), fact.name
            assert (one.lower, one.upper) == (fact.lower, fact.upper)


def test_no_other_argument_is_shared_by_nodes():
    names = {p.name for p in FingerArguments.declared()} - set(MACHINE)
    assert not names & {'mount_angle', 'belt_speed', 'finger_radius'}
    assert FingerArguments().machine['mount_angle'] == math.pi / 2.0


@pytest.mark.parametrize('name', OBJECTS)
def test_objects_have_files(name):
    assert config_file(f'{name}.yaml').is_file()
