# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameter files of a machine and an object, and what they say for a launch file."""

from pathlib import Path
from typing import Any

from tactile_push.launching.arguments import MACHINE, OBJECTS, FingerArguments
from tactile_push.parameters import PARAMETERS, config_file
from tactile_push.parameters.ros_file import Sections, read_sections

LAUNCH_SECTION = 'finger_launch'  # of the machine's file, for the launch file and no node


def object_file(p: FingerArguments) -> Path:
    """Return the parameter file of the object."""
    if p.object in OBJECTS:
        return config_file(f'{p.object}.yaml')
    if not p.object.endswith(('.yaml', '.yml')):
        kinds = ', '.join(OBJECTS)
        raise ValueError(f'argument object: expected {kinds} or a YAML file, got {p.object!r}')
    return Path(p.object)


def launch_values(hardware: Sections, file: Path) -> dict[str, Any]:
    """Return what the machine's file says for the launch file itself."""
    values: dict[str, Any] = {}
    for section, entries in hardware.items():
        if own_name(section) == LAUNCH_SECTION:
            values |= entries
    known = {one.name: one for one in FingerArguments.declared() if one.name != 'config'}
    for name, value in values.items():
        try:
            if name not in known:
                raise ValueError(f'parameter {name}: expected one of {", ".join(known)}')
            known[name].check(value)
        except ValueError as error:
            raise ValueError(f'{file}: {LAUNCH_SECTION}: {error}') from None
    return values


def read_file(file: Path) -> Sections:
    """Read a parameter file; ValueError if a node would not find there what is meant for it."""
    try:
        sections = read_sections(file)
    except OSError as error:
        raise ValueError(f'{file}: {error.strerror}') from None
    for section, entries in sections.items():
        name = own_name(section)
        if name == LAUNCH_SECTION:
            continue
        if name not in (*PARAMETERS, '*', '**'):
            raise ValueError(f'{file}: {section}: expected {LAUNCH_SECTION} or a node')
        for fact in MACHINE:
            if fact in entries:
                raise ValueError(
                    f'{file}: {section}: {fact}: expected below {LAUNCH_SECTION} in the file of '
                    'the machine, from where all nodes get it'
                )
    return sections


def own_name(section: str) -> str:
    """Return the node's name in a section's, without its namespace."""
    return section.rpartition('/')[2]
