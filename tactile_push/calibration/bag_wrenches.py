# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches of touches at known places, in a bag."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tactile_push.bags import BagReader
from tactile_push.bags.fields import NUMBER
from tactile_push.calibration.touch_table import KnownTouch, read_table
from tactile_push.interface import WRENCH_TYPE
from tactile_push.tactile.sphere import Array

CONTACT_FORCE, RELEASE_FORCE = 0.2, 0.1  # at which a touch begins and ends [N]
TARE_TIME = 0.5  # of the untouched tip at the beginning [s]
LEAST = 10  # wrenches of the untouched tip, and of a touch; picked
PRESSED = 0.5  # of a touch's greatest force: weaker wrenches of it do not count
FIELDS = {f'wrench.{part}.{axis}': NUMBER for part in ('force', 'torque') for axis in 'xyz'}


@dataclass(frozen=True)
class TouchWrenches:
    """The mean wrench of each touch, less that of the untouched tip."""

    forces: Array  #: in the sensor's axes, shape (n, 3) [N]
    moments: Array  #: about its origin, shape (n, 3) [N m]
    touches: list[KnownTouch]  #: where each is


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
    touches = [touch for touch in read_table(table) if touch.touched]
    times, wrenches = _wrenches(bag)
    untouched = wrenches[times - times[0] <= TARE_TIME * 1e9] if len(times) else wrenches
    if len(untouched) < LEAST:
        raise ValueError(
            f'expected {LEAST} wrenches of the untouched tip in the first {TARE_TIME:g} s, got '
            f'{len(untouched)}'
        )
    wrenches = wrenches - untouched.mean(axis=0)
    found = [_pressed(part) for part in _parts(wrenches) if len(part) >= LEAST]
    if len(found) != len(touches):
        raise ValueError(
            f'{table}: expected {len(found)} touches as in the bag, got {len(touches)}'
        )
    means = np.reshape([part.mean(axis=0) for part in found], (-1, 6))
    return TouchWrenches(means[:, :3], means[:, 3:], touches)


def _wrenches(bag: BagReader) -> tuple[Array, Array]:
    """Return log times [ns] and wrenches, shape (n, 6)."""
    topics = [topic for topic in bag.topics.values() if topic.type_name == WRENCH_TYPE]
    if len(topics) != 1:
        names = ', '.join(topic.name for topic in topics) or 'none'
        raise ValueError(f'expected one topic of wrenches, got {names}')
    if trouble := topics[0].trouble(FIELDS):
        raise ValueError(trouble)
    times, wrenches = [], []
    for message in bag.messages([topics[0].name]):
        wrench = bag.decode(message).wrench
        times.append(message.log_time)
        parts = wrench.force, wrench.torque
        wrenches.append([getattr(part, axis) for part in parts for axis in 'xyz'])
    values = np.reshape(np.array(wrenches, float), (-1, 6))
    if not np.isfinite(values).all():
        raise ValueError(f'{topics[0].name}: a wrench is not finite')
    return np.array(times, float), values


def _parts(wrenches: Array) -> Iterator[Array]:
    """Yield the wrenches of each touch."""
    force = np.linalg.norm(wrenches[:, :3], axis=1)
    begin = None
    for number, size in enumerate(force):
        if begin is None and size >= CONTACT_FORCE:
            begin = number
        elif begin is not None and size < RELEASE_FORCE:
            yield wrenches[begin:number]
            begin = None
    if begin is not None:
        yield wrenches[begin:]


def _pressed(part: Array) -> Array:
    force = np.linalg.norm(part[:, :3], axis=1)
    return part[force >= PRESSED * force.max()]
