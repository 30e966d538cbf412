# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of nodes that a bag has in its notes."""

import json
from collections.abc import Mapping
from typing import Any

from tactile_push.interface import PARAMETERS_NOTE, PLANTS
from tactile_push.parameters import PARAMETERS

MOST_WORDS = 200  # of a line about a value that may be of any length [characters]


def recorded_parameters(
    notes: Mapping[str, str],
) -> tuple[dict[str, dict[str, Any]] | None, list[str]]:
    """Return the parameters in the notes of a bag, and a line for each thing that is left out.

    The parameters are values by node, its full name without the leading slash; None if there are
    none. Values that the package's nodes refuse are left out. If a plant refuses one, all of its
    values are left out: with a default among them they would tell of another object.
    """
    text = notes.get(PARAMETERS_NOTE)
    if text is None:
        return None, []
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        content = None
    if not isinstance(content, dict):
        return None, ['the recorded parameters are left out: expected JSON, node to values']
    return usable_parameters(content)


def usable_parameters(content: Mapping[str, Any]) -> tuple[dict[str, dict[str, Any]], list[str]]:
    """Return parameters by node without those of no use, and a line for each that is left out."""
    found: dict[str, dict[str, Any]] = {}
    left_out = []
    for name, values in content.items():
        node = name.removeprefix('/')
        if not isinstance(values, dict):
            left_out.append(_short(f'expected values by name, got {values!r}', node))
            continue
        found[node] = dict(values)
        own = node.rpartition('/')[2]
        kind = PARAMETERS.get(own)
        for known in kind.declared() if kind else ():
            try:
                known.check(values.get(known.name, known.default))
            except ValueError as error:
                left_out.append(_short(str(error), node))
                del found[node][known.name]
        if own in PLANTS and len(found[node]) < len(values):
            del found[node]
    return found, left_out


def _short(what: str, node: str) -> str:
    words = f'recorded parameters of /{node}: left out: {what}'
    return words if len(words) <= MOST_WORDS else f'{words[:MOST_WORDS]}…'
