# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Names that are no parameter of a node: a slip, or meant for another one."""

import difflib
from collections.abc import Collection

from tactile_push.parameters import PARAMETERS
from tactile_push.parameters.ros_file import EACH_NODE_HAS, QOS_OVERRIDES

LIKENESS = 0.5  # of a name and the one that was meant; picked


def meant(name: str, declared: Collection[str]) -> str:
    """Return the parameter that a name looks like a slip of.

    Parameters
    ----------
    name : str
        The name that a node was given.
    declared : collection of str
        Names of the node's parameters.

    Returns
    -------
    str
        The name that was meant, perhaps of another node. It is empty if none of this node is
        similar, and for a parameter of another node, which a section for all nodes may have.
    """
    others = {known.name for kind in PARAMETERS.values() for known in kind.declared()}
    known = {*declared, *others, *EACH_NODE_HAS}
    if name in known or name.startswith(QOS_OVERRIDES):
        return ''
    if not difflib.get_close_matches(name, declared, 1, LIKENESS):
        return ''
    return difflib.get_close_matches(name, sorted(known), 1, LIKENESS)[0]
