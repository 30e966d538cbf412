# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The command on a pseudo terminal, seen from the person's side."""

import contextlib
import os
import pty
import select
import signal
import sys
import termios


class OnTerminal:
    """`tactile_push` with these words in a process that has a terminal of its own."""

    def __init__(self, words, environment, folder='.'):
        self._pid, self._terminal = pty.fork()
        if self._pid == 0:
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # as a shell does
            os.chdir(folder)
            os.execve(
                sys.executable, [sys.executable, '-m', 'tactile_push.cli', *words], environment
            )
        self.before = self.attributes()
        self.said = ''
        self.status = None

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self.status is None:
            os.kill(self._pid, signal.SIGKILL)
            os.waitpid(self._pid, 0)
        os.close(self._terminal)

    def attributes(self):
        """Return how the terminal is set."""
        return termios.tcgetattr(self._terminal)

    def type(self, keys):
        """Press keys."""
        os.write(self._terminal, keys.encode())

    def says(self, words):
        """Return whether it has said something, so far."""
        while select.select([self._terminal], [], [], 0.0)[0]:
            try:
                self.said += os.read(self._terminal, 4096).decode(errors='replace')
            except OSError:  # nobody is left at the other end
                break
        return words in self.said

    def ended(self):
        """Return whether it has ended, and take what it said until then."""
        self.says('')
        if self.status is None:
            pid, status = os.waitpid(self._pid, os.WNOHANG)
            if pid:
                with contextlib.suppress(OSError):
                    self.says('')
                self.status = os.waitstatus_to_exitcode(status)
        return self.status is not None
