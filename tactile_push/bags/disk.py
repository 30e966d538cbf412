# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files that a thread writes, so that whoever fills them does not wait for the disk."""

import contextlib
import os
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from queue import Queue

# Pieces that may wait for the disk; after that whoever fills a file waits, too. A piece is a chunk
# of a bag at the most.
_MOST_WAITING = 64


class Disk:
    """The thread that writes files, and what went wrong in it.

    All files have one thread, and are written in the order in which they were filled. After an
    error nothing more is written to any of them.

    Attributes
    ----------
    descriptors : set of int
        Of the files that are open.
    """

    def __init__(self) -> None:
        self._work: Queue[Callable[[], None] | None] = Queue(_MOST_WAITING)
        self._error: OSError | None = None
        self._told = False
        self.descriptors: set[int] = set()
        # Who forgets to close loses what waits, as if killed, rather than the end of the process.
        self._thread = threading.Thread(target=self._run, name='disk', daemon=True)
        self._thread.start()

    @property
    def failed(self) -> bool:
        """Whether an error ended the writing and somebody has been told."""
        return self._told

    def check(self) -> None:
        """Raise the error that ended the writing, if there was one."""
        if self._error is not None:
            self._told = True
            raise self._error

    def do(self, work: Callable[[], None]) -> None:
        """Let the thread do something, after everything that it was given before.

        Parameters
        ----------
        work : callable
            What to do; it is not done after an error.
        """
        self.check()
        self._work.put(work)

    def close(self) -> None:
        """Wait until everything is done; an error is told by `check`."""
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
    """A new file that is filled piece by piece, with the methods that MCAP's writer wants.

    A piece that does not go onto the disk whole is taken back: the file then ends with the piece
    before it.

    Parameters
    ----------
    disk : Disk
        Who writes it.
    path : path
        File, not there yet.
    """

    def __init__(self, disk: Disk, path: Path) -> None:
        self._disk = disk
        self._path = path
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
        self._descriptor = os.open(path, flags, 0o666)
        disk.descriptors.add(self._descriptor)
        self._length = self._flushed = 0  # as seen by whoever fills the file
        self._written = 0  # as seen by the thread
        disk.do(partial(sync_directory, path.parent))

    def write(self, piece: bytes) -> int:
        """Append a piece.

        Parameters
        ----------
        piece : bytes
            What stays whole or goes.

        Returns
        -------
        int
            Its length.
        """
        if piece:
            self._disk.do(partial(self._write, piece))
            self._length += len(piece)
        return len(piece)

    def tell(self) -> int:
        """Give the length of the file, with all that waits to be written [B]."""
        return self._length

    def flush(self) -> None:
        """See that what was appended will survive a power cut."""
        if self._length > self._flushed:
            self._flushed = self._length
            self._disk.do(self._sync)

    def close(self) -> None:
        """Say that nothing more comes."""
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
    """Write a file that is there whole or not at all, whatever happens in between.

    Parameters
    ----------
    path : path
        The file.
    text : str
        Its content.
    """
    unfinished = path.with_name(f'{path.name}.unfinished')
    try:
        with unfinished.open('w', encoding='utf-8') as stream:
            stream.write(text)
            stream.flush()
            os.fsync(stream.fileno())
        unfinished.replace(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
        raise
    sync_directory(path.parent)


def sync_directory(path: Path) -> None:
    """See that the entries of a directory survive a power cut, if its file system can do that.

    Parameters
    ----------
    path : path
        The directory.
    """
    with contextlib.suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
