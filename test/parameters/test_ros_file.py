# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A file means the same for `--config` as for a node's `--params-file`."""

import pytest

pytest.importorskip('rclpy')

from support.params_file import given_to, node_with, private_context
from tactile_push.nodes.ros.parameters import ConfigurationError, declare
from tactile_push.parameters import PARAMETERS
from tactile_push.replay.parameters import ParameterFile


@pytest.fixture(scope='module')
def context():
    with private_context() as context:
        yield context


def as_a_node(context, file, node, namespace=''):
    """Return the values that a node takes from a file, and all its parameters; None if refused."""
    try:
        made = node_with(context, file, node, namespace)
    except RuntimeError:
        return None, None
    given = given_to(made)
    try:
        return given, declare(made, PARAMETERS[node])
    except ConfigurationError:
        return given, None
    finally:
        made.destroy_node()


def as_a_config(file, node, namespace=''):
    """Return the same of a replay."""
    given = None
    try:
        given = ParameterFile(file).values(namespace and f'/{namespace}')[node]
        return given, PARAMETERS[node].of(given)
    except ValueError:
        return given, None


def text_of(*sections):
    """Return a file with one value in each section, named by the names above it."""
    lines = []
    for names, value in sections:
        names = names.split()
        lines += ['  ' * depth + f'{name}:' for depth, name in enumerate(names)]
        lines.append('  ' * len(names) + f'ros__parameters: {{{value}}}')
    return '\n'.join(lines) + '\n'


def values_of(*lines):
    return 'push_controller:\n  ros__parameters:\n' + ''.join(f'    {line}\n' for line in lines)


