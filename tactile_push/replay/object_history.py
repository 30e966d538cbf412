# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From single control periods to what the whole bag tells of an object."""

import math
import typing
from array import array
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tactile_push.control import PUSHING
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.paper import PaperFigures, paper_figures
from tactile_push.pipeline import Stamp
from tactile_push.replay.comparison import SensedTick
from tactile_push.replay.messages import nanoseconds
from tactile_push.report.merit import known_step

if typing.TYPE_CHECKING:
    from tactile_push.pipeline import Sensed

BOUNDS = ('d_lower', 'd_upper', 'd_least', 'd_most')
ROUNDING = 1e-9  # of a length [m], far below any length that matters


@dataclass(frozen=True)
class Contradiction:
    """A time during which the readings contradicted the object."""

    reason: str  #: one of `CONTRADICTIONS`
    at: float  #: when it began [s], from the start of the bag
    duration: float  #: [s]; up to the last control period if it did not end in the bag
    ended: bool


@dataclass(frozen=True)
class Forgotten:
    """A moment at which everything was forgotten."""

    reason: str
    at: float  #: [s], from the start of the bag


@dataclass(frozen=True)
class ObjectFigures:
    """What a bag tells about an object."""

    finger: str  #: namespace of the finger that pushed it, '' for the root
    object_told: bool  #: whether somebody named the object; otherwise it is the paper's block
    ticks: list[SensedTick]  #: what each control period told of d
    readings: int  #: that were taken
    values: dict[str, float] | None  #: last `active_sensing/state` with anything known
    at: float | None  #: when that was [s], from the start of the bag
    known_step: int | None  #: step from which d stayed known to 2 mm
    contradictions: list[Contradiction]  #: between the readings and the object
    forgotten: list[Forgotten]  #: moments at which everything was forgotten
    compared: int  #: control periods with anything known and with a simulator's true d
    inside: float | None  #: share of them with the true d in the 95 % interval
    inside_guaranteed: float | None  #: share of them with the true d in the guaranteed bounds
    paper: PaperFigures | None  #: what the paper publishes of the same experiment


class ObjectHistory:
    """Takes one control period after the other.

    `start` is the first log time of the bag [ns]. `pushed` is the object of the paper that the
    finger pushes, `OTHER` if it is none; `object_told` says whether somebody named the object.
    """

    def __init__(self, finger: str, start: int, object_told: bool, pushed: str) -> None:
        self._finger = finger
        self._start = start
        self._object_told = object_told
        self._pushed = pushed
        self._theta_desired = math.nan
        self._ticks: list[SensedTick] = []
        self._ages = array('d')  # of the readings [s]; NaN where nothing is known
        self._steps = array('d')  # control periods in which the law acted [s]
        self._readings = 0
        self._last: tuple[float, dict[str, float]] | None = None
        self._contradictions: list[Contradiction] = []
        self._since: tuple[float, int] | None = None  # when one began, and its kind
        self._forgotten: list[Forgotten] = []
        self._true_at, self._true_d = array('d'), array('d')

    def add(self, state: str, theta_desired: float, sensed: 'Sensed') -> None:
        """Take a control period with the controller's state, one of `STATES`, and goal [rad]."""
        at, values = self._seconds(sensed.stamp), sensed.values
        known = math.isfinite(values['d'])
        self._ticks.append(SensedTick.of(at, values))
        self._ages.append(values['age'] if known else math.nan)
        if state == PUSHING:
            self._steps.append(at)
            self._theta_desired = theta_desired
        self._readings += sensed.took
        if known:
            self._last = at, values
        if sensed.forgot:
            self._forgotten.append(Forgotten(sensed.forgot, at))
        contradiction = int(values['contradiction'])
        if self._since is not None and contradiction != self._since[1]:
            self._close_contradiction(at, ended=True)
        if contradiction and self._since is None:
            self._since = at, contradiction

    def truth(self, stamp: Stamp, values: Mapping[str, float]) -> None:
        """Take the numbers of a simulator's `ground_truth/state` at a time."""
        if 'd' in values:
            self._true_at.append(self._seconds(stamp))
            self._true_d.append(values['d'])

    def figures(self) -> ObjectFigures:
        """Evaluate what was taken; nothing more is taken after that."""
        if self._since is not None:
            self._close_contradiction(self._ticks[-1].time, ended=False)
        at, values = self._last or (None, None)
        compared, inside, inside_guaranteed = self._compare()
        return ObjectFigures(
            self._finger,
            self._object_told,
            self._ticks,
            self._readings,
            values,
            at,
            known_step(
                self._steps,
                (tick.time for tick in self._ticks),
                (tick.d_upper - tick.d_lower for tick in self._ticks),
            ),
            self._contradictions,
            self._forgotten,
            compared,
            inside,
            inside_guaranteed,
            paper_figures(self._theta_desired, self._pushed),
        )

    def _compare(self) -> tuple[int, float | None, float | None]:
        """Compare with the truth at the moments of the readings."""
        if not len(self._true_at):
            return 0, None, None
        read = np.array([tick.time for tick in self._ticks]) - np.array(self._ages)
        order = np.argsort(self._true_at, kind='stable')
        at, d = np.array(self._true_at)[order], np.array(self._true_d)[order]
        truth = np.interp(read, at, d, math.nan, math.nan)
        there = np.isfinite(truth)
        if not there.any():
            return 0, None, None
        lower, upper, least, most = (
            np.array([getattr(tick, name) for tick in self._ticks])[there] for name in BOUNDS
        )
        truth = truth[there]
        inside = np.mean((lower - ROUNDING <= truth) & (truth <= upper + ROUNDING))
        guaranteed = np.mean((least - ROUNDING <= truth) & (truth <= most + ROUNDING))
        return len(truth), float(inside), float(guaranteed)

    def _close_contradiction(self, end: float, *, ended: bool) -> None:
        assert self._since is not None
        at, kind = self._since
        self._contradictions.append(Contradiction(CONTRADICTIONS[kind], at, end - at, ended))
        self._since = None

    def _seconds(self, stamp: Stamp) -> float:
        return (nanoseconds(stamp) - self._start) * 1e-9
