# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The fixtures for pytest, which finds this module by its entry point.

The entry point has the module's own name, so whoever loads the plugin by name as well, with
``-p tactile_push.testing.plugin``, loads the same one.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tactile_push.testing import NodeProcesses, Observer, Rig


@pytest.fixture
def tactile_nodes(tmp_path: Path) -> Iterator[NodeProcesses]:
    """Start nodes as processes, in a ROS domain of the test's own on this machine.

    They end with the test. Their output is in `tmp_path`; a traceback in it fails the test.
    """
    pytest.importorskip('rclpy', reason='rclpy is not installed: no ROS nodes here')
    from tactile_push.testing.processes import NodeProcesses

    with NodeProcesses(tmp_path) as processes:
        yield processes
    for name in processes.running:
        assert 'Traceback' not in processes.log(name).read_text(), f'see {processes.log(name)}'


@pytest.fixture
def tactile_observer(tactile_nodes: NodeProcesses) -> Iterator[Observer]:
    """Hear topics, call services and wait for conditions in the domain of `tactile_nodes`."""
    from tactile_push.testing.observer import Observer

    with Observer(tactile_nodes.domain) as observer:
        yield observer


@pytest.fixture
def tactile_rig(tactile_nodes: NodeProcesses, tactile_observer: Observer, tmp_path: Path) -> Rig:
    """Simulate belt, object, finger and sensor: `start()` starts the plant and its nodes."""
    from tactile_push.testing.rig import Rig

    return Rig(tactile_nodes, tactile_observer, str(tmp_path / 'sensor'))
