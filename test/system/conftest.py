# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Real nodes as processes, and an observer in the test's own process."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from support.live import Observer, Rig
from tactile_push.testing.processes import NodeProcesses


@pytest.fixture
def nodes(tmp_path: Path) -> Iterator[NodeProcesses]:
    with NodeProcesses(tmp_path) as processes:
        yield processes
    for name in processes.running:
        assert 'Traceback' not in processes.log(name).read_text(), name


@pytest.fixture
def observer(nodes: NodeProcesses) -> Iterator[Observer]:
    watcher = Observer(nodes.domain)
    yield watcher
    watcher.close()


@pytest.fixture
def rig(nodes: NodeProcesses, observer: Observer, tmp_path: Path) -> Rig:
    return Rig(nodes, observer, str(tmp_path / 'sensor'))
