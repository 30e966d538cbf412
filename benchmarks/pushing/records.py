# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files of measured pushes."""

import json
import reprlib
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tactile_push.mechanics import Outline, Pose, Support
from tactile_push.simulation import read_object

PLACES = {'tip_start': 2, 'tip_end': 2, 'object_start': 3, 'object_end': 3}
FORCE_SHARE = 0.6  # of the time in contact, its end, over which a measured force is the mean
Way = tuple[tuple[float, float], tuple[float, float]]  # start and end [m]


@dataclass(frozen=True)
class Pushes:
    """A file of measured pushes."""

    name: str
    outline: Outline
    tip_radius: float
    starts: list[Pose]
    ends: list[Pose]
    ways: list[Way]
    published: dict[str, Any]
    support: Support | None  # if the file has it
    #: mean forces on the object over `FORCE_SHARE` of the contact [N], if every push has one
    forces: np.ndarray | None


def read_pushes(file: Path) -> Pushes:
    """Read a file of pushes."""
    thing = read_object(file)
    outline, centre_of_mass = thing.outline, thing.centre_of_mass
    content = json.loads(file.read_text())
    try:
        radius = _numbers('tip_radius', [content.get('tip_radius')], 1)[0]
        if not radius > 0.0:
            raise ValueError(f'tip_radius: expected a positive length [m], got {radius}')
        pushes = content.get('pushes')
        if not isinstance(pushes, list) or len(pushes) < 2:
            raise ValueError(f'pushes: expected a list of two or more, got {reprlib.repr(pushes)}')
        rows: dict[str, list[tuple[float, ...]]] = {key: [] for key in PLACES}
        for k, push in enumerate(pushes):
            for key, count in PLACES.items():
                value = push.get(key) if isinstance(push, dict) else None
                rows[key].append(_numbers(f'pushes[{k}]: {key}', value, count))
        support = None
        if 'support' in content:
            centre = centre_of_mass or Support.uniform(outline, 1).centre
            support = _support(content['support'], centre)
        forces = None
        if any('force' in push for push in pushes):
            forces = np.array(
                [
                    _numbers(f'pushes[{k}]: force', push.get('force'), 2)
                    for k, push in enumerate(pushes)
                ]
            )
        published = content.get('published', {})
        if 'object_did_not_move_baseline' in content and isinstance(published, dict):
            published = published | {'object did not move': content['object_did_not_move_baseline']}
        if not isinstance(published, dict) or not all(map(_are_errors, published.values())):
            raise ValueError(
                'published: expected an object of errors for every model, got '
                f'{reprlib.repr(published)}'
            )
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None
    return Pushes(
        file.stem,
        outline,
        radius,
        [Pose(*pose) for pose in rows['object_start']],
        [Pose(*pose) for pose in rows['object_end']],
        list(zip(rows['tip_start'], rows['tip_end'], strict=True)),
        published,
        support,
        forces,
    )


def _support(content: Any, centre_of_mass: tuple[float, float]) -> Support:
    """Read points with their loads, or with those of statics."""
    if not (isinstance(content, dict) and isinstance(content.get('points'), list)):
        raise ValueError(f'support: expected points and loads, got {reprlib.repr(content)}')
    points = [_numbers('support: points', point, 2) for point in content['points']]
    if 'loads' not in content:
        return Support.at_points(points).carrying(centre_of_mass)
    return Support.at_points(points, _numbers('support: loads', content['loads'], len(points)))


def _are_errors(errors: Any) -> bool:
    return isinstance(errors, dict) and all(map(_is_number, errors.values()))


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and abs(value) <= sys.float_info.max


def _numbers(name: str, value: Any, count: int) -> tuple[float, ...]:
    if not (isinstance(value, list) and len(value) == count and all(map(_is_number, value))):
        what = 'a finite number' if count == 1 else f'{count} finite numbers'
        raise ValueError(f'{name}: expected {what}, got {reprlib.repr(value)}')
    return tuple(map(float, value))
