# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Find where two decoded messages differ."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

_TIME = ['sec', 'nanosec']
_JOINT_STATE = 'sensor_msgs/JointState'
_JOINT_ARRAYS = ('position', 'velocity', 'effort')


class Unequal(NamedTuple):
    """A place at which two messages differ.

    `field` is the path of the field without the places in arrays: ``'poses[].position.x'``; values
    of a joint state have the joint's name: ``'position.theta'``. `where` has the places:
    ``'poses[3].position.x'``. `distance` is the size of the difference, infinite if it has none.
    """

    field: str
    where: str
    a: Any
    b: Any
    distance: float


@dataclass(frozen=True)
class Lone:
    """A field that only one of two messages has."""

    field: str
    in_a: bool


def compare_messages(a: Any, b: Any) -> Iterator[Unequal | Lone]:
    """Find the differences of two decoded messages, in the order of their fields.

    Every field is compared: NaN equals NaN, a time is one number [s]. Of an array of numbers the
    first and the largest difference are found. Joint states are matched by the joints' names.
    """
    return _compare(a, b, '', '')


def field_paths(message: Any) -> Iterator[str]:
    """Yield the path of each field of a message as in `Unequal.field`, and of each length."""
    return _paths(message, '')


def seconds(time: int) -> str:
    """Return a time [ns] in seconds, with nine decimals."""
    sign = '-' if time < 0 else ''
    return f'{sign}{abs(time) // 10**9}.{abs(time) % 10**9:09d}'


def _paths(value: Any, field: str) -> Iterator[str]:
    if hasattr(value, '__slots__') and not _is_time(value):
        joints = _match_joints(value, value)
        for name in value.__slots__:
            path = f'{field}.{name}' if field else name
            if joints and name in _JOINT_ARRAYS and getattr(value, name):
                yield from (f'{path}.{joint}' for joint, _, _ in joints.common)
            yield from _paths(getattr(value, name), path)
    elif _is_array(value):
        yield f'len({field})'
        yield f'{field}[]'
        for entry in value if value and hasattr(value[0], '__slots__') else ():
            yield from _paths(entry, f'{field}[]')
    else:
        yield field


def _compare(a: Any, b: Any, field: str, where: str) -> Iterator[Unequal | Lone]:
    if hasattr(a, '__slots__') and hasattr(b, '__slots__'):
        yield from _compare_parts(a, b, field, where)
    elif _is_array(a) and _is_array(b):
        yield from _compare_arrays(a, b, field, where)
    else:
        distance = _distance(a, b)
        if distance > 0.0:
            yield Unequal(field, where, a, b, distance)


def _compare_parts(a: Any, b: Any, field: str, where: str) -> Iterator[Unequal | Lone]:
    names_a, names_b = list(a.__slots__), list(b.__slots__)
    if _is_time(a) and _is_time(b):
        yield from _compare_times(a, b, field, where)
        return
    joints = _match_joints(a, b)
    prefix, place = (f'{path}.' if path else '' for path in (field, where))
    for name in [*names_a, *(name for name in names_b if name not in names_a)]:
        if name not in names_a or name not in names_b:
            yield Lone(prefix + name, name in names_a)
        elif joints and name == 'name':
            yield from (Lone(f'{prefix}position.{joint}', True) for joint in joints.only_a)
            yield from (Lone(f'{prefix}position.{joint}', False) for joint in joints.only_b)
        elif joints and name in _JOINT_ARRAYS and (getattr(a, name) and getattr(b, name)):
            for joint, in_a, in_b in joints.common:
                path = f'{name}.{joint}'
                yield from _compare(
                    getattr(a, name)[in_a], getattr(b, name)[in_b], prefix + path, place + path
                )
        else:
            yield from _compare(getattr(a, name), getattr(b, name), prefix + name, place + name)


def _is_time(value: Any) -> bool:
    return list(value.__slots__) == _TIME and all(
        isinstance(getattr(value, name), int) for name in _TIME
    )


