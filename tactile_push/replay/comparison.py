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
    """A control period of the replay beside the recorded one, NaN where there is none."""

    time: float  #: since the beginning of the bag [s]
    theta: float  #: what the law used [rad]
    phi: float  #: what the law gave [rad]
    v_x: float  #: what the law commands now [m/s]
    v_x_recorded: float  #: what was commanded then [m/s]
    state: str  #: what the controller does now, one of `control.STATES`
    stop_reason: str  #: one of `control.STOP_REASONS`
    v_y: float = 0.0  #: what is commanded along the belt now [m/s]
    v_y_recorded: float = 0.0  #: the same then [m/s]

    @property
    def differs(self) -> bool:
        """Whether the command is not to the bit what was commanded."""
        none = math.isnan(self.v_x) and math.isnan(self.v_x_recorded)
        return self.v_y != self.v_y_recorded or (self.v_x != self.v_x_recorded and not none)


class SensedTick(NamedTuple):
    """Where along the edge the finger was by one control period."""

    time: float  #: of the control period, since the beginning of the bag [s]
    d: float  #: the contact at the last reading [m]; NaN if nothing is known
    d_lower: float  #: bounds of its 95 % interval [m]
    d_upper: float  #: the same
    d_least: float  #: its guaranteed bounds [m]
    d_most: float  #: the same

    @classmethod
    def of(cls, time: float, values: Mapping[str, float]) -> 'SensedTick':
        """Return what the numbers of `active_sensing/state` say of d at a time [s]."""
        return cls(time, *(values[name] for name in cls._fields[1:]))

    def as_json(self) -> dict[str, object]:
        """Return plain values in SI units, None where there is no number."""
        return {name: _plain(value) for name, value in self._asdict().items()}


@dataclass
class Comparison:
    """How the commands of a finger compare."""

    finger: str  #: its namespace, '' for the root
    ticks: list[ReplayedTick] = field(default_factory=list)  #: the control periods
    kept: int = 0  #: first control periods, which depend on what was before the bag
    went_back: int = 0  #: kept ones whose stamp is before that of the one before them
    recorded: bool = True  #: whether the bag has control periods to compare with
    readings: int = 0  #: replayed
    contacts: int = 0  #: found in them
    refused: dict[str, int] = field(default_factory=dict)  #: readings by reason
    without_effect: list[str] = field(default_factory=list)  #: wanted parameters the bag decides
    sensed: list[SensedTick] | None = None  #: None if the object was not sensed
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
                time=time,
                theta=tick.theta,
                phi=tick.phi,
                v_x=_number(tick.v_x),
                v_x_recorded=_number(recorded.v_x if recorded else None),
                state=tick.state,
                stop_reason=tick.stop_reason,
                v_y=tick.v_y,
                v_y_recorded=recorded.v_y if recorded else math.nan,
            )
        )

    def different(self) -> list[ReplayedTick]:
        """Return the control periods whose command is not to the bit what was commanded."""
        return [tick for tick in self.ticks if tick.differs] if self.recorded else []

    def as_json(self) -> dict[str, object]:
        """Return plain values in SI units, None where there is no number."""
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
