# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of a replay: those of the recorded nodes, and those that somebody wants instead."""

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tactile_push.bags import BagReader
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTACT_GEOMETRY,
    PUSH_CONTROLLER,
    node_in,
)
from tactile_push.parameters import PARAMETERS
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.parameters.ros_file import matches, read_sections
from tactile_push.parameters.slips import meant

REPLAYED = (CONTACT_GEOMETRY, PUSH_CONTROLLER, ACTIVE_SENSING)
NODES = {node: PARAMETERS[node].declared() for node in REPLAYED}
# Parameters of active_sensing that other nodes of the finger have, too.
KNOWN_TO = {'belt_speed': PUSH_CONTROLLER, 'finger_radius': CONTACT_GEOMETRY}
LINKS = ('proximal_length', 'distal_length', 'mount_angle')
# Parameters whose effect is in the node's recorded state: when it ticked, where the finger was.
RECORDED_EFFECT = {
    CONTACT_GEOMETRY: {'joint_names', 'use_joint_states'},
    PUSH_CONTROLLER: {
        *('law', 'control_rate', 'joint_names', 'use_joint_states', *LINKS),
        *('steadying_max', 'edge_distance', 'finger_radius'),
    },
}
OF_OUTLINE = ('disk_radius', 'edge')  # go with the outline, so another outline replaces them

ByNode = dict[str, dict[str, Any]]
"""Values by node and name."""


class ParameterFile:
    """A ROS parameter file, as `--params-file` takes it; None stands for one without values.

    Raises ValueError if it is no such file, and OSError if it cannot be read.
    """

    def __init__(self, file: Path | None) -> None:
        self.file = file
        self._sections = {} if file is None else read_sections(file)

    def values(self, namespace: str) -> ByNode:
        """Return the parameters of a finger's nodes by node and name.

        Raises ValueError if a name looks like a slip.
        """
        values: ByNode = {node: {} for node in NODES}
        for node, declared in NODES.items():
            for section, given in self._sections.items():
                if matches(section, f'{namespace}/{node}'):
                    values[node].update(given)
            for name in values[node]:
                if similar := meant(name, {parameter.name for parameter in declared}):
                    raise ValueError(f'{self.file}: {name}: unknown, did you mean {similar}?')
        return values

    def check(self, namespaces: Iterable[str], nodes: Iterable[str] = REPLAYED) -> None:
        """Raise ValueError if there is a file and none of the nodes has a parameter in it."""
        looked_for = []
        for namespace in namespaces if self.file is not None else ():
            values = self.values(namespace)
            for node in nodes:
                if any(parameter.name in values[node] for parameter in NODES[node]):
                    return
                looked_for.append(f'{namespace}/{node}')
        if looked_for:
            names = ' or '.join(looked_for)
            raise ValueError(
                f'{self.file}: no parameter of a node of the bag, expected some of {names}'
            )

    def names(self, namespace: str, node: str) -> bool:
        """Return whether a section is for the node by its name, not for all nodes."""
        return any(
            section.endswith(node) and matches(section, f'{namespace}/{node}')
            for section in self._sections
        )


class FingerParameters(NamedTuple):
    """Parameters of a finger's nodes.

    `recorded` are the values in the bag by node and name. `wanted` are those that somebody wants
    instead; they do not follow the bag. `senses` says whether `active_sensing` was recorded or
    somebody asks for it by its name.
    """

    recorded: ByNode
    wanted: ByNode
    senses: bool

    @classmethod
    def of(
        cls,
        everything: Mapping[str, Mapping[str, Any]],
        namespace: str,
        file: ParameterFile,
        wanted: Mapping[str, Mapping[str, Any]],
    ) -> 'FingerParameters':
        """Collect what a bag recorded, a file, and values by node that come before both."""
        recorded = {node: dict(everything.get(node_in(namespace, node), {})) for node in NODES}
        in_file = file.values(namespace)
        senses = bool(recorded[ACTIVE_SENSING]) or file.names(namespace, ACTIVE_SENSING)
        return cls(recorded, {n: in_file[n] | dict(wanted.get(n, {})) for n in NODES}, senses)

    @property
    def used(self) -> ByNode:
        """Values that are not the default."""
        return {node: self.recorded[node] | self.wanted[node] for node in NODES}

    @property
    def sensing(self) -> dict[str, Any]:
        """Values for `active_sensing`.

        What it shares with other nodes is as they had it, if nobody says otherwise. Values that go
        with another outline than the wanted one are left out.
        """
        wanted, recorded = self.wanted[ACTIVE_SENSING], dict(self.recorded[ACTIVE_SENSING])
        if 'vertices' in wanted:
            for name in OF_OUTLINE:
                recorded.pop(name, None)
        of_others = {
            name: self.recorded[node][name]
            for name, node in KNOWN_TO.items()
            if name in self.recorded[node]
        }
        return of_others | recorded | wanted

    def without_effect(self, topics: Collection[str]) -> list[str]:
        """Return the parameters that somebody wants otherwise, but that the bag decides.

        They are told as ``'push_controller: control_rate'``.
        """
        return [
            f'{node}: {known.name}'
            for node, decided in RECORDED_EFFECT.items()
            if f'{node}/state' in topics
            for known in NODES[node]
            if known.name in decided and known.name in self.wanted[node]
            if self.wanted[node][known.name] != self.recorded[node].get(known.name, known.default)
        ]


def parameters_in(bag: BagReader) -> dict[str, dict[str, Any]]:
    """Return the parameters that a bag recorded, by node; what is left out is warned of."""
    found, left_out = recorded_parameters(bag.notes)
    for line in left_out:
        bag.warn(f'{bag.path}: {line}')
    return found or {}


def changed_parameters(event: Any) -> tuple[str, dict[str, Any]]:
    """Return the node and the changed values by name of a message of /parameter_events."""
    arrays = ('byte_array', 'bool_array', 'integer_array', 'double_array', 'string_array')
    kinds = ('bool', 'integer', 'double', 'string', *arrays)
    fields = ('', *(f'{kind}_value' for kind in kinds))  # by the number of the type
    return event.node, {
        changed.name: getattr(changed.value, fields[changed.value.type])
        for changed in event.changed_parameters
        if 0 < changed.value.type < len(fields)
    }
