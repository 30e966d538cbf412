# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read keys from the terminal of the process, and show a line of status on it."""

import atexit
import contextlib
import os
import re
import select
import signal
import sys
import termios
import threading
from collections.abc import Callable
from types import FrameType

STDIN, STDERR = 0, 2
KEY = re.compile(r'\x1b[\[O][0-9;]*[A-Za-z~]|.', re.DOTALL)
LFLAG = 3  # index into the attributes of a terminal


class Terminal:
    """The terminal of this process, while the process is in its foreground.

    It is left as it was found when the process ends, and while Ctrl-Z suspends the process: `hold`
    is called before that and `release` after it. A process in the background neither reads the
    terminal nor writes to it nor sets it: that would stop the process or disturb others.
    """

    def __init__(self, hold: Callable[[], None], release: Callable[[], None]) -> None:
        self._hold, self._release = hold, release
        self._found: list | None = None  # attributes to give back
        self._shown = ''
        atexit.register(self.close)
        if os.isatty(STDIN) and signal.getsignal(signal.SIGTSTP) == signal.SIG_DFL:
            signal.signal(signal.SIGTSTP, self._suspend)

    @property
    def there(self) -> bool:
        """Whether there is a terminal at all."""
        return os.isatty(STDIN) or os.isatty(STDERR)

    @property
    def answers(self) -> bool:
        """Whether somebody can see what is shown and press keys."""
        return os.isatty(STDIN) and os.isatty(STDERR)

    def read_keys(self) -> list[str]:
        """Return the characters and whole escape sequences typed since the last call."""
        if not _has_us(STDIN):
            return []
        with contextlib.suppress(OSError, termios.error):  # the terminal was closed
            self._take_keys_singly()
            if select.select([STDIN], [], [], 0.0)[0]:
                return KEY.findall(os.read(STDIN, 1024).decode(errors='replace'))
        return []

    def show(self, line: str) -> None:
        """Show a line in place of the last one."""
        if line != self._shown and _has_us(STDERR):
            self._write(f'\r{line}\x1b[K')
            self._shown = line

    def say(self, line: str) -> None:
        """Leave a line above the one that is shown."""
        if _has_us(STDERR):
            self._write(f'\r{line}\x1b[K\n')
            self._shown = ''

    def close(self) -> None:
        """Leave the terminal as it was found; further calls do nothing."""
        if self._shown and _has_us(STDERR):
            self._write('\r\x1b[K')
        self._shown = ''
        if self._found is not None and _has_us(STDIN):
            with contextlib.suppress(termios.error):
                termios.tcsetattr(STDIN, termios.TCSADRAIN, self._found)
            self._found = None

    def _take_keys_singly(self) -> None:
        """Get each key at once and unechoed; a shell resets this while we are suspended."""
        attributes = termios.tcgetattr(STDIN)
        if attributes[LFLAG] & termios.ICANON:
            self._found = termios.tcgetattr(STDIN)
            attributes[LFLAG] &= ~(termios.ICANON | termios.ECHO)
            termios.tcsetattr(STDIN, termios.TCSADRAIN, attributes)

    def _write(self, text: str) -> None:
        with contextlib.suppress(OSError):
            sys.stderr.write(text)
            sys.stderr.flush()

    def _suspend(self, signum: int, frame: FrameType | None) -> None:
        self._hold()
        self.close()
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)
        signal.pthread_kill(threading.get_ident(), signal.SIGTSTP)  # here it stands still
        signal.signal(signal.SIGTSTP, self._suspend)
        self._release()


def _has_us(descriptor: int) -> bool:
    """Return whether it is a terminal that has this process in the foreground."""
    try:
        return os.tcgetpgrp(descriptor) == os.getpgrp()
    except OSError:
        return False
