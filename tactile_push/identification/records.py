# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Measured pushes, and JSON files of them.

A file is an object's, see `simulation.object_files`, with `tip_radius` [m] and `pushes`. Each push
has `tip_start` and `tip_end` [x, y in m] and `object_start` and `object_end` [x, y in m, yaw in
rad] in one fixed frame, or `tip_path` and `object_path`, lists of such places that were measured
together. A push with paths is cut into pushes of `CUT`. It may have a `force`, the mean one on the
object over the last part of the contact [N].
"""

import math
import reprlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tactile_push.mechanics import Outline, Pose, Slider, Support
from tactile_push.mechanics.compiled import Array
from tactile_push.simulation import ObjectFile, object_of
from tactile_push.simulation.object_files import are_numbers

CUT = 0.005  # way of the tip in a push that is cut out of a longer one [m]
STRAIGHT = 0.001  # part of it that is taken for straight [m]
PLACES = {'tip_start': 2, 'tip_end': 2, 'object_start': 3, 'object_end': 3}
ALIKE = 1e-6  # lengths of one object in several files [m], and shares of a load
PATHS = {'tip_path': 2, 'object_path': 3}

Place = tuple[float, float]
Way = tuple[Place, ...]
"""Places of the tip's centre between which it goes straight [m], two or more."""


class Push(NamedTuple):
    """A measured push."""

    name: str  #: where it was found
    begin: Pose  #: of the object's frame
    end: Pose  #: the same
    way: Way  #: of the tip's centre [m]
    tip_radius: float  #: [m]
    #: mean force on the object over the last part of the contact [N]
    force: Place | None = None
    turn: float = 0.0  #: by how much the tip's disk turns on the way, evenly [rad]


class Bad(NamedTuple):
    """A record that is left out."""

    name: str  #: where it was found
    reason: str  #: why


@dataclass(frozen=True)
class Pushes:
    """Measured pushes of one object."""

    outline: Outline
    pushes: tuple[Push, ...]
    support: Support | None = None  #: if it is known
    bad: tuple[Bad, ...] = ()  #: records that are none

    def of(self, chosen: Sequence[int]) -> 'Pushes':
        """Return some of the pushes, by their indices."""
        return replace(self, pushes=tuple(self.pushes[k] for k in chosen))


def pushes_of(content: dict[str, Any], file: Path, known: ObjectFile | None = None) -> Pushes:
    """Read pushes from the content of a file.

    Parameters
    ----------
    content : dict
        The content.
    file : Path
        The file, for what is said of it.
    known : ObjectFile, optional
        The object, whose outline and support take the place of the file's.

    Returns
    -------
    Pushes
        The pushes. Records that are none are named.

    Raises
    ------
    ValueError
        If the file has another form, or a support that cannot carry the weight.
    """
    thing = known or object_of(content, file)
    try:
        (radius,) = _numbers('tip_radius', [content.get('tip_radius')], 1)
        if not radius > 0.0:
            raise ValueError(f'tip_radius: expected a positive length [m], got {radius}')
        records = content.get('pushes')
        if not (isinstance(records, list) and records):
            raise ValueError(f'pushes: expected a list of pushes, got {reprlib.repr(records)}')
        if thing.support is not None:  # must be under the object and carry its weight
            Slider.on(thing.outline, thing.support, centre_of_mass=thing.centre_of_mass)
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None
    pushes: list[Push] = []
    bad = []
    for k, record in enumerate(records):
        name = f'{file}: pushes[{k}]'
        try:
            pushes += _pushes_in(name, record, radius)
        except ValueError as error:
            bad.append(Bad(name, str(error)))
    return Pushes(thing.outline, tuple(pushes), thing.support, tuple(bad))


def cut(
    name: str,
    tip: Sequence[Place],
    poses: Sequence[Pose],
    tip_radius: float,
    psi: Sequence[float] | None = None,
) -> Iterator[Push]:
    """Cut a long push into short ones.

    Parameters
    ----------
    name : str
        Where the push was found.
    tip : sequence of tuple of float
        Places of the tip's centre in their order [m].
    poses : sequence of Pose
        Poses of the object at the same moments.
    tip_radius : float
        Radius of the tip [m].
    psi : sequence of float, optional
        Directions of the tip at the same moments [rad]; by default it does not turn.

    Yields
    ------
    Push
        A push in which the tip comes `CUT` or a little further; the rest is left out.
    """
    first, way = 0, tip[:1]
    for k, place in enumerate(tip):
        if math.dist(way[-1], place) < STRAIGHT:
            continue
        way = [*way, place]
        if math.dist(way[0], place) >= CUT:
            turn = 0.0 if psi is None else math.remainder(psi[k] - psi[first], math.tau)
            part = f'{name}, {first} to {k}'
            yield Push(part, poses[first], poses[k], tuple(way), tip_radius, turn=turn)
            first, way = k, [place]


def _pushes_in(name: str, record: Any, radius: float) -> list[Push]:
    if not isinstance(record, dict):
        raise ValueError(f'expected an object, got {reprlib.repr(record)}')
    if not PATHS.keys().isdisjoint(record):
        tip, poses = (_rows(key, record.get(key), count) for key, count in PATHS.items())
        if len(tip) != len(poses):
            raise ValueError(
                f'object_path: expected {len(tip)} poses as tip_path has places, got {len(poses)}'
            )
        return list(cut(name, tip, [Pose(*pose) for pose in poses], radius))
    tip_start, tip_end, start, end = (
        _numbers(key, record.get(key), count) for key, count in PLACES.items()
    )
    force = None
    if 'force' in record:
        f_x, f_y = _numbers('force', record['force'], 2)
        force = f_x, f_y
    way = (tip_start[0], tip_start[1]), (tip_end[0], tip_end[1])
    return [Push(name, Pose(*start), Pose(*end), way, radius, force)]


def _rows(key: str, value: Any, count: int) -> list[Any]:
    if not (isinstance(value, list) and len(value) > 1):
        raise ValueError(f'{key}: expected a list of two or more, got {reprlib.repr(value)}')
    return [_numbers(f'{key}[{k}]', row, count) for k, row in enumerate(value)]


def _numbers(name: str, value: Any, count: int) -> tuple[float, ...]:
    if not (are_numbers(value) and len(value) == count):
        what = 'a finite number' if count == 1 else f'{count} finite numbers'
        raise ValueError(f'{name}: expected {what}, got {reprlib.repr(value)}')
    return tuple(map(float, value))


def merged(parts: Sequence[Pushes]) -> Pushes:
    """Return the pushes of several sources as those of one object.

    Parameters
    ----------
    parts : sequence of Pushes
        The pushes, one part or more.

    Returns
    -------
    Pushes
        All of them.

    Raises
    ------
    ValueError
        If they are of several objects.
    """
    first = parts[0]
    for part in parts[1:]:
        for name, one, other in (
            ('outline', first.outline.pieces, part.outline.pieces),
            ('support', _rows_of(first.support), _rows_of(part.support)),
        ):
            if one.shape != other.shape or not np.allclose(one, other, rtol=0.0, atol=ALIKE):
                raise ValueError(f'{name}: expected the same in all DATA, got others')
    pushes = tuple(push for part in parts for push in part.pushes)
    return replace(first, pushes=pushes, bad=tuple(bad for part in parts for bad in part.bad))


def _rows_of(support: Support | None) -> Array:
    """Return points of a support and their shares of the load."""
    if support is None:
        return np.empty((0, 3))
    return np.column_stack([support.points, support.loads / support.f_max])
