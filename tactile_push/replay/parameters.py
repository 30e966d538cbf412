# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of a replay: those of the recorded nodes, and those that somebody wants instead."""

import difflib
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Set
from pathlib import Path
from typing import Any

import yaml

from tactile_push.parameters import (
    ActiveSensingParameters,
    ContactGeometryParameters,
    PushControllerParameters,
)

NODES = {
    'contact_geometry': ContactGeometryParameters.declared(),
    'push_controller': PushControllerParameters.declared(),
    'active_sensing': ActiveSensingParameters.declared(),
}
NOTE = 'tactile_push.parameters'  # of a bag
# What other nodes of the finger know too, where active_sensing was not recorded.
KNOWN_TO = {'belt_speed': 'push_controller', 'finger_radius': 'contact_geometry'}
# Of what the node's recorded state tells what came of it: when it ticked, where the finger was.
TOLD = {
    'contact_geometry': {'joint_names'},
    'push_controller': {
        'control_rate',
        'joint_names',
        'proximal_length',
        'distal_length',
        'mount_angle',
    },
}
OF_EVERY_NODE = ('use_sim_time',)  # the bag's time is the only one here
OF_OUTLINE = ('disk_radius', 'edge')  # what another outline replaces, too

ByNode = dict[str, dict[str, Any]]  # values by node and name


def recorded_parameters(notes: Mapping[str, str], namespace: str) -> ByNode:
    """Give the parameters of a finger's nodes as the bag has them.

    Parameters
    ----------
    notes : mapping of str to str
        The bag's notes.
    namespace : str
        Namespace with a slash at either end.

    Returns
    -------
    dict
        The values by node and name; none of a node that was not there.
    """
    everything = json.loads(notes.get(NOTE, '{}'))
    return {node: everything.get(f'{namespace}{node}'.lstrip('/'), {}) for node in NODES}


def read_config(file: Path | None, namespace: str) -> ByNode:
    """Read the parameters of a finger's nodes from a ROS parameter file.

    Parameters
    ----------
    file : path or None
        The file, as `--params-file` takes it, if there is one.
    namespace : str
        Namespace with a slash at either end.

    Returns
    -------
    dict
        The values by node and name.

    Raises
    ------
    ValueError
        If it is no such file, or has a name that looks like a slip.
    OSError
        If it cannot be read.
    """
    values: ByNode = {node: {} for node in NODES}
    for pattern, section in _sections(file):
        for node in NODES:
            if _matches(pattern, f'{namespace}{node}'):
                given = section.get('ros__parameters') if isinstance(section, dict) else None
                if not isinstance(given, dict):
                    raise ValueError(f'{file}: {pattern}: expected ros__parameters: with values')
                values[node].update(given)
    known = [parameter.name for parameters in NODES.values() for parameter in parameters]
    known += OF_EVERY_NODE
    for name in {name for given in values.values() for name in given} - set(known):
        similar = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
        if similar:
            raise ValueError(f'{file}: {name}: unknown, did you mean {similar[0]}?')
    return values


def check_config(
    file: Path | None, namespaces: Iterable[str], nodes: Iterable[str] = tuple(NODES)
) -> None:
    """Refuse a ROS parameter file that has no parameter of any node.

    Parameters
    ----------
    file : path or None
        The file, if there is one.
    namespaces : iterable of str
        Namespaces with a slash at either end.
    nodes : iterable of str, optional
        The nodes whose parameters are used, without the namespace.

    Raises
    ------
    ValueError
        If it has no parameter of one of the nodes.
    OSError
        If it cannot be read.
    """
    if file is None:
        return
    looked_for = []
    for namespace in namespaces:
        values = read_config(file, namespace)
        for node in nodes:
            if any(parameter.name in values[node] for parameter in NODES[node]):
                return
            looked_for.append(f'{namespace}{node}')
    names = ' or '.join(looked_for)
    raise ValueError(f'{file}: no parameter of a node of the bag, expected some of {names}')


def without_effect(given: ByNode, wanted: ByNode, recorded: Set[str]) -> list[str]:
    """Name parameters that somebody wants otherwise, but that the bag decides.

    Parameters
    ----------
    given : dict
        The recorded values by node and name.
    wanted : dict
        Those that somebody wants instead.
    recorded : set of str
        The finger's topics in the bag, without the namespace.

    Returns
    -------
    list of str
        Such as ``'push_controller: control_rate'``.
    """
    return [
        f'{node}: {parameter.name}'
        for node in TOLD
        if f'{node}/state' in recorded
        for parameter in NODES[node]
        if parameter.name in TOLD[node]
        and parameter.name in wanted[node]
        and wanted[node][parameter.name] != given[node].get(parameter.name, parameter.default)
    ]


def sensing_parameters(given: ByNode, wanted: ByNode) -> dict[str, Any]:
    """Give the parameters with which the object is sensed.

    Parameters
    ----------
    given : dict
        The recorded values by node and name.
    wanted : dict
        Those that somebody wants instead.

    Returns
    -------
    dict
        The values by name; those of the rig as its other nodes had them, if nobody says otherwise,
        and none that go with another outline than the wanted one.
    """
    wanted_now, recorded = wanted['active_sensing'], dict(given['active_sensing'])
    if 'vertices' in wanted_now:
        for name in OF_OUTLINE:
            recorded.pop(name, None)
    of_others = {name: given[node][name] for name, node in KNOWN_TO.items() if name in given[node]}
    return of_others | recorded | wanted_now


def names_node(file: Path | None, namespace: str, node: str) -> bool:
    """Tell whether a ROS parameter file has a section for a node by its name, not for all nodes.

    Parameters
    ----------
    file : path or None
        The file, if there is one.
    namespace : str
        Namespace with a slash at either end.
    node : str
        The node, without the namespace.

    Returns
    -------
    bool
        Whether it has.

    Raises
    ------
    ValueError
        If it is no such file.
    OSError
        If it cannot be read.
    """
    return any(
        pattern.endswith(node) and _matches(pattern, f'{namespace}{node}')
        for pattern, _ in _sections(file)
    )


def changed_parameters(event: Any) -> tuple[str, dict[str, Any]]:
    """Read a message of /parameter_events.

    Parameters
    ----------
    event : rcl_interfaces/ParameterEvent
        The message.

    Returns
    -------
    node : str
        Full name of the node.
    values : dict of str to object
        Its changed values by name.
    """
    fields = (
        '',
        'bool_value',
        'integer_value',
        'double_value',
        'string_value',
        'byte_array_value',
        'bool_array_value',
        'integer_array_value',
        'double_array_value',
        'string_array_value',
    )
    return event.node, {
        changed.name: getattr(changed.value, fields[changed.value.type])
        for changed in event.changed_parameters
        if 0 < changed.value.type < len(fields)
    }


def _sections(file: Path | None) -> Iterator[tuple[str, Any]]:
    """Give the sections of a parameter file, each with the nodes that it is for."""
    if file is None:
        return
    try:
        document = yaml.safe_load(file.read_text())
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ValueError(f'{file}: no YAML: {" ".join(str(error).split())}') from None
    for pattern, section in document.items() if isinstance(document, dict) else ():
        yield str(pattern), section


def _matches(pattern: str, node: str) -> bool:
    """Tell whether a section is for a node: `**` stands for any names, `*` for one."""
    pattern = '/' + pattern.lstrip('/')
    expression = re.escape(pattern).replace(r'\*\*', '.*').replace(r'\*', '[^/]*')
    return re.fullmatch(expression.replace('/.*/', '/(.*/)?'), node) is not None
