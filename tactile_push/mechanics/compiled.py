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
"""Compilation of the hot mathematics by numba, cached on disk."""

from contextlib import suppress
from pathlib import Path

import numba

compiled = numba.njit(cache=True)
"""Decorator: compile at the first call, and keep the machine code beside the source."""


def _forget_outdated(folder: Path) -> None:
    """Remove cached code that is older than any source.

    numba looks at the file of the function itself only, but the code holds the functions that it
    calls as well.
    """
    newest = max(source.stat().st_mtime for source in folder.glob('*.py'))
    for index in folder.glob('__pycache__/*.nbi'):
        with suppress(FileNotFoundError):  # another process was faster
            if index.stat().st_mtime < newest:
                index.unlink()


with suppress(OSError):  # a folder of somebody else's, whose cache numba keeps elsewhere
    _forget_outdated(Path(__file__).parent)
