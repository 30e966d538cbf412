# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `NODE --help` prints."""

from tactile_push.parameters import PARAMETERS


def node_help(node: str) -> str:
    """Return how to start a node, and its parameters with their defaults and ranges."""
    lines = [f'usage: {node} [--ros-args -p NAME:=VALUE … --params-file FILE …]', '', 'parameters:']
    for parameter in PARAMETERS[node].declared():
        lines.append(f'  {parameter.name} := {parameter.default}')
        lines.append(f'      {parameter.words}; {parameter.expected()}')
    return '\n'.join(lines)
