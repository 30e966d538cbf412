# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the law would have commanded beside what was commanded."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from tactile_push.control import Tick
from tactile_push.pipeline import Felt


class ReplayedTick(NamedTuple):
    """A control period of the replay beside the recorded one, NaN where there is none.

    Parameters
    ----------
    time : float
        Since the beginning of the bag [s].
    theta, phi : float
        What the law used and gave [rad].
    v_x, v_x_recorded : float
        What it commands now, and what was commanded then [m/s].
    state, stop_reason : str
        As it is now.
    """

    time: float
    theta: float
    phi: float
    v_x: float
    v_x_recorded: float
    state: str
    stop_reason: str


class SensedTick(NamedTuple):
    """Where along the edge the finger was by one control period.

    Parameters
    ----------
    time : float
        Of the control period, since the beginning of the bag [s].
    d, d_lower, d_upper, d_least, d_most : float
        The contact, its 95 % interval and its guaranteed bounds at the last reading [m]; d is NaN
        if nothing is known.
    """

    time: float
    d: float
    d_lower: float
    d_upper: float
    d_least: float
    d_most: float

    @classmethod
    def of(cls, time: float, values: Mapping[str, float]) -> 'SensedTick':
        """Take what the numbers of `active_sensing/state` say of d at a time [s]."""
        return cls(time, *(values[name] for name in cls._fields[1:]))

    def as_json(self) -> dict[str, object]:
        """Give it as plain values, SI units; null where there is no number."""
        return {name: _plain(value) for name, value in self._asdict().items()}


@dataclass
class Comparison:
    """How the commands of a finger compare.

    Parameters
    ----------
    finger : str
        Its namespace, '' for the root.

    Attributes
    ----------
    ticks : list of ReplayedTick
        The control periods.
    kept : int
        Control periods at the bag's beginning that depend on what was before, kept as recorded.
    went_back : int
        How many of these have a stamp before that of the one before them.
    recorded : bool
        Whether the bag has control periods to compare with.
    readings, contacts : int
        Readings replayed, and contacts found in them.
    refused : dict of str to int
        Readings refused, by reason.
    without_effect : list of str
        Parameters that were wanted otherwise but that the bag decides, each with its node.
    sensed : list of SensedTick or None
        Where along the edge the finger was; None if the object was not sensed.
    """

    finger: str
    ticks: list[ReplayedTick] = field(default_factory=list)
    kept: int = 0
    went_back: int = 0
    recorded: bool = True
    readings: int = 0
    contacts: int = 0
    refused: dict[str, int] = field(default_factory=dict)
    without_effect: list[str] = field(default_factory=list)
    sensed: list[SensedTick] | None = None
    _last_kept: int = field(default=0, repr=False)  # its stamp [ns]

    def count(self, felt: Felt) -> None:
        """Count a reading."""
        self.readings += 1
        self.contacts += felt.contact is not None
        if felt.refusal:
            self.refused[felt.refusal] = self.refused.get(felt.refusal, 0) + 1

    def keep(self, stamp: int) -> None:
        """Count a control period that is kept as recorded, by its stamp [ns]."""
        self.kept += 1
        self.went_back += stamp < self._last_kept
        self._last_kept = stamp

    def add(self, time: float, tick: Tick, recorded: Tick | None) -> None:
        """Take a control period at a time [s], as it is now and as it was recorded."""
        self.recorded = recorded is not None
        self.ticks.append(
            ReplayedTick(
                time,
                tick.theta,
                tick.phi,
                _number(tick.v_x),
                _number(recorded.v_x) if recorded else math.nan,
                tick.state,
                tick.stop_reason,
            )
        )

    def different(self) -> list[ReplayedTick]:
        """Return the control periods whose command is not to the bit what was commanded."""
        if not self.recorded:
            return []
        return [
            tick
            for tick in self.ticks
            if tick.v_x != tick.v_x_recorded
            and not (math.isnan(tick.v_x) and math.isnan(tick.v_x_recorded))
        ]

    def as_json(self) -> dict[str, object]:
        """Give it all as plain values, SI units; null where there is no number."""
        different = len(self.different()) if self.recorded else None
        return {
            'finger': self.finger,
            'readings': self.readings,
            'contacts': self.contacts,
            'refused': self.refused,
            'kept': self.kept,
            'different': different,
            'ticks': [{k: _plain(v) for k, v in tick._asdict().items()} for tick in self.ticks],
            'sensed': None if self.sensed is None else [tick.as_json() for tick in self.sensed],
        }


def _number(v_x: float | None) -> float:
    return math.nan if v_x is None else v_x


def _plain(value: object) -> object:
    return None if isinstance(value, float) and not math.isfinite(value) else value
