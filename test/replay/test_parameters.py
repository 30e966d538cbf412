# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import json
from types import SimpleNamespace

import pytest

from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.replay.parameters import FingerParameters, ParameterFile, changed_parameters


def parameters_of(notes, namespace):
    found, _ = recorded_parameters(notes)
    return FingerParameters.of(found or {}, namespace, ParameterFile(None), {}).recorded


def sensing_parameters(recorded, wanted):
    nodes = {node: {} for node in ('contact_geometry', 'push_controller', 'active_sensing')}
    return FingerParameters(nodes | recorded, nodes | wanted, senses=True).sensing


def test_parameters_of_a_finger_are_those_of_its_namespace():
    notes = {
        'tactile_push.parameters': json.dumps(
            {
                'push_controller': {'kp': 0.05},
                'left/push_controller': {'kp': 0.06},
                'left/contact_geometry': {'finger_radius': 0.01},
            }
        )
    }
    assert parameters_of(notes, '')['push_controller'] == {'kp': 0.05}
    assert parameters_of(notes, '')['contact_geometry'] == {}
    assert parameters_of(notes, '/left')['push_controller'] == {'kp': 0.06}
    assert parameters_of(notes, '/left')['contact_geometry'] == {'finger_radius': 0.01}
    assert parameters_of({}, '')['push_controller'] == {}


@pytest.mark.parametrize(
    ('section', 'namespace', 'meant'),
    [
        ('push_controller', '', True),
        ('/push_controller', '', True),
        ('/**', '', True),
        ('/**/push_controller', '', True),
        ('/**/push_controller', '/left', True),
        ('/*/push_controller', '/left', True),
        ('/left/push_controller', '/left', True),
        ('/left/push_controller', '', False),
        ('push_controller', '/left', False),
        ('/**/sim_plant', '', False),
        ('/**/my_push_controller', '', False),
    ],
)
def test_sections_are_for_whom_rcl_takes_them_to_be(tmp_path, section, namespace, meant):
    file = tmp_path / 'gains.yaml'
    file.write_text(f'{section}:\n  ros__parameters:\n    kp: 0.07\n')
    values = ParameterFile(file).values(namespace)
    assert values['push_controller'] == ({'kp': 0.07} if meant else {})


@pytest.mark.parametrize(
    ('section', 'named'),
    [
        ('active_sensing', True),
        ('/**/active_sensing', True),
        ('/left/active_sensing', True),
        ('/right/active_sensing', False),
        ('/**', False),
        ('/left/*', False),
        ('/left/push_controller', False),
    ],
)
def test_node_is_named_by_its_name_alone(tmp_path, section, named):
    file = tmp_path / 'object.yaml'
    file.write_text(f'{section}:\n  ros__parameters:\n    edge: 0\n')
    namespace = '' if section == 'active_sensing' else '/left'
    assert ParameterFile(file).names(namespace, 'active_sensing') == named
    assert not ParameterFile(None).names(namespace, 'active_sensing')


def test_wanted_comes_before_recorded_and_that_before_what_other_nodes_know():
    given = {
        'push_controller': {'belt_speed': 0.006, 'kp': 0.05},
        'contact_geometry': {'finger_radius': 0.01},
        'active_sensing': {'finger_radius': 0.012, 'noise': 0.003},
    }
    wanted = {'push_controller': {'belt_speed': 0.9}, 'active_sensing': {'noise': 0.004}}
    assert sensing_parameters(given, wanted) == {
        'belt_speed': 0.006,
        'finger_radius': 0.012,
        'noise': 0.004,
    }


def test_wanted_outline_is_another_object():
    given = {
        'push_controller': {},
        'contact_geometry': {},
        'active_sensing': {'disk_radius': 0.03, 'edge': 5, 'noise': 0.003},
    }
    assert sensing_parameters(given, {'active_sensing': {'vertices': [0.1]}}) == {
        'vertices': [0.1],
        'noise': 0.003,
    }
    assert sensing_parameters(given, {'active_sensing': {'edge': 2}}) == {
        'disk_radius': 0.03,
        'edge': 2,
        'noise': 0.003,
    }


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('/**:\n  ros__parameters:\n    theta_desird: 0.1\n', 'did you mean theta_desired'),
        ('/**:\n  kp: 0.1\n', 'expected ros__parameters'),
        ('/**: [1, 2]\n', 'line 1: expected a list below ros__parameters'),
        ("'a", 'no YAML'),
        ('\x00', 'no YAML'),
    ],
)
def test_file_that_says_nothing_of_use_is_refused_with_the_place(tmp_path, text, words):
    file = tmp_path / 'gains.yaml'
    file.write_text(text)
    with pytest.raises(ValueError, match=words) as refused:
        ParameterFile(file).values('')
    assert str(file) in str(refused.value)
    assert '\n' not in str(refused.value)


def test_clock_of_the_nodes_may_stand_in_the_file(tmp_path):
    file = tmp_path / 'simulated.yaml'
    file.write_text('/**:\n  ros__parameters:\n    use_sim_time: true\n    kp: 0.1\n')
    assert ParameterFile(file).values('')['push_controller']['kp'] == 0.1
    ParameterFile(file).check([''])


def test_event_tells_what_changed():
    def value(kind, **field):
        return SimpleNamespace(type=kind, **field)

    event = SimpleNamespace(
        node='/left/push_controller',
        changed_parameters=[
            SimpleNamespace(name='kd', value=value(3, double_value=4.5)),
            SimpleNamespace(name='max_ticks_lost', value=value(2, integer_value=7)),
            SimpleNamespace(name='autostart', value=value(1, bool_value=False)),
            SimpleNamespace(name='gone', value=value(0)),
        ],
    )
    assert changed_parameters(event) == (
        '/left/push_controller',
        {'kd': 4.5, 'max_ticks_lost': 7, 'autostart': False},
    )
