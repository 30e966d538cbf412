# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Standard streams that take whatever the package prints, wherever they lead."""

import codecs
import os
import sys
import typing
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper

PLAIN = {
    '°': ' deg',
    '…': '...',
    'θ': 'theta',
    'φ': 'phi',
    'μ': 'mu',
    '−': '-',
    '–': '-',
    '∞': 'inf',
    '×': 'x',
    '·': '*',
}


STANDARD_OUTPUT = 'standard output'


class _Output(TextIOWrapper):
    """Standard output, which names itself in the errors of writing."""

    def write(self, text: str, /) -> int:
        """Write text."""
        with _named():
            return super().write(text)

    def flush(self) -> None:
        """Write what waits."""
        with _named():
            super().flush()


@contextmanager
def _named() -> Iterator[None]:
    try:
        yield
    except OSError as error:
        error.filename = STANDARD_OUTPUT
        raise


def prepare_streams() -> None:
    """Let this process print on streams that are closed or know few characters.

    An OSError of standard output has the file name `STANDARD_OUTPUT`.

    A closed stream leads nowhere from now on. Otherwise the next file that is opened would get its
    number, and what the process prints would go into that file. A character that a stream cannot
    encode is written plainly, as ``theta`` for θ, and one without plain words by its number.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # which gets the lowest number that is free
            os.set_inheritable(number, True)
    sys.stdout = sys.stdout or os.fdopen(1, 'w', closefd=False)
    sys.stderr = sys.stderr or os.fdopen(2, 'w', closefd=False)
    codecs.register_error('tactile_push.plain', _plain)
    if type(sys.stdout) is TextIOWrapper:  # nobody has put another in its place
        sys.stdout = _Output(
            sys.stdout.detach(),
            sys.stdout.encoding,
            line_buffering=sys.stdout.line_buffering,
            write_through=sys.stdout.write_through,
        )
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors='tactile_push.plain')


def ignore_warnings_that_end() -> None:
    """Ignore Python's warnings if they would be errors, as PYTHONWARNINGS or -W has it.

    What a library says of another would otherwise end the process, and a finger's node with it.
    """
    actions = [option.partition(':')[0] for option in sys.warnoptions]
    if any(action and 'error'.startswith(action) for action in actions):
        warnings.simplefilter('ignore')


def one_line(text: str) -> str:
    """Write text so that it breaks no line and gives a terminal no orders.

    Names of files, topics and parameters may do either.

    Parameters
    ----------
    text : str
        Words that somebody else chose.

    Returns
    -------
    str
        The text, with escapes as in Python for what is not printable.
    """
    return ''.join(
        letter if letter.isprintable() else letter.encode('unicode_escape').decode()
        for letter in text
    )


def complain(who: str, words: object) -> None:
    """Print a line on standard error; if nobody can hear it, nothing is said.

    Parameters
    ----------
    who : str
        Command or node that complains.
    words : object
        What is wrong, or a warning.
    """
    with suppress(OSError):
        print(f'{who}: {one_line(str(words))}', file=sys.stderr, flush=True)


def is_nowhere(who: str) -> bool:
    """Return whether the working directory is gone, and complain if so.

    Parameters
    ----------
    who : str
        Command or node that would work there.
    """
    try:
        os.getcwd()
    except OSError as error:
        complain(who, f'working directory: {error.strerror}')
        return True
    return False


def _plain(error: UnicodeError) -> tuple[str | bytes, int]:
    """Return what stands for characters that cannot be encoded, and where to go on."""
    unknown = typing.cast(UnicodeEncodeError, error)
    characters = unknown.object[unknown.start : unknown.end]
    words = (
        PLAIN.get(one) or one.encode('ascii', 'backslashreplace').decode() for one in characters
    )
    return ''.join(words), unknown.end
