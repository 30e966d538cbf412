# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A control period, and the same as numbers with names, as it is published and recorded."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from tactile_push.control.law import PushLaw
from tactile_push.control.states import ANOTHER_COMMAND, STATES, STOP_REASONS


@dataclass(frozen=True)
class Tick:
    """All that one control period used and gave.

    Parameters
    ----------
    state : str
        One of `STATES`.
    stop_reason : str
        One of `STOP_REASONS`; `NO_REASON` unless stopped.
    theta : float
        Last sensed angle of the edge [rad]; NaN if there is none.
    phi : float
        Push angle [rad]; straight ahead while the finger rests.
    v_x : float or None
        Commanded finger velocity [m/s]; None before the first contact, and before the law has
        something to do: whoever moves the finger then, it is not this controller.
    silence : float
        Time since the last contact was sensed or, before the first one, since activation or since
        the clock went back [s].
    saturated : bool
        Whether phi is at one of its bounds.
    limited : bool
        Whether the law asked for more than the bounds on v_x and its change allow.
    finger_x : float
        Last known position of the finger across the belt [m]; NaN if there is none.
    ticks : int
        Ticks of the law since activation, this one included.
    ticks_lost : int
        Control periods since activation that passed without a tick.
    elapsed : float
        Time since the last tick on a clock that cannot be set [s]; NaN if that is not known.
    finger_age : float
        Time since the finger was at that position [s]; NaN if there is none.
    psi : float
        Angle of the finger tip's pole when the finger was there [rad]; NaN if it is not known.
    trim : float
        By how much steadying has moved theta_d [rad].
    v_y : float
        Commanded velocity of the finger along the belt, against its motion [m/s]; 0 while it
        pushes.
    apart : bool
        Whether the finger is off the object on purpose from then on, or about to leave it.
    """

    state: str
    stop_reason: str
    theta: float
    phi: float
    v_x: float | None
    silence: float
    saturated: bool
    limited: bool
    finger_x: float
    ticks: int
    ticks_lost: int
    elapsed: float
    finger_age: float
    psi: float = math.nan
    trim: float = 0.0
    v_y: float = 0.0
    apart: bool = False

    def x_at_reading(self, before: float) -> float:
        """Return where the finger was at the reading [m]; NaN if the joints do not tell.

        Between joint states and reading, which are never far apart, it followed its command.

        Parameters
        ----------
        before : float
            Velocity of the finger before the tick [m/s]; NaN if it is not known.

        Returns
        -------
        float
            Centre of the disk across the belt [m].
        """
        return self.finger_x + before * (self.finger_age - self.silence)

    @property
    def known_velocity(self) -> float:
        """Velocity of the finger from then on [m/s]; NaN if somebody else may move it."""
        return math.nan if self.v_x is None or self.stop_reason == ANOTHER_COMMAND else self.v_x


def tick_values(tick: Tick, law: PushLaw) -> dict[str, float]:
    """Return all inputs and outputs of a control period by name.

    Parameters
    ----------
    tick : Tick
        The control period.
    law : PushLaw
        The law that acted in it.

    Returns
    -------
    dict of str to float
        The numbers by name, SI units; NaN where there is none.
    """
    return {
        'theta': tick.theta,
        'theta_desired': law.aim,
        'phi': tick.phi,
        'v_x': math.nan if tick.v_x is None else tick.v_x,
        'kp': law.kp,
        'kd': law.kd,
        'silence': tick.silence,
        'saturated': float(tick.saturated),
        'limited': float(tick.limited),
        'finger_x': tick.finger_x,
        'state': float(STATES.index(tick.state)),
        'stop_reason': float(STOP_REASONS.index(tick.stop_reason)),
        'ticks': float(tick.ticks),
        'ticks_lost': float(tick.ticks_lost),
        'elapsed': tick.elapsed,
        'finger_age': tick.finger_age,
        'psi': tick.psi,
        'trim': tick.trim,
        'v_y': tick.v_y,
        'apart': float(tick.apart),
    }


def tick_of(values: Mapping[str, float]) -> Tick:
    """Return the control period that numbers describe.

    Parameters
    ----------
    values : mapping of str to float
        The numbers by name. Those from `elapsed` on may be missing, as in older recordings. Without
        `psi` the tip is taken to point straight ahead.

    Returns
    -------
    Tick
        The control period.

    Raises
    ------
    ValueError
        If a number is missing or impossible.
    """
    try:
        return Tick(
            state=STATES[_index(values['state'])],
            stop_reason=STOP_REASONS[_index(values['stop_reason'])],
            theta=values['theta'],
            phi=values['phi'],
            v_x=None if math.isnan(values['v_x']) else values['v_x'],
            silence=values['silence'],
            saturated=bool(values['saturated']),
            limited=bool(values['limited']),
            finger_x=values['finger_x'],
            ticks=int(values['ticks']),
            ticks_lost=int(values['ticks_lost']),
            elapsed=values.get('elapsed', math.nan),
            finger_age=values.get('finger_age', math.nan),
            psi=values.get('psi', math.pi / 2.0),
            trim=values.get('trim', 0.0),
            v_y=values.get('v_y', 0.0),
            apart=bool(values.get('apart', 0.0)),
        )
    except (KeyError, IndexError, ValueError, OverflowError) as error:
        raise ValueError(f'no control period: {error}') from None


def _index(value: float) -> int:
    if not value >= 0.0:
        raise ValueError(f'{value} is no state and no reason')
    return int(value)
