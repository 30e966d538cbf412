# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Message definitions as a bag stores them: MCAP's `ros2msg` schema encoding.

A definition is the text of the .msg file, followed by the texts of the messages that it
consists of, each after a separator line, in the order in which rosbag2 writes them.
"""

import os
import re
import sys
from pathlib import Path

_SEPARATOR = '=' * 80

_TYPE_NAME = re.compile(r'([A-Za-z0-9_]+)/(?:msg/)?([A-Za-z0-9_]+)')

# The type at the beginning of a line of a .msg file. Comments and bounded strings do not match:
# they name no message.
_FIELD_TYPE = re.compile(r'^[ \t]*([A-Za-z0-9_/]+)(?:\[[^\]]*\])?\s', re.MULTILINE)

_PRIMITIVES = {'bool', 'byte', 'char', 'float32', 'float64', 'string', 'wstring'} | {
    f'{kind}{bits}' for kind in ('int', 'uint') for bits in (8, 16, 32, 64)
}


def schema_text(type_name: str) -> str:
    """Return the definition of a message type with those of all its parts.

    Parameters
    ----------
    type_name : str
        For example ``'sensor_msgs/msg/JointState'``.

    Returns
    -------
    str
        Content of an MCAP schema record whose encoding is ``ros2msg``.

    Raises
    ------
    LookupError
        If no .msg file defines the type or one of its parts.
    """
    return _with_parts(type_name, set())


def full_type_name(type_name: str) -> str:
    """Return a type's name with the ``msg`` that some writers leave out; other names as they are.

    ``'sensor_msgs/JointState'`` is ``'sensor_msgs/msg/JointState'``.
    """
    match = _TYPE_NAME.fullmatch(type_name)
    return type_name if match is None else f'{match[1]}/msg/{match[2]}'


def _with_parts(type_name: str, seen: set[str]) -> str:
    """Return the definition of a type and of those parts that are not in `seen` yet."""
    package, text = _read_definition(type_name)
    parts = {
        name if '/' in name else f'{package}/{name}'
        for name in _FIELD_TYPE.findall(text)
        if name not in _PRIMITIVES
    }
    for part in sorted(parts):
        if part not in seen:
            seen.add(part)
            text += f'\n{_SEPARATOR}\nMSG: {part}\n' + _with_parts(part, seen)
    return text


def _read_definition(type_name: str) -> tuple[str, str]:
    """Return the package of a type and the text of its .msg file."""
    match = _TYPE_NAME.fullmatch(type_name)
    if match is None:
        raise LookupError(f"expected a message type package/msg/Type, got '{type_name}'")
    package, name = match.groups()
    # Packages from PyPI lie in the Python environment, where no ament prefix points.
    ament_prefixes = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    prefixes = [prefix for prefix in (*ament_prefixes, sys.prefix) if prefix]
    for prefix in prefixes:
        path = Path(prefix, 'share', package, 'msg', f'{name}.msg')
        if path.is_file():
            return package, path.read_bytes().decode()
    raise LookupError(
        f'no definition of {type_name}: no share/{package}/msg/{name}.msg in {", ".join(prefixes)}'
    )
