# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""An executor that wakes up only when there is something to do."""

import os
import signal
import threading

from rclpy.executors import SingleThreadedExecutor
from rclpy.guard_condition import GuardCondition


class Executor(SingleThreadedExecutor):
    """Runs callbacks in one thread, and returns at once when a signal arrives.

    After each callback rclpy's executors wake up twice more, which only those with several threads
    need. Each time costs more than most callbacks. Before the next wait the executor looks anyway
    at what a callback has changed.
    """

    def __init__(self) -> None:
        super().__init__()
        # rclpy has no public way.
        self._guard = _GuardFromElsewhere(self._guard)  # type: ignore[has-type]
        self._signalled, self._signal = os.pipe()
        os.set_blocking(self._signal, False)
        # Python handles a signal only once the wait is over.
        signal.set_wakeup_fd(self._signal)
        self._waker = threading.Thread(target=self._end_wait, name='signals', daemon=True)
        self._waker.start()

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stop to wait for signals and to run callbacks, as rclpy's executors do."""
        signal.set_wakeup_fd(-1)
        os.write(self._signal, b'\0')
        self._waker.join()
        os.close(self._signal)
        os.close(self._signalled)
        return super().shutdown(timeout_sec)

    def _end_wait(self) -> None:
        while os.read(self._signalled, 1) != b'\0':  # signals have numbers from 1
            self.create_task(lambda: None)


class _GuardFromElsewhere:
    """A guard condition that ignores triggers from the thread that made it."""

    def __init__(self, guard: GuardCondition) -> None:
        self.handle = guard.handle
        self.destroy = guard.destroy
        self._trigger = guard.trigger
        self._thread = threading.get_ident()

    def trigger(self) -> None:
        if threading.get_ident() != self._thread:
            self._trigger()
