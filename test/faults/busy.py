# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Processes that take the processors away, for a bounded time."""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PER_CORE = 4
LEAST = 19  # the lowest priority there is


@contextmanager
def busy_cores(seconds: float) -> Iterator[None]:
    """Keep every processor busy; the processes end by themselves too.

    Parameters
    ----------
    seconds : float
        For how long at the most [s].

    Yields
    ------
    None
        Once.
    """
    work = f'import time\nend = time.monotonic() + {seconds}\nwhile time.monotonic() < end: pass'
    cores = sorted(os.sched_getaffinity(0)) * PER_CORE
    busy = [
        subprocess.Popen([sys.executable, '-S', '-c', work], start_new_session=True) for _ in cores
    ]
    try:
        for process, core in zip(busy, cores, strict=True):
            os.sched_setaffinity(process.pid, {core})
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


def give_way(pid: int) -> None:
    """Give a process, with all its threads, the lowest priority.

    Parameters
    ----------
    pid : int
        The process.
    """
    for thread in Path(f'/proc/{pid}/task').iterdir():
        os.setpriority(os.PRIO_PROCESS, int(thread.name), LEAST)
