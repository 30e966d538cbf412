# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the machine itself stood still, which no node can be blamed for."""

import os
import threading
import time

NAP = 0.01  # [s]


class HoldUps:
    """Notices when one of the processors is not there for a while.

    Attributes
    ----------
    longest : float
        Longest hold-up since `restart` [s].
    """

    def __init__(self) -> None:
        self.longest = 0.0
        self._closing = threading.Event()
        self._threads = [
            threading.Thread(target=self._run, args=(core,), name='hold-ups', daemon=True)
            for core in sorted(os.sched_getaffinity(0))
        ]
        for thread in self._threads:
            thread.start()

    def restart(self) -> None:
        """Forget what was."""
        self.longest = 0.0

    def close(self) -> None:
        """End."""
        self._closing.set()
        for thread in self._threads:
            thread.join()

    def _run(self, core: int) -> None:
        os.sched_setaffinity(threading.get_native_id(), {core})
        before = time.monotonic()
        while not self._closing.wait(NAP):
            now = time.monotonic()
            self.longest = max(self.longest, now - before - NAP)
            before = now
