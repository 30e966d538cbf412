# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The process of a command goes on as a node."""

import math
import os
import subprocess
import sys

import pytest

from tactile_push.cli import become as module

# A stand-in for Python that says what it is asked to run, and as which process.
STAND_IN = '#!/bin/sh\necho "$$ $*"\nexit 7\n'
PROGRAM = """
import sys
from tactile_push.cli.become import become
sys.executable = sys.argv[1]
print('said before')
become('sim_plant', {'mu_c': 0.5, 'publish_clock': True})
"""


def test_process_and_exit_status_are_those_of_the_node(tmp_path):
    stand_in = tmp_path / 'python'
    stand_in.write_text(STAND_IN)
    stand_in.chmod(0o755)
    # Into a pipe, so that what was said before has to be written out first.
    environment = {k: v for k, v in os.environ.items() if k != 'PYTHONUNBUFFERED'}
    with subprocess.Popen(
        [sys.executable, '-c', PROGRAM, str(stand_in)],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        out, _ = process.communicate(timeout=60)
    assert process.returncode == 7
    assert out.splitlines() == [
        'said before',
        f'{process.pid} -m tactile_push.nodes.sim_plant --ros-args '
        '-p mu_c:=0.5 -p publish_clock:=true',
    ]


def test_more_ros_arguments_stand_before_the_parameters(monkeypatch):
    commands = []
    monkeypatch.setattr(os, 'execv', lambda program, command: commands.append(command))
    module.become('live_page', {'port': 0}, ['-r', '__ns:=/left'])
    assert commands[0][2:] == [
        *('tactile_push.nodes.live_page', '--ros-args', '-r', '__ns:=/left', '-p', 'port:=0'),
    ]


@pytest.mark.parametrize(
    'value', ['yes', 'null', '1', "it's", 'a: b', '', 1, 2.0, -math.inf, True, ['1', 'off']]
)
def test_parameter_keeps_its_type_and_value(monkeypatch, value):
    yaml = pytest.importorskip('yaml')
    commands = []
    monkeypatch.setattr(os, 'execv', lambda program, command: commands.append(command))
    module.become('bag_player', {'name': value})
    ((*_, option, word),) = commands
    name, _, text = word.partition(':=')
    assert (option, name) == ('-p', 'name')
    read = yaml.safe_load(text)
    assert (type(read), read) == (type(value), value)
