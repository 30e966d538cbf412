# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the words of a command line and says in one line what is wrong with them."""

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn, TypeAlias

MOST_STEPS = 10_000_000
PICTURES = ('.png', '.svg', '.pdf')


class Parser(argparse.ArgumentParser):
    """A parser that says in one line what is wrong."""

    def error(self, message: str) -> NoReturn:
        """End with exit status 2."""
        self.exit(2, f'{self.prog}: error: {message}; see {self.prog} --help\n')


Commands: TypeAlias = 'argparse._SubParsersAction[Parser]'


def number(what: str, lower: float, upper: float, *, closed: bool = True) -> Callable[[str], float]:
    """Give a reader of numbers between bounds, for argparse.

    Parameters
    ----------
    what : str
        What is expected, for people.
    lower, upper : float
        Bounds.
    closed : bool, optional
        Whether the bounds belong to the range.

    Returns
    -------
    callable
        Takes the text and gives the number.
    """

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
    """Read a number of steps, for argparse.

    Parameters
    ----------
    text : str
        A word of the command line.

    Returns
    -------
    int
        What it means.

    Raises
    ------
    argparse.ArgumentTypeError
        If it means nothing of the kind.
    """
    whole = text.isascii() and text.isdigit() and len(text) <= len(str(MOST_STEPS))
    if not (whole and int(text) <= MOST_STEPS):
        raise argparse.ArgumentTypeError(f'expected a whole number, 0 to {MOST_STEPS}, got {text}')
    return int(text)


def picture(text: str) -> Path:
    """Read the name of a picture, for argparse.

    Parameters
    ----------
    text : str
        A word of the command line.

    Returns
    -------
    path
        What it means.

    Raises
    ------
    argparse.ArgumentTypeError
        If it means nothing of the kind.
    """
    if Path(text).suffix.lower() not in PICTURES:
        raise argparse.ArgumentTypeError(f'expected a file *{", *".join(PICTURES)}, got {text}')
    return Path(text)
