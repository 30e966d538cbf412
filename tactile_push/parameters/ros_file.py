# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files as `--params-file` takes them, read without ROS.

`rcl` does not read YAML documents but goes through their events, and each of its rules decides what
a file means: what is a number, what is a node's name, which of two values counts. These are the
rules of rcl_yaml_param_parser 9.2 (ROS 2 Jazzy), with its odd ones, so that a file which a node
takes, or refuses, is one that commands without nodes take, or refuse, too.
"""

import re
from pathlib import Path
from typing import Any

import yaml

from tactile_push.parameters.ros_scalar import scalar
from tactile_push.small_files import read_small_file

PARAMS_KEY = 'ros__parameters'
EACH_NODE_HAS = ('use_sim_time', 'start_type_description_service')
QOS_OVERRIDES = 'qos_overrides.'  # parameters that rclpy declares where a node allows them
MOST_LETTERS = 255  # of a node's name, for rmw
# rcl keeps a value of each kind, and rclpy takes the first of these that there is.
KINDS = (bool, int, float, str)
_TOKEN = re.compile('[A-Za-z_][A-Za-z0-9_]*', re.ASCII)
_LOADER: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)  # libyaml, which rcl uses

Sections = dict[str, dict[str, Any]]
"""Values by the nodes that they are for and by name."""


def read_sections(file: Path) -> Sections:
    """Read a parameter file.

    Parameters
    ----------
    file : Path
        The file.

    Returns
    -------
    dict of str to dict of str to object
        Values by section and name, in the order of the file: of two sections for the same node the
        later one counts. `matches` says which nodes a section is for.

    Raises
    ------
    ValueError
        If `rcl` would refuse the file; the message is one line with the file and the line in it.
    OSError
        If it cannot be read.
    """
    reader, line = _Reader(), 0
    try:
        for event in yaml.parse(read_small_file(file), Loader=_LOADER):
            line = event.start_mark.line + 1
            reader.take(event)
    except yaml.YAMLError as error:
        raise ValueError(f'{file}: no YAML: {" ".join(str(error).split())}') from None
    except ValueError as error:
        raise ValueError(f'{file}: line {line}: {error}') from None
    return {node: _values(entries) for node, entries in reader.nodes.items()}


def matches(section: str, node: str) -> bool:
    """Return whether a section is for a node: `*` stands for one name, `**` for any number.

    Parameters
    ----------
    section, node : str
        Name of the section, such as ``'/**/push_controller'``, and full name of the node.
    """
    expression = '/' + section.removeprefix('/')
    return re.fullmatch(expression.replace('/*', r'(/\w+)'), node, re.ASCII) is not None


class _Entry:
    """A parameter as it is read: the last value of each kind, and of each kind of list."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.scalars: dict[type, Any] = {}
        self.lists: dict[type, list[Any]] = {}

    @property
    def value(self) -> Any:
        """The value that counts; an empty list if there is none, for rcl does not keep that."""
        for found in (self.scalars, self.lists):
            for kind in KINDS:
                if kind in found:
                    return found[kind]
        return []


def _values(entries: list[_Entry]) -> dict[str, Any]:
    return {entry.name: entry.value for entry in entries}


class _Names:
    """Names that a key stands below."""

    def __init__(self, separator: str) -> None:
        self.text = ''
        self.count = 0
        self._separator = separator

    def add(self, name: str) -> None:
        if self.count and not self.text.endswith(self._separator):
            self.text += self._separator
        self.text = self.text + name if self.count else name
        self.count += 1

    def drop(self) -> None:
        """Take the last name away, or its last part if it has parts."""
        self.text = self.text.rpartition(self._separator)[0] if self.count > 1 else ''
        self.count = max(self.count - 1, 0)


