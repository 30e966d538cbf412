# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `live_page`."""

from dataclasses import dataclass

from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class LivePageParameters(NodeParameters):
    """Where the page is, and how much it shows."""

    # fmt: off
    host: str = parameter('127.0.0.1', '',
        'address of this machine to listen on; 127.0.0.1 is for browsers on this machine alone, '
        '0.0.0.0 for everybody who can reach it', read_only=True)
    port: int = parameter(8765, '', 'port to listen on; 0 for any that is free',
        0, 65535, read_only=True)
    history: float = parameter(60.0, 's', 'how far back the page shows', 1.0, 600.0, read_only=True)
    # fmt: on
