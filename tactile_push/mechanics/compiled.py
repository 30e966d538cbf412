# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Compilation of the hot mathematics by numba, cached on disk."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import numba
import numpy as np
import numpy.typing as npt
from numba.core import event

Array = npt.NDArray[np.float64]

# Products and sums may fuse; infinities keep their meaning, for mu_c has one.
_REARRANGED = {'arcp', 'contract', 'nsz'}
_OPTIONS = {'cache': True, 'nogil': True, 'error_model': 'numpy'}

compiled = numba.njit(**_OPTIONS, fastmath=_REARRANGED)
"""Decorator: compile at the first call, and keep the machine code beside the source."""

equation = numba.njit(**_OPTIONS, fastmath=_REARRANGED, forceinline=True)
"""Decorator for equations: compiled into their callers, where a call would cost more than they."""

reduction = numba.njit(**_OPTIONS, fastmath=_REARRANGED | {'reassoc'})
"""Decorator for sums over many points, which may be taken in any order."""


@contextmanager
def compilation_announced(announce: Callable[[], None]) -> Iterator[None]:
    """Call a function before the first compilation in a block, if there is one.

    There is none if the machine code of all that the block calls is in the cache.
    """
    with event.install_listener('numba:compile', _Once(announce)):
        yield


class _Once(event.Listener):
    """Calls a function at the first event."""

    def __init__(self, announce: Callable[[], None]) -> None:
        self._announce: Callable[[], None] | None = announce

    def on_start(self, event: event.Event) -> None:
        """Announce the first compilation."""
        announce, self._announce = self._announce, None
        if announce is not None:
            announce()

    def on_end(self, event: event.Event) -> None:
        """Let a compilation end in silence."""


def _forget_outdated(folder: Path) -> None:
    """Remove cached code that is older than any source.

    numba looks at the file of the function itself only, but the code holds the functions that it
    calls as well.
    """
    newest = max(source.stat().st_mtime for source in folder.rglob('*.py'))
    for cached in folder.rglob('__pycache__/*.nb[ic]'):
        with suppress(FileNotFoundError):  # another process was faster
            if cached.stat().st_mtime < newest:
                cached.unlink()


with suppress(OSError):  # a folder of somebody else's, whose cache numba keeps elsewhere
    _forget_outdated(Path(__file__).parents[1])
