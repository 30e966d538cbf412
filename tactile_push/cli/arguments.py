# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read the words of a command line and say in one line what is wrong with them."""

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

MOST_STEPS = 10_000_000  # their history takes half a gigabyte; more would be a slip
BAG: dict[str, Any] = {
    'type': Path,
    'metavar': 'BAG',
    'help': 'folder of a bag, or one of its files',
}
PICTURES = ('.png', '.svg', '.pdf')


class Refused(Exception):  # noqa: N818, it is no fault of the program
    """The command cannot do what was asked for.

    Parameters
    ----------
    reason : str
        One line for people; an empty one says nothing.
    status : int, optional
        Exit status.
    """

    def __init__(self, reason: object, status: int = 2) -> None:
        super().__init__(str(reason))
        self.status = status


class Parser(argparse.ArgumentParser):
    """A parser that says in one line what is wrong."""

    def error(self, message: str) -> NoReturn:
        """End with exit status 2."""
        self.exit(2, f'{self.prog}: error: {message}; see {self.prog} --help\n')


Commands: TypeAlias = 'argparse._SubParsersAction[Parser]'


def rerun_options(parser: Parser, *, config: str, out: str, json: str) -> None:
    """Add the bag and the options, with these helps, of a command that computes a bag again."""
    parser.add_argument('bag', **BAG)
    parser.add_argument('--config', type=Path, metavar='FILE', help=config)
    parser.add_argument('-o', '--out', type=Path, metavar='DIR', help=out)
    parser.add_argument('--json', metavar='FILE|-', help=json)


def number(what: str, lower: float, upper: float, *, closed: bool = True) -> Callable[[str], float]:
    """Return a reader of numbers between bounds, which belong to the range if it is closed."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (lower <= value <= upper if closed else lower < value < upper):
            raise argparse.ArgumentTypeError(f'expected {what}, got {text}')
        return value

    return read


def steps(text: str) -> int:
    """Read a number of steps."""
    whole = text.isascii() and text.isdigit() and len(text) <= len(str(MOST_STEPS))
    if not (whole and int(text) <= MOST_STEPS):
        raise argparse.ArgumentTypeError(f'expected a whole number, 0 to {MOST_STEPS}, got {text}')
    return int(text)


def edge(text: str) -> int:
    """Read the number of an edge, -1 for an unknown one."""
    try:
        number = int(text)
    except ValueError:
        number = -2
    if number < -1:
        raise argparse.ArgumentTypeError(f'expected a whole number from -1 on, got {text}')
    return number


def picture(text: str) -> Path:
    """Read the name of a picture."""
    if Path(text).suffix.lower() not in PICTURES:
        raise argparse.ArgumentTypeError(f'expected a file *{", *".join(PICTURES)}, got {text}')
    return Path(text)


def page(text: str) -> Path:
    """Read the name of a page, which no bag can have."""
    if Path(text).suffix.lower() not in ('.html', '.htm'):
        raise argparse.ArgumentTypeError(f'expected a file *.html, got {text}')
    return Path(text)


def topic(text: str) -> str:
    """Read the full name of a topic; the leading slash may be left out."""
    return text if text.startswith('/') else f'/{text}'


def tolerance(text: str) -> tuple[tuple[str, str] | None, float]:
    """Read a tolerance: the topic and field that it is for, if any, and its value."""
    place, equals, value = text.rpartition('=')
    name, _, field = place.partition(':')
    try:
        found = float(value)
    except ValueError:
        found = math.nan
    if not found >= 0.0 or (equals and not (name and field)):
        raise argparse.ArgumentTypeError(
            f'expected a number of 0 or more, or TOPIC:FIELD=NUMBER, got {text}'
        )
    return ((topic(name), field) if equals else None), found
