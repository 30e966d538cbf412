# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Compilation of the hot mathematics by numba."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numba
import numpy as np
import numpy.typing as npt
from numba.core import event

from tactile_push.mechanics.machine_code import keep_machine_code

Array = npt.NDArray[np.float64]

# Products and sums may fuse; infinities keep their meaning, for mu_c has one.
_REARRANGED = {'arcp', 'contract', 'nsz'}


def _compiling(fastmath: set[str], **options: bool) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that compiles a function as asked and keeps its machine code."""
    compile_ = numba.njit(nogil=True, error_model='numpy', fastmath=fastmath, **options)
    if numba.config.DISABLE_JIT:
        return compile_
    return lambda function: keep_machine_code(compile_(function))


compiled = _compiling(_REARRANGED)
"""Decorator: compile at the first call, and keep the machine code."""

equation = _compiling(_REARRANGED, forceinline=True)
"""Decorator for equations: compiled into their callers, where a call would cost more than they."""

reduction = _compiling(_REARRANGED | {'reassoc'})
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
