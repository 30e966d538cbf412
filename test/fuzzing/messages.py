# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Messages with one field after the other at its extremes."""

import copy
import math
import sys
from array import array
from collections.abc import Iterator
from typing import Any

FLOATS = (
    math.nan,
    math.inf,
    -math.inf,
    sys.float_info.max,
    -sys.float_info.max,
    5e-324,
    -0.0,
)
TEXTS = ('', 'x' * 100_000, '\N{SNOWMAN}\n$\x01', 'azimuth')
LENGTHS = (0, 1, 3, 10_000)
INTEGERS = {
    'int32': (-(2**31), -1, 0, 2**31 - 1),
    'uint32': (0, 10**9, 2**32 - 1),
}


def extremes(message: Any) -> Iterator[tuple[str, Any]]:
    """Yield copies of a message, each with one field, at any depth, at one of its extremes.

    Parameters
    ----------
    message : ROS message
        A valid message.

    Yields
    ------
    str
        What is extreme, for people.
    ROS message
        The copy.
    """
    for path, kind in _fields(message):
        for value in _extremes(kind):
            spoiled = copy.deepcopy(message)
            part = spoiled
            for name in path[:-1]:
                part = getattr(part, name)
            setattr(part, path[-1], value)
            yield f'{".".join(path)} = {_brief(value)}', spoiled


def _fields(message: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str]]:
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if hasattr(value, 'get_fields_and_field_types'):
            yield from _fields(value, (*path, name))
        else:
            yield (*path, name), kind


def _extremes(kind: str) -> Iterator[Any]:
    if kind == 'double':
        yield from FLOATS
    elif kind == 'string':
        yield from TEXTS
    elif kind in INTEGERS:
        yield from INTEGERS[kind]
    elif kind == 'sequence<double>':
        for value in FLOATS:
            yield array('d', [value] * 3)
        for length in LENGTHS:
            yield array('d', [0.1] * length)
    elif kind == 'sequence<string>':
        for text in TEXTS:
            yield [text] * 3
        for length in LENGTHS:
            yield ['azimuth'] * length
    else:
        raise TypeError(f'no extremes of {kind}')


def _brief(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 40 else f'{text[:30]}… of {len(value)}'
