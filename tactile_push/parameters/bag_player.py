# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `bag_player`."""

from dataclasses import dataclass

from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class BagPlayerParameters(NodeParameters):
    """Which part of which bag to play, and how fast."""

    # fmt: off
    bag: str = parameter('', '', 'folder of a bag, or one of its files', read_only=True)
    rate: float = parameter(1.0, 's/s',
        "how fast the bag's time passes", 0.001, 1000.0, read_only=True)
    start: float = parameter(0.0, 's',
        'begin so long after the start of the bag', 0.0, 1e9, read_only=True)
    duration: float = parameter(0.0, 's',
        'play for so long; 0 plays to the end', 0.0, 1e9, read_only=True)
    loop: bool = parameter(False, '', 'start over at the end, for ever', read_only=True)
    clock: float = parameter(0.0, 'Hz',
        "publish /clock with the bag's time so often, and before each message; 0 publishes none",
        0.0, 10000.0, read_only=True)
    topics: list[str] = parameter([], '', 'topics to play; all if none is named', read_only=True)
    remap: list[str] = parameter([], '', 'new names of topics, each as OLD:=NEW', read_only=True)
    start_paused: bool = parameter(False, '', 'begin paused, see ~/pause', read_only=True)
    # fmt: on
