# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the commands that read bags have in common: progress, warnings, tables, JSON."""

import json
import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress

from tactile_push.bags.disk import write_whole

_WIDTH_OF_FILES = 160  # columns, where the output is no terminal


class _Console(Console):
    """A console that leaves it to the command what to do when nobody reads any more."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


@contextmanager
def reading(messages: int) -> Iterator[Callable[[int], None]]:
    """Show a progress bar on standard error, if that is a terminal.

    Parameters
    ----------
    messages : int
        How many there are to read.

    Yields
    ------
    callable
        To be told how many have been read.
    """
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task('reading', total=messages)
        yield lambda done: bar.update(task, completed=done)


def warner(command: str) -> Callable[[str], None]:
    """Give what prints a line about a bag that can be read in spite of it.

    Parameters
    ----------
    command : str
        Name of the command.

    Returns
    -------
    callable
        Takes the line.
    """
    return lambda line: print(f'tactile_push {command}: warning: {line}', file=sys.stderr)


def wide_console() -> Console:
    """Give a console for tables.

    Returns
    -------
    rich.console.Console
        As wide as the terminal; where there is none, wide enough.
    """
    return _Console(width=None if sys.stdout.isatty() else _WIDTH_OF_FILES)


def plain(value: Any) -> Any:
    """Give a value as JSON can say it: numbers that it does not know as text.

    Parameters
    ----------
    value : object
        Numbers, text, bytes, and lists, tuples and dictionaries of them.

    Returns
    -------
    object
        The same for JSON; ``'nan'``, ``'inf'``, ``'-inf'`` for what are no numbers there.
    """
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value


def write_json(file: str, content: object) -> None:
    """Write an object of plain values where `--json FILE|-` wants it.

    Parameters
    ----------
    file : str
        The file, or `-` for standard output.
    content : object
        What JSON knows.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    text = json.dumps(content) + '\n'
    if file == '-':
        sys.stdout.write(text)
    else:
        write_whole(Path(file), text)


def bounded(values: Mapping[str, float], name: str, factor: float, digits: int) -> str:
    """Give an estimated quantity with its intervals, for people.

    Parameters
    ----------
    values : mapping of str to float
        The numbers of `active_sensing/state` by name.
    name : str
        The quantity.
    factor : float
        To the unit that people read.
    digits : int
        Decimals.

    Returns
    -------
    str
        Such as ``'1.07, 95 %: 0.98 to 1.17, guaranteed: -1.20 to 3.50'``.
    """

    def fixed(value: float) -> str:
        if math.isnan(value):
            return 'unknown'
        if math.isinf(value):
            return '∞'
        return f'{round(factor * value, digits) + 0.0:.{digits}f}'  # no -0.0

    mean, lower, upper, least, most = (
        fixed(values[f'{name}{bound}']) for bound in ('', '_lower', '_upper', '_least', '_most')
    )
    return f'{mean}, 95 %: {lower} to {upper}, guaranteed: {least} to {most}'
