# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches of touches at known places, in a bag."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tactile_push.bags import BagReader
from tactile_push.bags.fields import NUMBER, TEXT
from tactile_push.calibration.bag_touches import (
    check_count,
    only_frame,
    only_topic,
    touches_in_order,
)
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.interface import WRENCH_TYPE
from tactile_push.tactile.sphere import Array
from tactile_push.tactile.wrench_reader import LEAST_OF_A_TARE, WrenchSensing

PRESSED = 0.5  # of a touch's greatest force: weaker wrenches of it do not count
NUMBERS = [f'wrench.{part}.{axis}' for part in ('force', 'torque') for axis in 'xyz']
FIELDS = {'header.frame_id': TEXT, **dict.fromkeys(NUMBERS, NUMBER)}


@dataclass(frozen=True)
class TouchWrenches:
    """The mean wrench of each touch, less that of the untouched tip."""

    forces: Array  #: in the sensor's axes, shape (n, 3) [N]
    moments: Array  #: about its origin, shape (n, 3) [N m]
    touches: list[KnownTouch]  #: where each is
    frame: str  #: of the sensor; '' if it has none


def wrenches_in_bag(bag: BagReader, table: Path) -> TouchWrenches:
    """Read wrenches from a bag: first of the untouched tip, then of one touch after the other.

    Parameters
    ----------
    bag : BagReader
        A bag with one topic of geometry_msgs/WrenchStamped.
    table : Path
        The touches in their order.

    Returns
    -------
    TouchWrenches
        The wrenches.

    Raises
    ------
    ValueError
        If the bag has no topic of wrenches or several, or another number of touches than the table.
    OSError
        If the table cannot be read.
    """
    touches = touches_in_order(table)
    times, wrenches, frame = _wrenches(bag)
    untouched = (
        wrenches[times - times[0] <= WrenchSensing.tare_time * 1e9] if len(times) else wrenches
    )
    if len(untouched) < LEAST_OF_A_TARE:
        raise ValueError(
            f'expected {LEAST_OF_A_TARE} wrenches of the untouched tip in the first '
            f'{WrenchSensing.tare_time:g} s, got {len(untouched)}'
        )
    wrenches = wrenches - untouched.mean(axis=0)
    found = [_pressed(part) for part in _parts(wrenches) if len(part) >= LEAST_OF_A_TARE]
    check_count(table, touches, len(found))
    means = np.reshape([part.mean(axis=0) for part in found], (-1, 6))
    return TouchWrenches(means[:, :3], means[:, 3:], touches, frame)


def wrench_of(content: Any) -> list[float]:
    """Return the numbers of a message.

    Parameters
    ----------
    content : object
        A geometry_msgs/WrenchStamped.

    Returns
    -------
    list of float
        Force and moment in the sensor's axes, three each [N, N m].
    """
    parts = content.wrench.force, content.wrench.torque
    return [getattr(part, axis) for part in parts for axis in 'xyz']


def _wrenches(bag: BagReader) -> tuple[Array, Array, str]:
    """Return log times [ns], wrenches, shape (n, 6), and their frame."""
    topic = only_topic(bag, {WRENCH_TYPE: FIELDS}, 'wrenches')
    times, wrenches = [], []
    frames = set()
    for message in bag.messages([topic.name]):
        times.append(message.log_time)
        content = bag.decode(message)
        wrenches.append(wrench_of(content))
        frames.add(content.header.frame_id)
    values = np.reshape(np.array(wrenches, float), (-1, 6))
    if not np.isfinite(values).all():
        raise ValueError(f'{topic.name}: a wrench is not finite')
    return np.array(times, float), values, only_frame(frames)


def _parts(wrenches: Array) -> Iterator[Array]:
    """Yield the wrenches of each touch."""
    force = np.linalg.norm(wrenches[:, :3], axis=1)
    begin = None
    for number, size in enumerate(force):
        if begin is None and size >= WrenchSensing.contact_force:
            begin = number
        elif begin is not None and size < WrenchSensing.release_force:
            yield wrenches[begin:number]
            begin = None
    if begin is not None:
        yield wrenches[begin:]


def _pressed(part: Array) -> Array:
    force = np.linalg.norm(part[:, :3], axis=1)
    return part[force >= PRESSED * force.max()]
