# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files that a thread writes, so that whoever fills them does not wait for the disk."""

import contextlib
import errno
import os
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from queue import Queue

# Pieces that may wait for the disk; with more, whoever fills a file waits too. A piece is at most a
# chunk of a bag, so 64 MiB wait; picked.
_MOST_WAITING = 64


class Disk:
    """A thread that writes files, and the error that it ran into.

    It writes all files in the order in which they were filled, and nothing more after an error.
    `descriptors` has the open files.
    """

    def __init__(self) -> None:
        self._work: Queue[Callable[[], None] | None] = Queue(_MOST_WAITING)
        self._error: OSError | None = None
        self._told = False
        self.descriptors: set[int] = set()
        # Without `close`, the process ends without what waits, as if killed, instead of hanging.
        self._thread = threading.Thread(target=self._run, name='disk', daemon=True)
        self._thread.start()

    @property
    def failed(self) -> bool:
        """Whether an error has ended the writing and `check` has raised it."""
        return self._told

    def check(self) -> None:
        """Raise the error that ended the writing, if there was one."""
        if self._error is not None:
            self._told = True
            raise self._error

    def do(self, work: Callable[[], None]) -> None:
        """Let the thread call `work` after everything before it, unless there is an error."""
        self.check()
        self._work.put(work)

    def close(self) -> None:
        """Wait until everything is done; `check` tells whether there was an error."""
        self._work.put(None)
        self._thread.join()
        for descriptor in self.descriptors:  # after an error
            os.close(descriptor)
        self.descriptors.clear()

    def _run(self) -> None:
        while (work := self._work.get()) is not None:
            if self._error is None:
                try:
                    work()
                except OSError as error:
                    self._error = error


class DiskFile:
    """A new file that is filled piece by piece, with the methods that MCAP's writer calls.

    If a piece does not reach the disk whole, it is removed: the file then ends with the piece
    before it.
    """

    def __init__(self, disk: Disk, path: Path) -> None:
        self._disk = disk
        self._path = path
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, 'O_BINARY', 0)
        self._descriptor = os.open(path, flags, 0o666)
        disk.descriptors.add(self._descriptor)
        self._length = self._flushed = 0  # as seen by whoever fills the file
        self._written = 0  # as seen by the thread
        disk.do(partial(sync_directory, path.parent))

    def write(self, piece: bytes) -> int:
        """Append a piece; return its length."""
        if piece:
            self._disk.do(partial(self._write, piece))
            self._length += len(piece)
        return len(piece)

    def tell(self) -> int:
        """Return the length of the file with all that waits to be written [B]."""
        return self._length

    def flush(self) -> None:
        """Have all that was appended put onto the disk, to survive a power cut."""
        if self._length > self._flushed:
            self._flushed = self._length
            self._disk.do(self._sync)

    def close(self) -> None:
        """Close the file after everything that waits has been written."""
        self._disk.do(self._close)

    def _write(self, piece: bytes) -> None:
        left = memoryview(piece)
        try:
            while left:
                left = left[os.write(self._descriptor, left) :]
        except OSError as error:
            self._take_back()
            raise self._named(error) from None
        self._written += len(piece)

    def _take_back(self) -> None:
        with contextlib.suppress(OSError):
            if self._written:
                os.ftruncate(self._descriptor, self._written)
            else:
                self._path.unlink()  # a file of nothing is no bag

    def _sync(self) -> None:
        try:
            os.fdatasync(self._descriptor)
        except OSError as error:
            raise self._named(error) from None

    def _close(self) -> None:
        self._sync()
        self._disk.descriptors.remove(self._descriptor)
        os.close(self._descriptor)

    def _named(self, error: OSError) -> OSError:
        return OSError(error.errno, error.strerror, str(self._path))


def write_whole(path: Path, text: str) -> None:
    """Write a file whole or not at all, whatever happens meanwhile, and put it onto the disk.

    What is no file, such as a terminal or a pipe, is written to directly. A pipe that nobody reads
    is refused, because opening it would wait for ever. An OSError has the name of the file.
    """
    is_no_file = path.exists() and not path.is_file()
    part = path if is_no_file else path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        opener = _without_waiting if is_no_file else None
        with open(part, 'w', encoding='utf-8', errors='replace', opener=opener) as stream:
            stream.write(text)
            stream.flush()
            if not is_no_file:
                os.fsync(stream.fileno())
                part.replace(path)
    except OSError as error:
        if not is_no_file:
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
        unread = is_no_file and error.errno == errno.ENXIO
        words = 'nobody reads this pipe' if unread else error.strerror
        raise OSError(error.errno, words, str(path)) from None
    sync_directory(path.parent)


def _without_waiting(path: str, flags: int) -> int:
    """Open what is no file; ENXIO if it is a pipe that nobody reads."""
    descriptor = os.open(path, flags | getattr(os, 'O_NONBLOCK', 0))
    os.set_blocking(descriptor, True)
    return descriptor


def sync_directory(path: Path) -> None:
    """Put the entries of a directory onto the disk, if its file system can do that."""
    with contextlib.suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY | getattr(os, 'O_DIRECTORY', 0))
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
