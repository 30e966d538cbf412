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
"""Commands that go on as one of the package's nodes."""

import os
import sys
from collections.abc import Mapping
from typing import NoReturn


def become(node: str, parameters: Mapping[str, object]) -> NoReturn:
    """Let this process go on as a node, which then gets the signals and gives the exit status.

    Parameters
    ----------
    node : str
        One of the package's nodes.
    parameters : mapping of str to object
        Values of its parameters.
    """
    from tactile_push.processes import yaml_value

    words = [f'{name}:={yaml_value(value)}' for name, value in parameters.items()]
    arguments = [word for pair in zip(['-p'] * len(words), words, strict=True) for word in pair]
    sys.stdout.flush()
    command = [sys.executable, '-m', f'tactile_push.nodes.{node}', '--ros-args', *arguments]
    os.execv(sys.executable, command)
