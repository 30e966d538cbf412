# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What must never be heard, whatever the fault."""

import bisect
import math
import time
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from tactile_push.testing import field, seconds

from .messages import stamp_of
from .proxy import Sent

if TYPE_CHECKING:
    from .finger import Finger

MAX_SPEED = 0.02  # [m/s]
MAX_STEP = 0.05 * 0.1  # max_acceleration times the control period [m/s]
MAX_JOINT_SPEED = 2.0  # [rad/s]
GAP = 0.06  # of three periods of the sensor [s]
OLDEST = 0.3  # a reading that is stamped so much later than it was sent is old [s]


def wrong_commands(velocities: Sequence[float], before: float = 0.0) -> list[str]:
    """Find commands that are no finite number, too fast or a kick; a stop is no kick.

    Parameters
    ----------
    velocities : sequence of float
        The commands [m/s].
    before : float, optional
        The command before the first of them [m/s].

    Returns
    -------
    list of str
        What is wrong.
    """
    found = []
    for v_x in velocities:
        if not math.isfinite(v_x):
            found.append(f'command of {v_x}')
            continue
        if abs(v_x) > MAX_SPEED:
            found.append(f'command of {1000.0 * v_x:.1f} mm/s')
        if v_x != 0.0 and abs(v_x - before) > MAX_STEP + 1e-9:
            found.append(f'step of {1000.0 * (v_x - before):.1f} mm/s')
        before = v_x
    return found


def wrong_velocities(velocities: Iterable[Sequence[float]]) -> list[str]:
    """Find velocities of joints that are no finite numbers or too fast.

    Parameters
    ----------
    velocities : iterable of sequence of float
        The velocities of both joints [rad/s].

    Returns
    -------
    list of str
        What is wrong.
    """
    return [
        f'joint velocities of {list(rates)}'
        for rates in velocities
        if len(rates) != 2 or not all(abs(rate) <= MAX_JOINT_SPEED for rate in rates)
    ]


def wrong_readings(
    readings: Iterable[tuple[float, int, float, float]],
    sent: dict[int, Sent],
    known: set[int],
    oldest: float = OLDEST,
) -> list[str]:
    """Find readings that nobody sent, that came twice or that are older than their stamp says.

    Parameters
    ----------
    readings : iterable of tuple
        Stamp on the steady clock [s], number, azimuth and elevation [rad] of each.
    sent : dict of int to Sent
        What the device has sent, by number.
    known : set of int
        Numbers that have come already; those that come are added.
    oldest : float, optional
        How much later than it was sent a reading may be stamped [s].

    Returns
    -------
    list of str
        What is wrong.
    """
    found = []
    for stamp, number, azimuth, elevation in readings:
        origin = sent.get(number)
        if origin is None or not (
            math.isclose(origin.reading.azimuth, azimuth, abs_tol=1e-5)
            and math.isclose(origin.reading.elevation, elevation, abs_tol=1e-5)
        ):
            found.append(f'reading {number} that was never sent')
        elif number in known:
            found.append(f'reading {number} twice')
        elif stamp - origin.at > oldest:
            found.append(f'reading {1000.0 * (stamp - origin.at):.0f} ms old stamped as new')
        known.add(number)
    return found


class Watch:
    """Looks at all that is heard of a finger, each message once.

    Parameters
    ----------
    finger : Finger
        The finger.
    aged : bool
        Whether the nodes' clock is the system's, so that ages can be told.
    """

    def __init__(self, finger: 'Finger', aged: bool) -> None:
        self._finger = finger
        self._oldest = OLDEST if aged else math.inf
        self._commands = self._readings = self._contacts = self._velocities = 0
        self._v_x = 0.0
        self._numbers: set[int] = set()
        self._stamps: set[tuple[int, int]] = set()
        self._used: set[tuple[int, int]] = set()

    def complaints(self) -> list[str]:
        """Return what is wrong with the messages heard since the last time."""
        finger = self._finger
        offset = time.time() - time.monotonic()
        velocities = [
            h.twist.linear.x
            for h in finger.commands[self._commands :]
            if stamp_of(h) not in finger.foreign
        ]
        self._commands = len(finger.commands)
        found = wrong_commands(velocities, self._v_x)
        self._v_x = velocities[-1] if velocities else self._v_x
        rates = [m.data for m in finger.velocities[self._velocities :]]
        self._velocities = len(finger.velocities)
        found += wrong_velocities(rates)
        tactile = finger.tactile[self._readings :]
        self._readings = len(finger.tactile)
        self._stamps.update(map(stamp_of, tactile))
        found += wrong_readings(
            [
                (
                    seconds(m) - offset,
                    int(m.effort[2]),
                    field(m, 'azimuth'),
                    field(m, 'elevation'),
                )
                for m in tactile
                if finger.is_numbered
                and stamp_of(m) not in finger.foreign
                and math.isfinite(m.effort[2])
            ],
            finger.proxy.sent,
            self._numbers,
            self._oldest,
        )
        stamps = [stamp_of(m) for m in finger.contacts[self._contacts :]]
        found += wrong_contacts(
            [stamp for stamp in stamps if stamp not in finger.foreign],
            self._stamps,
            self._used,
        )
        self._contacts = len(finger.contacts)
        prefix = f'{finger.namespace}: ' if finger.namespace else ''
        return [prefix + complaint for complaint in summary(found)]


def wrong_contacts(
    contacts: Iterable[tuple[int, int]], readings: set[tuple[int, int]], known: set[tuple[int, int]]
) -> list[str]:
    """Find contacts that come twice from a reading or from none.

    Readings of a driver that has just started may be heard by the geometry and not yet here, so
    only a stamp between those of two readings heard shortly one after the other is sure to belong
    to none.

    Parameters
    ----------
    contacts : iterable of tuple
        Stamps [s, ns].
    readings : set of tuple
        Stamps of the readings so far [s, ns].
    known : set of tuple
        Stamps of contacts that have come already; those that come are added.

    Returns
    -------
    list of str
        What is wrong.
    """
    found = []
    order = sorted(readings)
    for stamp in contacts:
        if stamp in known:
            found.append('two contacts with one stamp')
        elif stamp not in readings:
            place = bisect.bisect(order, stamp)
            before, after = order[place - 1 : place], order[place : place + 1]
            if before and after and _apart(before[0], after[0]) < GAP:
                found.append('contact without a reading')
        known.add(stamp)
    return found


def _apart(before: tuple[int, int], after: tuple[int, int]) -> float:
    return after[0] - before[0] + (after[1] - before[1]) * 1e-9


def summary(found: Sequence[str], most: int = 3) -> list[str]:
    """Shorten a long list."""
    rest = len(found) - most
    return [*found[:most], f'and {rest} more of the kind'] if rest > 0 else list(found)
