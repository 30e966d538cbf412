# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Real nodes as processes, and an observer in the test's own process."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from live import Observer, Rig

from tactile_push.processes import NodeProcesses


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
