# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Turn a command into one of the package's nodes."""

import os
import sys
from collections.abc import Mapping, Sequence
from typing import NoReturn


def become(node: str, parameters: Mapping[str, object], arguments: Sequence[str] = ()) -> NoReturn:
    """Let this process go on as a node, which then gets the signals and gives the exit status.

    `arguments` are more ROS arguments.
    """
    from tactile_push.testing.processes import yaml_value

    words = [*arguments]
    for name, value in parameters.items():
        words += ['-p', f'{name}:={yaml_value(value)}']
    sys.stdout.flush()
    command = [sys.executable, '-m', f'tactile_push.nodes.{node}', '--ros-args', *words]
    os.execv(sys.executable, command)
