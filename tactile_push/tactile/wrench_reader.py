# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the wrenches of a force/torque sensor under the finger tip to readings."""

import math
from collections import deque
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.hemisphere import ReadingRejectedError
from tactile_push.tactile.reading import NO_CONTACT, NotUntouchedError, Reading
from tactile_push.tactile.wrench import LEAST_FORCE, MOST_FORCE, axes_of_rpy, contact_of_wrench

LEAST_OF_A_TARE = 10  # wrenches within its time; a slower sensor is of no use anyway; picked
NOT_TARED = 'not tared'
ANOTHER_FRAME = 'another frame'
GAP = 'too long after the one before'
TORSION = 'torsion'
BEHIND = 'contact behind the tip'
NOT_FINITE, SATURATED, NOT_NEWER = 'not finite', 'saturated', 'not newer'
WRENCH_REFUSALS = (  # why a wrench is refused
    NOT_TARED,
    ANOTHER_FRAME,
    GAP,
    TORSION,
    BEHIND,
    NOT_FINITE,
    SATURATED,
    NOT_NEWER,
)

Vector = npt.NDArray[np.float64]


@dataclass(frozen=True)
class WrenchSensing:
    """How a hemispherical tip sits on a force/torque sensor, and which of its wrenches to believe.

    Raises
    ------
    ValueError
        If a number is not finite or out of its range, or the forces are in the wrong order.
    """

    radius: float  #: of the hemisphere [m]
    #: where the tip's frame is in the sensor's: its origin, which is the hemisphere's centre [m]
    xyz: tuple[float, ...]
    rpy: tuple[float, ...]  #: its roll, pitch and yaw, as in a URDF [rad]
    reaction: bool = False  #: whether wrenches are what the tip exerts; else what acts on it
    contact_force: float = 0.2  #: from this force on the tip touches [N]
    release_force: float = 0.1  #: below this force it touches no more [N]
    time_constant: float = 0.02  #: of the filter, a lag of first order [s]; 0 for none
    max_torsion: float = 0.005  #: greatest moment that a contact leaves unexplained [N m]
    max_gap: float = 0.05  #: longest time between two wrenches [s]
    max_rate: float = 100.0  #: of readings [Hz]; wrenches between them only go into the filter
    force_range: float = math.inf  #: a component of this size is saturated [N]
    moment_range: float = math.inf  #: the same of the moment [N m]
    tare_time: float = 0.5  #: the last wrenches of so long make a tare [s]
    frame: str = ''  #: in which wrenches come; '' for that of the tare

    def __post_init__(self) -> None:
        for name in ('xyz', 'rpy'):
            value = getattr(self, name)
            if len(value) != 3 or not all(map(math.isfinite, value)):
                raise ValueError(f'{name}: expected three finite numbers, got {list(value)}')
        for name in ('radius', 'max_torsion', 'max_gap', 'max_rate', 'tare_time'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')
        if not 0.0 <= self.time_constant < math.inf:
            raise ValueError(f'time_constant: expected 0 or more [s], got {self.time_constant}')
        for name in ('force_range', 'moment_range'):
            if not getattr(self, name) > 0.0:
                raise ValueError(f'{name}: expected more than 0, got {getattr(self, name)}')
        if not LEAST_FORCE <= self.release_force <= self.contact_force <= MOST_FORCE:
            raise ValueError(
                f'release_force: expected a positive force up to contact_force '
                f'({self.contact_force} N), got {self.release_force} N'
            )

    @cached_property
    def ranges(self) -> Vector:
        """Sizes from which on the components of force and moment are saturated, shape (6,)."""
        return np.minimum([self.force_range] * 3 + [self.moment_range] * 3, MOST_FORCE)

    @cached_property
    def axes(self) -> Vector:
        """The tip's axes in the sensor's frame, the columns of shape (3, 3)."""
        return axes_of_rpy(self.rpy)


@dataclass(frozen=True)
class Touch:
    """What a wrench tells."""

    reading: Reading  #: the contact; `NO_CONTACT` if nothing touches
    tangential_force: float  #: along the tip's surface [N]; NaN without contact
    torsion: float  #: moment that no force at the contact explains [N m]; NaN without contact
    age: float  #: by how much it is older than the wrench, as the filter delays it [s]


class WrenchReader:
    """Reads contacts off wrenches, which it tares and filters.

    The filter is an exponentially weighted mean of the wrenches and of their times, so each reading
    knows its age. A contact begins and ends at two different forces, so noise does not make it
    flicker. A tare is the mean of the last wrenches.

    Parameters
    ----------
    sensing : WrenchSensing
        The tip and what to believe. It may be replaced at any time.
    needs_tare : bool, optional
        Whether wrenches are refused until there is a tare; a sensor that tares itself needs none.
    """

    def __init__(self, sensing: WrenchSensing, needs_tare: bool = True) -> None:
        self.sensing = sensing
        self._tare: Vector | None = None if needs_tare else np.zeros(6)
        self._frame: str | None = None  # of the tare, or of the first wrench if none is needed
        self._recent: deque[tuple[float, str, Vector]] = deque()  # time, frame, as it came
        self._filtered: Vector | None = None
        self._filtered_time = math.nan
        self._time = -math.inf  # of the last wrench [s]
        self._next = -math.inf  # when the next reading is due [s]
        self._touches = False
        self._free_since = math.nan  # since when nothing touches [s]
        self.gap = math.nan  #: time between the last two wrenches [s]

    @property
    def tared(self) -> bool:
        """Whether there is a tare, or none is needed."""
        return self._tare is not None

    @property
    def force(self) -> float:
        """Size of the filtered force [N]; NaN before the first."""
        return math.nan if self._filtered is None else math.hypot(*self._filtered[:3])

    @property
    def drift(self) -> float:
        """Force that the tare leaves in the air, as a mean over `tare_time` [N].

        It is NaN unless nothing has touched the tip for so long.
        """
        if self._tare is None or not self._time - self._free_since >= self.sensing.tare_time:
            return math.nan
        mean = np.mean([wrench[:3] for _, _, wrench in self._recent], axis=0) - self._tare[:3]
        return math.hypot(*mean)

    def restart(self) -> None:
        """Forget the wrenches, but not the tare."""
        self._recent.clear()
        self._filtered = None
        self._time = self._next = -math.inf
        self._touches, self._free_since = False, math.nan

    def touch(
        self, time: float, frame: str, force: npt.ArrayLike, moment: npt.ArrayLike
    ) -> Touch | None:
        """Take a wrench.

        A wrench that is older than the last one by more than `max_gap` tells that the clock was
        set, and counts as the first one.

        Parameters
        ----------
        time : float
            When it was measured [s].
        frame : str
            The sensor's frame.
        force, moment : array_like, shape (3,)
            In the sensor's axes and about its origin [N, N m].

        Returns
        -------
        Touch or None
            What it tells; None if no reading is due.

        Raises
        ------
        ReadingRejectedError
            If it tells nothing; the message is one of `WRENCH_REFUSALS`.
        """
        wrench = np.array([*np.asarray(force, float), *np.asarray(moment, float)])
        self._check(time, frame, wrench)
        self.gap, self._time = time - self._time, time
        self._remember(time, frame, wrench)
        if self.gap > self.sensing.max_gap:
            self._filtered = None
        if self._tare is None:
            raise ReadingRejectedError(NOT_TARED)
        if self._frame is None:
            self._frame = frame
        self._filter(time, wrench - self._tare)
        if self.sensing.max_gap < self.gap < math.inf:
            raise ReadingRejectedError(GAP)
        return self._felt()

    def tare(self) -> None:
        """Take the mean of the last wrenches for that of a tip that touches nothing.

        Raises
        ------
        NotUntouchedError
            If the tip is in contact, or there are too few wrenches, of several frames, or such that
            change too much.
        """
        if self._touches:
            raise NotUntouchedError(
                f'in contact with {self.force:.2f} N; lift the finger, or clean the node up and '
                'configure it anew if nothing touches it'
            )
        wrenches = np.array([wrench for _, _, wrench in self._recent])
        if len(wrenches) < LEAST_OF_A_TARE:
            raise NotUntouchedError(
                f'expected {LEAST_OF_A_TARE} wrenches within {self.sensing.tare_time:g} s, '
                f'got {len(wrenches)}'
            )
        frames = {frame for _, frame, _ in self._recent}
        if len(frames) > 1:
            raise NotUntouchedError(f'expected wrenches in one frame, got {sorted(frames)}')
        spread = float(np.sqrt(wrenches[:, :3].var(axis=0).sum()))
        if spread > self.sensing.release_force:
            raise NotUntouchedError(
                f'the force varies by {spread:.2f} N, more than release_force; hold the finger '
                'still, or raise release_force if that is the noise'
            )
        self._tare, self._frame = wrenches.mean(axis=0), frames.pop()
        self._filtered = None
        self._free_since = self._time

    def _check(self, time: float, frame: str, wrench: Vector) -> None:
        """Refuse what must not even be remembered."""
        if not (np.isfinite(wrench).all() and math.isfinite(time)):
            raise ReadingRejectedError(NOT_FINITE)
        expected = self.sensing.frame or self._frame
        if expected is not None and frame != expected:
            raise ReadingRejectedError(ANOTHER_FRAME)
        if (np.abs(wrench) >= self.sensing.ranges).any():
            raise ReadingRejectedError(SATURATED)
        if time < self._time - self.sensing.max_gap:
            self.restart()
        elif time <= self._time:
            raise ReadingRejectedError(NOT_NEWER)

    def _remember(self, time: float, frame: str, wrench: Vector) -> None:
        self._recent.append((time, frame, wrench))
        while time - self._recent[0][0] > self.sensing.tare_time:
            self._recent.popleft()

    def _filter(self, time: float, wrench: Vector) -> None:
        if self._filtered is None:
            self._filtered, self._filtered_time = wrench, time
            return
        tau = self.sensing.time_constant
        share = -math.expm1(-self.gap / tau) if tau > 0.0 else 1.0
        self._filtered = self._filtered + share * (wrench - self._filtered)
        self._filtered_time += share * (time - self._filtered_time)

    def _felt(self) -> Touch | None:
        """Return what the filtered wrench tells, if a reading is due."""
        assert self._filtered is not None
        p, age = self.sensing, self._time - self._filtered_time
        touched = self._touches
        self._touches = self.force >= (p.release_force if touched else p.contact_force)
        if self._touches:
            self._free_since = math.nan
        elif touched or math.isnan(self._free_since):
            self._free_since = self._time
        if self._time < self._next:
            return None
        self._next = max(self._next, self._time - 1.0 / p.max_rate) + 1.0 / p.max_rate
        if not self._touches:
            return Touch(NO_CONTACT, math.nan, math.nan, age)
        to_tip = p.axes.T * (-1.0 if p.reaction else 1.0)
        found = contact_of_wrench(
            *(to_tip @ self._filtered[:3], to_tip @ self._filtered[3:]),
            *(p.axes.T @ np.array(p.xyz), p.radius),
        )
        if abs(found.torsion) > p.max_torsion:
            raise ReadingRejectedError(TORSION)
        if found.reading.elevation < 0.0:
            raise ReadingRejectedError(BEHIND)
        return Touch(found.reading, found.tangential_force, found.torsion, age)