def _compare_times(a: Any, b: Any, field: str, where: str) -> Iterator[Unequal]:
    times = [value.sec * 10**9 + value.nanosec for value in (a, b)]
    if times[0] != times[1]:
        in_words = seconds(times[0]), seconds(times[1])
        yield Unequal(field, where, *in_words, abs(times[0] - times[1]) / 1e9)


@dataclass(frozen=True)
class _Joints:
    """The joints' names that only one of two joint states has, and the places of the others."""

    only_a: list[str]
    only_b: list[str]
    common: list[tuple[str, int, int]]


def _match_joints(a: Any, b: Any) -> _Joints | None:
    """Match two joint states by name; None if they are none or do not allow it."""
    for state in (a, b):
        if not _is_joint_state(state):
            return None
        if len(set(state.name)) != len(state.name):
            return None
        if any(len(getattr(state, name)) not in (0, len(state.name)) for name in _JOINT_ARRAYS):
            return None
    places_a, places_b = ({name: k for k, name in enumerate(state.name)} for state in (a, b))
    return _Joints(
        [name for name in a.name if name not in places_b],
        [name for name in b.name if name not in places_a],
        [(name, k, places_b[name]) for name, k in places_a.items() if name in places_b],
    )


def _is_joint_state(value: Any) -> bool:
    """Return whether it is a joint state as ROS defines it; a bag may define it otherwise."""
    names = ('name', *_JOINT_ARRAYS)
    return (
        value._type == _JOINT_STATE
        and all(_is_array(getattr(value, name, None)) for name in names)
        and all(isinstance(name, str) for name in value.name)
    )


def _is_array(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _compare_arrays(a: Any, b: Any, field: str, where: str) -> Iterator[Unequal | Lone]:
    if len(a) != len(b):
        # Only the lengths are compared: which elements are new or gone is unknown.
        yield Unequal(f'len({field})', f'len({where})', len(a), len(b), math.inf)
        return
    if len(a) == 0 or a == b:
        return
    if not all(type(entry) in (int, float) for entry in (a[0], b[0])):
        for k, (value_a, value_b) in enumerate(zip(a, b, strict=True)):
            yield from _compare(value_a, value_b, f'{field}[]', f'{where}[{k}]')
        return
    distances = _distances(a, b)
    for k in dict.fromkeys((int(np.argmax(distances > 0.0)), int(np.argmax(distances)))):
        if distances[k] > 0.0:
            yield Unequal(f'{field}[]', f'{where}[{k}]', a[k], b[k], float(distances[k]))


def _distances(a: Sequence[float], b: Sequence[float]) -> np.ndarray:
    """Return how far the numbers of two arrays are apart, as `_distance` does."""
    if isinstance(a, bytes) and isinstance(b, bytes):
        values = [np.frombuffer(array, np.uint8).astype(float) for array in (a, b)]
    elif isinstance(a[0], int) and isinstance(b[0], int):
        # Integers: floating point is not exact for 64 bits.
        return np.array([float(abs(x - y)) for x, y in zip(a, b, strict=True)])
    else:
        values = [np.asarray(array, dtype=float) for array in (a, b)]
    with np.errstate(invalid='ignore', over='ignore'):
        distances = np.abs(values[0] - values[1])
    unclear = np.isnan(distances)
    if unclear.any():
        # Differences of infinities, or with a NaN.
        same = (values[0] == values[1]) | (np.isnan(values[0]) & np.isnan(values[1]))
        distances[unclear] = np.where(same[unclear], 0.0, np.inf)
    return distances


def _distance(a: Any, b: Any) -> float:
    """Return how far two values are apart: 0 if they are equal, infinity if it has no size."""
    if a == b or (a != a and b != b):
        return 0.0
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and type(a) is type(b):
        distance = abs(a - b)
        if not isinstance(a, bool) and distance == distance:
            return float(distance)
    return math.inf
