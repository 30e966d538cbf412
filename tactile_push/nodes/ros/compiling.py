# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says that a node compiles its mathematics, which holds up its first start."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from rclpy.node import Node

from tactile_push.mechanics.compiled import compilation_announced
from tactile_push.nodes.ros.diagnostics import PERIOD, WARN, Diagnostics, Health


@contextmanager
def compiling(node: Node, diagnostics: Diagnostics) -> Iterator[None]:
    """Log a line and warn on /diagnostics while a block compiles; say nothing if it need not.

    A thread warns, because a node that is still being made has no executor yet.
    """
    done = threading.Event()

    def warn() -> None:
        while True:
            diagnostics.announce(Health(WARN, 'compiling'))
            if done.wait(PERIOD):
                return

    warner = threading.Thread(target=warn, name='compiling', daemon=True)

    def announce() -> None:
        node.get_logger().info('compiling; this start takes longer than later ones')
        warner.start()

    try:
        with compilation_announced(announce):
            yield
    finally:
        done.set()
        if warner.is_alive():
            warner.join()
