# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Turn a command into one of the package's nodes."""

import os
import sys
from collections.abc import Mapping
from typing import NoReturn


def become(node: str, parameters: Mapping[str, object]) -> NoReturn:
    """Let this process go on as a node, which then gets the signals and gives the exit status."""
    from tactile_push.testing.processes import yaml_value

    arguments: list[str] = []
    for name, value in parameters.items():
        arguments += ['-p', f'{name}:={yaml_value(value)}']
    sys.stdout.flush()
    command = [sys.executable, '-m', f'tactile_push.nodes.{node}', '--ros-args', *arguments]
    os.execv(sys.executable, command)
