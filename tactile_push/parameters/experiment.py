# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `experiment`."""

from dataclasses import dataclass

from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class ExperimentParameters(NodeParameters):
    """What to record and for how long."""

    # fmt: off
    bag: str = parameter('', '', 'folder of the bag, which must not exist yet', read_only=True)
    steps: int = parameter(600, '', 'control periods to run', 1, 1000000000, read_only=True)
    # fmt: on
