# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Commands that go on as one of the package's nodes."""

import os
import sys
from collections.abc import Mapping
from typing import NoReturn


def become(node: str, parameters: Mapping[str, object]) -> NoReturn:
    """Let this process go on as a node, which then gets the signals and gives the exit status.

    Parameters
    ----------
    node : str
        One of the package's nodes.
    parameters : mapping of str to object
        Values of its parameters.
    """
    from tactile_push.testing.processes import yaml_value

    words = [f'{name}:={yaml_value(value)}' for name, value in parameters.items()]
    arguments = [word for pair in zip(['-p'] * len(words), words, strict=True) for word in pair]
    sys.stdout.flush()
    command = [sys.executable, '-m', f'tactile_push.nodes.{node}', '--ros-args', *arguments]
    os.execv(sys.executable, command)
