# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Machine code on disk, which may be outdated or damaged, and for which there may be no place."""

import hashlib
import logging
import os
import pickle
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.dispatcher import Dispatcher

PACKAGE = Path(__file__).parents[1]
CHECKSUM = 32  # bytes of SHA-256 before the content of each file
PATIENCE = (
    60.0  # for another process that compiles one function [s]; ten times what the longest takes
)
LOOK = (
    0.01  # between two looks whether it is ready [s]; a compilation takes a hundred times as long
)

_LOG = logging.getLogger('tactile_push')


def keep_machine_code(dispatcher: Dispatcher) -> Dispatcher:
    """Keep the machine code of a compiled function beside its source, or where the user may write.

    Parameters
    ----------
    dispatcher : numba.core.dispatcher.Dispatcher
        The function.

    Returns
    -------
    numba.core.dispatcher.Dispatcher
        The same function.
    """
    try:
        dispatcher._cache = _MachineCode(dispatcher.py_func)  # type: ignore[attr-defined]
    except RuntimeError:  # numba found no folder
        _warn_once(
            'no folder for machine code can be written, so every start compiles; '
            'NUMBA_CACHE_DIR may name one'
        )
    return dispatcher


class _MachineCode(FunctionCache):
    """The machine code of one function; what cannot be read is compiled again.

    Of processes that need it at once, one compiles and the others wait for it.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        name = f'{self._impl.filename_base}.checked'  # files that numba wrote have no checksum
        stamp = _stamp_of_sources(), _stamp_of(function)
        self._cache_file = _CheckedFiles(self._cache_path, name, stamp)
        self._turn = _Turn(Path(self._cache_path) / f'{name}.lock')

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the code for a signature, or None if it has to be compiled."""
        code = self._load(sig, target_context)
        if code is None:
            self._turn.take()
            code = self._load(sig, target_context)  # which another process may have made meanwhile
            if code is not None:
                self._turn.end()
        return code

    def _load(self, sig: Any, target_context: Any) -> Any:
        """Return the code for a signature, or None if there is none that can be used."""
        try:
            return super().load_overload(sig, target_context)
        except _DamagedError as error:
            _warn_once(f'machine code in {self._cache_path} is damaged, so it is compiled again')
            with suppress(OSError):
                error.file.unlink()
        except OSError as error:
            _warn_once(f'machine code cannot be read, so it is compiled again: {error}')
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the code for a signature if there is room for it."""
        try:
            super().save_overload(sig, data)
        except (_DamagedError, OSError) as error:
            _warn_once(f'machine code cannot be kept, so the next start compiles again: {error}')
        finally:
            self._turn.end()


class _Turn:
    """The right to compile a function, which one process has at a time.

    A process whose compilation fails keeps it until its end. Nobody waits longer than `PATIENCE`.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._held: int | None = None

    def take(self) -> None:
        """Take the turn as soon as nobody else has it, or without it after `PATIENCE`."""
        if self._held is not None:
            return
        try:
            self._held = os.open(self._file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        except OSError:  # no room, which is said when the code is to be kept
            return
        patient_until = time.monotonic() + PATIENCE
        while not _lock(self._held) and time.monotonic() < patient_until:
            time.sleep(LOOK)

    def end(self) -> None:
        """Let the next process have the turn."""
        if self._held is not None:
            os.close(self._held)
            self._held = None


def _lock(file: int) -> bool:
    """Return whether this process has a file to itself now."""
    if sys.platform == 'win32':
        return True
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks
        return True
    return True


class _CheckedFiles(IndexDataCacheFile):
    """Index and data of a function's machine code, each behind a checksum.

    Data are written before the index that names them, under a name made from what they are. So two
    processes that compile at the same time write the same, and a stop in between loses nothing.
    """

    def save(self, key: Any, data: Any) -> None:
        """Save an entry."""
        overloads = self._load_index()
        if not overloads:
            pattern = Path(self._index_name).with_suffix('.*.nbc')
            for outdated in Path(self._cache_path).glob(str(pattern)):
                outdated.unlink(missing_ok=True)
        number = int.from_bytes(hashlib.sha256(repr(key).encode()).digest()[:6], 'big')
        overloads[key] = name = self._data_name_pattern.format(number=number)
        self._save_data(name, data)
        self._save_index(overloads)

    def _load_index(self) -> dict[Any, str]:
        """Return the index; an empty one if it is of other sources or of another numba."""
        path = Path(self._index_path)
        if not path.exists():
            return {}
        try:
            stamp, overloads = _read(path)
        except (ImportError, AttributeError):  # it names types that these sources do not have
            return {}
        return overloads if stamp == (self._version, self._source_stamp) else {}

    def _save_index(self, overloads: dict[Any, str]) -> None:
        stamp = self._version, self._source_stamp
        self._write(self._index_path, self._dump((stamp, overloads)))

    def _load_data(self, name: str) -> Any:
        return _read(Path(self._data_path(name)))

    def _save_data(self, name: str, data: Any) -> None:
        self._write(self._data_path(name), self._dump(data))

    def _write(self, path: str, content: bytes) -> None:
        with self._open_for_write(path) as file:
            file.write(hashlib.sha256(content).digest() + content)


class _DamagedError(Exception):
    """A file is not what was written."""

    def __init__(self, file: Path) -> None:
        super().__init__(f'{file} is damaged')
        self.file = file


def _read(file: Path) -> Any:
    content = file.read_bytes()
    checksum, content = content[:CHECKSUM], content[CHECKSUM:]
    if hashlib.sha256(content).digest() != checksum:
        raise _DamagedError(file)
    return pickle.loads(content)


@cache
def _stamp_of_sources() -> bytes:
    """Return what differs as soon as any source of the package does.

    Machine code holds the functions that its function calls, which are in other files.
    """
    sources = hashlib.sha256()
    for file in sorted(PACKAGE.rglob('*.py')):
        sources.update(str(file.relative_to(PACKAGE)).encode())
        sources.update(file.read_bytes())
    return sources.digest()


def _stamp_of(function: Callable[..., Any]) -> bytes:
    """Return what differs as soon as the file of a function does, which may be outside."""
    return hashlib.sha256(Path(function.__code__.co_filename).read_bytes()).digest()


@cache
def _warn_once(words: str) -> None:
    _LOG.warning('tactile_push: %s', words)
