# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The fields that a message has by the definition in a bag."""

import io
from collections.abc import Iterator, Mapping
from contextlib import redirect_stderr

from mcap_ros2._dynamic import _for_each_msgdef
from mcap_ros2._vendor.rosidl_adapter.parser import MessageSpecification, parse_message_string

_WHOLE = frozenset(
    ('byte', 'char', *(f'{kind}{bits}' for kind in ('int', 'uint') for bits in (8, 16, 32, 64)))
)

# Which primitive types do where a field of a kind is expected.
WHOLE, NUMBER, TEXT, FLAG = 'a whole number', 'a number', 'a text', 'true or false'
_KINDS = {
    WHOLE: _WHOLE,
    NUMBER: _WHOLE | {'float32', 'float64'},
    TEXT: frozenset(['string']),
    FLAG: frozenset(['bool']),
}

# Parts that a definition need not have.
_TIME = 'int32 sec\nuint32 nanosec'
_BUILT_IN = {
    name: parse_message_string('builtin_interfaces', name, _TIME) for name in ('Time', 'Duration')
}


def fields_of(type_name: str, definition: str) -> dict[str, str]:
    """Return the primitive type of each field of a message type, by its path and in their order.

    A path has ``[]`` for each array, or its fixed length: ``'name[]'``, ``'covariance[36]'``,
    ``'status[].level'``. ValueError says what is wrong with the definition.
    """
    parts = {f'builtin_interfaces/{name}': part for name, part in _BUILT_IN.items()}

    def take(full_name: str, short_name: str, part: MessageSpecification) -> None:
        parts[full_name] = parts[short_name] = part

    try:
        # mcap_ros2's parser also prints the error that it raises.
        with redirect_stderr(io.StringIO()):
            _for_each_msgdef(type_name, definition, take)
    except Exception as error:  # any may come
        raise ValueError(f'is invalid: {" ".join(str(error).split())}') from None
    if type_name not in parts:
        raise ValueError(f'lacks {type_name} itself')
    return dict(_flat(parts, parts[type_name], '', ()))


def same_fields(type_name: str, one: str, other: str) -> bool:
    """Return whether two definitions have the same fields; of invalid ones the texts count."""
    if one == other:
        return True
    try:
        fields, others = (list(fields_of(type_name, text).items()) for text in (one, other))
    except ValueError:
        return False
    return fields == others


def trouble_with(fields: Mapping[str, str], expected: Mapping[str, str]) -> str:
    """Say what is wrong with the fields of a definition where others are expected, '' if nothing.

    `expected` are kinds, such as `NUMBER`, by path.
    """
    if expected and not fields:
        return 'is missing'
    for path, kind in expected.items():
        if path not in fields:
            return f'lacks {path}'
        if fields[path] not in _KINDS[kind]:
            return f'has another {path}: expected {kind}, got {fields[path]}'
    return ''


def _flat(
    parts: Mapping[str, MessageSpecification],
    message: MessageSpecification,
    prefix: str,
    within: tuple[str, ...],
) -> Iterator[tuple[str, str]]:
    for field in message.fields:
        kind = field.type
        fixed = kind.array_size if kind.is_fixed_size_array() else ''
        path = f'{prefix}{field.name}' + (f'[{fixed}]' if kind.is_array else '')
        if kind.is_primitive_type():
            yield path, kind.type
            continue
        name = f'{kind.pkg_name}/{kind.type}'
        if name not in parts:
            raise ValueError(f'lacks {name}')
        if name in within:
            raise ValueError(f'is invalid: {name} is a part of itself')
        yield from _flat(parts, parts[name], f'{path}.', (*within, name))
