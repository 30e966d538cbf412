# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""ROS 2 nodes: parameters, topics, lifecycle and diagnostics around the package's mathematics."""

import os
import signal
import sys
from pathlib import Path
from types import FrameType

from tactile_push.needs_ros import ros_is_missing
from tactile_push.streams import (
    complain,
    ignore_warnings_that_end,
    is_nowhere,
    prepare_streams,
)


def _end_at_once(signum: int, frame: FrameType | None) -> None:
    os._exit(0)


def _name() -> str:
    """Return the name of the node that this process is about to be."""
    modules = (word for word in sys.orig_argv if 'tactile_push.nodes.' in word)
    return Path(next(modules, sys.argv[0])).name.rpartition('.')[2]


def _is_imported_by_a_node() -> bool:
    """Return whether this process is about to be a node, by `python -m` or by its command."""
    program = Path(sys.argv[0])
    return program == Path('-m') or (Path(__file__).parent / f'{program.name}.py').exists()


if _is_imported_by_a_node():
    prepare_streams()
    ignore_warnings_that_end()
    # A node that is interrupted while it still imports has nothing to stop and nothing to say.
    signal.signal(signal.SIGINT, _end_at_once)
    signal.signal(signal.SIGTERM, _end_at_once)
    if {'-h', '--help'} & set(sys.argv[1:]):  # which needs neither ROS nor the compiler
        from tactile_push.parameters.help import node_help

        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # its reader may stop early, such as `head`
        try:
            print(node_help(_name()), flush=True)
        except OSError as error:
            complain(_name(), f'{error.filename}: {error.strerror}')
            os._exit(2)  # or Python would try again
        sys.exit()
    if is_nowhere(_name()) or ros_is_missing(_name()):
        sys.exit(2)
