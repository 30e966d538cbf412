# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A control period as numbers with names, as it is published and recorded, and back."""

import math
from collections.abc import Mapping

from tactile_push.control.law import PushLaw
from tactile_push.control.push_control import Tick
from tactile_push.control.states import STATES, STOP_REASONS


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
    }


def tick_of(values: Mapping[str, float]) -> Tick:
    """Return the control period that numbers describe.

    Parameters
    ----------
    values : mapping of str to float
        The numbers by name. `elapsed`, `finger_age`, `psi` and `trim` may be missing, as in older
        recordings. Without `psi` the tip is taken to point straight ahead.

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
        )
    except (KeyError, IndexError, ValueError, OverflowError) as error:
        raise ValueError(f'no control period: {error}') from None


def _index(value: float) -> int:
    if not value >= 0.0:
        raise ValueError(f'{value} is no state and no reason')
    return int(value)
