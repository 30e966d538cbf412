# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest


@pytest.fixture
def bench():
    """Return what makes a node in this process and talks with it."""
    from support.node_bench import NodeBench  # needs rclpy, so that its lack skips one file a time

    bench = NodeBench()
    yield bench
    bench.close()