# Which values reach /push_controller and /left/push_controller; None if the file is refused.
SECTIONS = [
    (text_of(('push_controller', 'kd: 3.0')), {'kd': 3.0}, {}),
    (text_of(('/push_controller', 'kd: 3.0')), {'kd': 3.0}, {}),
    (text_of(('left push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/left push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/left/ push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/ left push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('left/push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/*', 'kd: 3.0')), {'kd': 3.0}, {}),
    (text_of(('/**', 'kd: 3.0')), {'kd': 3.0}, {'kd': 3.0}),
    (text_of(('"*"', 'kd: 3.0')), {'kd': 3.0}, {}),
    (text_of(('"**"', 'kd: 3.0')), {'kd': 3.0}, {'kd': 3.0}),
    (text_of(('/* push_controller', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/** push_controller', 'kd: 3.0')), {'kd': 3.0}, {'kd': 3.0}),
    (text_of(('/**/push_controller', 'kd: 3.0')), {'kd': 3.0}, {'kd': 3.0}),
    (text_of(('/left "*"', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('left "**"', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/*/*', 'kd: 3.0')), {}, {'kd': 3.0}),
    (text_of(('/**', 'kd: 3.0'), ('push_controller', 'kd: 4.0')), {'kd': 4.0}, {'kd': 3.0}),
    (text_of(('push_controller', 'kd: 4.0'), ('/**', 'kd: 3.0')), {'kd': 3.0}, {'kd': 3.0}),
    (
        text_of(('/**', 'kd: 3.0'), ('push_controller', 'kd: 4.0'), ('/**', 'kp: 0.1')),
        {'kd': 4.0, 'kp': 0.1},
        {'kd': 3.0, 'kp': 0.1},
    ),
    (text_of(('/**', 'belt_speed: 0.004'), ('left push_controller', 'kd: 3.0')),
     {'belt_speed': 0.004}, {'belt_speed': 0.004, 'kd': 3.0}),
    (text_of(('/**', 'noise: 0.005, disk_radius: 0.0')),
     {'noise': 0.005, 'disk_radius': 0.0}, {'noise': 0.005, 'disk_radius': 0.0}),
    (
        'left:\n  push_controller:\n    ros__parameters: {kd: 3.0}\n'
        '  active_sensing:\n    ros__parameters: {noise: 0.005}\n'
        'push_controller:\n  ros__parameters: {kd: 4.0}\n',
        {'kd': 4.0},
        {'kd': 3.0},
    ),
    ('', {}, {}),
    ('left: {}\n', {}, {}),
    (text_of(('push_controller', '')), {}, {}),
    (text_of(('my_push_controller', 'kd: 3.0')), {}, {}),
    ('kd: 3.0\n', None, None),
    ('ros__parameters: {kd: 3.0}\n', None, None),
    ('push_controller: {kd: 3.0}\n', None, None),
    ('push_controller:\n', None, None),
    ('push_controller:\n  ros__parameters:\n', None, None),
    ('- push_controller\n', None, None),
    ('push_controller: [1, 2]\n', None, None),
    (text_of(('"push*"', 'kd: 3.0')), None, None),
    (text_of(('//push_controller', 'kd: 3.0')), None, None),
    (text_of(('1left push_controller', 'kd: 3.0')), None, None),
    ('a: [1\n', None, None),
    ('\x00', None, None),
    ('a: &x\n  ros__parameters: {kd: 3.0}\nb: *x\n', None, None),
]  # fmt: skip


@pytest.mark.parametrize(('text', 'here', 'left'), SECTIONS)
def test_sections_are_for_the_nodes_that_a_node_takes_them_to_be_for(
    context, tmp_path, text, here, left
):
    file = tmp_path / 'gains.yaml'
    file.write_text(text)
    for namespace, expected in (('', here), ('left', left)):
        lived = as_a_node(context, file, 'push_controller', namespace)
        assert lived[0] == expected
        assert as_a_config(file, 'push_controller', namespace) == lived
        if expected is None:
            break  # nobody takes it


# What the node does with the values: as they are read, None if the file or a value is refused.
VALUES = [
    (values_of('kd: 5e-3'), {'kd': 0.005}),
    (values_of('kd: 1e2'), {'kd': 100.0}),
    (values_of('kd: 0x1p3'), {'kd': 8.0}),
    (values_of('kd: 08'), {'kd': 8.0}),
    (values_of('max_ticks_lost: 0x10'), {'max_ticks_lost': 16}),
    (values_of('max_ticks_lost: 010'), {'max_ticks_lost': 8}),
    (values_of('max_ticks_lost: 3', 'max_ticks_lost: 4'), {'max_ticks_lost': 4}),
    (values_of('autostart: off'), {'autostart': False}),
    (values_of('autostart: y'), {'autostart': True}),
    (values_of('joint_names: [a, "1"]'), {'joint_names': ['a', '1']}),
    (values_of('joint_names: [[a, b]]'), {'joint_names': ['a', 'b']}),
    (values_of('joint_names: [!!str 1, a]'), {'joint_names': ['1', 'a']}),
    (values_of('kd: |-', '  0.5'), {'kd': 0.5}),
    (values_of('use_sim_time: true', 'start_type_description_service: true',
               'qos_overrides: {/parameter_events: {publisher: {depth: 1000}}}', 'kd: 3.0'),
     {'use_sim_time': True, 'start_type_description_service': True, 'kd': 3.0,
      'qos_overrides./parameter_events.publisher.depth': 1000}),
    (values_of('kd: inf'), None),
    (values_of('kd: .nan'), None),
    (values_of('kd: 1_0.0'), None),
    (values_of('kd: 3'), None),
    (values_of('kd: "3.0"'), None),
    (values_of('kd: 1e999'), None),
    (values_of('kd: |', '  0.5'), None),
    (values_of('kd: 3.0', 'kd: 3'), None),  # whichever of them the node takes: the whole number
    (values_of('kd: '), None),
    (values_of('kd: ""'), None),
    (values_of('kd: []'), None),
    (values_of('kd: {a: 1.0}'), None),
    (values_of('zzz: {a: 1.0, b: {c: 2.0}, d: 3.0}'), {'zzz.a': 1.0, 'zzz.b.c': 2.0, 'zzz.d': 3.0}),
    (values_of('zzz: {}'), {'zzz': []}),
    (values_of('kd: [1.0, 2]'), None),
    (values_of('joint_names: []'), {'joint_names': []}),
    (values_of('max_ticks_lost: 1:30'), None),
    (values_of('autostart: 1'), None),
    (values_of('kkd: 3.0'), None),
    (values_of('zzz: 3.0'), {'zzz': 3.0}),
]  # fmt: skip


@pytest.mark.parametrize(('text', 'values'), VALUES)
def test_values_are_those_that_a_node_takes(context, tmp_path, text, values):
    file = tmp_path / 'gains.yaml'
    file.write_text(text)
    given, lived = as_a_node(context, file, 'push_controller')
    assert as_a_config(file, 'push_controller')[1] == lived
    assert (lived is None) == (values is None)
    if values is not None:
        assert given == values == as_a_config(file, 'push_controller')[0]


@pytest.mark.parametrize(
    ('value', 'taken'),
    [
        ('vertices: []', True),
        ('vertices: [0.0, 0.0, 0.1, 0.0, 0.0, 0.1]', True),
        ('vertices: [0, 0, 1, 0, 0, 1]', False),
        ('mu_c_max: inf', True),
        ('mu_c_max: .inf', True),
        ('mu_c_max: Infinity', True),
        ('edge: -1', True),
        ('noise: 5e-3', True),
    ],
)
def test_values_of_active_sensing_are_those_that_the_node_takes(context, tmp_path, value, taken):
    file = tmp_path / 'object.yaml'
    file.write_text(text_of(('active_sensing', value)))
    lived = as_a_node(context, file, 'active_sensing')
    assert as_a_config(file, 'active_sensing') == lived
    assert (lived[1] is not None) == taken
