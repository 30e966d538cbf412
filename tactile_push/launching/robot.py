# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's description in URDF, from its links."""

from collections.abc import Mapping
from typing import Any

from tactile_push.parameters import config_file


def robot_description(machine: Mapping[str, Any]) -> str:
    """Write the finger's description in URDF.

    Parameters
    ----------
    machine : mapping of str to object
        `FingerArguments.machine`, in SI units.

    Returns
    -------
    str
        The description, an XML document.

    Raises
    ------
    ValueError
        If xacro is not installed, which only whoever shows the finger needs.
    """
    try:
        import xacro
    except ModuleNotFoundError:
        raise ValueError(
            'xacro is not installed: sudo apt install ros-jazzy-xacro, or pip install xacro'
        ) from None

    values = {name: value for name, value in machine.items() if not isinstance(value, list)}
    for joint, name in zip(('proximal', 'distal', 'wrist'), machine['joint_names'], strict=False):
        values[f'{joint}_joint'] = name
    for number, joint in enumerate(('proximal', 'distal')):
        for bound in ('min', 'max', 'speed'):
            values[f'{joint}_{bound}'] = machine[f'joint_{bound}'][number]
    file = config_file('finger.urdf.xacro', 'urdf')
    mappings = {name: str(value) for name, value in values.items()}
    return str(xacro.process_file(str(file), mappings=mappings).documentElement.toxml())
