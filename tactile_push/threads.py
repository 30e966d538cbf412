# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Threads for work that lets other threads run, as compiled functions do."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager


def usable_cores() -> int:
    """Return on how many cores this process may run."""
    if hasattr(os, 'sched_getaffinity'):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def on_all_cores() -> Iterator[ThreadPoolExecutor]:
    """Give work to one thread a core, and wait for it.

    An exception, such as that of Ctrl-C, drops what has not begun.

    Yields
    ------
    ThreadPoolExecutor
        Takes the work.
    """
    with ThreadPoolExecutor(usable_cores()) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
