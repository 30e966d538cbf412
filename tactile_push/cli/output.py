# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What commands have in common: opening a bag, progress, warnings, tables and JSON."""

import json
import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import Progress

from tactile_push.bags import BagError, BagReader
from tactile_push.bags.disk import write_whole
from tactile_push.cli.arguments import Refused
from tactile_push.streams import complain, one_line

WIDTH_OF_FILES = 160  # columns, where the output is no terminal


class OutputConsole(Console):
    """A console that leaves it to the command what to do when nobody reads any more."""

    def on_broken_pipe(self) -> None:
        """Raise what `main` expects."""
        raise BrokenPipeError


def wide_console() -> Console:
    """Return a console for tables: as wide as the terminal or, where there is none, wide enough."""
    return OutputConsole(width=None if sys.stdout.isatty() else WIDTH_OF_FILES)


def shown(text: str) -> str:
    """Return words that somebody else chose, for a console that takes markup."""
    return escape(one_line(text))


def warner(command: str) -> Callable[[str], None]:
    """Return a function that prints a warning of a command."""
    return lambda line: complain(f'tactile_push {command}: warning', line)


@contextmanager
def opened(bag: Path, warn: Callable[[str], None]) -> Iterator[BagReader]:
    """Open a bag; what is wrong with it, or with what is asked of it, is refused."""
    try:
        with BagReader(bag, warn) as reader:
            yield reader
    except (BagError, ValueError) as error:
        raise Refused(error) from None


@contextmanager
def naming(file: object, option: str = '') -> Iterator[None]:
    """Refuse what fails with a file, in the words of the system, after the option that names it."""
    try:
        yield
    except BrokenPipeError:  # nobody reads the output any more, which is no mistake
        raise
    except OSError as error:
        place = f'{option}: ' if option else ''
        raise Refused(f'{place}{error.filename or file}: {error.strerror}') from None


@contextmanager
def reading(messages: int) -> Iterator[Callable[[int], None]]:
    """Show on a terminal how many of so many messages have been read, which the function takes."""
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task('reading', total=messages)
        yield lambda done: bar.update(task, completed=done)


def plain(value: Any) -> Any:
    """Return a value as JSON has it: numbers that are not finite, and paths, as text."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, Path) or (isinstance(value, float) and not math.isfinite(value)):
        return str(value)
    return value


def write_json(file: str, content: object) -> None:
    """Write plain values where `--json FILE|-` wants them."""
    text = json.dumps(content) + '\n'
    if file == '-':
        sys.stdout.write(text)
    else:
        write_whole(Path(file), text)


def bounded(values: Mapping[str, float], name: str, factor: float, digits: int) -> str:
    """Return a quantity of `active_sensing/state` with its intervals, in the unit of people.

    Such as ``'1.07, 95 %: 0.98 to 1.17, guaranteed: -1.20 to 3.50'``.
    """

    def words(value: float) -> str:
        if math.isnan(value):
            return 'unknown'
        if math.isinf(value):
            return '∞'
        return f'{round(factor * value, digits) + 0.0:.{digits}f}'  # no -0.0

    mean, lower, upper, least, most = (
        words(values[f'{name}{bound}']) for bound in ('', '_lower', '_upper', '_least', '_most')
    )
    return f'{mean}, 95 %: {lower} to {upper}, guaranteed: {least} to {most}'
