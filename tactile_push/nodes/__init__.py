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
"""ROS 2 nodes: parameters, topics, lifecycle and diagnostics around the package's mathematics."""

import os
import signal
import sys
from pathlib import Path
from types import FrameType


def _end_at_once(signum: int, frame: FrameType | None) -> None:
    os._exit(0)


def _is_imported_by_a_node() -> bool:
    """Tell whether this process is about to be a node, by `python -m` or by its command."""
    program = Path(sys.argv[0])
    return program == Path('-m') or (Path(__file__).parent / f'{program.name}.py').exists()


if _is_imported_by_a_node():
    # A node that is interrupted while it still imports has nothing to stop and nothing to say.
    signal.signal(signal.SIGINT, _end_at_once)
    signal.signal(signal.SIGTERM, _end_at_once)
