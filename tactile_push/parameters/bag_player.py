# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `bag_player`."""

from dataclasses import dataclass

from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class BagPlayerParameters(NodeParameters):
    """Which part of which bag to play, and how fast."""

    # fmt: off
    bag: str = parameter('', '', 'folder of the bag, or an .mcap file', read_only=True)
    rate: float = parameter(1.0, 's/s',
        "how fast the bag's time passes", 0.001, 1000.0, read_only=True)
    start: float = parameter(0.0, 's',
        'where to begin, from the beginning of the bag', 0.0, 1e9, read_only=True)
    duration: float = parameter(0.0, 's',
        'how much to play from there; 0 plays to the end', 0.0, 1e9, read_only=True)
    loop: bool = parameter(False, '', 'start over at the end, for ever', read_only=True)
    clock: float = parameter(0.0, 'Hz',
        "how often to publish /clock by the bag's time, besides before each message; 0 for not at "
        "all", 0.0, 10000.0, read_only=True)
    topics: list[str] = parameter([], '', 'topics to play; all if none is named', read_only=True)
    remap: list[str] = parameter([], '', 'new names of topics, each as OLD:=NEW', read_only=True)
    start_paused: bool = parameter(False, '', 'wait for ~/pause or ~/step', read_only=True)
    # fmt: on
