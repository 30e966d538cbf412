# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Reads files that a person wrote, whatever lies in their place."""

import errno
import os
import stat
from pathlib import Path

MOST_BYTES = 10_000_000  # no person writes more; picked


def read_small_file(file: Path) -> bytes:
    """Read a file whole.

    Parameters
    ----------
    file : Path
        The file, or the pipe that a shell makes of ``<(command)``.

    Returns
    -------
    bytes
        Its content.

    Raises
    ------
    OSError
        If it cannot be read, has more than `MOST_BYTES`, or is a named pipe: that would wait until
        somebody writes to it.
    """
    if is_named_pipe(file):
        raise OSError(errno.EINVAL, 'expected a file, got a named pipe', str(file))
    with open(file, 'rb') as stream:
        content = stream.read(MOST_BYTES + 1)
    if len(content) > MOST_BYTES:
        raise OSError(errno.EFBIG, os.strerror(errno.EFBIG), str(file))
    return content


def is_named_pipe(file: str | Path) -> bool:
    """Return whether it is a pipe in a folder, which whoever opens it waits for.

    Parameters
    ----------
    file : str or Path
        The file. One that is not there is none, nor is a pipe of a shell.
    """
    try:
        piped = stat.S_ISFIFO(os.stat(file).st_mode)
    except (OSError, ValueError):
        return False
    return piped and os.path.exists(os.path.realpath(file))
