# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read the words of a command line and say in one line what is wrong with them."""

import argparse
import math
import os
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

from tactile_push.streams import complain

MOST_STEPS = 10_000_000  # their history takes half a gigabyte; more would be a slip
BAG: dict[str, Any] = {
    'type': Path,
    'metavar': 'BAG',
    'help': 'folder of a bag, or one of its files',
}
NAMESPACE = re.compile(r'[A-Za-z]\w*(/[A-Za-z]\w*)*', re.ASCII)
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


_MISSING = 'the following arguments are required: '  # argparse's words


class Parser(argparse.ArgumentParser):
    """A parser that says in one line what is wrong, and lets files stand behind a list of words.

    argparse gives all words behind an option such as ``--topics`` to it. If files are missing then,
    the last of these words are taken for them, provided that they are there.
    """

    _lists: Sequence[str] = ()  # options in the last words that take all words behind them

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse words as argparse does, with files behind lists of words."""
        words = [*(sys.argv[1:] if args is None else args)]
        self._lists = [word for word in words if self._nargs(word) == '+']
        return super().parse_known_args(self._files_last(words), namespace)

    def error(self, message: str) -> NoReturn:
        """End with exit status 2."""
        if message.startswith(_MISSING) and self._lists:
            message += f', before {self._lists[0]}'
        complain(f'{self.prog}: error', f'{message}; see {self.prog} --help')
        self.exit(2)

    def _nargs(self, word: str) -> int | str | None:
        action = self._option_string_actions.get(word)
        return None if action is None else action.nargs

    def _files_last(self, words: list[str]) -> list[str]:
        """Move missing files from behind options, which would swallow them, to the end."""
        required = [action for action in self._actions if _is_file(action)]
        missing = len(required)
        swallowed: list[int] = []
        place = 0
        while place < len(words) and missing > 0:
            action = self._option_string_actions.get(words[place])
            run = 0 if action is None else self._run(words, place + 1)
            if words[place] == '--':
                return words
            if action is None:
                # An option with its value, or a shortened one, is left to argparse.
                missing -= not words[place].startswith('-')
            elif action.nargs is None:
                run = min(run, 1)
            elif action.nargs == '+':
                swallowed += range(place + 2, place + 1 + run)
            elif action.nargs == '?' and run:
                run = 1
                if _refuses(action, words[place + 1]):
                    swallowed.append(place + 1)
            else:
                run = 0
            place += 1 + run
        there = [place for place in swallowed if os.path.exists(words[place])]
        if not 0 < missing <= len(there):
            return words
        taken = there[-missing:]
        given = [words[place] for place in taken]
        return [word for place, word in enumerate(words) if place not in taken] + ['--', *given]

    @staticmethod
    def _run(words: list[str], first: int) -> int:
        """Return how many words follow before the next option."""
        options = (k for k in range(first, len(words)) if words[k].startswith('-'))
        return next(options, len(words)) - first


def _is_file(action: argparse.Action) -> bool:
    return not action.option_strings and action.nargs is None


def _refuses(action: argparse.Action, word: str) -> bool:
    assert callable(action.type)
    try:
        action.type(word)
    except argparse.ArgumentTypeError:
        return True
    return False


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


def port(text: str) -> int:
    """Read the number of a port, 0 for any that is free."""
    if not (text.isascii() and text.isdigit() and len(text) <= 5 and int(text) <= 65535):
        raise argparse.ArgumentTypeError(f'expected a whole number, 0 to 65535, got {text}')
    return int(text)


def namespace(text: str) -> str:
    """Read a ROS namespace, and return it with the slash that may be missing."""
    name = text.strip('/')
    if not NAMESPACE.fullmatch(name):
        raise argparse.ArgumentTypeError(f'expected a namespace such as left, got {text}')
    return f'/{name}'


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
