# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The nodes that `finger.launch.py` plans, started without `ros2 launch`."""

import math
from pathlib import Path

import pytest
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState

from tactile_push.interface import NODES
from tactile_push.launching import finger_plan
from tactile_push.paper import THETA_INITIAL
from tactile_push.parameters import config_file
from tactile_push.testing import NodeProcesses, Observer
from tactile_push.testing.observer import field

pytest.importorskip('xacro', reason='pip install xacro')


def test_simulation_of_the_machine_turns_and_locates_the_block(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    poses = observer.hear(PoseWithCovarianceStamped, '/left/object_pose')
    truth = observer.hear(JointState, '/left/ground_truth/state')
    machine = tmp_path / 'machine.yaml'
    quick = 'real_time_factor: 20.0'
    text = config_file('hardware.yaml').read_text()
    machine.write_text(text.replace('real_time_factor: 1.0', quick))
    assert quick in machine.read_text()
    plan = finger_plan({'config': str(machine), 'sim': 'true', 'namespace': 'left'})
    own = [program for program in plan.programs if program.executable in NODES]
    for program in own:
        values = dict(program.parameters)
        if 'device' in values:
            values['device'] = str(tmp_path / 'sensor')  # others may use the usual one meanwhile
        nodes.start(program.executable, values, arguments=('-r', f'__ns:=/{plan.namespace}'))
    observer.wait_for(
        lambda: truth and field(truth[-1], 'theta') < THETA_INITIAL - math.radians(5.0),
        'the block to turn',
    )
    observer.wait_for(lambda: poses, 'an estimate')
    for program in own:
        assert 'unknown' not in nodes.log(program.executable).read_text()
