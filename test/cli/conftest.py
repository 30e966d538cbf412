# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The command in this process, and what it becomes."""

import os
import sys

import pytest
import yaml

from tactile_push.cli import main


@pytest.fixture
def command(capsys):
    """Return a function that runs the command: exit status, standard output, standard error."""

    def run(*arguments):
        capsys.readouterr()
        try:
            status = main([*map(str, arguments)])
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


@pytest.fixture
def become(monkeypatch):
    """Return a function that runs the command: the node it turns into, and its parameters."""

    class BecameError(Exception):
        pass

    def execv(program, command):
        assert program == sys.executable
        raise BecameError(command)

    monkeypatch.setattr(os, 'execv', execv)

    def run(*words):
        with pytest.raises(BecameError) as became:
            main([*words])
        return node_and_parameters(became.value.args[0])

    return run


def node_and_parameters(command):
    """Return the node and its parameters as ROS reads them."""
    option, module, ros_args, *words = command[1:]
    assert (option, ros_args) == ('-m', '--ros-args')
    assert set(words[::2]) <= {'-p', '-r'}
    given = (word.partition(':=') for word in words[1::2])
    parameters = {name: yaml.safe_load(value) for name, _, value in given}
    return module.removeprefix('tactile_push.nodes.'), parameters
