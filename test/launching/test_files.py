# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest

from tactile_push.launching import FingerArguments, finger_plan
from tactile_push.launching.files import LAUNCH_SECTION
from tactile_push.parameters import PARAMETERS, config_file
from tactile_push.parameters.ros_file import read_sections

pytest.importorskip('xacro', reason='pip install xacro')


@pytest.mark.parametrize(
    ('nodes', 'expected'),
    [
        ({'push_controller': {'kp': -1.0}}, r'^push_controller: parameter kp: expected a number'),
        (
            {'push_controller': {'kpp': 1.0}},
            r'^push_controller: parameter kpp: unknown, did you mean kp\?$',
        ),
        ({'push_controler': {'kp': 1.0}}, r'yaml: /\*\*/push_controler: expected finger_launch or'),
        ({'push_controller': {'belt_speed': 0.1}}, 'belt_speed: expected below finger_launch'),
        ({'finger_launch': {'belt': 0.1}}, 'finger_launch: parameter belt: expected one of sensor'),
        ({'finger_launch': {'config': 'x'}}, 'finger_launch: parameter config: expected one of'),
        ({'finger_launch': {'belt_speed': 5}}, 'finger_launch: parameter belt_speed: expected a n'),
        ({'finger_launch': {'object': 'x.yaml'}}, '^x.yaml: No such file'),
        ({'finger_launch': {'object': 'hardware'}}, 'object: expected block, disk or a YAML file'),
        ({'finger_launch': {'calibration': '/no/file'}}, '^/no/file: No such file'),
        ({'finger_launch': {'joint_names': ['one']}}, '^joint_names: expected two or three'),
    ],
)
def test_bad_file_is_refused_with_one_line_before_anything_starts(own, nodes, expected):
    with pytest.raises(ValueError, match=expected) as refused:
        finger_plan({'config': own(**nodes)})
    assert '\n' not in str(refused.value)


def test_missing_file_of_the_machine_is_refused():
    with pytest.raises(ValueError, match='^/no/such.yaml: No such file'):
        finger_plan({'config': '/no/such.yaml'})


HARDWARE = config_file('hardware.yaml')


def test_file_of_the_machine_says_every_argument_and_repeats_defaults():
    sections = {key.removeprefix('/**/'): v for key, v in read_sections(HARDWARE).items()}
    said = sections.pop(LAUNCH_SECTION)
    defaults = {p.name: p.default for p in FingerArguments.declared() if p.name != 'config'}
    assert said == defaults
    assert list(said) == list(defaults)
    for node, given in sections.items():
        declared = {p.name: p.default for p in PARAMETERS[node].declared()}
        given.pop('device', None)
        assert given == {name: declared[name] for name in given}, node


def test_every_line_of_the_machines_file_is_explained():
    lines = [line for line in HARDWARE.read_text().splitlines() if line.strip()]
    silent = [line for line in lines if '#' not in line and 'ros__parameters:' not in line]
    assert silent == []
