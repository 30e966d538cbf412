# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files that a calibration writes, for `--params-file` of the sensor's node."""

import json
from collections.abc import Mapping

from tactile_push.parameters.ros_file import PARAMS_KEY

SIGNIFICANT = 9  # digits of a number


def parameter_file(node: str, values: Mapping[str, object], remarks: list[str]) -> str:
    """Return the text of a parameter file.

    Parameters
    ----------
    node : str
        The node that loads it, in any namespace.
    values : mapping of str to object
        Values by name: numbers, lists of numbers, texts, true and false.
    remarks : list of str
        Lines for people.

    Returns
    -------
    str
        YAML as ROS has it.
    """
    lines = [*(f'# {remark}' for remark in remarks), f'/**/{node}:', f'  {PARAMS_KEY}:']
    lines += [f'    {name}: {_shown(value)}' for name, value in values.items()]
    return '\n'.join([*lines, ''])


def _shown(value: object) -> str:
    """Return a value with the decimal point that ROS wants of a real number."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value)  # which YAML reads as well
    if isinstance(value, list):
        return f'[{", ".join(map(_shown, value))}]'
    if not isinstance(value, float):
        return str(value)
    text = f'{value:.{SIGNIFICANT}g}'
    return text if {'.', 'e'} & set(text) else f'{text}.0'
