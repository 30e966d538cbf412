# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from pathlib import Path

import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically

from tactile_push.testing import NodeProcesses, Observer


def double(value: float) -> ParameterValue:
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('kp', double(-1.0)),
        ('kp', double(float('nan'))),
        ('kd', ParameterValue(type=ParameterType.PARAMETER_STRING, string_value='much')),
        ('theta_desired', double(40.0)),
        ('belt_speed', double(0.01)),
        ('kpp', double(1.0)),
        ('kp', ParameterValue()),
        ('kp', ParameterValue(type=77)),
    ],
)
def test_refused_parameter_stays_unchanged(
    nodes: NodeProcesses, observer: Observer, name: str, value: ParameterValue
):
    nodes.start('push_controller')

    def get() -> ParameterValue:
        answer = observer.call(
            GetParameters, 'push_controller/get_parameters', GetParameters.Request(names=[name])
        )
        return answer.values

    before = get()
    request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    (result,) = observer.call(SetParameters, 'push_controller/set_parameters', request).results
    assert not result.successful
    assert result.reason
    assert get() == before


def test_values_of_no_type_are_refused_together_too(nodes: NodeProcesses, observer: Observer):
    nodes.start('contact_geometry')
    request = SetParametersAtomically.Request(
        parameters=[
            Parameter(name='mount_angle', value=double(0.5)),
            Parameter(name='mount_angle', value=ParameterValue(type=255)),
        ]
    )
    service = 'contact_geometry/set_parameters_atomically'
    result = observer.call(SetParametersAtomically, service, request).result
    assert not result.successful
    assert result.reason
    request = GetParameters.Request(names=['mount_angle'])
    answer = observer.call(GetParameters, 'contact_geometry/get_parameters', request)
    assert answer.values[0].double_value == math.pi / 2.0


def test_gains_change_at_run_time(nodes: NodeProcesses, observer: Observer):
    nodes.start('push_controller')
    request = SetParameters.Request(parameters=[Parameter(name='kd', value=double(3.0))])
    (result,) = observer.call(SetParameters, 'push_controller/set_parameters', request).results
    assert result.successful
    request = GetParameters.Request(names=['kd'])
    answer = observer.call(GetParameters, 'push_controller/get_parameters', request)
    assert answer.values[0].double_value == 3.0


@pytest.mark.parametrize(
    ('node', 'parameters', 'expected'),
    [
        ('push_controller', {'kp': -1.0}, 'parameter kp: expected a number'),
        ('push_controller', {'kp': 1}, 'parameter kp: expected a number with a decimal point'),
        ('push_controller', {'joint_names': []}, 'joint_names: expected two or three different'),
        (
            'push_controller',
            {'joint_names': ['a', 'a']},
            'joint_names: expected two or three different',
        ),
        ('push_controller', {'use_sim_time': 'maybe'}, "'use_sim_time' to 'maybe'"),
        ('push_controller', {'kq': 1.0}, 'parameter kq: unknown, did you mean kp?'),
        ('sim_plant', {'object': 'cone'}, 'parameter object: expected one of block, disk'),
        (
            'sim_plant',
            {'d_initial': 0.03},
            'parameter d_initial: expected a contact',
        ),
        ('sim_plant', {'device': 'serial:/x'}, 'device: expected socket://host:port'),
        ('sim_plant', {'real_time_factor': 2.0}, 'real_time_factor: expected 1.0 unless'),
        ('contact_geometry', {'max_out_of_plane': 2.0}, 'max_out_of_plane: expected a number'),
        ('sensor_driver', {'device': 'nonsense://x'}, 'nonsense'),
    ],
)
def test_bad_parameter_ends_a_node_with_one_line(
    nodes: NodeProcesses, node: str, parameters: dict, expected: str
):
    process = nodes.start(node, parameters)
    assert process.wait(30.0) == 2
    said = nodes.log(node).read_text()
    assert said.count('\n') == 1
    assert expected in said


@pytest.mark.parametrize(
    ('arguments', 'expected'),
    [
        (('--params-file', 'broken.yaml'), 'broken.yaml'),
        (('--params-file', 'missing.yaml'), 'missing.yaml'),
        (('-p', 'kp'), "'-p kp'"),
        (('--oops',), '--oops'),
        (('--', 'kp:=1.0'), 'unknown argument kp:=1.0'),
    ],
)
def test_bad_argument_ends_a_node_with_one_line(
    nodes: NodeProcesses, tmp_path: Path, monkeypatch, arguments: tuple[str, ...], expected: str
):
    monkeypatch.chdir(tmp_path)
    Path('broken.yaml').write_text('push_controller:\n  ros__parameters: [kp\n')
    assert nodes.start('push_controller', arguments=arguments).wait(30.0) == 2
    said = nodes.log('push_controller').read_text()
    assert said.count('\n') == 1
    assert expected in said
