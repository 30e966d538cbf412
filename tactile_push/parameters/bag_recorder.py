# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `bag_recorder`."""

from dataclasses import dataclass

from tactile_push.bags.writer import COMPRESSIONS
from tactile_push.interface import RECORDED
from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class BagRecorderParameters(NodeParameters):
    """What to record, and how it is stored."""

    # fmt: off
    output: str = parameter('', '',
        'folder of the bag, which must not exist yet; empty for tactile_push_ and the date',
        read_only=True)
    topics: list[str] = parameter(list(RECORDED), '',
        'topics to record as soon as somebody publishes them', read_only=True)
    all: bool = parameter(False, '',
        'record all topics that are not hidden instead', read_only=True)
    compression: str = parameter('zstd', '',
        "compression of the file's chunks", choices=tuple(COMPRESSIONS), read_only=True)
    max_size: int = parameter(0, 'B',
        'start another file once one has this many bytes; 0 for one file',
        0, 10**15, read_only=True)
    max_duration: float = parameter(0.0, 's',
        'start another file once one is this long; 0 for one file', 0.0, 1e9, read_only=True)
    # fmt: on
