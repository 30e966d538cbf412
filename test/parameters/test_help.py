# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

import pytest

from tactile_push.parameters import PARAMETERS
from tactile_push.parameters.help import node_help


@pytest.mark.parametrize('node', PARAMETERS)
def test_help_has_every_parameter_with_default_words_and_its_unit_once(node):
    usage, *lines = node_help(node).splitlines()
    assert usage.startswith(f'usage: {node} [--ros-args')
    for declared in PARAMETERS[node].declared():
        index = lines.index(f'  {declared.name} := {declared.default}')
        assert declared.words in lines[index + 1]
        assert lines[index + 1].count(f'[{declared.unit}]') == (1 if declared.unit else 0)


def test_help_needs_neither_ros_nor_the_compiler():
    command = [sys.executable, '-X', 'importtime', '-m', 'tactile_push.nodes.sim_plant', '--help']
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0
    assert done.stdout.startswith('usage: sim_plant')
    imported = {line.rpartition('|')[2].strip() for line in done.stderr.splitlines()}
    assert 'tactile_push.parameters' in imported
    assert imported.isdisjoint({'rclpy', 'numba', 'matplotlib'})
