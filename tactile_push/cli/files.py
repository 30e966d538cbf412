# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files that commands write."""

import os
from contextlib import suppress
from pathlib import Path


def write_whole(path: Path, text: str) -> None:
    """Write a file so that it has all of the text, or stays as it was.

    Parameters
    ----------
    path : path
        The file.
    text : str
        What it shall have.

    Raises
    ------
    OSError
        If it cannot be written; with the file's name.
    """
    is_no_file = path.exists() and not path.is_file()  # a terminal, a pipe, a folder
    part = path if is_no_file else path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        part.write_text(text, encoding='utf-8', errors='replace')
        os.replace(part, path)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    finally:
        if part != path:
            with suppress(OSError):
                part.unlink(missing_ok=True)
