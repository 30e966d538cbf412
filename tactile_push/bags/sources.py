# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes of a bag's files by their place; files that rosbag2 has compressed are decompressed."""

import os
from pathlib import Path
from typing import IO, Protocol

import zstandard

from tactile_push.streams import one_line

# How much is decompressed at once on the way to a place further on [bytes]; picked.
_STEP = 1 << 20

# zstd's own bound on what a frame may demand for its history [bytes].
_LARGEST_WINDOW = 1 << 27


class BagError(Exception):
    """A bag that cannot be read, or a mistake about one: a line that says where and what.

    Parameters
    ----------
    text : str
        The line, with names as they stand in the bag.
    """

    def __init__(self, text: str) -> None:
        super().__init__(one_line(text))


class Source(Protocol):
    """A file that is read at any place; after `close`, the next read opens it again."""

    @property
    def size(self) -> int | None:
        """Size [bytes]; None if it is unknown."""

    def read(self, offset: int, length: int) -> bytes:
        """Return the bytes at a place, fewer where the file ends."""

    def close(self) -> None:
        """Close the file."""


def open_source(path: Path) -> Source:
    """Open an MCAP file, or one that rosbag2 has compressed (``.mcap.zstd``)."""
    return _ZstdSource(path) if path.suffix == '.zstd' else _FileSource(path)


def _open(path: Path) -> IO[bytes]:
    try:
        # Opening a pipe would block until somebody writes to it.
        if path.exists() and not path.is_file():
            raise BagError(f'{path}: expected an MCAP file, got something that is not a file')
        return path.open('rb')
    except (OSError, ValueError) as error:
        raise BagError(f'{path}: {getattr(error, "strerror", None) or error}') from None


class _FileSource:
    """A file as it is."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._stream: IO[bytes] | None = _open(path)
        self.size = os.fstat(self._stream.fileno()).st_size

    def read(self, offset: int, length: int) -> bytes:
        if self._stream is None:
            self._stream = _open(self._path)
        # Python allocates the whole length before it reads, so a damaged length must not reach it.
        length = min(length, self.size - offset)
        if length <= 0:
            return b''
        try:
            self._stream.seek(offset)
            return self._stream.read(length)
        except OSError as error:
            raise BagError(f'{self._path}: {error.strerror or error}') from None

    def close(self) -> None:
        if self._stream is not None:
            self._stream.close()
        self._stream = None


class _ZstdSource:
    """A file in zstd: fast to read forwards; going back starts again at its beginning."""

    size = None

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file: IO[bytes] | None = None
        self._position = 0
        self._rewind()

    def read(self, offset: int, length: int) -> bytes:
        if self._file is None or offset < self._position:
            self._rewind()
        while self._position < offset:
            if not self._take(min(offset - self._position, _STEP)):
                return b''
        parts = []
        while length > 0 and (part := self._take(min(length, _STEP))):
            parts.append(part)
            length -= len(part)
        return b''.join(parts)

    def close(self) -> None:
        if self._file is not None:
            self._file.close()
        self._file = None

    def _rewind(self) -> None:
        self.close()
        self._file = _open(self._path)
        self._stream = zstandard.ZstdDecompressor(max_window_size=_LARGEST_WINDOW).stream_reader(
            self._file, read_across_frames=True
        )
        self._position = 0

    def _take(self, length: int) -> bytes:
        try:
            part = self._stream.read(length)
        except zstandard.ZstdError:
            return b''
        except OSError as error:
            raise BagError(f'{self._path}: {error.strerror or error}') from None
        self._position += len(part)
        return part