class _Reader:
    """Goes through a file's events. `nodes` has the parameters by the section's name."""

    def __init__(self) -> None:
        self.nodes: dict[str, list[_Entry]] = {}
        self._node: list[_Entry] = []
        self._at = 0  # the parameter whose value comes next
        self._above_nodes, self._above_parameters = _Names('/'), _Names('.')
        self._depth = 0
        self._in_parameters = self._in_list = self._new_mapping = False
        self._wants_key = True
        self._kind: type | None = None  # of the list

    def take(self, event: Any) -> None:
        """Take an event; ValueError if nothing can follow from it."""
        if isinstance(event, yaml.AliasEvent):
            raise ValueError('expected no alias (*name)')
        if isinstance(event, yaml.ScalarEvent):
            (self._key if self._wants_key else self._value)(event)
        elif isinstance(event, yaml.SequenceStartEvent):
            if self._wants_key or not self._in_parameters:
                raise ValueError(f'expected a list below {PARAMS_KEY} only, as a value')
            self._in_list, self._kind = True, None
        elif isinstance(event, yaml.SequenceEndEvent):
            self._in_list, self._wants_key = False, True
        elif isinstance(event, yaml.MappingStartEvent):
            self._depth += 1
            at_parameters = self._in_parameters and self._depth == self._above_nodes.count + 3
            self._new_mapping, self._wants_key = not at_parameters, True
        elif isinstance(event, yaml.MappingEndEvent):
            self._end_mapping()

    def _end_mapping(self) -> None:
        if self._in_parameters and self._above_parameters.count:
            self._above_parameters.drop()
        elif self._in_parameters:
            self._in_parameters = False
        elif self._depth == self._above_nodes.count + 1:
            self._above_nodes.drop()
        self._depth -= 1

    def _key(self, event: Any) -> None:
        name: str = event.value
        if not name:
            raise ValueError('expected a key')
        if self._in_parameters:
            self._parameter(name)
        elif name.startswith(PARAMS_KEY):
            self._section()
        else:
            self._above_nodes.add(name)
        self._wants_key = False

    def _section(self) -> None:
        """Begin with the parameters of a node, whose name was the last key."""
        if not self._above_nodes.count:
            raise ValueError(f'expected the name of a node above {PARAMS_KEY}')
        name = self._above_nodes.text
        if not _is_name(name):
            raise ValueError(f'expected the name of a node, got {name!r}')
        self._node = self.nodes.setdefault(name, [])
        self._above_nodes.drop()
        self._in_parameters = True

    def _parameter(self, name: str) -> None:
        above = self._above_parameters
        if self._new_mapping:  # the key before was the name above these
            if self._at >= len(self._node):
                raise ValueError(f'expected a parameter, got {name!r}')
            above.text, above.count = self._node[self._at].name, above.count + 1
            self._new_mapping = False
        self._at = self._find(above.text if above.count else name)
        if above.count:
            self._node[self._at].name = f'{above.text}.{name}'

    def _find(self, name: str) -> int:
        """Return the place of a parameter in its node, where it is added if need be."""
        for at, entry in enumerate(self._node):
            if entry.name == name:
                return at
        self._node.append(_Entry(name))
        return len(self._node) - 1

    def _value(self, event: Any) -> None:
        if not self._in_parameters or self._at >= len(self._node):
            raise ValueError(f'expected {PARAMS_KEY} above a value')
        value = scalar(event)
        entry, kind = self._node[self._at], type(value)
        if not self._in_list:
            entry.scalars[kind] = value
            self._wants_key = True
        elif self._kind is None:
            entry.lists[kind] = [value]
            self._kind = kind
        elif self._kind is kind:
            entry.lists[kind].append(value)
        else:
            before = entry.lists[self._kind][-1]
            raise ValueError(f'expected one type in a list, got {value!r} after {before!r}')


def _is_name(name: str) -> bool:
    """Return whether a section may have the name: names and wildcards between slashes."""
    *above, last = ('/' + name.removeprefix('/')).split('/')[1:]
    wild = ('*', '**')
    fits = all(part in wild or _TOKEN.fullmatch(part) for part in above)
    return fits and (
        last in wild or (_TOKEN.fullmatch(last) is not None and len(last) <= MOST_LETTERS)
    )
